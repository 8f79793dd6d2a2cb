// Baselines: the quantities and the last shape of each scene at the last blessing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/regress/strict_csv.h"
#include "experiments/regress/tolerance.h"
#include "mysim/types.h"

namespace crosscheck {

// Baselines: the quantities of each method at the last blessing. One readable file per scene.

struct BaselineRow {
  std::string method, without;
  bool slow = false;  // selected in full runs only
  QuantityWithTolerance what;
  int blessing = 1;  // its number in the file, from 1
};

struct Baseline {
  std::string scene, hash;  // of the scene that these are quantities of
  std::vector<Blessing> blessings;
  std::vector<BaselineRow> expected;
  std::string source = {};  // hash of the text of the scene's file; empty in baselines of earlier versions
};

/// SCENE.csv in the folder: comment lines with the scene's hash and each blessing, then one row for each quantity.
std::string text_of(const Baseline& baseline);
std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& scene);

/// Throws InputError "FILE:LINE: expected ..." where the text is no baseline; nothing where there is no file.
std::optional<Baseline> read_baseline(const std::filesystem::path& folder, const std::string& scene);

// The last shape of a scene under its own method, kept beside its baseline: what pictures of a failure are set against.

/// SCENE-shape.csv in the folder.
std::filesystem::path shape_file(const std::filesystem::path& folder, const std::string& scene);

/// One row for each particle, m, to 6 digits, which is all that a picture shows; t in s.
std::string shape_text(const std::string& scene, const std::string& method, double t, const Points& x);

struct FinalShape {
  double t;  // s
  Points x;  // m
};
/// None where there is no such file, or one that does not hold `particles` rows.
std::optional<FinalShape> read_shape(const std::filesystem::path& folder, const std::string& scene, int particles);

}  // namespace crosscheck
