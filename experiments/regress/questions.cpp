#include "experiments/regress/questions.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include "experiments/adequacy/ingredients.h"
#include "experiments/estimate.h"
#include "experiments/scenes.h"
#include "mysim/errors.h"

namespace crosscheck {
namespace {

constexpr double cheap = 0.5, dearest = 20;  // s

std::vector<Method> engines() {
  std::vector<Method> methods;
  for (Method& method : all_methods())
    if (asked_by_itself(method.name)) methods.push_back(std::move(method));
  return methods;
}

double seconds(const Question& q) {
  Run run = default_run(q.scene);
  run.duration = q.scene.window, run.samples = 1;
  // a program of its own has to start
  return estimated_seconds(q.method, q.scene, run) + (q.method.name.starts_with("bullet32/") ? 0.2 : 0);
}

}  // namespace

std::vector<std::string> scenes_of(const Asked& asked) {
  if (!asked.scenes.empty()) return asked.scenes;
  return {shipped_scenes().begin(), shipped_scenes().end()};
}

bool asked_by_itself(const std::string& method) { return method.starts_with("mysim/") || method.starts_with("bullet"); }

bool passes(const std::string& filter, const std::string& scene, const std::string& method) {
  return filter.empty() || fnmatch(filter.c_str(), scene.c_str(), FNM_EXTMATCH) == 0 ||
         fnmatch(filter.c_str(), (scene + "/" + method).c_str(), FNM_EXTMATCH) == 0;
}

std::vector<Question> questions(const Asked& asked) {
  std::vector<Question> all;
  const auto add = [&](Question q) {
    const double cost = seconds(q);
    q.dear = cost > cheap;
    if (passes(asked.filter, q.scene.name, q.method.name) && cost <= (asked.full ? dearest : cheap))
      all.push_back(std::move(q));
  };
  const std::vector<Method> methods = asked.methods.empty() ? engines() : asked.methods;
  for (const std::string& name : scenes_of(asked)) {
    const Scene scene = load_scene(name);
    const std::string own = find_method(scene.method).name;
    for (const Method& method : methods) {
      add({scene, method, "", false, scene.hash});
      if (method.name != own && asked.methods.empty()) continue;
      for (const Ingredient& ingredient : ingredients_of(scene))
        if (ingredient.name != "rotation")  // the whole of a first-order scene
          add({without(scene, ingredient), method, ingredient.name, false, scene.hash});
    }
  }
  if (all.empty()) throw InputError(fmt::format("--filter {}: no scene and method match", asked.filter));
  return all;
}

}  // namespace crosscheck
