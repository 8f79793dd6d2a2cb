// Rows of experiment `fabric`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// A strip clamped level that hangs at rest.
struct CantileverRow {
  std::string load;
  long cells = 0;
  double gamma = 0, tip_load = 0, drop = 0, truth = 0, deviation = 0;

  static constexpr std::string_view table = "fabric-cantilevers";
  static constexpr auto columns = [](auto&& column) {
    column("load", "1", &CantileverRow::load, "what bends the strip"),
        column("cells", "1", &CantileverRow::cells, "cells along the strip"),
        column("gamma", "1", &CantileverRow::gamma, "weight per area x length^3 / rigidity"),
        column("tip load", "1", &CantileverRow::tip_load, "load on the last particles per width x length^2 / rigidity"),
        column("drop", "1", &CantileverRow::drop, "how far the tip hangs below the clamp, over the length"),
        column("drop of the elastica", "1", &CantileverRow::truth, "the same by the two-point problem"),
        column("deviation", "1", &CantileverRow::deviation, "drop over that of the elastica, less 1");
  };
};

/// The same strip's small vibrations without weight.
struct StripVibrationRow {
  long cells = 0, mode = 0;
  double frequency = 0, truth = 0, deviation = 0;

  static constexpr std::string_view table = "fabric-vibrations";
  static constexpr auto columns = [](auto&& column) {
    column("cells", "1", &StripVibrationRow::cells, "cells along the strip"),
        column("mode", "1", &StripVibrationRow::mode, "first, second or third vibration"),
        column("frequency", "Hz", &StripVibrationRow::frequency, "of the linearised scene"),
        column("frequency of the beam", "Hz", &StripVibrationRow::truth, "of a clamped beam"),
        column("deviation", "1", &StripVibrationRow::deviation, "frequency over that of the beam, less 1");
  };
};

/// A strip with the bending term beside one with skip-one springs that droops alike on one grid.
struct SkipOneRow {
  std::string net;
  long cells = 0;
  double skip_one = 0, drop = 0, truth = 0;

  static constexpr std::string_view table = "fabric-skip-one";
  static constexpr auto columns = [](auto&& column) {
    column("net", "1", &SkipOneRow::net, "what resists bending"),
        column("cells", "1", &SkipOneRow::cells, "cells along the strip"),
        column("skip-one stiffness", "N/m", &SkipOneRow::skip_one, "of each skip-one spring; 0: none"),
        column("drop", "1", &SkipOneRow::drop, "how far the tip hangs below the clamp, over the length"),
        column("drop of the elastica", "1", &SkipOneRow::truth, "the same by the two-point problem");
  };
};

}  // namespace crosscheck
