// scene.json of the engine protocol: the expanded scene and the requested run, for external programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mysim/base/json.h"
#include "mysim/run/run.h"
#include "mysim/types.h"

namespace crosscheck {

// Vectors and points in the JSON files of scenes and runs.

/// Vector from three numbers. Throws InputError like JsonField.
Vec3 vec3_of(const JsonField& field);
/// 3 x count matrix from count triples of numbers. Throws InputError like JsonField.
Points points_of(const JsonField& field, int count);

/// Three numbers, or one triple per column.
Json json_of(const Vec3& v);
Json json_of(const Points& p);

// scene.json of the engine protocol: the expanded scene and the requested run, for external programs. Its format is
// described in PROTOCOL.md.

/// The file's content. Every number is written so that reading it restores the same bits.
std::string scene_json(const Scene& scene, const Run& run, const std::vector<std::string>& options);

/// The task of an external program.
struct EngineTask {
  Scene scene;
  Run run;
  std::vector<std::string> options;
};

/// Reads the file back. Scene hash and step equal those of the written ones. Data that engines do not need (camera,
/// default method) are left empty. Throws InputError: "FILE: PLACE: expected ..."; Unsupported if there is a term of a
/// later version.
EngineTask read_scene_json(const std::filesystem::path& file);

}  // namespace crosscheck
