// From scenes and results to pictures: modes, shapes and cameras.
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
  double text = 0;  // height of letters, pixels; 0: as the size needs. With it the panels choose rows and height
};

/// The shot at the head of a scene's part of the report.
Shot usual_shot(const Scene& scene, bool full);

/// Results of one scene side by side, in one view. Results without frames are left out; a failed run is shown at its
/// last finite frame and says so. In mode difference the others are compared with the first one.
/// Throws InputError when nothing can be shown.
render::Picture picture_of(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot);

/// The common view of pictures that are to be compared.
struct CommonView {
  render::View view;
  double top;  // upper end of the scale, in its unit
};
/// The one that suits this shot.
CommonView common_view(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot);
render::Picture picture_of(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                           const CommonView& common);

/// From where a scene is seen, and the ground below all that it does.
struct CameraPlacement {
  Vec3 from;                    // from what is looked at towards the eye, of any length
  std::optional<double> floor;  // m, height; none where all lies in a plane that faces the viewer
};
/// Of everything shown, and of the obstacles at all these times (s).
CameraPlacement camera_placement(const Scene& scene, const std::vector<Points>& shown,
                                 const std::vector<double>& times);

/// The frame of the result that such a shot shows (not of mode strip).
int frame_shown(const Scene& scene, const MethodResult& answer, const Shot& shot);

/// The methods that a picture of the scene shows when none is named.
std::vector<std::string> pictured_methods(const Scene& scene);

}  // namespace crosscheck
