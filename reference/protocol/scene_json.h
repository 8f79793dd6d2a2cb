// scene.json of the engine protocol: the expanded scene and the run that is asked, for programs outside.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mysim/base/json.h"
#include "mysim/run/run.h"
#include "mysim/types.h"

namespace crosscheck {

// What JSON files of scenes and runs hold beside plain values: vectors and places.

/// Of three numbers. Throws InputError as JsonField does.
Vec3 vec3_of(const JsonField& field);
/// 3 x count, of count triples of numbers. Throws InputError as JsonField does.
Points points_of(const JsonField& field, int count);

/// Three numbers, and one triple for each column.
Json json_of(const Vec3& v);
Json json_of(const Points& p);

// scene.json of the engine protocol: the expanded scene and the run that is asked, for programs outside. Its format is
// described in PROTOCOL.md.

/// The file's content. Every number is written such that reading it gives the same bits.
std::string scene_json(const Scene& scene, const Run& run, const std::vector<std::string>& options);

/// What a program was asked.
struct EngineTask {
  Scene scene;
  Run run;
  std::vector<std::string> options;
};

/// Reads the file back: the scene has the hash, the run the step of those that were written. What engines do not see
/// (camera, default method) is left empty. Throws InputError: "FILE: PLACE: expected ...".
EngineTask read_scene_json(const std::filesystem::path& file);

}  // namespace crosscheck
