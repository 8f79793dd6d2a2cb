#include "mysim/network/plan.h"

#include <algorithm>
#include <map>

namespace crosscheck::network {
namespace {

Spring turned(Spring s) {
  if (s.a > s.b) std::swap(s.a, s.b);
  return s;
}

bool earlier(const Spring& p, const Spring& q) { return p.a < q.a; }

/// Blocks from the first to the last that springs in this order begin in.
int blocks_of(const std::vector<Spring>& springs, const std::vector<int>& order) {
  return turned(springs[order.back()]).a / block + 1 - turned(springs[order.front()]).a / block;
}

/// Springs by offset, each in the order of a; of springs between the same two particles only the first.
std::map<int, std::vector<int>> by_offset(const std::vector<Spring>& springs) {
  std::map<int, std::vector<int>> found;
  for (size_t i = 0; i < springs.size(); ++i)
    if (springs[i].a != springs[i].b) found[std::abs(springs[i].b - springs[i].a)].push_back(static_cast<int>(i));
  for (auto& [offset, order] : found) {
    const auto begin = [&](int i) { return turned(springs[i]).a; };
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return begin(i) < begin(j); });
    const auto same = [&](int i, int j) { return begin(i) == begin(j); };
    order.erase(std::unique(order.begin(), order.end(), same), order.end());
  }
  return found;
}

}  // namespace

Plan plan_for(const std::vector<Spring>& springs, int particles, const Costs& costs) {
  const auto in_pairs = [&](double n) { return costs.call + particles * costs.particle + n * costs.pair; };
  const double all = static_cast<double>(springs.size());
  const double elsewhere = std::min(costs.plain, in_pairs(all) / std::max(1.0, all));  // what a spring costs otherwise

  Plan plan;
  std::vector<bool> taken(springs.size(), false);
  double cost = costs.call + (particles + block - 1) / block * costs.block, saved = 0;
  for (const auto& [offset, order] : by_offset(springs)) {
    const double lines = blocks_of(springs, order) * costs.line,
                 instead = static_cast<double>(order.size()) * elsewhere;
    if (lines >= instead) continue;
    cost += lines;
    saved += instead;
    plan.diagonals.emplace_back();
    for (const int i : order) {
      plan.diagonals.back().push_back(turned(springs[i]));
      taken[i] = true;
    }
  }
  if (cost >= saved) {
    plan.diagonals.clear();
    taken.assign(springs.size(), false);
  }

  for (size_t i = 0; i < springs.size(); ++i)
    if (!taken[i]) (springs[i].a == springs[i].b ? plan.plain : plan.pairs).push_back(springs[i]);
  const double left = static_cast<double>(plan.pairs.size());
  if (in_pairs(left) >= left * costs.plain) {
    plan.pairs.clear();
    plan.plain.clear();
    for (size_t i = 0; i < springs.size(); ++i)
      if (!taken[i]) plan.plain.push_back(springs[i]);
  }
  for (Spring& s : plan.pairs) s = turned(s);
  std::stable_sort(plan.pairs.begin(), plan.pairs.end(), earlier);
  return plan;
}

}  // namespace crosscheck::network
