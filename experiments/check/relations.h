// Relations: invariants and metamorphic relations between runs of one engine, which need no reference solution. Each is
// checked on the smallest scene that can show a violation, with a derived tolerance.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/check/subject.h"

namespace crosscheck {

struct RelationResult {
  std::string what;  // phrase that names the compared quantity
  std::string unit;
  double measured = 0, tolerance = 0;  // in the unit
  std::optional<double> since = {};    // s, first time at which `measured` exceeds `tolerance`

  /// Infinite if the tolerance is zero or the measured value is NaN.
  double ratio() const;
  bool holds() const { return ratio() <= 1; }
};

RelationResult worse(RelationResult a, RelationResult b);

struct Relation {
  std::string_view name;      // as used in tables and in files of known breaks
  std::string_view sentence;  // for human readers
  std::string_view allowed;   // derivation of the tolerance
  std::vector<Scene> (*smallest)();
  /// Returns why the relation does not apply to a scene, or an empty text if it does.
  std::string (*excluded)(const Scene& scene);
  /// Throws CannotBeAsked and RunFailed (subject.h).
  RelationResult (*ask)(Subject& subject, const Scene& scene, unsigned seed);
};

std::span<const Relation> relations();
const Relation* relation_named(std::string_view name);
/// Throws InputError with a suggestion if no relation has this name.
const Relation& find_relation(const std::string& name);

// relations, defined in transformed.cpp, mechanics.cpp and settings.cpp

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
