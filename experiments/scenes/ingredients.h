// The ingredients of a scene, and the scene without any one of them.
#pragma once

#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

struct Ingredient {
  std::string name;  // "gravity", "bend springs", "gusts", ...
  std::vector<std::string>
      keys;                // keys to erase from the scene's file (TomlDocument::erase); empty: a file cannot express it
  void (*remove)(Model&);  // removes it from an expanded model
};

/// The removable ingredients of the scene: each term, each family of springs, pins, motions, gusts, friction. If all
/// springs belong to one family, it is listed once.
std::vector<Ingredient> ingredients_of(const Scene& scene);

/// The scene without the ingredient. Its hash is recomputed; its text remains.
Scene without(const Scene& scene, const Ingredient& ingredient);

/// Number of springs and hard distances, at least 1: the cost of an evaluation of the right-hand side in springs.
long springs_of(const Model& model);

}  // namespace crosscheck
