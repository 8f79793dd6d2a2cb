// The table of shipped scenes, and how a name or a path becomes a scene.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/scene.h"

namespace crosscheck {

/// Names of the shipped scenes, from simple to rich.
std::span<const std::string_view> shipped_scenes();

/// A shipped scene by name, or any TOML file by path. Throws InputError that lists what there is.
Scene load_scene(const std::string& name_or_path);

}  // namespace crosscheck
