#include "experiments/check/relations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/check/compare.h"
#include "experiments/check/transformations.h"
#include "mysim/base/errors.h"
#include "mysim/base/text.h"

namespace crosscheck {
namespace {

std::string any_scene(const Scene&) { return ""; }
std::string with_springs(const Scene& s) {
  return s.model.find<Springs>() || s.model.find<Constraints>() ? "" : "no springs";
}
std::string movable(const Scene& s) {
  if (s.model.first_order()) return "its field depends on place and direction";
  // rounding decides the last bounces before rest; perturbations of the start do not reveal this, so no bound is known
  for (const Surface& surface : surfaces_of(s.model))
    if (surface.restitution > 0) return "rounding decides the last of endless bounces";
  return "";
}
std::string symmetric(const Scene& s) { return mirror_of(s) ? "" : "not symmetric"; }
std::string smooth(const Scene& s) { return has_contact(s.model) ? "contact lowers the order" : ""; }
std::string unchanging(const Scene& s) { return outside_of(s).changing ? "forces or pins vary with time" : ""; }
std::string pinned(const Scene& s) { return s.model.particles.pins.empty() ? "no pins" : ""; }
std::string hanging_chain(const Scene& s) { return hanging_chain_of(s).empty() ? "no damped hanging chain" : ""; }

std::string falling(const Scene& s) {
  const Outside o = outside_of(s);
  if (!o.gravity) return "no gravity";
  if (o.pins || o.wind || o.air || o.drag || o.contact || o.constraints) return "external forces besides gravity";
  if (!springs_at_rest(s)) return "springs are not at rest";
  return largest_column((s.start.v.colwise() - Vec3(s.start.v.col(0))).eval()) > 0 ? "initial velocities differ" : "";
}
std::string resting(const Scene& s) {
  const Outside o = outside_of(s);
  if (o.gravity || o.wind || o.air || o.contact || o.field || o.changing) return "external forces act";
  if (!springs_at_rest(s)) return "springs are not at rest";
  return largest_column(s.start.v) > 0 ? "it starts in motion" : "";
}
std::string isolated(const Scene& s) {
  const Outside o = outside_of(s);
  return o.pins || o.gravity || o.wind || o.air || o.drag || o.contact || o.field ? "external forces act" : "";
}
std::string undamped(const Scene& s) {
  const Outside o = outside_of(s);
  return o.drag || o.dashpots || o.wind || o.air || o.contact || o.constraints || o.field || o.changing
             ? "energy is supplied or dissipated"
             : "";
}

constexpr auto rounding =
    "three times the measured growth of a perturbation of 10 u L sqrt(n) (unit round-off, lengths, steps)";
constexpr auto rounding_and_unsolved =
    "three times the measured growth of a perturbation of 10 u L sqrt(n), and for implicit rules the residual of the "
    "equation in each step";
constexpr auto rounding_and_iterations =
    "three times the measured growth of a perturbation of 10 u L sqrt(n), and with sequential projection the "
    "difference between n and 2n iterations";
constexpr auto settling = "the movement of the runs in their last quarter, and 10 u L sqrt(n)";

constexpr Relation table[] = {
    {"free-fall", "an unpinned net falls by the formula of its rule, without relative motion", rounding_and_unsolved,
     falling_nets, falling, free_fall},
    {"turned", "a rotated start gives the rotated run", rounding_and_unsolved, nets_anywhere, movable, turned_start},
    {"shifted", "a shifted start gives the shifted run", rounding_and_unsolved, small_nets, movable, shifted_start},
    {"no-force", "no force, no motion", rounding, resting_nets, resting, no_force_no_motion},
    {"rest-shape", "the shape at rest does not depend on damping", settling, hanging_chains, hanging_chain,
     rest_without_damping},
    {"extension", "in a hanging chain, stiffness times extension is the weight below", settling, hanging_chains_in_drag,
     hanging_chain, extension_by_stiffness},
    {"stiffness", "the stiffness of every spring has an effect", settling, hanging_chains_in_drag, hanging_chain,
     stiffness_has_effect},
    {"one-answer", "finer steps and more iterations converge to one answer",
     "half of the first difference after two halvings, and twice the rounding", small_nets, smooth, one_answer},
    {"particle-order", "the order of particles does not matter", rounding_and_iterations, small_nets, any_scene,
     order_of_particles},
    {"spring-order", "the order of springs does not matter", rounding_and_iterations, small_nets, with_springs,
     order_of_springs},
    {"half-step", "halving the step changes the motion as the rule's order allows",
     "2^(1/2 - order) of the first difference, and twice the rounding", small_nets, smooth, half_the_step},
    {"scaling", "a scene scaled in length, mass or time gives the scaled run", rounding, small_nets, any_scene,
     scaled_scene},
    {"momentum", "a free net conserves its momentum", rounding_and_unsolved, flying_nets, isolated, momentum_kept},
    {"angular-momentum", "a free net conserves its angular momentum",
     "rounding, and for rules that are not symplectic 2^(1/2 - order) of the change at twice the step", flying_nets,
     isolated, angular_momentum_kept},
    {"mirror", "a symmetric scene stays symmetric", rounding_and_iterations, symmetric_nets, symmetric,
     mirror_symmetry},
    {"pins", "pins stay in place, or on their prescribed path", "10 u L sqrt(n)", pinned_nets, pinned,
     pins_on_their_path},
    {"energy", "the energy of an undamped net has no drift beyond its oscillation, or one that falls with the step",
     "the oscillation within a tenth of the run (median) and 10 u E sqrt(n); beyond that 2^(1/2 - order) of the drift "
     "at twice the step",
     vibrating_nets, undamped, energy_without_drift},
    {"resume", "a run that is stopped and resumed from its state continues unchanged",
     "rounding, and the change by half the step", small_nets, unchanging, stop_and_go_on},
    {"repeatable", "repeating a call gives the same bits", "none", small_nets, any_scene, same_call_twice},
};

}  // namespace

double RelationResult::ratio() const {
  if (std::isnan(measured) || std::isnan(tolerance)) return std::numeric_limits<double>::infinity();
  if (measured <= 0) return 0;
  return tolerance > 0 ? measured / tolerance : std::numeric_limits<double>::infinity();
}

RelationResult worse(RelationResult a, RelationResult b) { return b.ratio() > a.ratio() ? std::move(b) : std::move(a); }

std::span<const Relation> relations() { return table; }

const Relation* relation_named(std::string_view name) {
  const auto* at = std::ranges::find(table, name, &Relation::name);
  return at == std::end(table) ? nullptr : at;
}

const Relation& find_relation(const std::string& name) {
  if (const Relation* relation = relation_named(name)) return *relation;
  std::vector<std::string> names;
  for (const Relation& relation : table) names.emplace_back(relation.name);
  throw InputError(fmt::format("unknown relation '{}'; expected one of: {}{}", name, fmt::join(names, ", "),
                               did_you_mean(name, names)));
}

}  // namespace crosscheck
