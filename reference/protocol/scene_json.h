// scene.json of the engine protocol (PROTOCOL.md): the expanded scene and the requested run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mysim/base/json.h"
#include "mysim/run/run.h"
#include "mysim/types.h"

namespace crosscheck {

/// Vector from three numbers. Throws InputError like JsonField.
Vec3 vec3_of(const JsonField& field);
/// Matrix (3 x count) from count triples. Throws InputError like JsonField.
Points points_of(const JsonField& field, int count);

/// JSON list of three numbers, or of one triple per column.
Json json_of(const Vec3& v);
Json json_of(const Points& p);

/// The file's content. Reading it back restores the bits of every number.
std::string scene_json(const Scene& scene, const Run& run, const std::vector<std::string>& options);

struct EngineTask {
  Scene scene;
  Run run;
  std::vector<std::string> options;
};

/// Reads the file back, with the written scene's hash and step. Fields that engines do not need (camera, default
/// method) stay empty. Throws InputError: "FILE: PLACE: expected ..."; Unsupported for a term of a later version.
EngineTask read_scene_json(const std::filesystem::path& file);

}  // namespace crosscheck
