// From words to experiments and scenes.
#include "report/figures_asked.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/scenes.h"
#include "mysim/errors.h"
#include "mysim/nearest.h"
#include "report/printed_picture.h"

namespace crosscheck {
namespace {

constexpr std::string_view picture = "-picture";

const Experiment* experiment_named(const std::string& name) {
  for (const Experiment& e : experiments())
    if (name == e.name) return &e;
  return nullptr;
}

/// The scenes that somebody named, or those that stand for the others.
std::vector<AskedPicture> scenes_asked(const FiguresOptions& options) {
  std::vector<AskedPicture> all;
  const std::vector<Scene> scenes = scenes_for({}, options.scenes, options.full);
  for (size_t i = 0; i < scenes.size(); ++i)
    all.push_back({scenes[i], options.scenes.empty() ? scenes[i].name : options.scenes[i]});
  return all;
}

AskedPicture picture_named(const std::string& name, const FiguresOptions& options) {
  if (options.scenes.empty()) {
    const std::string scene = name.substr(0, name.size() - picture.size());
    return {load_scene(scene), scene};
  }
  const std::vector<AskedPicture> all = scenes_asked(options);
  std::vector<std::string> names;
  for (const AskedPicture& asked : all) {
    if (name == picture_name(asked.scene)) return asked;
    names.push_back(picture_name(asked.scene));
  }
  throw InputError(fmt::format("{}: expected a picture of a scene that --scene names: {}{}", name,
                               fmt::join(names, ", "), did_you_mean(name, names)));
}

[[noreturn]] void fail(const std::string& name) {
  std::vector<std::string> known;
  for (const Experiment& e : experiments()) known.emplace_back(e.name);
  throw InputError(fmt::format("unknown figures '{}'; expected SCENE-picture or one of {}{}", name,
                               fmt::join(known, ", "), did_you_mean(name, known)));
}

}  // namespace

AskedFigures figures_asked(const FiguresOptions& options) {
  AskedFigures asked;
  if (options.names.empty()) {
    for (const Experiment& e : experiments()) asked.experiments.push_back(&e);
    asked.pictures = scenes_asked(options);
  }
  for (size_t i = 0; i < options.names.size(); ++i) {
    const std::string& name = options.names[i];
    if (std::count(options.names.begin(), options.names.end(), name) > 1)
      throw InputError(fmt::format("{}: expected each name once", name));
    if (const Experiment* experiment = experiment_named(name))
      asked.experiments.push_back(experiment);
    else if (name.ends_with(picture))
      asked.pictures.push_back(picture_named(name, options));
    else
      fail(name);
  }
  return asked;
}

}  // namespace crosscheck
