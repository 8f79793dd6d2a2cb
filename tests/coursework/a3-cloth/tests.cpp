// The tests of the cloth assignment and their points.
#include "tests/coursework/a3-cloth/cases.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework {

const Assignment& a3_cloth() {
  static const Part parts[] = {{"grid", "grid.title"},
                               {"springs", "springs.title"},
                               {"forces", "forces.title"},
                               {"wind", "wind.title"},
                               {"derivative", "derivative.title"}};
  static const Test tests[] = {
      {"1.1", "grid", 2, 1, {"indexing"}, "The grid", a3::index},
      {"1.2", "grid", 3, 2, {"indexing", "boundaries"}, "The grid", a3::neighbours},
      {"1.3", "grid", 2, 2, {"geometry"}, "The grid", a3::positions},
      {"2.1", "springs", 4, 2, {"springs", "boundaries"}, "Three families of springs", a3::structural},
      {"2.2", "springs", 4, 2, {"springs", "boundaries"}, "Three families of springs", a3::shear},
      {"2.3", "springs", 4, 2, {"springs", "boundaries"}, "Three families of springs", a3::flexion},
      {"2.4", "springs", 3, 2, {"springs", "rest length"}, "Rest lengths", a3::spring_steps},
      {"2.5", "springs", 2, 1, {"springs", "counting"}, "How many there are", a3::spring_counts},
      {"3.1", "forces", 3, 2, {"spring force"}, "The force of a spring", a3::one_spring},
      {"3.2", "forces", 3, 2, {"spring force", "superposition"}, "The force of a spring", a3::sheet_springs, nullptr,
       a3::small_sheet_springs},
      {"3.3", "forces", 3, 2, {"conservation laws", "energy"}, "Laws that need no numbers", a3::spring_laws, nullptr,
       a3::small_spring_laws},
      {"3.4", "forces", 2, 1, {"robustness"}, "When two ends meet", a3::ends_that_meet},
      {"3.5", "forces", 1, 1, {"gravity"}, "Gravity and drag", a3::gravity},
      {"3.6", "forces", 1, 1, {"drag"}, "Gravity and drag", a3::drag},
      {"4.1", "wind", 2, 1, {"meshes", "boundaries"}, "Triangles", a3::triangles},
      {"4.2", "wind", 2, 1, {"time dependence"}, "Wind that comes and goes", a3::air},
      {"4.3", "wind", 3, 2, {"pressure"}, "Pressure on a triangle", a3::one_triangle},
      {"4.4", "wind", 4, 3, {"pressure", "relative velocity"}, "Pressure on a triangle", a3::wind_on_cloth, nullptr,
       a3::small_wind_on_cloth},
      {"5.1", "derivative", 4, 2, {"right-hand side"}, "The derivative", a3::rates, nullptr,
       a3::small_rates},
      {"5.2", "derivative", 3, 2, {"pins"}, "Pins", a3::pinned_rates, nullptr,
       a3::small_pinned_rates},
      {"5.3", "derivative", 2, 2, {"pure functions"}, "The state you are given", a3::rates_again, nullptr,
       a3::small_rates_again},
      {"5.4", "derivative", 2, 1, {"equilibrium"}, "A strip that hangs", a3::hanging_strip, nullptr,
       a3::small_pinned_rates},
      {"5.5", "derivative", 2, 2, {"motion"}, "The derivative", a3::swinging_cloth, nullptr,
       a3::small_rates},
  };
  static const Assignment assignment{"a3-cloth", "Cloth", parts, tests};
  return assignment;
}

}  // namespace coursework
