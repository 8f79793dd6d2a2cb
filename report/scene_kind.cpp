#include "report/scene_kind.h"

namespace crosscheck {

std::string kind_of(const Scene& scene) {
  const Model& model = scene.model;
  const std::pair<bool, const char*> table[] = {{model.find<Spheres>(), "ball"},
                                                {model.find<Constraints>(), "hard lengths"},
                                                {!scene.triangles.empty(), "cloth"},
                                                {model.find<Springs>(), "springs"},
                                                {model.find<Rotation>(), "rotation"}};
  for (const auto& [is, kind] : table)
    if (is) return kind;
  return "free flight";
}

}  // namespace crosscheck
