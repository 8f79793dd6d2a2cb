// Two passes: springs in blocks, then particles.
#include "mysim/spring_kernel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace crosscheck {
namespace {

constexpr int block = 32;  // springs at a time: their scratch arrays stay in the first-level cache

int padded(size_t n) { return static_cast<int>((n + block - 1) / block * block); }

/// 1 when one of the numbers, none of them negative, is 0. Written on their bits: a comparison would end in a branch.
bool any_zero(const double (&numbers)[block]) {
  std::uint64_t found = 0;
  for (double number : numbers) found |= (std::bit_cast<std::uint64_t>(number) - 1) >> 63;
  return found != 0;
}

}  // namespace

SpringKernel::SpringKernel(const Springs& springs, int particles)
    : law_(springs.law), x_(Columns::Zero(4, particles)), begin_at_(particles + 1, 0), end_at_(particles + 1, 0) {
  std::vector<Spring> list = springs.list;
  std::stable_sort(list.begin(), list.end(), [](const Spring& p, const Spring& q) { return p.a < q.a; });
  const int n = static_cast<int>(list.size());
  ends_.assign(padded(n), {0, 0});
  k_.assign(padded(n), 0);
  rest_.assign(padded(n), 0);
  force_.resize(4, padded(n));
  for (int i = 0; i < n; ++i) {
    const Spring& s = list[i];
    ends_[i] = {s.a, s.b};
    k_[i] = s.k;
    rest_[i] = s.rest;
    ++begin_at_[s.a + 1];
    ++end_at_[s.b + 1];
  }
  for (int i = 0; i < particles; ++i) {
    begin_at_[i + 1] += begin_at_[i];
    end_at_[i + 1] += end_at_[i];
  }
  ending_.resize(n);
  std::vector<int> next = end_at_;
  for (int i = 0; i < n; ++i) ending_[next[ends_[i].b]++] = i;
}

/// Writes the force on end a of each spring; returns how many springs of rest length above zero had no length.
long SpringKernel::spring_pass() {
  long coincident = 0;
  Eigen::Matrix<double, 4, block> d;
  double l2[block], scale[block];
  for (size_t begin = 0; begin < ends_.size(); begin += block) {
    const Ends* ends = &ends_[begin];
    const double *k = &k_[begin], *rest = &rest_[begin];
    for (int i = 0; i < block; ++i) {
      d.col(i) = x_.col(ends[i].a) - x_.col(ends[i].b);
      l2[i] = d.col(i).squaredNorm();
    }
    // the same operations as in the plain loop, several springs side by side: -T(L) / L
    if (law_ == SpringLaw::hooke) {
      for (int i = 0; i < block; ++i) {
        const double length = std::sqrt(l2[i]);
        scale[i] = k[i] * (rest[i] - length) / length;
      }
    } else {
      for (int i = 0; i < block; ++i) {
        const double r2 = rest[i] * rest[i];
        scale[i] = k[i] * (r2 - l2[i]) / (l2[i] + r2);
      }
    }
    if (any_zero(l2))  // ends that met have no direction and get no force; padding, which has no length, ends here too
      for (int i = 0; i < block; ++i)
        if (l2[i] == 0) {
          scale[i] = 0;
          coincident += rest[i] > 0;
        }
    for (int i = 0; i < block; ++i) force_.col(static_cast<int>(begin) + i) = scale[i] * d.col(i);
  }
  return coincident;
}

void SpringKernel::add_force(const Points& x, Forces& forces) {
  x_.topRows<3>() = x;
  forces.coincident += spring_pass();
  for (int i = 0; i < forces.f.cols(); ++i) {
    Eigen::Vector4d pulls = Eigen::Vector4d::Zero(), pushes = Eigen::Vector4d::Zero();
    for (int e = begin_at_[i]; e < begin_at_[i + 1]; ++e) pulls += force_.col(e);
    for (int e = end_at_[i]; e < end_at_[i + 1]; ++e) pushes += force_.col(ending_[e]);
    forces.f.col(i) += (pulls - pushes).head<3>();
  }
}

}  // namespace crosscheck
