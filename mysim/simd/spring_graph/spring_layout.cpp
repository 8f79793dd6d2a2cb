#include "mysim/simd/spring_graph/spring_layout.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <map>

namespace crosscheck::spring_graph {

COMPILED_FOR_EACH_INSTRUCTION_SET(Kernels kernels_of(bool hooke))

Kernels kernels(simd::InstructionSet isa, SpringLaw law) {
  return SELECT_COMPILED(isa, kernels_of)(law == SpringLaw::hooke);
}

namespace {

/// Coordinate (m) of a padding particle, far from the real particles and from other padding particles.
double padding_position(long i) { return 1e6 + 17 * static_cast<double>(i); }

}  // namespace

DiaStorage::DiaStorage(const std::vector<OrientedSprings>& diagonals, int particles) {
  const int tiles = (particles + tile - 1) / tile;
  for (const OrientedSprings& diagonal : diagonals) {
    assert(!diagonal.empty() && diagonal.front().a < diagonal.front().b && diagonal.back().b < particles);
    const int offset = diagonal.front().b - diagonal.front().a;
    // room for the springs of a tile, of the previous tile (being finished), and for loads beyond them
    const long places = std::bit_ceil(static_cast<unsigned long>(offset + 3 * tile));
    rings_.emplace_back(3 * (places + tile));
    diagonals_.push_back(
        {offset, diagonal.front().a / tile, diagonal.back().a / tile + 1, places - 1, rings_.back().data()});
  }
  const long apart = tile * (tiles + 2L);
  x_ = AlignedBuffer<double>(3 * apart);
  for (int c = 0; c < 3; ++c)
    for (long i = 0; i < apart; ++i) x_.data()[c * apart + i] = padding_position(i);
  pulls_ = AlignedBuffer<double>(2 * 3 * tile);
  view_ = {particles, tiles,        static_cast<int>(diagonals.size()), diagonals_.data(), nullptr, nullptr,
           {},        pulls_.data()};
  for (int c = 0; c < 3; ++c) view_.x[c] = x_.data() + c * apart + tile;
  fill_coefficients(diagonals);
}

void DiaStorage::fill_coefficients(const std::vector<OrientedSprings>& diagonals) {
  using CoefficientRow = std::array<double, 2 * tile>;
  using Bits = std::array<std::uint64_t, 2 * tile>;
  std::map<Bits, int> known;
  std::vector<CoefficientRow> coefficients;
  std::vector<size_t> next(diagonals.size(), 0);
  for (int b = 0; b < view_.tiles; ++b)
    for (size_t i = 0; i < diagonals.size(); ++i) {
      if (b < diagonals_[i].first || b >= diagonals_[i].last) continue;
      CoefficientRow coefficient_row{};
      for (; next[i] < diagonals[i].size() && diagonals[i][next[i]].a / tile == b; ++next[i]) {
        const Spring& s = diagonals[i][next[i]];
        coefficient_row[s.a % tile] = s.k;
        coefficient_row[tile + s.a % tile] = s.rest;
      }
      const auto [at, is_new] =
          known.try_emplace(std::bit_cast<Bits>(coefficient_row), static_cast<int>(coefficients.size()));
      if (is_new) coefficients.push_back(coefficient_row);
      coefficient_row_.push_back(at->second);
    }
  coefficients_ = AlignedBuffer<double>(coefficients.size() * 2 * tile);
  for (size_t i = 0; i < coefficients.size(); ++i)
    std::copy(coefficients[i].begin(), coefficients[i].end(), coefficients_.data() + 2 * tile * i);
  view_.coefficient_row = coefficient_row_.data();
  view_.coefficients = coefficients_.data();
}

long DiaStorage::degenerate_springs() const {
  long degenerate_springs = 0;
  const int* coefficient_row = view_.coefficient_row;
  for (int b = 0; b < view_.tiles; ++b)
    for (const Diagonal& diagonal : diagonals_) {
      if (b < diagonal.first || b >= diagonal.last) continue;
      const double* rest = view_.coefficients + 2L * tile * *coefficient_row++ + tile;
      for (int lane = 0; lane < tile; ++lane) {
        double squared = 0;
        for (const double* x : view_.x) {
          const double d = x[b * tile + lane] - x[b * tile + lane + diagonal.offset];
          squared += d * d;
        }
        degenerate_springs += rest[lane] > 0 && squared == 0;
      }
    }
  return degenerate_springs;
}

CooStorage::CooStorage(const OrientedSprings& springs, int particles) {
  const size_t count = springs.size(), padded = (count + tile - 1) / tile * tile;
  k_ = AlignedBuffer<double>(padded);
  rest_ = AlignedBuffer<double>(padded);
  for (size_t i = 0; i < padded; ++i) {
    const Spring& s = i < count ? springs[i] : Spring{particles, particles + 1, 0, 0, Family::single};
    assert(0 <= s.a && s.a < s.b && s.b <= particles + 1);
    ends_.insert(ends_.end(), {4 * s.a, 4 * s.b});
    k_.data()[i] = s.k;
    rest_.data()[i] = s.rest;
  }
  x_ = AlignedBuffer<double>(4 * (particles + 2L));
  for (int i = 0; i < 2; ++i)
    for (int c = 0; c < 3; ++c) x_.data()[4L * (particles + i) + c] = padding_position(i);
  force_ = AlignedBuffer<double>(x_.size());
  view_ = {particles, static_cast<int>(padded), ends_.data(), k_.data(), rest_.data(), x_.data(), force_.data()};
}

long CooStorage::degenerate_springs() const {
  long degenerate_springs = 0;
  for (int i = 0; i < view_.springs; ++i) {
    double squared = 0;
    for (int c = 0; c < 3; ++c) {
      const double d = view_.x[ends_[2 * i] + c] - view_.x[ends_[2 * i + 1] + c];
      squared += d * d;
    }
    degenerate_springs += view_.rest[i] > 0 && squared == 0;
  }
  return degenerate_springs;
}

namespace {

Spring oriented(Spring s) {
  if (s.a > s.b) std::swap(s.a, s.b);
  return s;
}

bool by_first_end(const Spring& p, const Spring& q) { return p.a < q.a; }

/// Number of tiles from the first to the last in which these springs begin; `order`: their indices, sorted by `a`.
int tiles_of(const std::vector<Spring>& springs, const std::vector<int>& order) {
  return oriented(springs[order.back()]).a / tile + 1 - oriented(springs[order.front()]).a / tile;
}

/// Springs by offset, sorted by `a`; includes only the first of several springs between the same two particles.
std::map<int, std::vector<int>> by_offset(const std::vector<Spring>& springs) {
  std::map<int, std::vector<int>> found;
  for (size_t i = 0; i < springs.size(); ++i)
    if (springs[i].a != springs[i].b) found[std::abs(springs[i].b - springs[i].a)].push_back(static_cast<int>(i));
  for (auto& [offset, order] : found) {
    const auto begin = [&](int i) { return oriented(springs[i]).a; };
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return begin(i) < begin(j); });
    const auto same = [&](int i, int j) { return begin(i) == begin(j); };
    order.erase(std::unique(order.begin(), order.end(), same), order.end());
  }
  return found;
}

}  // namespace

SpringPartition partition_springs(const std::vector<Spring>& springs, int particles, const Costs& costs) {
  const auto as_coo = [&](double n) { return costs.call + particles * costs.coo_particle + n * costs.coo_spring; };
  const double all = static_cast<double>(springs.size());
  const double elsewhere = std::min(costs.plain, as_coo(all) / std::max(1.0, all));  // cost of a spring outside DIA

  SpringPartition partition;
  std::vector<bool> taken(springs.size(), false);
  double cost = costs.call + (particles + tile - 1) / tile * costs.tile, saved = 0;
  for (const auto& [offset, order] : by_offset(springs)) {
    const double coefficients = tiles_of(springs, order) * costs.coefficient_row,
                 instead = static_cast<double>(order.size()) * elsewhere;
    if (coefficients >= instead) continue;
    cost += coefficients;
    saved += instead;
    partition.dia.emplace_back();
    for (const int i : order) {
      partition.dia.back().push_back(oriented(springs[i]));
      taken[i] = true;
    }
  }
  if (cost >= saved) {
    partition.dia.clear();
    taken.assign(springs.size(), false);
  }

  for (size_t i = 0; i < springs.size(); ++i)
    if (!taken[i]) (springs[i].a == springs[i].b ? partition.plain : partition.coo).push_back(springs[i]);
  const double left = static_cast<double>(partition.coo.size());
  if (as_coo(left) >= left * costs.plain) {
    partition.coo.clear();
    partition.plain.clear();
    for (size_t i = 0; i < springs.size(); ++i)
      if (!taken[i]) partition.plain.push_back(springs[i]);
  }
  for (Spring& s : partition.coo) s = oriented(s);
  std::stable_sort(partition.coo.begin(), partition.coo.end(), by_first_end);
  assert(static_cast<size_t>(std::count(taken.begin(), taken.end(), false)) ==
         partition.coo.size() + partition.plain.size());
  return partition;
}

}  // namespace crosscheck::spring_graph
