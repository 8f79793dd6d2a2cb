// Calls of part 2. All answers are sorted, because the order of springs and of their ends is free.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>

#include "calls_read.h"

namespace coursework {
namespace {

using Family = std::vector<Spring> (*)(const Grid&, double);
const std::map<std::string, Family> families = {{"structural", structural}, {"shear", shear}, {"flexion", flexion}};

/// The two ends of each spring, the smaller index first, in ascending order.
Numbers pairs(const std::vector<Spring>& springs) {
  std::vector<std::array<int, 2>> ends;
  for (const Spring& s : springs) ends.push_back({std::min(s.a, s.b), std::max(s.a, s.b)});
  std::sort(ends.begin(), ends.end());
  Numbers out;
  for (const auto& [a, b] : ends) out.insert(out.end(), {double(a), double(b)});
  return out;
}

/// Groups the springs by the distance between their ends, counted in rows and in columns. For each group: these two
/// distances, the smallest and the largest rest length, the smallest and the largest stiffness.
Numbers steps(const Grid& grid, const std::vector<Spring>& springs) {
  std::map<std::array<int, 2>, std::array<double, 4>> found;
  for (const Spring& s : springs) {
    const int down = std::abs(s.a / grid.columns - s.b / grid.columns);
    const int across = std::abs(s.a % grid.columns - s.b % grid.columns);
    auto& [shortest, longest, softest, stiffest] =
        found.try_emplace({down, across}, std::array<double, 4>{s.rest, s.rest, s.k, s.k}).first->second;
    shortest = std::fmin(shortest, s.rest);
    longest = std::fmax(longest, s.rest);
    softest = std::fmin(softest, s.k);
    stiffest = std::fmax(stiffest, s.k);
  }
  Numbers out;
  for (const auto& [step, range] : found) {
    out.insert(out.end(), step.begin(), step.end());
    out.insert(out.end(), range.begin(), range.end());
  }
  return out;
}

}  // namespace

/// structural, shear, flexion (a grid, then k): the result of pairs().
/// spring_steps (a grid, then k of each family): the result of steps() for the three families, one after the other.
/// spring_counts (number of grids, then the grids): the number of springs of each family, for each grid.
bool answer_springs(const std::string& call, const Numbers& in, Numbers& out) {
  Reader reader(in);
  if (const auto family = families.find(call); family != families.end()) {
    const Grid grid = read_grid(reader);
    out = pairs(family->second(grid, reader.number()));
  } else if (call == "spring_steps") {
    const Grid grid = read_grid(reader);
    for (Family of : {structural, shear, flexion}) {
      const Numbers rows = steps(grid, of(grid, reader.number()));
      out.insert(out.end(), rows.begin(), rows.end());
    }
  } else if (call == "spring_counts") {
    for (int left = reader.integer(); left > 0; --left) {
      const Grid grid = read_grid(reader);
      for (Family of : {structural, shear, flexion}) out.push_back(static_cast<double>(of(grid, 1).size()));
    }
  } else {
    return false;
  }
  return true;
}

}  // namespace coursework
