// Contact of all particles with the scene's spheres, after a step.
#pragma once

#include "mysim/model.h"
#include "mysim/run.h"

namespace crosscheck {

enum class ContactRule { coulomb, sticky };  // sticky: the assignment's sphere, kept to be shown failing

/// What a rule does to one particle that touches a sphere: as resolve_contact.
using ContactFunction = double (*)(const Sphere&, const Vec3& centre, const Vec3& x_n, Eigen::Ref<Vec3> x,
                                   Eigen::Ref<Vec3> v);

/// Lets every sphere act, each in its own frame, on a particle that was at x_n at time t_n and would be at x with v at
/// t; true when one touched.
bool touch(const Spheres& spheres, ContactFunction act, double t_n, double t, const Vec3& x_n, Eigen::Ref<Vec3> x,
           Eigen::Ref<Vec3> v);

class Contacts {
 public:
  Contacts(const Model& model, ContactRule rule);
  bool any() const { return spheres_ != nullptr; }
  /// Remembers where the step begins.
  void begin(const State& s);
  /// Lets every sphere act on the whole step of every free particle; true when one touched.
  bool resolve(State& s);
  /// Hands the states before and after the last resolve() to the observer, if something touched.
  void tell(Observer& observer, const State& resolved) const;
  /// The state before the last resolve(), where something touched.
  const State& proposed() const { return proposed_; }

 private:
  const Particles& particles_;
  const Spheres* spheres_;
  ContactRule rule_;
  double t_n_ = 0;  // s, where the step began
  Points x_n_;      // m, likewise
  State proposed_;
  bool touched_ = false;
};

}  // namespace crosscheck
