// Contact of all particles with the scene's surfaces (spheres and planes) after a step, and the energy lost in it.
//
// Definitions, per kilogram of a particle: J is the velocity change by a surface, a = (v* - v_n) / h the acceleration
// by all other forces. x_n, v_n are the state at the start of the step, x*, v* the stepper's proposal, x', v' the state
// after contact.
//   Impact: |J| > 3 (1 + e) |a| h, i.e. the approach is faster than those forces explain. It is instantaneous, occurs
//   x' - x* before the end of the displacement, and loses the kinetic energy -J . (v* + v') / 2 + a . (x' - x*).
//   Any other contact lasts throughout the step. Its normal part works only through the displacement s of a moving
//   surface, and friction over the particle's displacement. The loss is -(J_t . (x' - x_n) + J_n . s) / h.
// Hence a particle at rest on a fixed surface loses nothing, whatever the stepper proposes. The free step and the push
// out of the surface also change the energy of a touching particle. This change is an error of the method, not a loss,
// and remains in the balance. The factor is 3 because explicit Euler supports a resting particle only in every other
// step, with |J| = 2 |a| h.
#pragma once

#include <optional>
#include <string_view>

#include "mysim/model/model.h"

namespace crosscheck {

struct Stepper;

enum class ContactRule {
  coulomb,  // acts on whole steps (terms/surface.h): order 1
  events,   // locates touching, leaving and stopping within the step (contact_events.h); requires locates_events()
  sticky,   // the assignment's sphere, kept to demonstrate its failure
};
/// The rule of a method option ("events", "sticky"), or nothing for other options.
std::optional<ContactRule> contact_rule_of_option(std::string_view option);

/// True for rules of order 2 under ContactRule::events. A first-order rule moves particles by h^2 a / 2 off the path
/// that their velocities indicate, as much as contact displaces them. A multi-stage rule evaluates forces inside the
/// solids, where rounding of the speed at first touch decides between two paths.
bool locates_events(const Stepper& stepper);

/// The action of a rule on one particle that touches a surface; same contract as resolve_contact.
using ContactFunction = double (*)(const Surface&, const Vec3& origin, const Vec3& x_n, Eigen::Ref<Vec3> x,
                                   Eigen::Ref<Vec3> v);

/// Applies every surface, each in its own frame, to a particle that was at x_n with v_n at time t_n and would be at x
/// with v at t. Returns the energy lost in the contacts (J/kg), or nothing if no surface was touched. Without
/// `with_loss`, the energy is 0, which saves as much time as the contact itself takes.
std::optional<double> resolve_surfaces(std::span<const Surface> surfaces, ContactFunction act, double t_n, double t,
                                       const Vec3& x_n, const Vec3& v_n, Eigen::Ref<Vec3> x, Eigen::Ref<Vec3> v,
                                       bool with_loss = true);

class Contacts {
 public:
  Contacts(const Model& model, ContactRule rule);
  bool any() const { return !surfaces_.empty(); }
  void begin(const State& s);
  /// Returns true if any particle touched a surface.
  bool resolve(State& s);
  /// Energy lost in the last resolve() (J); nothing if no particle touched a surface.
  const std::optional<double>& lost() const { return lost_; }

 private:
  const Particles& particles_;
  std::vector<Surface> surfaces_;
  ContactRule rule_;
  Eigen::ArrayXd drag_rate_;  // n, 1/s
  State before_;              // beginning of the step
  std::optional<double> lost_;
};

}  // namespace crosscheck
