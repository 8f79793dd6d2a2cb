// The ingredients of a scene, and the scene without each of them.
#pragma once

#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

struct Ingredient {
  std::string name;  // "gravity", "bend springs", "gusts", ...
  std::vector<std::string>
      keys;                // what to erase from the scene's file (TomlDocument::erase); empty: a file cannot say it
  void (*remove)(Model&);  // takes it out of an expanded model
};

/// The ingredients of the scene that could be left out: each term, each family of springs, pins, motions, gusts,
/// friction. A family that is all of the springs is named once.
std::vector<Ingredient> ingredients_of(const Scene& scene);

/// The scene without it. Its hash is taken anew; its text stays.
Scene without(const Scene& scene, const Ingredient& ingredient);

/// Springs and hard distances, at least 1: what an evaluation of the right-hand side costs, in springs.
long springs_of(const Model& model);

}  // namespace crosscheck
