// Pictures of scenes and results: modes, shapes and cameras.
#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "mysim/scene/scene.h"
#include "report/pictures/picture.h"

namespace crosscheck {

enum class Mode { shaded, stretch, springs, difference, strip };
/// Throws InputError that lists the modes.
Mode mode_named(const std::string& name);

struct Shot {
  Mode mode = Mode::shaded;
  double at = -1;  // s; negative: the end
  render::Quality quality = render::Quality::still;
  int width = 1280, height = 720;
  double text = 0;  // height of letters, pixels; 0: chosen from the size. If given, the panels determine rows and
                    // height
};

/// The default shot of a scene's card in the report.
Shot usual_shot(const Scene& scene, bool full);

/// Results of one scene side by side, in one view. Omits results without frames; shows a failed run at its last finite
/// frame, with a note. In mode difference the other methods are compared with the first. Throws InputError if nothing
/// can be shown.
render::Picture picture_of(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot);

/// The common view of pictures that are compared with each other.
struct CommonView {
  render::View view;
  double top;  // upper end of the scale, in its unit
};
/// The common view for this shot.
CommonView common_view(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot);
render::Picture picture_of(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                           const CommonView& common);

/// Direction from which a scene is seen, and the ground below all of its motion.
struct CameraPlacement {
  Vec3 from;                    // from the target towards the eye, of any length
  std::optional<double> floor;  // height, m; empty if everything lies in a plane that faces the viewer
};
/// Placement for all shown positions, and for the obstacles at these times (s).
CameraPlacement camera_placement(const Scene& scene, const std::vector<Points>& shown,
                                 const std::vector<double>& times);

/// The frame of the result that such a shot shows (not for mode strip).
int frame_shown(const Scene& scene, const MethodResult& answer, const Shot& shot);

/// The default methods of a picture of the scene.
std::vector<std::string> pictured_methods(const Scene& scene);

}  // namespace crosscheck
