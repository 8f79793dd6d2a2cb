// Relations: what two runs of one engine must have in common without any truth, each on the smallest scene that can
// show it, with a tolerance that is derived and not chosen.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/check/subject.h"

namespace crosscheck {

/// What was measured, beside what it may be.
struct RelationResult {
  std::string what;  // what was compared, a phrase
  std::string unit;
  double measured = 0, tolerance = 0;  // in the unit
  std::optional<double> since = {};    // s, the first time over the tolerance

  /// measured / tolerance; infinite where nothing is allowed, and NaN counts as infinite.
  double ratio() const;
  bool holds() const { return ratio() <= 1; }
};

/// The one that is farther over its tolerance, or nearer to it.
RelationResult worse(RelationResult a, RelationResult b);

struct Relation {
  std::string_view name;      // in tables and files of known disagreements
  std::string_view sentence;  // for people
  std::string_view allowed;   // how its tolerance is derived
  std::vector<Scene> (*smallest)();
  /// Why the relation says nothing about a scene; empty where it does.
  std::string (*excluded)(const Scene& scene);
  /// Throws CannotBeAsked and RunFailed (subject.h).
  RelationResult (*ask)(Subject& subject, const Scene& scene, unsigned seed);
};

/// The table (relations.cpp).
std::span<const Relation> relations();
/// The relation of that name, or null.
const Relation* relation_named(std::string_view name);
/// The same. Throws InputError that names the nearest.
const Relation& find_relation(const std::string& name);

// The functions of the table. Those of transformed scenes are in transformed.cpp, those of mechanics in mechanics.cpp,
// those of one scene solved by other settings in settings.cpp.

RelationResult turned_start(Subject& subject, const Scene& scene, unsigned seed);
RelationResult shifted_start(Subject& subject, const Scene& scene, unsigned seed);
RelationResult order_of_particles(Subject& subject, const Scene& scene, unsigned seed);
RelationResult order_of_springs(Subject& subject, const Scene& scene, unsigned seed);
RelationResult scaled_scene(Subject& subject, const Scene& scene, unsigned seed);
RelationResult mirror_symmetry(Subject& subject, const Scene& scene, unsigned seed);

RelationResult free_fall(Subject& subject, const Scene& scene, unsigned seed);
RelationResult no_force_no_motion(Subject& subject, const Scene& scene, unsigned seed);
RelationResult momentum_kept(Subject& subject, const Scene& scene, unsigned seed);
RelationResult angular_momentum_kept(Subject& subject, const Scene& scene, unsigned seed);
RelationResult energy_without_drift(Subject& subject, const Scene& scene, unsigned seed);
RelationResult pins_on_their_path(Subject& subject, const Scene& scene, unsigned seed);
RelationResult rest_without_damping(Subject& subject, const Scene& scene, unsigned seed);
RelationResult extension_by_stiffness(Subject& subject, const Scene& scene, unsigned seed);
RelationResult stiffness_has_effect(Subject& subject, const Scene& scene, unsigned seed);

RelationResult half_the_step(Subject& subject, const Scene& scene, unsigned seed);
RelationResult one_answer(Subject& subject, const Scene& scene, unsigned seed);
RelationResult stop_and_go_on(Subject& subject, const Scene& scene, unsigned seed);
RelationResult same_call_twice(Subject& subject, const Scene& scene, unsigned seed);

}  // namespace crosscheck
