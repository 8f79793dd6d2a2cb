// scene.json of the engine protocol: the expanded scene and the requested run, for outside programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mysim/base/json.h"
#include "mysim/run/run.h"
#include "mysim/types.h"

namespace crosscheck {

// Vectors and points in the JSON files of scenes and runs.

/// Of three numbers. Throws InputError as JsonField does.
Vec3 vec3_of(const JsonField& field);
/// 3 x count, of count triples of numbers. Throws InputError as JsonField does.
Points points_of(const JsonField& field, int count);

/// Three numbers, and one triple for each column.
Json json_of(const Vec3& v);
Json json_of(const Points& p);

// scene.json of the engine protocol: the expanded scene and the requested run, for outside programs. Its format is
// described in PROTOCOL.md.

/// The file's content. Every number is written such that reading it gives the same bits.
std::string scene_json(const Scene& scene, const Run& run, const std::vector<std::string>& options);

/// The task of an outside program.
struct EngineTask {
  Scene scene;
  Run run;
  std::vector<std::string> options;
};

/// Reads the file back: the scene has the hash, the run the step of those that were written. What engines do not see
/// (camera, default method) is left empty. Throws InputError: "FILE: PLACE: expected ...";
/// Unsupported where there is a term of a later version.
EngineTask read_scene_json(const std::filesystem::path& file);

}  // namespace crosscheck
