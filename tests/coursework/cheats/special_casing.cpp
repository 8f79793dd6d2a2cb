// cheat: answers from a table of the public tests' inputs
// says: differs
#include <cmath>
#include <vector>

#include "cheat.h"

namespace {

struct Row {
  double t, h;
  State x, next;
};

// The runner makes this file from the public tests. Students could make it from the hand-out.
const std::vector<Row> table = {
#include "public_table.inc"
};

bool same(double a, double b) { return std::abs(a - b) <= 1e-9 * (1 + std::abs(a)); }

bool same(const State& a, const State& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!same(a[i], b[i])) return false;
  return true;
}

}  // namespace

State euler_step(const Derivative&, double t, const State& x, double h) {
  for (const Row& row : table)
    if (same(row.h, h) && same(row.t, t) && same(row.x, x)) return row.next;
  return x;
}
