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

/// Coordinates of the same particle should not fall on the same places of the first-level cache, which repeat every 64
/// lines.
long apart_in_cache(long lines) { return lines + (21 - lines % 64 + 64) % 64; }

}  // namespace

BandMemory::BandMemory(const std::vector<Turned>& bands, int particles) {
  const int blocks = (particles + block - 1) / block;
  for (const Turned& band : bands) {
    const int offset = band.front().b - band.front().a;
    // the springs of a block, of the one before, which is finished then, and what their loads go beyond
    const long places = std::bit_ceil(static_cast<unsigned long>(offset + 3 * block));
    rings_.emplace_back(3 * (places + block));
    bands_.push_back({offset, band.front().a / block, band.back().a / block + 1, places - 1, rings_.back().data()});
  }
  const long apart = block * apart_in_cache(blocks + 2);
  x_ = Lines<double>(3 * apart);
  for (int c = 0; c < 3; ++c)
    for (long i = 0; i < apart; ++i) x_.data()[c * apart + i] = nowhere(i);
  pulls_ = Lines<double>(2 * 3 * block);
  view_ = {particles, blocks, static_cast<int>(bands.size()), bands_.data(), nullptr, nullptr, {}, pulls_.data()};
  for (int c = 0; c < 3; ++c) view_.x[c] = x_.data() + c * apart + block;
  fill_lines(bands);
}

void BandMemory::fill_lines(const std::vector<Turned>& bands) {
  using Line = std::array<double, 2 * block>;
  using Bits = std::array<std::uint64_t, 2 * block>;
  std::map<Bits, int> known;
  std::vector<Line> lines;
  std::vector<size_t> next(bands.size(), 0);
  for (int b = 0; b < view_.blocks; ++b)
    for (size_t i = 0; i < bands.size(); ++i) {
      if (b < bands_[i].first || b >= bands_[i].last) continue;
      Line line{};
      for (; next[i] < bands[i].size() && bands[i][next[i]].a / block == b; ++next[i]) {
        const Spring& s = bands[i][next[i]];
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

long BandMemory::met() const {
  long met = 0;
  const int* line = view_.line;
  for (int b = 0; b < view_.blocks; ++b)
    for (const Band& band : bands_) {
      if (b < band.first || b >= band.last) continue;
      const double* rest = view_.lines + 2L * block * *line++ + block;
      for (int lane = 0; lane < block; ++lane) {
        double squared = 0;
        for (const double* x : view_.x) {
          const double d = x[b * block + lane] - x[b * block + lane + band.offset];
          squared += d * d;
        }
        met += rest[lane] > 0 && squared == 0;
      }
    }
  return met;
}

PairMemory::PairMemory(const Turned& springs, int particles) : begin_(particles + 1, 0), end_(particles + 1, 0) {
  const size_t count = springs.size(), padded = (count + group - 1) / group * group;
  ends_.assign(2 * padded, 0);
  k_ = Lines<double>(padded);
  rest_ = Lines<double>(padded);
  for (size_t i = 0; i < padded; ++i) {
    ends_[2 * i + 1] = 4 * particles;
    if (i >= count) continue;
    const Spring& s = springs[i];
    ends_[2 * i] = 4 * s.a;
    ends_[2 * i + 1] = 4 * s.b;
    k_.data()[i] = s.k;
    rest_.data()[i] = s.rest;
    ++begin_[s.a + 1];
    ++end_[s.b + 1];
  }
  for (int i = 0; i < particles; ++i) {
    begin_[i + 1] += begin_[i];
    end_[i + 1] += end_[i];
  }
  ending_.resize(count);
  std::vector<int> next = end_;
  for (size_t i = 0; i < count; ++i) ending_[next[springs[i].b]++] = static_cast<int>(i);

  x_ = Lines<double>(4 * (particles + 1L));
  for (int c = 0; c < 3; ++c) x_.data()[4L * particles + c] = nowhere(0);
  const long ring = places();
  for (int& place : ending_) place = static_cast<int>(place & (ring - 1));
  force_ = Lines<double>(4 * (ring + 1));
  view_ = {particles,   static_cast<int>(padded), ends_.data(), k_.data(),     rest_.data(), begin_.data(),
           end_.data(), ending_.data(),           x_.data(),    force_.data(), ring - 1};
}

/// A power of two: as many as are computed after the first spring of a particle and before it is finished.
long PairMemory::places() const {
  long most = group;
  for (size_t i = 0; i + 1 < begin_.size(); ++i) {
    const long finished = (begin_[i + 1] + group - 1) / group * group;
    long first = begin_[i];
    if (end_[i] < end_[i + 1]) first = std::min<long>(first, ending_[end_[i]]);
    most = std::max(most, finished - first);
  }
  return static_cast<long>(std::bit_ceil(static_cast<unsigned long>(most)));
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
