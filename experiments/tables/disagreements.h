#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

struct DisagreementRow {
  TABLE("disagreements");
  COLUMN(std::string, name, "name", "1", "name of the disagreement and of its scene");
  COLUMN(std::string, world, "world", "1", "Bullet method that disagrees");
  COLUMN(std::string, what, "what", "1", "property that cannot be matched, or that fails");
  COLUMN(std::string, cause, "cause", "1", "cause of the disagreement");
  COLUMN(std::string, effect, "effect", "1", "measured size of the disagreement");
  COLUMN(std::string, threads, "threads", "1", "upstream reports that it explains; empty if none is known");
  COLUMN(std::string, state, "state", "1",
         "explained, reproduced, not reproduced or not asked, according to the criterion");
  COLUMN(std::string, criterion, "criterion", "1", "condition on the curves that decides on the state");
  COLUMN(std::string, scene_hash, "scene hash", "1", "fingerprint of the scene file");
};

/// A disagreement over time. Each of these tables names its last column after the disagreement's quantity.
struct DisagreementCurveRow {
  TABLE("NAME-disagreement");
  COLUMN(std::string, curve, "curve", "1", "title of the curve");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(double, t, "t", "s", "time of the sample");
  COLUMN(double, value, "QUANTITY", "UNIT", "quantity that shows the disagreement; the file has its name and unit");
};

struct ContactAngleRow {
  TABLE("NAME-angles");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, angle, "angle", "rad", "position on the ball, measured from its top");
  COLUMN(double, in_plane, "in plane", "rad",
         "angle from the normal to the direction of the push, in the plane of gravity; positive: as if farther down");
  COLUMN(double, sideways, "sideways", "rad",
         "angle from the normal to the direction of the push, across the plane of gravity");
  COLUMN(std::string, scene_hash, "scene hash", "1", "fingerprint of the scene file");
};

}  // namespace crosscheck
