// A student's stepper on the grader's own system.
#pragma once

#include "own.h"

namespace probe {

template <class S>
struct StepperBase {
  using type = TimeStepper;
};
template <class S>
typename StepperBase<S>::type& stepper_base(S& stepper) {
  return stepper;
}

/// takeStep is often private in the class itself: it is called through the base.
template <class S>
void take_step(S& stepper, Own& own, float h) {
  ParticleSystem& system = own;
  coursework::calling("takeStep");
  if constexpr (requires { stepper.takeStep(&system, h); })
    stepper.takeStep(&system, h);
  else if constexpr (requires { stepper.takeStep(system, h); })
    stepper.takeStep(system, h);
  else
    stepper_base(stepper).takeStep(&system, h);
}

/// "PART.path": in h, count of steps, nine numbers of A, q, and the state, three numbers each; out the state after each
/// step, row after row.
template <class S>
bool path(const coursework::Numbers& in, coursework::Numbers& out) {
  Vec state;
  for (std::size_t i = 12; i + 2 < in.size(); i += 3)
    state.push_back(Vector3f(static_cast<float>(in[i]), static_cast<float>(in[i + 1]), static_cast<float>(in[i + 2])));
  Own& own = *make<Own>(static_cast<int>(state.size()), true);
  own.become(&in[2], in[11], state);
  S& stepper = *make<S>(1, false);
  for (int step = 0; step < in[1]; ++step) {
    take_step(stepper, own, static_cast<float>(in[0]));
    for (const Vector3f& s : state_of(base_of(own)))
      for (int k = 0; k < 3; ++k) out.push_back(s[k]);
  }
  return true;
}

}  // namespace probe
