// The table of shipped scenes, and how a name or a path becomes a scene.
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

/// Those of them that a quick run uses when none is named: each kind of scene once, and of several cloths one.
std::vector<std::string> quick_scenes();

/// A shipped scene by name, the scene of a known disagreement by name, or any TOML file by path. Throws InputError that
/// lists what there is. A file whose method is a program is refused unless the command line names `methods`
/// ("A,B,..."): then the first of them takes its place, as such a command does not use the file's method.
Scene load_scene(const std::string& name_or_path, const std::string& methods = "");

/// Where the scene of a known disagreement is.
std::filesystem::path file_of_disagreement(const std::string& name);

/// Several at once; none given: all shipped ones. Throws InputError when two have the same name or the same file name,
/// under which their rows or files would clash.
std::vector<Scene> load_scenes(const std::vector<std::string>& names, const std::string& methods = "");

}  // namespace crosscheck
