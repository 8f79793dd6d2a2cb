#include "tests/coursework/classic/springs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace coursework::classic {

Springs springs_of(const Numbers& raw) {
  Springs springs;
  if (raw.empty() || !(raw[0] >= 1) || raw[0] > 1e5) return springs;
  const auto n = static_cast<std::size_t>(raw[0]);
  const auto whole = static_cast<double>(n);  // an index just below a fraction would be one too many
  if (raw.size() < 1 + 6 * n + 2) return springs;
  std::size_t at = 1;
  for (std::size_t i = 0; i < n; ++i, at += 3) {
    springs.x.push_back(raw[at]);
    springs.y.push_back(raw[at + 1]);
    springs.z.push_back(raw[at + 2]);
  }
  // one that never moves, or never gathers speed, is fixed
  for (std::size_t i = 0; i < n; ++i) springs.fixed.push_back(raw[at + i] == 0 || raw[at + n + i] == 0);
  for (std::size_t i = 0; i < n; ++i) springs.still.push_back(raw[at + i] == 0 || raw[at + 2 * n + i] == 0);
  at += 3 * n;
  springs.repeats = raw[at++] == 1;
  const double count = raw[at++];
  springs.moved.assign(n, false);
  for (double i = 0; i < count && at < raw.size(); ++i) {
    const double index = raw[at++];
    if (index >= 0 && index < whole) springs.moved[static_cast<std::size_t>(index)] = true;
  }
  springs.particles = static_cast<int>(n);
  for (; at + 11 <= raw.size(); at += 11) {
    const double* r = &raw[at];
    if (!(r[0] >= 0 && r[0] < whole && r[1] >= 0 && r[1] < whole)) continue;
    Spring spring{static_cast<int>(r[1]), static_cast<int>(r[0]), 0, 0, false};
    const double* s = r + 2;
    const double* p = r + 5;  // along, across, along, across, ...
    spring.k = (p[2] - p[0]) / (s[1] - s[0]);
    spring.rest = s[0] - p[0] / spring.k;
    if (!std::isfinite(spring.k) || !std::isfinite(spring.rest)) continue;
    const double foreseen = spring.k * (s[2] - spring.rest);
    const double size = std::max({std::abs(p[0]), std::abs(p[2]), std::abs(p[4])});
    // single precision beside a dozen other springs leaves 1e-5; a law of another shape is out by a tenth
    spring.linear = std::abs(p[4] - foreseen) < 0.01 * size && std::max({p[1], p[3], p[5]}) < 0.01 * size;
    springs.all.push_back(spring);
  }
  return springs;
}

namespace {

std::optional<Grid> grid_by_place(const Springs& s) {
  const int n = s.particles;
  if (n < 4) return {};
  const auto step = [&](int from, int to) {
    const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
    return std::array{s.x[b] - s.x[a], s.y[b] - s.y[a], s.z[b] - s.z[a]};
  };
  const auto size = [](const std::array<double, 3>& d) { return std::hypot(d[0], d[1], d[2]); };
  const auto first = step(0, 1);
  const auto alike = [&](int i) {
    const auto d = step(i, i + 1);
    return size({d[0] - first[0], d[1] - first[1], d[2] - first[2]}) < 0.5 * size(first);
  };
  if (!(size(first) > 0)) return {};
  int columns = 1;
  while (columns < n && alike(columns - 1)) ++columns;
  if (columns < 2 || columns == n || n % columns != 0) return {};
  for (int i = 0; i + 1 < n; ++i)
    if (alike(i) != ((i + 1) % columns != 0)) return {};
  return Grid{n / columns, columns};
}

}  // namespace

std::optional<Grid> grid_of(const Springs& s) {
  if (const auto grid = grid_by_place(s)) return grid;
  std::optional<Grid> best;
  int most = 0;
  for (int columns = 2; columns <= s.particles / 2; ++columns) {
    if (s.particles % columns != 0) continue;
    const Grid grid{s.particles / columns, columns};
    int fit = 0;
    for (const Spring& one : s.all) {
      const int down = std::abs(grid.row(one.a) - grid.row(one.b));
      const int side = std::abs(grid.column(one.a) - grid.column(one.b));
      // structural, shear, flexion: those that lie close count for it, all others against
      fit += (down <= 1 && side <= 1) || (down + side == 2 && down * side == 0) ? 1 : -1;
    }
    if (fit > most) most = fit, best = grid;
  }
  return best;
}

}  // namespace coursework::classic
