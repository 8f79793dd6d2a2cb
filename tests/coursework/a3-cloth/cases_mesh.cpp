// Parts 1 and 2: the grid and its springs. All expected numbers are integers, or exact to round-off.
#include <algorithm>
#include <cmath>

#include "tests/coursework/a3-cloth/cases.h"

namespace coursework::a3 {
namespace {

// positions and lengths are of the order of a metre, computed in two or three operations: 1e-9 is far above their
// round-off and far below any cell size
constexpr double mesh_round_off = 1e-9;

Case mesh_case(const char* call, const Mesh& mesh, const char* row, const char* column, int columns) {
  Case c{.call = call, .columns = columns, .tolerance = mesh_round_off, .row = row, .column = column};
  put(c.in, mesh);
  return c;
}

using crosscheck::Family;

std::vector<crosscheck::Spring> family_of(const Mesh& mesh, Family family) {
  std::vector<crosscheck::Spring> all = grid_springs(grid_of(mesh, 1, 1, 1));
  std::erase_if(all, [&](const auto& s) { return s.family != family; });
  return all;
}

Case pairs_case(const char* call, Family family, const Mesh& mesh) {
  Case c = mesh_case(call, mesh, "spring", "pair", 2);
  c.in.push_back(100);
  std::vector<std::array<int, 2>> pairs;
  for (const auto& s : family_of(mesh, family)) pairs.push_back({std::min(s.a, s.b), std::max(s.a, s.b)});
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [a, b] : pairs) c.expected.insert(c.expected.end(), {double(a), double(b)});
  return c;
}

Cases pairs_cases(const char* call, Family family, Random& random) {
  Cases cases;
  for (int i = 0; i < 2; ++i) cases.push_back(pairs_case(call, family, random_mesh(random, 3, 5)));
  return cases;
}

}  // namespace

Cases index(Random& random) {
  Cases cases;
  for (int i = 0; i < 2; ++i) {
    Case c = mesh_case("index", random_mesh(random, 3, 6), "particle", "index", 1);
    for (int n = 0; n < c.in[0] * c.in[1]; ++n) c.expected.push_back(n);
    cases.push_back(c);
  }
  return cases;
}

Cases neighbours(Random& random) {
  Cases cases;
  for (int i = 0; i < 2; ++i) {
    const Mesh mesh = random_mesh(random, 3, 5);
    Case c = mesh_case("neighbours", mesh, "particle", "neighbours", 5);
    // neighbours are the other ends of mysim's structural springs
    const auto springs = family_of(mesh, Family::structural);
    for (int n = 0; n < mesh.size(); ++n) {
      std::vector<double> beside;
      for (const auto& s : springs)
        if (s.a == n || s.b == n) beside.push_back(s.a == n ? s.b : s.a);
      std::sort(beside.begin(), beside.end());
      c.expected.push_back(static_cast<double>(beside.size()));
      beside.resize(4, -1);
      c.expected.insert(c.expected.end(), beside.begin(), beside.end());
    }
    cases.push_back(c);
  }
  return cases;
}

Cases positions(Random& random) {
  Cases cases;
  for (int i = 0; i < 2; ++i) {
    const Mesh mesh = random_mesh(random, 2, 5);
    Case c = mesh_case("positions", mesh, "particle", "position", 3);
    c.expected = numbers_of(mesh.points());
    c.plot_x = 0;
    c.plot_y = 2;
    cases.push_back(c);
  }
  return cases;
}

Cases structural(Random& random) { return pairs_cases("structural", Family::structural, random); }
Cases shear(Random& random) { return pairs_cases("shear", Family::shear, random); }
Cases flexion(Random& random) { return pairs_cases("flexion", Family::bend, random); }

Case spring_steps_of(Random& random) {
  const Mesh mesh = random_mesh(random, 4, 6);
  Case c = mesh_case("spring_steps", mesh, "offset", "rest", 6);
  const double k[] = {random.uniform(80, 120), random.uniform(40, 60), random.uniform(20, 30)};
  c.in.insert(c.in.end(), std::begin(k), std::end(k));
  const double diagonal = std::hypot(mesh.across, mesh.down);
  auto row = [&](int down, int across, double rest, double stiffness) {
    c.expected.insert(c.expected.end(), {double(down), double(across), rest, rest, stiffness, stiffness});
  };
  row(0, 1, mesh.across, k[0]);
  row(1, 0, mesh.down, k[0]);
  row(1, 1, diagonal, k[1]);
  row(0, 2, 2 * mesh.across, k[2]);
  row(2, 0, 2 * mesh.down, k[2]);
  return c;
}

// two grids: a solution must not keep state between calls
Cases spring_steps(Random& random) { return {spring_steps_of(random), spring_steps_of(random)}; }

Cases spring_counts(Random& random) {
  // the classic grid, a single row, a single column, a band of two rows, and an arbitrary one
  const std::array<int, 2> sizes[] = {{8, 8},
                                      {1, random.integer(3, 6)},
                                      {random.integer(3, 6), 1},
                                      {2, random.integer(5, 9)},
                                      {random.integer(9, 12), random.integer(5, 7)}};
  Case c{.call = "spring_counts", .columns = 3, .row = "grid", .column = "counts"};
  c.in.push_back(static_cast<double>(std::size(sizes)));
  for (const auto& [rows, columns] : sizes) {
    put(c.in, Mesh{rows, columns, 0.1, 0.2, Vec3::Zero()});
    c.expected.push_back(rows * (columns - 1) + columns * (rows - 1));
    c.expected.push_back(2 * (rows - 1) * (columns - 1));
    c.expected.push_back(rows * std::max(0, columns - 2) + columns * std::max(0, rows - 2));
  }
  return {c};
}

}  // namespace coursework::a3
