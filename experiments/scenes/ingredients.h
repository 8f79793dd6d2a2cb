// The ingredients of a scene, each of which can be removed.
#pragma once

#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

struct Ingredient {
  std::string name;  // "gravity", "bend springs", "gusts", ...
  std::vector<std::string>
      keys;  // keys to erase from the scene's file (TomlDocument::erase); empty if a file cannot express the removal
  void (*remove)(Model&);
};

/// Lists terms, families of springs, pins, motions, gusts and friction. If all springs belong to one family, lists them
/// as one ingredient.
std::vector<Ingredient> ingredients_of(const Scene& scene);

/// Recomputes the scene's hash, but keeps its text.
Scene without(const Scene& scene, const Ingredient& ingredient);

/// Number of springs and hard distances, at least 1. The cost of a force evaluation is proportional to it.
long springs_of(const Model& model);

}  // namespace crosscheck
