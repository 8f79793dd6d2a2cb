// Union-find over the springs, and a sweep along one direction for coincident particles.
#include "mysim/model/pieces.h"

#include <algorithm>
#include <numeric>

namespace crosscheck {

std::vector<int> pieces_of(const Model& model) {
  const int n = model.particles.size();
  std::vector<int> parent(n);
  std::iota(parent.begin(), parent.end(), 0);
  auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  if (const auto* springs = model.find<Springs>())
    for (const Spring& s : springs->list) parent[root(s.a)] = root(s.b);
  if (const auto* bending = model.find<Bending>())
    for_each_pair(*bending, [&](int a, int b, double) { parent[root(a)] = root(b); });
  if (const auto* constraints = model.find<Constraints>())
    for (const auto& c : constraints->list) parent[root(c.a)] = root(c.b);
  std::vector<int> number(n, -1), piece(n);
  int pieces = 0;
  for (int i = 0; i < n; ++i) {
    int& known = number[root(i)];
    if (known < 0) known = pieces++;
    piece[i] = known;
  }
  return piece;
}

std::vector<std::pair<int, int>> coincident_pairs(const Points& x, double distance) {
  // grid particles have distinct coordinates along this direction
  const Eigen::VectorXd along = x.transpose() * Vec3(0.48, 0.55, 0.68).normalized();
  std::vector<int> order(along.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return along[a] < along[b]; });
  std::vector<std::pair<int, int>> pairs;
  for (size_t i = 0; i < order.size(); ++i)
    for (size_t j = i + 1; j < order.size() && along[order[j]] - along[order[i]] <= distance; ++j)
      if ((x.col(order[i]) - x.col(order[j])).norm() <= distance) pairs.push_back(std::minmax(order[i], order[j]));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace crosscheck
