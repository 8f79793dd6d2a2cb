#include "tests/coursework/a4-collision/cases.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework {

const Assignment& a4_collision() {
  static const Part parts[] = {{"closest", "closest.title"},
                               {"position", "position.title"},
                               {"velocity", "velocity.title"},
                               {"step", "step.title"},
                               {"cloth", "cloth.title"}};
  static const Test tests[] = {
      {"1.1", "closest", 2, 2, {"distance"}, "Distance and normal", a4::gap, nullptr, a4::small_place},
      {"1.2", "closest", 2, 1, {"normal"}, "Distance and normal", a4::normal, nullptr, a4::small_place},
      {"1.3", "closest", 2, 1, {"projection"}, "Distance and normal", a4::nearest, nullptr, a4::small_place},
      {"1.4", "closest", 1, 1, {"robustness"}, "At the very centre", a4::very_centre},
      {"1.5", "closest", 1, 1, {"distance", "projection"}, "A plane", a4::plane_places},
      {"2.1", "position", 2, 1, {"contact"}, "The position", a4::untouched, nullptr, a4::small_move},
      {"2.2", "position", 3, 2, {"projection"}, "The position", a4::pushed_out, nullptr, a4::small_move},
      {"2.3", "position", 3, 2, {"friction"}, "Friction on the position", a4::sliding, nullptr, a4::small_move},
      {"2.4", "position", 3, 2, {"friction"}, "Friction on the position", a4::holding, nullptr, a4::small_move},
      {"2.5", "position", 2, 1, {"robustness"}, "The position", a4::inside_at_the_start, nullptr, a4::small_move},
      {"2.6", "position", 2, 1, {"friction"}, "Friction on the position", a4::plane_moves},
      {"3.1", "velocity", 2, 1, {"contact"}, "The velocity", a4::going_away, nullptr, a4::small_velocity},
      {"3.2", "velocity", 3, 2, {"projection"}, "The velocity", a4::inward_removed, nullptr, a4::small_velocity},
      {"3.3", "velocity", 3, 2, {"restitution"}, "Restitution", a4::bounce, nullptr, a4::small_velocity},
      {"3.4",
       "velocity",
       3,
       2,
       {"friction", "restitution"},
       "Friction on the velocity",
       a4::rubbing,
       nullptr,
       a4::small_velocity},
      {"3.5", "velocity", 2, 2, {"friction"}, "Friction on the velocity", a4::stopped, nullptr, a4::small_velocity},
      {"4.1", "step", 3, 1, {"symplectic Euler"}, "The step", a4::free_flight},
      {"4.2", "step", 4, 2, {"contact"}, "The step", a4::one_step, nullptr, a4::small_step},
      {"4.3", "step", 3, 2, {"frictionless slide"}, "Where a slide ends", a4::leaving_angle, nullptr, a4::small_step},
      {"4.4", "step", 2, 2, {"restitution"}, "How high it bounces", a4::rebound_height, nullptr, a4::small_step},
      {"4.5",
       "step",
       3,
       2,
       {"friction", "Coulomb cone"},
       "What holds and what slides",
       a4::coulomb_cone,
       nullptr,
       a4::small_step},
      {"5.1", "cloth", 2, 1, {"right-hand side"}, "The cloth", a4::accelerations, nullptr, a4::small_accelerations},
      {"5.2", "cloth", 3, 2, {"pins", "contact"}, "The cloth", a4::pins_and_spheres, nullptr, a4::small_cloth_step},
      {"5.3",
       "cloth",
       2,
       2,
       {"friction"},
       "A patch that holds or slides",
       a4::patch_on_a_slope,
       nullptr,
       a4::small_cloth_step},
      {"5.4", "cloth", 2, 2, {"motion"}, "The cloth", a4::drape, nullptr, a4::small_cloth_step},
  };
  static const Assignment assignment{"a4-collision", "Collision", parts, tests};
  return assignment;
}

}  // namespace coursework
