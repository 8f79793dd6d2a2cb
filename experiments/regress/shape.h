// The last shape of a scene under its own method, kept beside its baseline: what pictures of a failure are set against.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mysim/types.h"

namespace crosscheck {

/// SCENE-shape.csv in the folder.
std::filesystem::path shape_file(const std::filesystem::path& folder, const std::string& scene);

/// One row for each particle, m, to 6 digits, which is all that a picture shows; t in s.
std::string shape_text(const std::string& scene, const std::string& method, double t, const Points& x);

struct Shape {
  double t;  // s
  Points x;  // m
};
/// None where there is no such file, or one that does not hold `particles` rows.
std::optional<Shape> read_shape(const std::filesystem::path& folder, const std::string& scene, int particles);

}  // namespace crosscheck
