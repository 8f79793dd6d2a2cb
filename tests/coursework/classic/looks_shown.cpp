// What a probe asked of a system and what came, told of the first particle or spring that is not as it should be.
#include <algorithm>
#include <cmath>
#include <set>

#include "tests/coursework/check/words.h"
#include "tests/coursework/classic/looks.h"
#include "tests/coursework/classic/replay.h"
#include "tests/coursework/classic/springs.h"

namespace coursework::classic {
namespace {

std::string four_digits(double value) { return with_digits(std::abs(value) < 1e-9 ? 0 : value, 4); }
std::string vector_text(const double* v) {
  return "(" + four_digits(v[0]) + ", " + four_digits(v[1]) + ", " + four_digits(v[2]) + ")";
}

bool near(double a, double b) { return std::abs(a - b) <= 1e-5 * std::max({1.0, std::abs(a), std::abs(b)}); }
bool near(const double* a, const double* b) { return near(a[0], b[0]) && near(a[1], b[1]) && near(a[2], b[2]); }
bool none(const double* v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

std::size_t count_in(const Numbers& raw, std::size_t each, std::size_t before = 1) {
  const auto n = raw.empty() || !(raw[0] >= 1) || raw[0] > 1e5 ? 0 : static_cast<std::size_t>(raw[0]);
  return raw.size() >= before + n * each ? n : 0;
}

/// Entries in their order: evalF with another state stored, the same again, with the same state stored, and what the
/// stored one has changed by.
std::string purity_shown(const Texts& own, const Numbers& raw) {
  constexpr std::size_t most_in_order = 200;  // of a larger state some are drawn (probe/draws.h)
  if (raw.size() < 14 || raw[0] > static_cast<double>(most_in_order)) return "";
  for (std::size_t i = 0; 2 + 12 * i + 12 <= raw.size(); ++i) {
    double f[4][3];
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t what = 0; what < 4; ++what) f[what][k] = raw[2 + 12 * i + 4 * k + what];
    const std::string entry = std::to_string(i);
    if (!none(f[3])) return own.fill("shown.kept", entry, vector_text(f[3]));
    if (f[0][0] != f[1][0] || f[0][1] != f[1][1] || f[0][2] != f[1][2])
      return own.fill("shown.again", entry, vector_text(f[0]), vector_text(f[1]));
    if (!near(f[0], f[2])) return own.fill("shown.purity", entry, vector_text(f[0]), vector_text(f[2]));
  }
  return "";
}

std::string motion_shown(const Texts& own, const Numbers& raw) {
  const std::size_t n = count_in(raw, 30);
  for (std::size_t i = 0; i < n; ++i) {
    const double* v = &raw[1 + 3 * n + i * 9];  // v, x', v'
    if (!near(v, v + 3) && !none(v + 3))
      return own.fill("shown.motion", std::to_string(i), vector_text(v), vector_text(v + 3), vector_text(v + 6));
  }
  return "";
}

/// Of three draws the first: v' of each particle at x and at its mirror image.
std::string gravity_shown(const Texts& own, const Numbers& raw) {
  const std::size_t n = count_in(raw, 18);
  std::vector<std::pair<double, std::size_t>> down;
  const auto mean = [&](std::size_t i, std::size_t k) { return (raw[1 + 6 * i + k] + raw[4 + 6 * i + k]) / 2; };
  for (std::size_t i = 0; i < n; ++i)
    if (!none(&raw[1 + 6 * i]) || !none(&raw[4 + 6 * i])) down.emplace_back(-mean(i, 1), i);
  if (down.empty()) return "";
  const std::size_t i = std::min_element(down.begin(), down.end())->second;
  const double gravity[3] = {mean(i, 0), mean(i, 1), mean(i, 2)};
  return own.fill("shown.gravity", std::to_string(i), vector_text(&raw[1 + 6 * i]), vector_text(&raw[4 + 6 * i]),
                  vector_text(gravity));
}

/// The velocity w that a particle alone gets, and its v' at 0, w and 2 w: of the one that it slows least.
std::string drag_shown(const Texts& own, const Numbers& raw) {
  constexpr std::size_t most_in_order = 200;  // of more some are drawn
  const std::size_t n = count_in(raw, 12);
  std::vector<std::pair<double, std::size_t>> slowed;
  for (std::size_t i = 0; i < n; ++i) {
    const double* w = &raw[1 + 12 * i];
    if (none(w + 3) && none(w + 6)) continue;
    double along = 0;
    for (int k = 0; k < 3; ++k) along += (w[3 + k] - w[6 + k]) * w[k];
    slowed.emplace_back(along, i);
  }
  if (slowed.empty() || n >= most_in_order) return "";
  const auto [least, most] = std::minmax_element(slowed.begin(), slowed.end());
  const double* w = &raw[1 + 12 * least->second];
  std::string text =
      own.fill("shown.drag", std::to_string(least->second), vector_text(w + 3), vector_text(w + 6), vector_text(w));
  std::string list;
  std::size_t alike = 0;  // what slows these least
  for (const auto& [along, i] : slowed)
    if (std::abs(along - least->first) < 0.02 * std::abs(most->first) && ++alike <= 6)
      list += (list.empty() ? "" : ", ") + std::to_string(i);
  if (alike < slowed.size()) text += " " + own.fill("shown.drag_of", list + (alike > 6 ? ", ..." : ""));
  return text;
}

/// Where the records of pairs begin (probe/forces.h); the end where there are none.
std::size_t pairs_in(const Numbers& raw, std::size_t particles) {
  const std::size_t at = 1 + 6 * particles + 2;
  return at > raw.size() ? raw.size() : at + static_cast<std::size_t>(std::clamp(raw[at - 1], 0.0, 1e5));
}

/// The first spring that does not draw together, is not linear, has no rest length, or pulls otherwise at its other
/// end.
std::string law_shown(const Texts& own, const Numbers& raw, const Springs& s) {
  const auto record = [&](int a, int b) -> const double* {
    for (std::size_t at = pairs_in(raw, static_cast<std::size_t>(s.particles)); at + 11 <= raw.size(); at += 11)
      if (raw[at] == b && raw[at + 1] == a) return &raw[at];
    return nullptr;
  };
  const auto told = [&](int a, int b) {
    const double* r = record(a, b);
    if (!r) return std::string();
    return own.fill("shown.spring", std::to_string(b), std::to_string(a),
                    four_digits(r[2]) + ", " + four_digits(r[3]) + ", " + four_digits(r[4]),
                    four_digits(r[5]) + ", " + four_digits(r[7]) + ", " + four_digits(r[9]));
  };
  for (const Spring& one : s.all) {
    if (s.fixed[static_cast<std::size_t>(one.a)]) continue;
    if (!one.linear || one.k <= 0 || one.rest <= 1e-3) return told(one.a, one.b);
    if (s.fixed[static_cast<std::size_t>(one.b)] || !s.moved[static_cast<std::size_t>(one.a)]) continue;
    const double *here = record(one.a, one.b), *there = record(one.b, one.a);
    if (!there || !(std::abs(here[5] - there[5]) <= 0.02 * std::abs(here[5]) + 1e-4)) {
      const std::string back = told(one.b, one.a);
      return told(one.a, one.b) + " " +
             (back.empty() ? own.fill("shown.no_pull", std::to_string(one.a), std::to_string(one.b)) : back);
    }
  }
  return "";
}

using Pairs = std::set<std::pair<int, int>>;

std::string place_text(const Grid& grid, int i) {
  return "(" + std::to_string(grid.row(i)) + ", " + std::to_string(grid.column(i)) + ")";
}

/// The first few springs of these offsets that nothing shows from either end.
std::string missing_shown(const Texts& own, const Springs& s, const std::vector<std::pair<int, int>>& offsets) {
  const auto grid = grid_of(s);
  if (!grid) return "";
  Pairs pairs;
  for (const Spring& one : s.all) pairs.insert({one.a, one.b}), pairs.insert({one.b, one.a});
  const auto seen = [&](int a, int b) {
    return s.moved[static_cast<std::size_t>(b)] && !s.fixed[static_cast<std::size_t>(a)];
  };
  std::string list;
  int count = 0;
  for (const auto& [down, side] : offsets)
    for (int i = 0; i < s.particles; ++i) {
      const int row = grid->row(i) + down, column = grid->column(i) + side;
      if (row >= grid->rows || column < 0 || column >= grid->columns) continue;
      const int other = row * grid->columns + column;
      if (pairs.count({i, other}) || (!seen(i, other) && !seen(other, i)) || ++count > 3) continue;
      list += (list.empty() ? "" : "; ") + place_text(*grid, i) + " - " + place_text(*grid, other);
    }
  return count == 0 ? "" : own.fill("shown.missing", std::to_string(count), list);
}

/// The first few springs that are of no family.
std::string others_shown(const Texts& own, const Springs& s) {
  const auto grid = grid_of(s);
  if (!grid) return "";
  std::string list;
  int count = 0;
  Pairs told;
  for (const Spring& one : s.all) {
    const int down = std::abs(grid->row(one.a) - grid->row(one.b)),
              side = std::abs(grid->column(one.a) - grid->column(one.b));
    const bool within = (down <= 1 && side <= 1) || (down + side == 2 && down * side == 0);
    if (within || !told.insert(std::minmax(one.a, one.b)).second || ++count > 3) continue;
    list += (list.empty() ? "" : "; ") + place_text(*grid, one.a) + " - " + place_text(*grid, one.b);
  }
  return count == 0 ? "" : own.fill("shown.others", std::to_string(count), list);
}

std::string links_shown(const Texts& own, const Springs& s) {
  Pairs pairs;
  for (const Spring& one : s.all) pairs.insert(std::minmax(one.a, one.b));
  std::string springs, fixed;
  for (const auto& [a, b] : pairs)
    springs += (springs.empty() ? "" : ", ") + std::to_string(a) + "-" + std::to_string(b);
  for (int i = 0; i < s.particles; ++i)
    if (s.fixed[static_cast<std::size_t>(i)]) fixed += (fixed.empty() ? "" : ", ") + std::to_string(i);
  return own.fill("shown.links", springs.empty() ? "-" : springs, fixed.empty() ? "-" : fixed);
}

std::string pins_shown(const Texts& own, const Springs& s) {
  const auto grid = grid_of(s);
  if (!grid) return "";
  std::string list;
  int count = 0;
  for (int i = 0; i < s.particles; ++i)
    if (s.fixed[static_cast<std::size_t>(i)] && ++count <= 6) list += (list.empty() ? "" : ", ") + place_text(*grid, i);
  return own.fill("shown.pins", std::to_string(grid->rows), std::to_string(grid->columns),
                  count == 0 ? "-" : list + (count > 6 ? ", ..." : ""));
}

}  // namespace

std::string shown(const Texts& own, const Case& what, const Numbers& answers) {
  if (what.column == "vector") return "";
  const Numbers raw = replay(what, answers);
  if (raw.empty()) return "";
  const std::string& column = what.column;
  if (column == "purity") return purity_shown(own, raw);
  if (column == "motion" || column == "cloth_motion") return motion_shown(own, raw);
  if (column == "gravity") return gravity_shown(own, raw);
  if (column == "drag") return drag_shown(own, raw);
  const Springs s = springs_of(raw);
  if (s.particles == 0 || !s.repeats) return "";
  if (column == "law") return law_shown(own, raw, s);
  if (column == "links") return links_shown(own, s);
  if (column == "structural") return missing_shown(own, s, {{0, 1}, {1, 0}});
  if (column == "shear") return missing_shown(own, s, {{1, 1}, {1, -1}});
  if (column == "flexion") return missing_shown(own, s, {{0, 2}, {2, 0}});
  if (column == "others") return others_shown(own, s);
  return column == "pins" ? pins_shown(own, s) : "";
}

}  // namespace coursework::classic
