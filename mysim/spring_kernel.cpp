// Two passes: springs in blocks, then particles.
#include "mysim/spring_kernel.h"

#include <algorithm>
#include <cmath>

namespace crosscheck {
namespace {

constexpr int block = 64;  // springs at a time: their scratch arrays stay in the first-level cache

int padded(size_t n) { return static_cast<int>((n + block - 1) / block * block); }

}  // namespace

SpringKernel::SpringKernel(const Springs& springs, int particles) : law_(springs.law) {
  const int n = static_cast<int>(springs.list.size());
  ends_.assign(padded(n), {0, 0});
  k_.assign(padded(n), 0);
  rest_.assign(padded(n), 0);
  force_.resize(3, padded(n));
  first_.assign(particles + 1, 0);
  for (int i = 0; i < n; ++i) {
    const Spring& s = springs.list[i];
    ends_[i] = {s.a, s.b};
    k_[i] = s.k;
    rest_[i] = s.rest;
    ++first_[s.a + 1];
    ++first_[s.b + 1];
  }
  for (int i = 0; i < particles; ++i) first_[i + 1] += first_[i];
  spring_.resize(2 * springs.list.size());
  sign_.resize(spring_.size());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int i = 0; i < n; ++i)
    for (const auto& [end, sign] : {std::pair{ends_[i].a, 1.0}, std::pair{ends_[i].b, -1.0}}) {
      spring_[next[end]] = i;
      sign_[next[end]++] = sign;
    }
}

/// Writes the force on end a of each spring; returns how many springs of rest length above zero had no length.
long SpringKernel::spring_pass(const Points& x) {
  const double* at = x.data();
  double* out = force_.data();
  long coincident = 0;
  double d[3][block], l2[block], scale[block];
  for (size_t begin = 0; begin < ends_.size(); begin += block) {
    const Ends* ends = &ends_[begin];
    const double *k = &k_[begin], *rest = &rest_[begin];
    for (int i = 0; i < block; ++i) {
      const double *a = at + 3 * ends[i].a, *b = at + 3 * ends[i].b;
      for (int axis = 0; axis < 3; ++axis) d[axis][i] = a[axis] - b[axis];
    }
    for (int i = 0; i < block; ++i) l2[i] = d[0][i] * d[0][i] + d[1][i] * d[1][i] + d[2][i] * d[2][i];
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
    double shortest = 1;
    for (int i = 0; i < block; ++i) shortest = std::min(shortest, l2[i]);
    if (shortest == 0)  // ends that met have no direction and get no force; padding, which has no length, ends here too
      for (int i = 0; i < block; ++i)
        if (l2[i] == 0) {
          scale[i] = 0;
          coincident += rest[i] > 0;
        }
    for (int i = 0; i < block; ++i)
      for (int axis = 0; axis < 3; ++axis) out[3 * (begin + i) + axis] = scale[i] * d[axis][i];
  }
  return coincident;
}

void SpringKernel::add_force(const Points& x, Forces& forces) {
  forces.coincident += spring_pass(x);
  const double* f = force_.data();
  for (int i = 0; i < forces.f.cols(); ++i) {
    double sum[3] = {0, 0, 0};
    for (int e = first_[i]; e < first_[i + 1]; ++e)
      for (int axis = 0; axis < 3; ++axis) sum[axis] += sign_[e] * f[3 * spring_[e] + axis];
    for (int axis = 0; axis < 3; ++axis) forces.f(axis, i) += sum[axis];
  }
}

}  // namespace crosscheck
