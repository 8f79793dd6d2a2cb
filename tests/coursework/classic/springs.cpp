#include "tests/coursework/classic/springs.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

namespace coursework::classic {

Springs springs_of(const probe::Findings& found) {
  Springs springs{static_cast<int>(found.places.size()),
                  found.repeats,
                  found.places,
                  found.fixed,
                  found.still,
                  found.moved,
                  found.fixed,
                  {}};
  if (!std::count(found.fixed.begin(), found.fixed.end(), true))
    for (std::size_t i = 0; i < found.places.size(); ++i)
      if (found.tied[i]) springs.anchors[i] = springs.still[i] = true;
  for (const probe::Pull& pull : found.pulls) {
    Spring spring{static_cast<int>(pull.a), static_cast<int>(pull.b), 0, 0, false, pull.measured, pull};
    const auto& [s, p, across] = std::tie(pull.at, pull.along, pull.across);
    if (pull.measured) {
      spring.k = (double(p[1]) - p[0]) / (double(s[1]) - s[0]);
      spring.rest = s[0] - p[0] / spring.k;
      if (!std::isfinite(spring.k) || !std::isfinite(spring.rest)) continue;
      const double foreseen = spring.k * (s[2] - spring.rest);
      const double size = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
      // single precision with a dozen other springs leaves 1e-5; a law of another shape deviates by a tenth
      spring.linear =
          std::abs(p[2] - foreseen) < 0.01 * size && std::max({across[0], across[1], across[2]}) < 0.01 * size;
    }
    springs.all.push_back(spring);
  }
  return springs;
}

namespace {

std::optional<Grid> grid_by_place(const Springs& s) {
  const int n = s.particles;
  if (n < 4) return {};
  const auto step = [&](int i) {
    return probe::plus(s.places[static_cast<std::size_t>(i) + 1], -1, s.places[static_cast<std::size_t>(i)]);
  };
  const probe::Plain first = step(0);
  const auto alike = [&](int i) { return length(probe::plus(step(i), -1, first)) < 0.5f * length(first); };
  if (!(length(first) > 0)) return {};
  int columns = 1;
  while (columns < n && alike(columns - 1)) ++columns;
  if (columns < 2 || columns == n || n % columns != 0) return {};
  for (int i = 0; i + 1 < n; ++i)
    if (alike(i) != ((i + 1) % columns != 0)) return {};
  return Grid{n / columns, columns};
}

}  // namespace

bool of_a_family(const Grid& grid, int a, int b) {
  const int down = std::abs(grid.row(a) - grid.row(b)), side = std::abs(grid.column(a) - grid.column(b));
  return (down <= 1 && side <= 1) || (down + side == 2 && down * side == 0);
}

std::optional<Grid> grid_of(const Springs& s) {
  if (const auto grid = grid_by_place(s)) return grid;
  std::optional<Grid> best;
  int most = 0;
  for (int columns = 2; columns <= s.particles / 2; ++columns) {
    if (s.particles % columns != 0) continue;
    const Grid grid{s.particles / columns, columns};
    int fit = 0;
    // springs of a family count in favour, all others against
    for (const Spring& one : s.all) fit += of_a_family(grid, one.a, one.b) ? 1 : -1;
    if (fit > most) most = fit, best = grid;
  }
  return best;
}

}  // namespace coursework::classic
