// The hand-out's calls of all parts, under the starter's names, in one program. Additional calls for the hand-out's
// drawings advance the student's systems with the student's trapezoidal rule. In the grader each class has its own
// program (base/class_calls.cpp).
#include "calls.h"
#include "TimeStepper.hpp"
#include "looks.h"
#include "pendulumSystem.h"
#include "probe/roles.h"
#include "probe/stepper.h"
#include "simpleSystem.h"

namespace coursework {

Calls answer_cloth;  // calls_cloth.cpp

namespace {

/// Appends an entry of the state at the start and after each step of h (s).
template <class T>
void follow(T& system, std::size_t entry, float h, double steps, Numbers& out) {
  Trapzoidal& rule = *probe::make<Trapzoidal>(1, false);
  TimeStepper& stepper = rule;  // takeStep is private in the class itself
  for (int step = 0; step <= steps; ++step) {
    if (step > 0) stepper.takeStep(&system, h);
    const Vector3f at = probe::state_of(system).at(entry);
    for (int k = 0; k < 3; ++k) out.push_back(at[k]);
  }
}

/// Inputs: h (s), number of steps, and those listed below. Output: the position (3) at the start and after each step.
///   simple.turn       nothing more
///   pendulum.bounce   index of the observed particle, initial position of particle 1 (3), and the position (3) at
///                     which the observed particle is released
bool answer_motion(const std::string& call, const Numbers& in, Numbers& out) {
  const float h = static_cast<float>(in.at(0));
  if (call == "simple.turn") {
    follow(probe::ready<SimpleSystem>(1, false), 0, h, in.at(1), out);
    return true;
  }
  PendulumSystem& pendulum = probe::ready<PendulumSystem>(2, true);
  probe::Vec state = probe::state_of(pendulum);
  // positions and velocities alternate, unless the second entry is the initial position of particle 1
  const bool apart = state.at(1) == probe::vector_at(in, 3) && !(state.at(2) == probe::vector_at(in, 3));
  const auto which = static_cast<std::size_t>(in.at(2)), entry = apart ? which : 2 * which;
  state.at(entry) = probe::vector_at(in, 6);
  state.at(entry + (apart ? 2 : 1)) = Vector3f(0.0f, 0.0f, 0.0f);
  probe::store(pendulum, state);
  follow(pendulum, entry, h, in.at(1), out);
  return true;
}

}  // namespace

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  if (call == "simple.turn" || call == "pendulum.bounce") return answer_motion(call, in, out);
  if (call.rfind("euler.", 0) == 0) return probe::path<ForwardEuler>(call, in, out);
  if (call.rfind("trapezoidal.", 0) == 0) return probe::path<Trapzoidal>(call, in, out);
  return probe::simple<SimpleSystem>(call, in, out) || answer_cloth(call, in, out) ||
         probe::pendulum<PendulumSystem, PendulumSystem>(call, in, out);
}

Found compared(const Case& what, const Numbers& answered) { return classic::features(what, answered); }

std::string asked_and_came(const Texts& own, const Case& what, const Numbers& answered) {
  return classic::shown(own, what, answered);
}

}  // namespace coursework
