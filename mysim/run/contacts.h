// Contact of all particles with the scene's surfaces (spheres and planes), after a step; and the energy that it takes.
//
// Per kilogram of a particle, with J the change of its velocity by a surface and a = (v* - v_n) / h the acceleration by
// all other forces, where x_n, v_n are the start of the step, x*, v* what the stepper proposed, x', v' what contact
// made of it:
//   An impact is where |J| > 3 (1 + e) |a| h: what came in faster than those forces explain. It lies at one moment and
//   takes -J . (v* + v') / 2 + a . (x' - x*), the kinetic energy with which the particle met the surface, which lies
//   x' - x* before the end of its displacement.
//   Any other contact lasted through the step. Its normal part does no work but what a moving surface does by its
//   displacement s in the step; friction works over the particle's displacement: -(J_t . (x' - x_n) + J_n . s) / h.
// Hence 0 for what rests on a surface at rest, whatever the stepper proposes in each step. What the free step and the
// push out of the surface do to the energy of a particle that touches is an error of the method, not a loss, and is
// left to the balance. The 3: explicit Euler holds a resting particle in every other step, by |J| = 2 |a| h.
#pragma once

#include <optional>
#include <string_view>

#include "mysim/model/model.h"

namespace crosscheck {

struct Stepper;

enum class ContactRule {
  coulomb,  // acts on whole steps (terms/surface.h): of order 1
  events,   // with touching, leaving and stopping located within the step (contact_events.h): see locates_events
  sticky,   // the assignment's sphere, kept to be shown failing
};
/// The rule that an option of a method asks for ("events", "sticky"), or nothing.
std::optional<ContactRule> contact_rule_of_option(std::string_view option);

/// True for rules that reach order 2 under ContactRule::events. A rule of order 1 moves along another path than its
/// velocities, by h^2 a / 2, as much as contact holds it by. A rule that evaluates forces at several stages does so
/// inside the solids: there a rounding of the speed at first touch decides between two paths.
bool locates_events(const Stepper& stepper);

/// The action of a rule on one particle that touches a surface: as resolve_contact.
using ContactFunction = double (*)(const Surface&, const Vec3& origin, const Vec3& x_n, Eigen::Ref<Vec3> x,
                                   Eigen::Ref<Vec3> v);

/// Lets every surface act, each in its own frame, on a particle that was at x_n with v_n at time t_n and would be at x
/// with v at t. What the contacts took, J per kilogram of the particle (0 where it is not asked for: it costs as much
/// as the contact itself); nothing where none touched.
std::optional<double> resolve_surfaces(std::span<const Surface> surfaces, ContactFunction act, double t_n, double t,
                                       const Vec3& x_n, const Vec3& v_n, Eigen::Ref<Vec3> x, Eigen::Ref<Vec3> v,
                                       bool with_loss = true);

class Contacts {
 public:
  Contacts(const Model& model, ContactRule rule);
  bool any() const { return !surfaces_.empty(); }
  /// Remembers where the step begins.
  void begin(const State& s);
  /// Lets every surface act on the whole step of every free particle; true when one touched.
  bool resolve(State& s);
  /// The loss in the last resolve(), J; nothing where nothing touched.
  const std::optional<double>& lost() const { return lost_; }

 private:
  const Particles& particles_;
  std::vector<Surface> surfaces_;
  ContactRule rule_;
  Eigen::ArrayXd drag_rate_;  // n, 1/s
  State before_;              // where the step began
  std::optional<double> lost_;
};

}  // namespace crosscheck
