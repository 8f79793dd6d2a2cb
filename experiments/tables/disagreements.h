// The tables of experiment `disagreements`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// A case where one of Bullet's worlds solves another problem than the scene's.
struct DisagreementRow {
  TABLE("disagreements");
  COLUMN(std::string, name, "name", "1", "name of the disagreement and of its scene");
  COLUMN(std::string, world, "world", "1", "method whose it is");
  COLUMN(std::string, what, "what", "1", "what cannot be matched, or fails");
  COLUMN(std::string, cause, "cause", "1", "why");
  COLUMN(std::string, effect, "effect", "1", "its size as measured");
  COLUMN(std::string, threads, "threads", "1", "upstream reports that it answers; empty: none known");
  COLUMN(std::string, state, "state", "1",
         "explained, reproduced, not reproduced or not asked, computed by the criterion");
  COLUMN(std::string, criterion, "criterion", "1", "what the curves must do for that");
  COLUMN(std::string, scene_hash, "scene hash", "1", "fingerprint of the scene file");
};

/// A disagreement over time. Each such table calls its last column by its own quantity.
struct DisagreementCurveRow {
  TABLE("NAME-disagreement");
  COLUMN(std::string, curve, "curve", "1", "title of the curve");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(double, t, "t", "s", "time of the sample");
  COLUMN(double, value, "QUANTITY", "UNIT", "what the disagreement is seen in; the file has its name and unit");
};

/// In which direction a ball pushes.
struct ContactAngleRow {
  TABLE("NAME-angles");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, angle, "angle", "rad", "place on the ball, from its top");
  COLUMN(double, in_plane, "in plane", "rad",
         "direction of the push less the normal, in the plane of gravity; positive: as if farther down");
  COLUMN(double, sideways, "sideways", "rad", "the same across that plane");
  COLUMN(std::string, scene_hash, "scene hash", "1", "fingerprint of the scene file");
};

}  // namespace crosscheck
