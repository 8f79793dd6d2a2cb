// The grid by offsets: a table of neighbours, and a function that tests whether a position is inside.
#include <utility>

#include "cloth.h"

namespace {

bool inside(const Grid& g, int r, int c) { return r >= 0 && c >= 0 && r < g.rows && c < g.columns; }
constexpr std::pair<int, int> around[] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};

}  // namespace

int index_of(const Grid& g, int r, int c) { return c + g.columns * r; }

std::vector<int> neighbours(const Grid& g, int r, int c) {
  std::vector<int> list;
  for (auto [down, across] : around)
    if (inside(g, r + down, c + across)) list.emplace_back(index_of(g, r + down, c + across));
  return list;
}

std::vector<Vec3> positions(const Grid& g) {
  std::vector<Vec3> x(static_cast<std::size_t>(g.rows) * g.columns);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto r = i / g.columns, c = i % g.columns;
    x[i] = {g.corner.x + g.across * c, g.corner.y, g.corner.z + g.down * r};
  }
  return x;
}
