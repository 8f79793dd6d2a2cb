// scene.json of the engine protocol: the expanded scene and the run that is asked, for programs outside. Its format is
// described in PROTOCOL.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mysim/run.h"

namespace crosscheck {

/// The file's content. Every number is written such that reading it gives the same bits.
std::string scene_json(const Scene& scene, const Run& run, const std::vector<std::string>& options);

/// What a program was asked.
struct Task {
  Scene scene;
  Run run;
  std::vector<std::string> options;
};

/// Reads the file back: the scene has the hash, the run the step of those that were written. What engines do not see
/// (camera, default method) is left empty. Throws InputError: "FILE: PLACE: expected ...".
Task read_scene_json(const std::filesystem::path& file);

}  // namespace crosscheck
