// In which direction a method pushes a particle away from a ball, against the ball's own normal.
#pragma once

#include <string>
#include <vector>

#include "mysim/scene.h"

namespace crosscheck {

/// At one place of the ball, `angle` from the top: the direction of the impulses, less the normal there, in the plane
/// of gravity (positive: as if the place were farther down) and across it. rad; as the step goes to 0.
struct DirectionError {
  double angle, in_plane, sideways;
};

/// Lets the scene's particle go at rest 0.12 mm inside the scene's ball, without friction, at each of the angles (rad),
/// and reads the direction off the impulses of 4 ms, m (v - g t), in which it moves by less than 0.06 mm. In steps h of
/// 0.2 ms and half of it, extrapolated to 0 as 2 e(h/2) - e(h). Throws std::runtime_error where the method cannot run
/// the scene.
std::vector<DirectionError> direction_errors(const std::string& method, Scene scene, const std::vector<double>& angles);

}  // namespace crosscheck
