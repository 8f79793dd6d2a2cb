// Baselines: the quantities of each scene and its last shape, as recorded by the last blessing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/regress/strict_csv.h"
#include "experiments/regress/tolerance.h"
#include "mysim/types.h"

namespace crosscheck {

struct BaselineRow {
  std::string method, without;
  bool slow = false;  // true if the case is selected in full runs only
  QuantityWithTolerance what;
  int blessing = 1;  // number of the blessing that recorded the value, from 1
};

struct Baseline {
  std::string scene, hash;
  std::vector<Blessing> blessings;
  std::vector<BaselineRow> expected;
  std::string source = {};  // hash of the scene file's text; empty in baselines written by earlier versions
};

/// Text of the file SCENE.csv: comment lines with the scene's hash and each blessing, then one row per quantity.
std::string text_of(const Baseline& baseline);
std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& scene);

/// Throws InputError "FILE:LINE: expected ..." if the text is not a baseline. Returns nullopt if there is no file.
std::optional<Baseline> read_baseline(const std::filesystem::path& folder, const std::string& scene);

// The last shape of a scene under its own method, for pictures of failures.

/// SCENE-shape.csv
std::filesystem::path shape_file(const std::filesystem::path& folder, const std::string& scene);

/// One row per particle, with positions in m to 6 digits (enough for a picture); t in s.
std::string shape_text(const std::string& scene, const std::string& method, double t, const Points& x);

struct FinalShape {
  double t;  // s
  Points x;  // m
};
/// Returns nullopt if there is no such file, or if it does not have `particles` rows.
std::optional<FinalShape> read_shape(const std::filesystem::path& folder, const std::string& scene, int particles);

}  // namespace crosscheck
