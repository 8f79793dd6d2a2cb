// Springs from the pair probe, and oracles on them: their law, the chain, the families of the cloth.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>

#include "tests/coursework/classic/oracles.h"
#include "tests/coursework/classic/springs.h"

namespace coursework::classic {

Springs springs_of(const probe::Findings& found) {
  Springs springs{
      static_cast<int>(found.places.size()), found.places, found.fixed, found.still, found.moved, found.fixed, {}};
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
      // rounding of a dozen springs to single precision causes errors of 1e-5; a nonlinear law deviates by a tenth
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
    // springs of a family count in favour of the grid, all others against it
    for (const Spring& one : s.all) fit += of_a_family(grid, one.a, one.b) ? 1 : -1;
    if (fit > most) most = fit, best = grid;
  }
  return best;
}

namespace {

bool held(const Springs& s, int i) { return s.fixed[static_cast<std::size_t>(i)]; }
bool was_moved(const Springs& s, int i) { return s.moved[static_cast<std::size_t>(i)]; }

/// True if moving b would show a spring between a and b at particle a.
bool shows(const Springs& s, int a, int b) { return was_moved(s, b) && !held(s, a); }

std::set<std::pair<int, int>> pairs_of(const Springs& s) {
  std::set<std::pair<int, int>> pairs;
  for (const Spring& one : s.all) pairs.insert({one.a, one.b});
  return pairs;
}

/// Median rest length of the springs with this offset on the grid; 0 if there are none.
double rest_of(const Springs& s, const Grid& grid, int down, int side) {
  std::vector<double> rests;
  for (const Spring& one : s.all)
    if (one.measured && grid.row(one.b) - grid.row(one.a) == down && grid.column(one.b) - grid.column(one.a) == side)
      rests.push_back(one.rest);
  if (rests.empty()) return 0;
  std::sort(rests.begin(), rests.end());
  return rests[rests.size() / 2];
}

/// True if the springs form one line through all particles, in any order.
bool one_line(const Springs& s) {
  std::map<int, std::set<int>> next;
  int springs = 0;
  for (const Spring& one : s.all)
    if (next[one.a].insert(one.b).second + next[one.b].insert(one.a).second > 0) ++springs;
  if (springs != s.particles - 1) return false;
  std::set<int> reached;
  std::vector<int> open = {0};
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    if (next[at].size() > 2) return false;
    if (reached.insert(at).second) open.insert(open.end(), next[at].begin(), next[at].end());
  }
  return static_cast<int>(reached.size()) == s.particles;
}

}  // namespace

Features spring_law(const Findings& found_here) {
  const Springs s = springs_of(found_here);
  int movable = 0, joined = 0, all = 0, plus = 0, minus = 0, linear = 0, rest = 0, both = 0, equal = 0;
  std::set<int> hangs;
  std::map<std::pair<int, int>, const Spring*> by_pair;
  for (const Spring& one : s.all) hangs.insert(one.a), by_pair[{one.a, one.b}] = &one;
  for (int i = 0; i < s.particles; ++i) movable += !held(s, i), joined += !held(s, i) && hangs.count(i);
  double stiffest = 0;
  for (const Spring& one : s.all) stiffest = std::max(stiffest, std::abs(one.k));
  for (const Spring& one : s.all) {
    if (held(s, one.a) || !one.measured) continue;
    ++all;
    plus += one.k > 1e-6 * stiffest;
    minus += one.k < -1e-6 * stiffest;
    linear += one.linear;
    // without a rest length, `rest` is zero up to rounding; 1e-3 is above rounding and below all lengths seen so far
    rest += one.rest > 1e-3;
    if (!shows(s, one.b, one.a)) continue;
    const auto back = by_pair.find({one.b, one.a});
    ++both;
    equal += back != by_pair.end() && std::abs(back->second->k - one.k) < 0.01 * std::abs(one.k) &&
             std::abs(back->second->rest - one.rest) < 0.01 * std::abs(one.rest) + 1e-4;
  }
  // if all other particles are fixed, no pair can be observed from both ends
  const Feature mutual = all == 0 ? 0 : both == 0 ? 1 : share(equal, both);
  // if a big cloth is probed with a few samples, some particles are not observed
  const bool seen = std::count(s.moved.begin(), s.moved.end(), true) == s.particles;
  return {seen ? share(joined, movable) : share(all > 0, 1), sign(plus, minus, all), share(linear, all),
          share(rest, all), mutual};
}

Features chain_links(const Findings& found_here) {
  const Springs s = springs_of(found_here);
  const int n = s.particles;
  const auto pairs = pairs_of(s);
  int there = 0, expected = 0, ends = 0, inner = 0;
  double others = 0;
  std::map<int, std::set<int>> next;
  for (const auto& [a, b] : pairs) {
    others += std::abs(a - b) != 1 && (a < b || !pairs.count({b, a}));
    next[a].insert(b), next[b].insert(a);
  }
  for (int i = 0; i + 1 < n; ++i) {
    if (!shows(s, i, i + 1) && !shows(s, i + 1, i)) continue;
    ++expected;
    there += (!shows(s, i, i + 1) || pairs.count({i, i + 1})) && (!shows(s, i + 1, i) || pairs.count({i + 1, i}));
  }
  const bool line = n > 2 && one_line(s);
  for (int i = 0; i < n; ++i)
    if (s.anchors[static_cast<std::size_t>(i)])
      ((line ? next[i].size() == 1 : i == 0 || i == n - 1) ? ends : inner) += 1;
  const double fixed = inner ? 2 : ends ? 1 : 0;
  if (line) return {1, 0, fixed};
  return {share(there, expected), others, fixed};
}

std::vector<Offset> family_of(const std::string& column) {
  if (column == "structural") return {{0, 1}, {1, 0}};
  if (column == "shear") return {{1, 1}, {1, -1}};
  if (column == "flexion") return {{0, 2}, {2, 0}};
  return {};
}

Features cloth_family(const Findings& found_here, const std::vector<Offset>& family) {
  const Springs s = springs_of(found_here);
  const auto grid = grid_of(s);
  if (!grid) return {0, 0, 0, 0};
  const auto pairs = pairs_of(s);
  Features found, where;
  for (const auto& [down, side] : family) {
    int there = 0, expected = 0;
    bool all_touch[4] = {true, true, true, true};
    for (int i = 0; i < s.particles; ++i) {
      const int row = grid->row(i) + down, column = grid->column(i) + side;
      if (row >= grid->rows || column < 0 || column >= grid->columns) continue;
      const int other = row * grid->columns + column;
      // a spring is observed from both ends, or from one end if the other is fixed
      const bool here = shows(s, i, other), beyond = shows(s, other, i);
      if (!here && !beyond) continue;
      ++expected;
      if ((!here || pairs.count({i, other})) && (!beyond || pairs.count({other, i}))) {
        ++there;
        continue;
      }
      const int left = std::min(column, grid->column(i)), right = std::max(column, grid->column(i));
      const bool touch[4] = {row == grid->rows - 1, right == grid->columns - 1, grid->row(i) == 0, left == 0};
      for (int border = 0; border < 4; ++border) all_touch[border] = all_touch[border] && touch[border];
    }
    found.push_back(share(there, expected));
    int borders = 1;
    for (int border = 0; border < 4; ++border) borders += all_touch[border] << border;
    where.push_back(there == 0 || there == expected ? 0 : borders);
  }
  found.insert(found.end(), where.begin(), where.end());
  return found;
}

Features cloth_others(const Findings& found_here) {
  const Springs s = springs_of(found_here);
  const auto grid = grid_of(s);
  if (!grid || s.all.empty()) return {0, 0, 0};
  double others = 0;
  int all = 0, within = 0;
  const auto pairs = pairs_of(s);
  for (const auto& [a, b] : pairs) {
    if (a > b && pairs.count({b, a})) continue;
    ++all;
    if (of_a_family(*grid, a, b)) {
      ++within;
      continue;
    }
    const int down = std::abs(grid->row(a) - grid->row(b)), side = std::abs(grid->column(a) - grid->column(b));
    const bool across = side >= grid->columns - 2 || down >= grid->rows - 2;
    others = std::max(others, across ? 1.0 : 2.0);
  }
  return {share(within, all), others, 1};
}

Features cloth_lengths(const Findings& found_here) {
  const Springs s = springs_of(found_here);
  const auto grid = grid_of(s);
  if (!grid) return {0, 0, 0};
  const double row = rest_of(s, *grid, 0, 1), column = rest_of(s, *grid, 1, 0);
  // Rows and columns may be spaced differently, so each family is compared with structural springs in its own direction
  // (diagonals: in both). Another test detects a missing diagonal.
  const auto ratio = [](double a, double b) { return b > 0 ? a / b : 0; };
  const double diagonal = std::hypot(row, column) / std::sqrt(2.0);
  const double one = ratio(rest_of(s, *grid, 1, 1), diagonal), other = ratio(rest_of(s, *grid, 1, -1), diagonal);
  const auto off = [](double shear) { return std::abs(shear - std::sqrt(2.0)); };
  const double shear = one == 0 || (other != 0 && off(other) > off(one)) ? other : one;
  return {shear, ratio(rest_of(s, *grid, 0, 2), row), ratio(rest_of(s, *grid, 2, 0), column)};
}

Features cloth_pins(const Findings& found_here) {
  const Springs s = springs_of(found_here);
  const auto grid = grid_of(s);
  if (!grid || s.all.empty()) return {0, 0, 0};
  const int rows = grid->rows, columns = grid->columns;
  std::set<std::pair<int, int>> pins;
  int still = 0;
  for (int i = 0; i < s.particles; ++i)
    if (s.anchors[static_cast<std::size_t>(i)])
      pins.insert({grid->row(i), grid->column(i)}), still += s.still[static_cast<std::size_t>(i)];
  const int count = static_cast<int>(pins.size());
  const auto all = [&](auto&& good) { return std::all_of(pins.begin(), pins.end(), good); };
  const auto edge = [](int at, int all_of) { return at == 0 || at == all_of - 1; };
  bool even = all([&](auto p) { return edge(p.first, rows) && edge(p.second, columns); });
  for (const int border : {0, rows - 1})
    even = even || all([&](auto p) { return p.first == border && pins.count({border, columns - 1 - p.second}); });
  for (const int border : {0, columns - 1})
    even = even || all([&](auto p) { return p.second == border && pins.count({rows - 1 - p.first, border}); });
  return {share(std::min(count, 2), 2), count > 0 && even ? 1.0 : 0.0, share(still, count)};
}

}  // namespace coursework::classic
