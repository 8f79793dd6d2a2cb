#include "mysim/network/memory.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>

namespace crosscheck::network {
namespace {

/// m: where particles that there are none of stand, far from the others and from each other.
double nowhere(long i) { return 1e6 + 17 * static_cast<double>(i); }

}  // namespace

DiagonalMemory::DiagonalMemory(const std::vector<Turned>& diagonals, int particles) {
  const int blocks = (particles + block - 1) / block;
  for (const Turned& diagonal : diagonals) {
    const int offset = diagonal.front().b - diagonal.front().a;
    // the springs of a block, of the one before, which is finished then, and what their loads go beyond
    const long places = std::bit_ceil(static_cast<unsigned long>(offset + 3 * block));
    rings_.emplace_back(3 * (places + block));
    diagonals_.push_back(
        {offset, diagonal.front().a / block, diagonal.back().a / block + 1, places - 1, rings_.back().data()});
  }
  const long apart = block * (blocks + 2L);
  x_ = Lines<double>(3 * apart);
  for (int c = 0; c < 3; ++c)
    for (long i = 0; i < apart; ++i) x_.data()[c * apart + i] = nowhere(i);
  pulls_ = Lines<double>(2 * 3 * block);
  view_ = {particles, blocks,       static_cast<int>(diagonals.size()), diagonals_.data(), nullptr, nullptr,
           {},        pulls_.data()};
  for (int c = 0; c < 3; ++c) view_.x[c] = x_.data() + c * apart + block;
  fill_lines(diagonals);
}

void DiagonalMemory::fill_lines(const std::vector<Turned>& diagonals) {
  using Line = std::array<double, 2 * block>;
  using Bits = std::array<std::uint64_t, 2 * block>;
  std::map<Bits, int> known;
  std::vector<Line> lines;
  std::vector<size_t> next(diagonals.size(), 0);
  for (int b = 0; b < view_.blocks; ++b)
    for (size_t i = 0; i < diagonals.size(); ++i) {
      if (b < diagonals_[i].first || b >= diagonals_[i].last) continue;
      Line line{};
      for (; next[i] < diagonals[i].size() && diagonals[i][next[i]].a / block == b; ++next[i]) {
        const Spring& s = diagonals[i][next[i]];
        line[s.a % block] = s.k;
        line[block + s.a % block] = s.rest;
      }
      const auto [at, is_new] = known.try_emplace(std::bit_cast<Bits>(line), static_cast<int>(lines.size()));
      if (is_new) lines.push_back(line);
      line_.push_back(at->second);
    }
  lines_ = Lines<double>(lines.size() * 2 * block);
  for (size_t i = 0; i < lines.size(); ++i) std::copy(lines[i].begin(), lines[i].end(), lines_.data() + 2 * block * i);
  view_.line = line_.data();
  view_.lines = lines_.data();
}

long DiagonalMemory::met() const {
  long met = 0;
  const int* line = view_.line;
  for (int b = 0; b < view_.blocks; ++b)
    for (const Diagonal& diagonal : diagonals_) {
      if (b < diagonal.first || b >= diagonal.last) continue;
      const double* rest = view_.lines + 2L * block * *line++ + block;
      for (int lane = 0; lane < block; ++lane) {
        double squared = 0;
        for (const double* x : view_.x) {
          const double d = x[b * block + lane] - x[b * block + lane + diagonal.offset];
          squared += d * d;
        }
        met += rest[lane] > 0 && squared == 0;
      }
    }
  return met;
}

PairMemory::PairMemory(const Turned& springs, int particles) {
  const size_t count = springs.size(), padded = (count + block - 1) / block * block;
  k_ = Lines<double>(padded);
  rest_ = Lines<double>(padded);
  for (size_t i = 0; i < padded; ++i) {
    const Spring& s = i < count ? springs[i] : Spring{particles, particles + 1, 0, 0, Family::single};
    ends_.insert(ends_.end(), {4 * s.a, 4 * s.b});
    k_.data()[i] = s.k;
    rest_.data()[i] = s.rest;
  }
  x_ = Lines<double>(4 * (particles + 2L));
  for (int i = 0; i < 2; ++i)
    for (int c = 0; c < 3; ++c) x_.data()[4L * (particles + i) + c] = nowhere(i);
  force_ = Lines<double>(x_.size());
  view_ = {particles, static_cast<int>(padded), ends_.data(), k_.data(), rest_.data(), x_.data(), force_.data()};
}

long PairMemory::met() const {
  long met = 0;
  for (int i = 0; i < view_.springs; ++i) {
    double squared = 0;
    for (int c = 0; c < 3; ++c) {
      const double d = view_.x[ends_[2 * i] + c] - view_.x[ends_[2 * i + 1] + c];
      squared += d * d;
    }
    met += view_.rest[i] > 0 && squared == 0;
  }
  return met;
}

}  // namespace crosscheck::network
