// The ingredients of a scene, and the scene without any one of them.
#pragma once

#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

struct Ingredient {
  std::string name;  // "gravity", "bend springs", "gusts", ...
  std::vector<std::string>
      keys;  // keys to erase from the scene's file (TomlDocument::erase); empty: a file cannot express the removal
  void (*remove)(Model&);
};

/// Each term, each family of springs, pins, motions, gusts, friction. A single family of springs is listed once.
std::vector<Ingredient> ingredients_of(const Scene& scene);

/// Recomputes the hash, but keeps the text.
Scene without(const Scene& scene, const Ingredient& ingredient);

/// Springs and hard distances, at least 1: the unit of cost of a force evaluation.
long springs_of(const Model& model);

}  // namespace crosscheck
