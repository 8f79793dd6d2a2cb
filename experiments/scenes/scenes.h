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

/// The scenes of a quick run if none is named: one of each kind, including one of several cloths.
std::vector<std::string> quick_scenes();

/// A shipped scene by name, the scene of a known disagreement by name, or any TOML file by path. Throws InputError with
/// a suggestion if there is none. A file whose method is a program is refused unless the command line names `methods`
/// ("A,B,..."). Then the first of them replaces it, because such a command does not use the file's method.
Scene load_scene(const std::string& name_or_path, const std::string& methods = "");

/// The scene file of a known disagreement.
std::filesystem::path file_of_disagreement(const std::string& name);

/// Several scenes; all shipped ones if `names` is empty. Throws InputError if two have the same name or the same file
/// name, under which their rows or files would clash.
std::vector<Scene> load_scenes(const std::vector<std::string>& names, const std::string& methods = "");

}  // namespace crosscheck
