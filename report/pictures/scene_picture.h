// From scenes and results to pictures: modes, shapes and cameras.
#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "mysim/scene/scene.h"
#include "report/pictures/picture.h"

namespace crosscheck {

// The stretch of springs, as colours show it.

/// Extension of the line between two particles, % of its length at rest; compression counts as zero.
double extension(const Points& x, int a, int b, double rest);

/// Mean extension of the structural springs and hard distances at each particle, %; that of every spring, on request.
std::vector<double> stretch_of(const Scene& scene, const Points& x, std::vector<double>* per_spring = nullptr);

/// A round number not below the value: 1, 2 or 5 times a power of ten.
double round_up(double value);

enum class Mode { shaded, stretch, springs, difference, strip };
/// Throws InputError that lists the modes.
Mode mode_named(const std::string& name);

struct Shot {
  Mode mode = Mode::shaded;
  double at = -1;                 // s; negative: the end
  bool at_first_failure = false;  // all at the time at which the first of the runs failed, colours up to its stretch
  render::Quality quality = render::Quality::still;
  int width = 1280, height = 720;
  double text = 0;       // height of letters, pixels; 0: as the size needs. With it the panels choose rows and height
  bool in_clip = false;  // times with two decimals always, and no word of a failure before it comes
};

/// The shot at the head of a scene's part of the report.
Shot usual_shot(const Scene& scene, bool full);

/// Results of one scene side by side, in one view. Results without frames are left out; a failed run is shown at its
/// last finite frame and says so. In mode difference the others are compared with the first one.
/// Throws InputError when nothing can be shown.
render::Picture picture_of(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot);

/// The common view of pictures that are to be compared, like those of a clip.
struct CommonView {
  render::View view;
  double top;  // of the scale, in its unit
};
/// The one that suits all of these shots, which are of one mode and size, in the order of their times.
CommonView common_view(const Scene& scene, const std::vector<const MethodResult*>& answers,
                       const std::vector<Shot>& shots);
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

/// The body at one of the result's frames; in mode difference coloured by the distance from `base`.
render::Body body_of(const Scene& scene, const MethodResult& answer, int frame, Mode mode, const Points* base);

/// The families that the scene's springs belong to, in the order of the legend.
std::vector<Family> families_of(const Scene& scene);

/// The springs of a cloth as tubes, one body per family: structural ones thick, shear and bend ones thin. Bend springs
/// lie on the structural ones; they are lifted towards the eye so that both are seen.
std::vector<render::Body> tubes_of(const Scene& scene, const Points& x, const Vec3& towards_eye);

/// The obstacles at time t, s.
std::vector<render::Ball> balls_of(const Scene& scene, double t);

}  // namespace crosscheck
