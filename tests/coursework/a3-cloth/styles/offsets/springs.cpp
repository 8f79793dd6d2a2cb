// One function for all families: tries offsets from both ends, keeps each pair once in a set, measures rest lengths.
#include <initializer_list>
#include <set>
#include <utility>

#include "cloth.h"

namespace {

std::vector<Spring> family(const Grid& g, double k, std::initializer_list<std::pair<int, int>> offsets) {
  std::set<std::pair<int, int>> pairs;
  for (int r = 0; r < g.rows; ++r)
    for (int c = 0; c < g.columns; ++c)
      for (auto [down, across] : offsets)
        for (int sign : {-1, 1}) {
          const int r2 = r + sign * down, c2 = c + sign * across;
          if (r2 < 0 || c2 < 0 || r2 >= g.rows || c2 >= g.columns) continue;
          const int i = index_of(g, r, c), j = index_of(g, r2, c2);
          pairs.insert(i > j ? std::make_pair(i, j) : std::make_pair(j, i));
        }
  const std::vector<Vec3> x = positions(g);
  std::vector<Spring> springs;
  for (auto [a, b] : pairs) springs.push_back(Spring{a, b, k, length(x[a] - x[b])});
  return springs;
}

}  // namespace

std::vector<Spring> structural(const Grid& g, double k) { return family(g, k, {{0, 1}, {1, 0}}); }
std::vector<Spring> shear(const Grid& g, double k) { return family(g, k, {{1, 1}, {1, -1}}); }
std::vector<Spring> flexion(const Grid& g, double k) { return family(g, k, {{0, 2}, {2, 0}}); }
