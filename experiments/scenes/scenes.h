// The table of shipped scenes, and the lookup of scenes by name or path.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// Names of the shipped scenes, from simple to rich.
std::span<const std::string_view> shipped_scenes();

/// Scenes of a quick run if the user names none: the shipped scenes, with only one cloth of each kind.
std::vector<std::string> quick_scenes();

/// Finds a shipped scene or a known disagreement by name, or any TOML file by path. Throws InputError with a suggestion
/// if there is no such scene. Refuses a file whose method is a program, unless the command line names `methods`
/// ("A,B,..."); the first of these methods replaces that of the file.
Scene load_scene(const std::string& name_or_path, const std::string& methods = "");

std::filesystem::path file_of_disagreement(const std::string& name);

/// All named scenes, or all shipped scenes if `names` is empty. Throws InputError if two have the same name or the same
/// file name, because their rows or files would clash.
std::vector<Scene> load_scenes(const std::vector<std::string>& names, const std::string& methods = "");

}  // namespace crosscheck
