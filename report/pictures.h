// From scenes and answers to pictures: what is drawn in which mode, and from where it is seen.
#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "report/render/picture.h"

namespace crosscheck {

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

/// Answers of one scene side by side, in one view. Answers without frames are left out; a failed run is shown at its
/// last finite frame and says so. In mode difference the first answer is the one that the others are set against.
/// Throws InputError when nothing can be shown.
render::Picture picture_of(const Scene& scene, const std::vector<const Answer*>& answers, const Shot& shot);

/// What pictures have in common that are to be compared, like those of a clip.
struct Look {
  render::View view;
  double top;  // of the scale, in its unit
};
/// The one that suits all of these shots, which are of one mode and size, in the order of their times.
Look look_of(const Scene& scene, const std::vector<const Answer*>& answers, const std::vector<Shot>& shots);
render::Picture picture_of(const Scene& scene, const std::vector<const Answer*>& answers, const Shot& shot,
                           const Look& look);

/// From where a scene is seen, and the ground below all that it does.
struct Vantage {
  Vec3 from;                    // from what is looked at towards the eye, of any length
  std::optional<double> floor;  // m, height; none where all lies in a plane that faces the viewer
};
/// Of everything shown, and of the obstacles at all these times (s).
Vantage vantage_of(const Scene& scene, const std::vector<Points>& shown, const std::vector<double>& times);

/// Which of the answer's frames such a shot shows (not of mode strip).
int frame_shown(const Scene& scene, const Answer& answer, const Shot& shot);

/// The methods that a picture of the scene shows when nobody names any.
std::vector<std::string> pictured_methods(const Scene& scene);

}  // namespace crosscheck
