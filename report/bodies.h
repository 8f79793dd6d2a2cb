// What of a scene is drawn, and as which shapes.
#pragma once

#include <vector>

#include "experiments/experiment.h"
#include "report/pictures.h"

namespace crosscheck {

/// What the answer looks like at one of its frames; in mode difference coloured by the distance from `base`.
render::Body body_of(const Scene& scene, const Answer& answer, int frame, Mode mode, const Points* base);

/// The families that the scene's springs belong to, in the order of the legend.
std::vector<Family> families_of(const Scene& scene);

/// The springs of a cloth as tubes, one body per family: structural ones thick, shear and bend ones thin. Bend springs
/// lie on the structural ones; they are lifted towards the eye so that both are seen.
std::vector<render::Body> tubes_of(const Scene& scene, const Points& x, const Vec3& towards_eye);

/// The obstacles at time t, s.
std::vector<render::Ball> balls_of(const Scene& scene, double t);

}  // namespace crosscheck
