// Compares motions of the student's systems with the exact ones, for the hand-out's check. Masses and lengths of a
// pendulum are the student's choice, so the exact motion uses the values measured from the student's answers.
#include <cmath>
#include <complex>

#include "calls.h"
#include "tests/coursework/classic/oracles.h"
#include "tests/coursework/classic/springs.h"

namespace coursework {
namespace {

struct Pendulum {
  std::size_t bob = 1;           // the moving particle
  Numbers anchor, first;         // m: position of the fixed particle, and initial position of particle 1
  double k = 0, rest = 0;        // 1/s^2 (stiffness by mass), m
  double gravity = 0, drag = 0;  // m/s^2, 1/s (drag by mass)
};

probe::Findings found_by(const char* call) {
  Case what;
  what.call = call, what.in = {2, 1};
  Numbers record;
  return answer(call, what.in, record) ? classic::replay(what, record) : probe::Findings();
}

/// Returns false if no spring moves either particle. Assumes the correct signs; missing gravity or a missing rest
/// length is replaced by standard gravity or the initial distance.
bool read(Pendulum& p) {
  const classic::Springs springs = classic::springs_of(found_by("pendulum.springs"));
  const probe::Findings gravity = found_by("pendulum.gravity"), drag = found_by("pendulum.drag");
  if (springs.particles != 2 || gravity.n != 2 || drag.n != 2) return false;
  const auto place = [&](std::size_t i) { return Numbers(springs.places[i].at, springs.places[i].at + 3); };
  p.bob = springs.fixed[1] && !springs.fixed[0] ? 0 : 1;
  p.anchor = place(1 - p.bob), p.first = place(1);
  for (const classic::Spring& spring : springs.all)
    if (spring.a == static_cast<int>(p.bob)) p.k = std::abs(spring.k), p.rest = spring.rest;
  const Numbers start = place(p.bob);
  if (!(p.rest > 1e-3)) p.rest = std::hypot(start[0] - p.anchor[0], start[1] - p.anchor[1], start[2] - p.anchor[2]);
  const double down = std::abs(classic::gravity_on(gravity, p.bob));
  p.gravity = down > 1e-3 ? down : 9.81;
  p.drag = std::abs(classic::drag_on(drag, p.bob));
  return p.k > 0 && p.rest > 0;
}

/// The bob is released straight below the anchor, lower than the equilibrium position: a damped vertical vibration.
bool bounce(Case& drawn, Numbers& got) {
  Pendulum p;
  if (!read(p)) return false;
  const double hangs = p.rest + p.gravity / p.k, lower = hangs / 4, beat = std::sqrt(p.k);
  const double h = 0.05 / beat;
  const int steps = 500;  // four vibrations
  drawn = {"pendulum.bounce", {h, double(steps), double(p.bob)}, {}, 3, 0, "time", "bounce", -1, 1, h};
  drawn.in.insert(drawn.in.end(), p.first.begin(), p.first.end());
  drawn.in.insert(drawn.in.end(), {p.anchor[0], p.anchor[1] - hangs - lower, p.anchor[2]});
  const std::complex<double> root = std::sqrt(std::complex<double>(p.drag * p.drag / 4 - p.k));
  const std::complex<double> one = -p.drag / 2 + root, other = -p.drag / 2 - root;
  for (int step = 0; step <= steps; ++step) {
    const double t = step * h;
    const double share = ((one * std::exp(other * t) - other * std::exp(one * t)) / (one - other)).real();
    drawn.expected.insert(drawn.expected.end(), {p.anchor[0], p.anchor[1] - hangs - lower * share, p.anchor[2]});
  }
  return answer(drawn.call, drawn.in, got);
}

/// One revolution on the circle on which the student's point starts.
bool turn(Case& drawn, Numbers& got) {
  const double h = 0.03;
  const int steps = 209;
  drawn = {"simple.turn", {h, double(steps)}, {}, 3, 0, "step", "vector", 0, 1, h};
  if (!answer(drawn.call, drawn.in, got)) return false;
  for (int step = 0; step <= steps; ++step) {
    const double cosine = std::cos(step * h), sine = std::sin(step * h);
    const Numbers at = {got[0] * cosine - got[1] * sine, got[0] * sine + got[1] * cosine, got[2]};
    drawn.expected.insert(drawn.expected.end(), at.begin(), at.end());
  }
  return true;
}

}  // namespace

bool motion_of(const std::string& test, Case& drawn, Numbers& got) {
  // shown with the last test of the pendulum, which involves all its forces
  return test == "3.1" ? turn(drawn, got) : test == "4.5" && bounce(drawn, got);
}

}  // namespace coursework
