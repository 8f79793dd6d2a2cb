#pragma once

#include "experiments/tables/table.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

Provenance provenance(const std::string& command);

Provenance with_scene(Provenance lines, const Scene& scene);
Provenance with_scenes(Provenance lines, const std::vector<Scene>& scenes);

std::string value_of(const Provenance& lines, const std::string& key);

}  // namespace crosscheck
