// Dispatch tables with one line for each column of the texts.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>

#include "tests/coursework/check/words.h"
#include "tests/coursework/classic/looks.h"
#include "tests/coursework/classic/oracles.h"
#include "tests/coursework/classic/springs.h"

namespace coursework::classic {
namespace {

/// `size` is the requested number of particles; for a cloth, the number along a side.
Features look(const std::string& column, int size, const Findings& found) {
  if (column == "purity") return purity(found);
  if (column == "motion") return motion(found, size);
  if (column == "cloth_motion") {
    // the presence and the place of a cloth's pins are the student's choice; only the moving particles are checked
    Features features = motion(found, size * size);
    features.erase(features.begin() + 2, features.end());
    return features;
  }
  // the forces of a non-deterministic evalF cannot be inferred
  if (!found.repeats) return {};
  if (column == "gravity") return gravity(found);
  if (column == "drag") return drag(found);
  if (column == "law") return spring_law(found);
  if (column == "links") return chain_links(found);
  if (const auto family = family_of(column); !family.empty()) return cloth_family(found, family);
  if (column == "others") return cloth_others(found);
  if (column == "lengths") return cloth_lengths(found);
  if (column == "pins") return cloth_pins(found);
  throw std::logic_error("no oracle finds the column " + column);
}

}  // namespace

Found features(const Case& what, const Numbers& answers) {
  if (what.column == "vector") return answers;
  Found found({});
  for (const Feature& one : look(what.column, static_cast<int>(what.in.at(0)), replay(what, answers)))
    found.got.push_back(one.got), found.of.push_back(one.of);
  return found;
}

namespace {

using probe::Plain;

std::string listed(const std::vector<std::string>& all, const std::string& between = ", ") {
  std::string list;
  for (const std::string& one : all) list += (list.empty() ? "" : between) + one;
  return list.empty() ? "-" : list;
}

std::string four_digits(double value) { return with_digits(std::abs(value) < 1e-9 ? 0 : value, 4); }
std::string three_text(const float* v) {
  return four_digits(v[0]) + ", " + four_digits(v[1]) + ", " + four_digits(v[2]);
}
std::string vector_text(const Plain& v) { return "(" + three_text(v.at) + ")"; }

// with more entries or particles, only a random sample is checked (probe/draws.h)
constexpr std::size_t most_in_order = 200;

std::string purity_shown(const Texts& own, const Findings& found) {
  if (found.n >= most_in_order) return "";
  for (std::size_t i = 0; i < found.n; ++i) {
    const auto& [f, again, stored_too, change] = found.row(i);
    const std::string entry = std::to_string(i);
    if (!zero(change)) return own.fill("shown.kept", entry, vector_text(change));
    if (!probe::same(f, again)) return own.fill("shown.again", entry, vector_text(f), vector_text(again));
    if (!close(f, stored_too)) return own.fill("shown.purity", entry, vector_text(f), vector_text(stored_too));
  }
  return std::all_of(found.rows.begin(), found.rows.end(), [](const auto& row) { return zero(row[0]); })
             ? own.of("shown.zero")
             : "";
}

std::string motion_shown(const Texts& own, const Findings& found) {
  for (std::size_t i = 0; i < found.n; ++i)
    if (const auto& [v, slope, pull, start] = found.row(i); !close(v, slope) && !zero(slope))
      return own.fill("shown.motion", std::to_string(i), vector_text(v), vector_text(slope), vector_text(pull));
  return "";
}

/// The free particle with the smallest value of on(). Columns `first` to `last` of its rows determine whether a
/// particle is free.
std::optional<std::size_t> least_of(const Findings& found, std::size_t first, std::size_t last,
                                    double (*on)(const Findings&, std::size_t)) {
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < found.n; ++i)
    if (is_free(found, i, first, last) && (!least || on(found, i) < on(found, *least))) least = i;
  return least;
}

/// Shows v' of a particle at x and at its mirror image, in the first of three draws.
std::string gravity_shown(const Texts& own, const Findings& found) {
  const auto i = least_of(found, 0, 1, gravity_on);
  if (!i) return "";
  const Plain &a = found.row(*i)[0], &mirrored = found.row(*i)[1];
  return own.fill("shown.gravity", std::to_string(*i), vector_text(a), vector_text(mirrored),
                  vector_text(probe::plus(probe::plus({}, 0.5f, a), 0.5f, mirrored)));
}

/// Shows v' of the free particle with the least drag: at rest, and at a velocity w while all others are at rest. If the
/// drag of another free particle is not proportional to that particle's own velocity, shows that particle instead, and
/// also its v' at 2 w while all others have w.
std::string drag_shown(const Texts& own, const Findings& found) {
  auto i = least_of(found, 1, 3, drag_on);
  if (!i || found.n >= most_in_order) return "";
  const auto depends_on_others = [&](std::size_t k) { return drag_on(found, k) != 0 && !is_proportional(found, k); };
  for (std::size_t k = 0; k < found.n && !depends_on_others(*i); ++k)
    if (is_free(found, k, 1, 3) && depends_on_others(k)) i = k;
  const auto& [w, at_rest, once, twice] = found.row(*i);
  std::string text =
      own.fill("shown.drag", std::to_string(*i), vector_text(at_rest), vector_text(once), vector_text(w));
  if (depends_on_others(*i))
    return text + " " +
           own.fill("shown.drag_others", vector_text(probe::plus(w, 1, w)), vector_text(w), vector_text(twice),
                    vector_text(proportional_drag(found, *i)));
  std::vector<std::string> alike;
  for (std::size_t k = 0; k < found.n; ++k)
    if (is_free(found, k, 1, 3) && std::abs(drag_on(found, k) - drag_on(found, *i)) < 1e-3)
      alike.push_back(std::to_string(k));
  if (alike.size() > 1 && alike.size() <= 6) text += " " + own.fill("shown.drag_of", listed(alike));
  return text;
}

/// Shows the first spring that does not contract, is not linear, has no rest length, or pulls differently at its other
/// end.
std::string law_shown(const Texts& own, const Springs& s) {
  const auto told = [&](const Spring& one) {
    return own.fill("shown.spring", std::to_string(one.b), std::to_string(one.a), three_text(one.as_found.at),
                    three_text(one.as_found.along));
  };
  for (const Spring& one : s.all) {
    if (s.fixed[static_cast<std::size_t>(one.a)] || !one.measured) continue;
    if (!one.linear || one.k <= 0 || one.rest <= 1e-3) return told(one);
    if (s.fixed[static_cast<std::size_t>(one.b)] || !s.moved[static_cast<std::size_t>(one.a)]) continue;
    const auto back =
        std::find_if(s.all.begin(), s.all.end(), [&](const Spring& two) { return two.a == one.b && two.b == one.a; });
    if (back == s.all.end())
      return told(one) + " " + own.fill("shown.no_pull", std::to_string(one.a), std::to_string(one.b));
    const float here = one.as_found.along[0], there = back->as_found.along[0];
    if (!(std::abs(here - there) <= 0.02f * std::abs(here) + 1e-4f)) return told(one) + " " + told(*back);
  }
  return "";
}

/// Place of particle i: "(row, column)".
std::string place_text(const Grid& grid, int i) {
  return "(" + std::to_string(grid.row(i)) + ", " + std::to_string(grid.column(i)) + ")";
}

using Pairs = std::set<std::pair<int, int>>;

/// Shows the first three pairs as "(row, column) - (row, column)", and the total number.
std::string pairs_shown(const Texts& own, const char* key, const Grid& grid, const Pairs& pairs) {
  std::vector<std::string> first;
  for (const auto& [a, b] : pairs)
    if (first.size() < 3) first.push_back(place_text(grid, a) + " - " + place_text(grid, b));
  return pairs.empty() ? "" : own.fill(key, std::to_string(pairs.size()), listed(first, "; "));
}

/// Shows springs of the family that are missing at both ends.
std::string missing_shown(const Texts& own, const Springs& s, const std::vector<Offset>& family) {
  const auto grid = grid_of(s);
  if (!grid) return "";
  Pairs pairs, missing;
  for (const Spring& one : s.all) pairs.insert(std::minmax(one.a, one.b));
  const auto seen = [&](int a, int b) {
    return s.moved[static_cast<std::size_t>(b)] && !s.fixed[static_cast<std::size_t>(a)];
  };
  for (const auto& [down, side] : family)
    for (int i = 0; i < s.particles; ++i) {
      const int row = grid->row(i) + down, column = grid->column(i) + side;
      if (row >= grid->rows || column < 0 || column >= grid->columns) continue;
      const int other = row * grid->columns + column;
      if (!pairs.count({i, other}) && (seen(i, other) || seen(other, i))) missing.insert({i, other});
    }
  return pairs_shown(own, "shown.missing", *grid, missing);
}

/// Shows springs that belong to no family.
std::string others_shown(const Texts& own, const Springs& s) {
  const auto grid = grid_of(s);
  if (!grid) return "";
  Pairs others;
  for (const Spring& one : s.all)
    if (!of_a_family(*grid, one.a, one.b)) others.insert(std::minmax(one.a, one.b));
  return pairs_shown(own, "shown.others", *grid, others);
}

std::string links_shown(const Texts& own, const Springs& s) {
  std::set<std::string> springs;
  std::vector<std::string> fixed;
  for (const Spring& one : s.all)
    springs.insert(std::to_string(std::min(one.a, one.b)) + "-" + std::to_string(std::max(one.a, one.b)));
  for (int i = 0; i < s.particles; ++i)
    if (s.anchors[static_cast<std::size_t>(i)]) fixed.push_back(std::to_string(i));
  return own.fill("shown.links", listed({springs.begin(), springs.end()}), listed(fixed));
}

std::string pins_shown(const Texts& own, const Springs& s) {
  const auto grid = grid_of(s);
  if (!grid) return "";
  std::vector<std::string> pins;
  for (int i = 0; i < s.particles; ++i)
    if (s.anchors[static_cast<std::size_t>(i)]) pins.push_back(place_text(*grid, i));
  if (pins.size() > 6) pins.resize(6), pins.push_back("...");
  return own.fill("shown.pins", std::to_string(grid->rows), std::to_string(grid->columns), listed(pins));
}

}  // namespace

std::string shown(const Texts& own, const Case& what, const Numbers& answers) {
  if (what.column == "vector") return "";
  const Findings found = replay(what, answers);
  if (found.empty()) return "";
  const std::string& column = what.column;
  if (column == "purity") return purity_shown(own, found);
  if (column == "motion" || column == "cloth_motion") return motion_shown(own, found);
  if (column == "gravity") return gravity_shown(own, found);
  if (column == "drag") return drag_shown(own, found);
  if (!found.repeats) return "";
  const Springs s = springs_of(found);
  if (column == "law") return law_shown(own, s);
  if (column == "links") return links_shown(own, s);
  if (const auto family = family_of(column); !family.empty()) return missing_shown(own, s, family);
  if (column == "others") return others_shown(own, s);
  return column == "pins" ? pins_shown(own, s) : "";
}

}  // namespace coursework::classic
