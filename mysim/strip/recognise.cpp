#include "mysim/strip/recognise.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace crosscheck::strip {
namespace {

/// What the largest difference of indices says: the springs that have it lead two rows on, or to the next row.
std::vector<int> possible_columns(const Springs& springs, int particles) {
  int farthest = 0;
  for (const Spring& s : springs.list) farthest = std::max(farthest, std::abs(s.b - s.a));
  std::vector<int> columns;
  if (farthest <= 2) columns.push_back(particles);  // a single row
  // the farthest is two rows on, or one and to the right, straight, or to the left
  for (const int c : {farthest / 2, farthest - 1, farthest, farthest + 1})
    if (c > 1 && particles % c == 0 && std::find(columns.begin(), columns.end(), c) == columns.end())
      columns.push_back(c);
  return columns;
}

/// The direction of a spring whose first end is the earlier particle; empty where it is none of them.
std::optional<int> direction_of(int a, int b, int columns) {
  const Direction to{b / columns - a / columns, b % columns - a % columns};
  for (int d = 0; d < directions; ++d)
    if (direction[d].down == to.down && direction[d].right == to.right) return d;
  return std::nullopt;
}

long how_many(int rows, int columns, const Direction& d) {
  return std::max(0L, static_cast<long>(rows - d.down)) * std::max(0, columns - std::abs(d.right));
}

std::optional<Weave> weave_with(const Springs& springs, int rows, int columns) {
  struct Collected {
    Weave::Family family;
    std::vector<char> seen;  // by the earlier end
    long count = 0;
  };
  std::array<Collected, directions> all;
  for (const Spring& s : springs.list) {
    const auto [a, b] = std::minmax(s.a, s.b);
    const auto d = direction_of(a, b, columns);
    if (!d) return std::nullopt;
    Collected& c = all[*d];
    if (c.count == 0) c.family = {s.k, s.rest}, c.seen.assign(static_cast<size_t>(rows) * columns, 0);
    if (s.k != c.family.k || s.rest != c.family.rest || c.seen[a]) return std::nullopt;
    c.seen[a] = 1;
    ++c.count;
  }
  Weave weave{rows, columns, {}};
  for (int d = 0; d < directions; ++d) {
    const Collected& c = all[d];
    if (c.count == 0) continue;
    if (c.count != how_many(rows, columns, direction[d]) || !(c.family.rest > 0)) return std::nullopt;
    weave.families[d] = c.family;
  }
  return weave;
}

}  // namespace

std::optional<Weave> weave_of(const Springs& springs, int particles) {
  if (springs.law != SpringLaw::hooke || springs.list.empty()) return std::nullopt;
  for (const int columns : possible_columns(springs, particles))
    if (const auto weave = weave_with(springs, particles / columns, columns)) return weave;
  return std::nullopt;
}

}  // namespace crosscheck::strip
