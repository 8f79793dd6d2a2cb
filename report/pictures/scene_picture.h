#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "mysim/scene/scene.h"
#include "report/pictures/picture.h"

namespace crosscheck {

enum class Mode { shaded, stretch, springs, difference, strip };
/// Mode with this name. Throws InputError that lists the modes.
Mode mode_named(const std::string& name);

struct Shot {
  Mode mode = Mode::shaded;
  double at = -1;  // s; negative: the end
  render::Quality quality = render::Quality::still;
  int width = 1280, height = 720;
  double text = 0;  // height of letters, pixels; 0: derived from the size. If it is given, the panels determine rows
                    // and height
};

/// Default shot for a scene's card in the report.
Shot usual_shot(const Scene& scene, bool full);

/// Results side by side in one view. Omits results without frames; shows a failed run at its last finite frame, with a
/// note. In mode `difference`, compares all methods with the first one. Throws InputError if nothing can be shown.
render::Picture picture_of(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot);

/// View and scale that make pictures comparable.
struct CommonView {
  render::View view;
  double top;  // upper end of the scale, in the unit of the scale
};
CommonView common_view(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot);
render::Picture picture_of(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                           const CommonView& common);

/// Viewing direction, and height of the ground, which is below the entire motion.
struct CameraPlacement {
  Vec3 from;                    // towards the eye, of any length
  std::optional<double> floor;  // m, height of the ground; nullopt if everything lies in a plane that faces the viewer
};
/// Camera for these positions, and for the obstacles at these times (s).
CameraPlacement camera_placement(const Scene& scene, const std::vector<Points>& shown,
                                 const std::vector<double>& times);

/// The frame that a shot shows (not for mode strip).
int frame_shown(const Scene& scene, const MethodResult& answer, const Shot& shot);

/// Default methods for a picture.
std::vector<std::string> pictured_methods(const Scene& scene);

}  // namespace crosscheck
