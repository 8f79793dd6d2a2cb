// The largest stable step that theory allows a rule on a scene: the least over the scene's modes.
#pragma once

#include <string>

#include "experiments/stability/spectrum.h"
#include "reference/method.h"

namespace crosscheck {

/// True for Runge-Kutta rules, which see f(X, t) alone and multiply every eigenvector of the Jacobian by R(h lambda).
inline bool is_runge_kutta(const Stepper& rule) { return rule.first_order; }

struct Prediction {
  double limit = 0;     // s; 0: no step is stable; infinite: every step is
  int mode = -1;        // of the spectrum's, the one that binds; -1: none, or not told apart
  std::string missing;  // why there is no prediction; empty where there is one
};
/// The minimum of the rule's limit over the modes. Where damping and stiffness do not commute: Runge-Kutta rules take
/// the eigenvalues of the first-order Jacobian one by one; symplectic Euler is stable while 4 - h^2 K - 2 h C is
/// positive definite (in w'(4 - h^2 K - 2 h C) w both conditions of a single mode hold for every w, and where it is
/// singular there is an eigenvalue -1); leapfrog while 4 - h^2 K is, if there are no dashpots; the others by the
/// largest eigenvalue of their step matrix, up to 90 free coordinates. Where only the fastest rates are known, only
/// rules whose stability region is about as deep in all directions have a prediction: rk4's, to 12 %.
Prediction predicted_limit(const Stepper& rule, const Spectrum& spectrum);

/// By the rule that the method follows; `missing` where it follows none, or only without what the scene has.
Prediction predicted_limit(const Method& method, const Spectrum& spectrum);

}  // namespace crosscheck
