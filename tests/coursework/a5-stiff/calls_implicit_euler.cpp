// Calls of implicit_euler_step. Their input is n, steps, h, drag, gravity (3), number of springs, then `a`, `b`,
// stiffness, rest of each spring, then mass (n), fixed (n; 0 or 1), x (3 n), v (3 n).
//   implicit_euler.all                                 x (3), v (3) of each particle after the last step
//   implicit_euler.watch   also: index of a particle   x (3), v (3) of this particle after each step
#include <utility>

#include "calls.h"
#include "stiff.h"

namespace coursework {
namespace {

void add_row(const State& state, std::size_t i, Numbers& out) {
  const Vec3 &x = state.x.at(i), &v = state.v.at(i);
  out.insert(out.end(), x.begin(), x.end());
  out.insert(out.end(), v.begin(), v.end());
}

}  // namespace

bool answer_implicit_euler(const std::string& call, const Numbers& in, Numbers& out) {
  const bool watch = call == "implicit_euler.watch";
  if (!watch && call != "implicit_euler.all") return false;
  auto at = in.begin();
  auto next = [&] { return *at++; };
  auto vector = [&] {
    Vec3 v;
    for (double& part : v) part = next();
    return v;
  };
  const int n = static_cast<int>(next()), steps = static_cast<int>(next());
  const double h = next();
  System system;
  system.drag = next();
  system.gravity = vector();
  for (int left = static_cast<int>(next()); left > 0; --left) {
    Spring spring{};
    spring.a = static_cast<int>(next()), spring.b = static_cast<int>(next());
    spring.stiffness = next(), spring.rest = next();
    system.springs.push_back(spring);
  }
  for (int i = 0; i < n; ++i) system.mass.push_back(next());
  for (int i = 0; i < n; ++i) system.fixed.push_back(next() != 0);
  State state;
  for (int i = 0; i < n; ++i) state.x.push_back(vector());
  for (int i = 0; i < n; ++i) state.v.push_back(vector());
  const std::size_t watched = watch ? static_cast<std::size_t>(next()) : 0;
  for (int step = 0; step < steps; ++step) {
    const State given = state;
    calling("implicit_euler_step");
    State after = implicit_euler_step(system, state, h);
    if (given.x != state.x || given.v != state.v) throw Unusable("state_kept");
    state = std::move(after);
    if (watch) add_row(state, watched, out);
  }
  for (std::size_t i = 0; !watch && i < static_cast<std::size_t>(n); ++i) add_row(state, i, out);
  return true;
}

}  // namespace coursework
