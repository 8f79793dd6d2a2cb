// The provenance of numbers: command, commit, compiler, machine, engines.
#pragma once

#include "experiments/tables/table.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

/// All lines except those about scenes. `command` is the command line as given.
Provenance provenance(const std::string& command);

/// Adds the hash of the scene, or of each scene.
Provenance with_scene(Provenance lines, const Scene& scene);
Provenance with_scenes(Provenance lines, const std::vector<Scene>& scenes);

/// Value of a line, or "".
std::string value_of(const Provenance& lines, const std::string& key);

}  // namespace crosscheck
