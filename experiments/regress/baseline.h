// Baselines: what each method answered when somebody last said that this is right. One readable file per scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/regress/lines.h"
#include "experiments/regress/tolerance.h"

namespace crosscheck {

struct Expected {
  std::string method, without;
  bool dear = false;  // asked in full runs only
  Toleranced what;
  int blessing = 1;  // its number in the file, from 1
};

struct Baseline {
  std::string scene, hash;  // of the scene that these are answers to
  std::vector<Blessing> blessings;
  std::vector<Expected> expected;
};

/// SCENE.csv in the folder: comment lines with the scene's hash and each blessing, then one row for each quantity.
std::string text_of(const Baseline& baseline);
std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& scene);

/// Throws InputError "FILE:LINE: expected ..." where the text is no baseline; nothing where there is no file.
std::optional<Baseline> read_baseline(const std::filesystem::path& folder, const std::string& scene);

}  // namespace crosscheck
