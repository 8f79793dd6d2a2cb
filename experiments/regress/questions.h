// What a regression run asks: which scenes under which methods, and which of them without one ingredient.
#pragma once

#include "experiments/regress/answer.h"

namespace crosscheck {

struct Asked {
  std::vector<std::string> scenes = {};  // names or files; empty: all shipped ones
  bool full = false;                     // dear questions too
  std::string filter;                    // glob on SCENE or SCENE/METHOD, with !(A|B) and @(A|B); empty: all
  std::vector<Method> methods;           // empty: all of mysim and Bullet
};

/// The names or files of the scenes.
std::vector<std::string> scenes_of(const Asked& asked);
/// Whether all is asked that baselines of these scenes should have.
inline bool whole(const Asked& asked) { return asked.filter.empty() && asked.methods.empty(); }
/// Whether somebody here changes the engine; what stands beside them as a judge is not asked unless named.
bool asked_by_itself(const std::string& method);
/// Whether the filter leaves this scene under this method.
bool passes(const std::string& filter, const std::string& scene, const std::string& method);

/// Every scene under every method, as far as its cost allows (0.5 s by the estimate of estimate.h, 20 s in
/// full runs); and under its own method also without each of its ingredients, which tells causes apart. Methods that
/// refuse a scene are asked too: a refusal is behaviour. Throws InputError where the filter leaves nothing.
std::vector<Question> questions(const Asked& asked);

}  // namespace crosscheck
