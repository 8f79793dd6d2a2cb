// A student's stepper on the grader's own system.
#pragma once

#include "own.h"

namespace probe {

/// takeStep is often private in the class itself, so it is called through the base class.
template <class S, class Base = TimeStepper>  // makes types depend on the call, so that missing members can be tested
void take_step(S& stepper, Own& own, float h) {
  ParticleSystem& system = own;
  coursework::calling("takeStep");
  if constexpr (requires { stepper.takeStep(&system, h); })
    stepper.takeStep(&system, h);
  else if constexpr (requires { stepper.takeStep(system, h); })
    stepper.takeStep(system, h);
  else
    static_cast<Base&>(stepper).takeStep(&system, h);
}

/// "base". Output: 1 if the student's base class returns the state that was stored in it, otherwise 0.
template <class = void>
bool base_works(coursework::Numbers& out) {
  Vec state(7, Vector3f(1.0f, 2.0f, 3.0f)), other(7, Vector3f(4.0f, 5.0f, 6.0f));
  state[6] = other[0], other[6] = state[0];
  Own& own = *make<Own>(7, true);
  const double none[11] = {};
  own.become(none, state);
  bool works = true;
  for (const Vec& given : {state, other, state}) {
    store(base_of(own), given);
    const Vec back = state_of(base_of(own));
    works = works && back.size() == given.size();
    for (std::size_t i = 0; works && i < given.size(); ++i)
      for (int k = 0; k < 3; ++k) works = works && back[i][k] == given[i][k];
  }
  out.push_back(works);
  return true;
}

/// "PART.path". Input: h, number of steps, nine numbers of A, q, c, and the state, three numbers per vector. Output:
/// the state after each step, row by row. "PART.calls". Output: the number of calls of evalF.
template <class S>
bool path(const std::string& call, const coursework::Numbers& in, coursework::Numbers& out) {
  const bool calls = call.find(".calls") != std::string::npos;
  if (!calls && call.find(".path") == std::string::npos) return false;
  Vec state;
  for (std::size_t i = 13; i + 2 < in.size(); i += 3) state.push_back(vector_at(in, i));
  Own& own = *make<Own>(static_cast<int>(state.size()), true);
  own.become(&in[2], state);
  S& stepper = *make<S>(1, false);
  for (int step = 0; step < in[1]; ++step) {
    take_step(stepper, own, static_cast<float>(in[0]));
    for (const Vector3f& s : state_of(base_of(own)))
      for (int k = 0; k < 3 && !calls; ++k) out.push_back(s[k]);
  }
  if (calls) out.push_back(own.asked);
  return true;
}

}  // namespace probe
