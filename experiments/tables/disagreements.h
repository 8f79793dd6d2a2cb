// The tables of experiment `disagreements`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// A case where one of Bullet's worlds solves another problem than the scene's.
struct DisagreementRow {
  std::string name, world, what, cause, effect, threads, state, criterion, scene_hash;

  static constexpr std::string_view table = "disagreements";
  static constexpr auto columns = [](auto&& column) {
    column("name", "1", &DisagreementRow::name, "name of the disagreement and of its scene"),
        column("world", "1", &DisagreementRow::world, "method whose it is"),
        column("what", "1", &DisagreementRow::what, "what cannot be matched, or fails"),
        column("cause", "1", &DisagreementRow::cause, "why"),
        column("effect", "1", &DisagreementRow::effect, "its size as measured"),
        column("threads", "1", &DisagreementRow::threads, "upstream reports that it answers; empty: none known"),
        column("state", "1", &DisagreementRow::state,
               "explained, reproduced, not reproduced or not asked, computed by the criterion"),
        column("criterion", "1", &DisagreementRow::criterion, "what the curves must do for that"),
        column("scene hash", "1", &DisagreementRow::scene_hash, "fingerprint of the scene file");
  };
};

/// A disagreement over time. Each such table calls its last column by its own quantity.
struct DisagreementCurveRow {
  std::string curve, method;
  double step = 0;
  Verdict verdict = Verdict::ok;
  double t = 0, value = 0;

  static constexpr std::string_view table = "NAME-disagreement";
  static constexpr auto columns = [](auto&& column) {
    column("curve", "1", &DisagreementCurveRow::curve, "title of the curve"),
        column("method", "1", &DisagreementCurveRow::method, "method that was run"),
        column("step", "s", &DisagreementCurveRow::step, "time step taken"),
        column("verdict", "1", &DisagreementCurveRow::verdict, "how the run ended"),
        column("t", "s", &DisagreementCurveRow::t, "time of the sample"),
        column("QUANTITY", "UNIT", &DisagreementCurveRow::value,
               "what the disagreement is seen in; the file has its name and unit");
  };
};

/// In which direction a ball pushes.
struct ContactAngleRow {
  std::string method;
  double angle = 0, in_plane = 0, sideways = 0;
  std::string scene_hash;

  static constexpr std::string_view table = "NAME-angles";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &ContactAngleRow::method, "method that was run"),
        column("angle", "rad", &ContactAngleRow::angle, "place on the ball, from its top"),
        column("in plane", "rad", &ContactAngleRow::in_plane,
               "direction of the push less the normal, in the plane of gravity; positive: as if farther down"),
        column("sideways", "rad", &ContactAngleRow::sideways, "the same across that plane"),
        column("scene hash", "1", &ContactAngleRow::scene_hash, "fingerprint of the scene file");
  };
};

}  // namespace crosscheck
