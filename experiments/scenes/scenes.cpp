#include "experiments/scenes/scenes.h"

#include <fmt/format.h>

#include <algorithm>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/installation.h"
#include "mysim/base/text.h"
#include "mysim/scene/toml.h"
#include "reference/method.h"

namespace crosscheck {
namespace {

std::filesystem::path folder_of_scenes() { return data_folder() / "experiments" / "scenes"; }
std::filesystem::path folder_of_disagreements() { return folder_of_scenes() / "disagreements"; }

constexpr std::string_view left_to_full_runs[] = {"cloth-stiff", "cloth-cantilever", "cloth-swing", "cloth-wind",
                                                  "flag",        "cloth-carried",    "curtain",     "jelly",
                                                  "floor-drop",  "cloth-small",      "room-bounce"};

}  // namespace

std::span<const std::string_view> shipped_scenes() {
  static constexpr std::string_view table[] = {
      "circle",              //
      "projectile",          //
      "spring",              //
      "normal-modes",        //
      "pendulum",            //
      "chain",               //
      "chain-link",          //
      "rod",                 //
      "slide",               //
      "bounce",              //
      "slope-slide",         //
      "room-bounce",         //
      "cloth-student",       //
      "cloth-small",         //
      "cloth-hang",          //
      "cloth-stiff",         //
      "cloth-inextensible",  //
      "cloth-cantilever",    //
      "cloth-swing",         //
      "cloth-wind",          //
      "flag",                //
      "cloth-sphere",        //
      "cloth-carried",       //
      "floor-drop",          //
      "curtain",             //
      "jelly",
  };
  return table;
}

std::vector<std::string> quick_scenes() {
  std::vector<std::string> quick;
  for (const auto name : shipped_scenes())
    if (std::find(std::begin(left_to_full_runs), std::end(left_to_full_runs), name) == std::end(left_to_full_runs))
      quick.emplace_back(name);
  return quick;
}

namespace {

std::vector<std::string> scenes_of_disagreements() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder_of_disagreements()))
    if (file.path().extension() == ".toml") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Reads the file and checks its default method.
Scene checked(const std::filesystem::path& file, const std::string& methods) {
  Scene scene = read_scene(file);
  // parses the text again for the line number
  const auto time = [&] { return TomlTable::parse_text(scene.source, file.string()).section("time"); };
  if (scene.method.empty()) scene.method = methods.substr(0, methods.find(','));
  if (scene.method.empty())
    time().fail("method",
                fmt::format("a method that is no program (programs are named on the command line only: --method {})",
                            shell_quote(time().text("method"))));
  try {
    find_method(scene.method);
  } catch (const InputError& error) {
    time().fail("method", fmt::format("an existing method: {}", error.what()));
  }
  return scene;
}

}  // namespace

std::filesystem::path file_of_disagreement(const std::string& name) {
  return folder_of_disagreements() / (name + ".toml");
}

Scene load_scene(const std::string& name, const std::string& methods) {
  const auto shipped = shipped_scenes();
  if (std::find(shipped.begin(), shipped.end(), name) != shipped.end())
    return checked(folder_of_scenes() / (name + ".toml"), methods);
  const auto known = scenes_of_disagreements();
  if (std::find(known.begin(), known.end(), name) != known.end()) return checked(file_of_disagreement(name), methods);
  std::error_code unreadable;  // if set, `name` is taken as a path; reading the file then reports the error
  if (name.ends_with(".toml") || name.find('/') != std::string::npos || std::filesystem::exists(name, unreadable) ||
      unreadable)
    return checked(name, methods);
  std::vector<std::string> names(shipped.begin(), shipped.end());
  names.insert(names.end(), known.begin(), known.end());
  throw InputError(unknown_name("scene", name, names, "crosscheck list scenes"));
}

std::vector<Scene> load_scenes(const std::vector<std::string>& names, const std::string& methods) {
  std::vector<Scene> scenes;
  if (names.empty())
    for (const auto name : shipped_scenes()) scenes.push_back(load_scene(std::string(name)));
  for (const std::string& name : names) {
    Scene scene = load_scene(name, methods);
    for (size_t i = 0; i < scenes.size(); ++i)
      if (file_name_of(scenes[i].name) == file_name_of(scene.name))
        throw InputError(fmt::format("{}: expected scenes of different names; this one is '{}', that of {} is '{}'",
                                     name, scene.name, names[i], scenes[i].name));
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace crosscheck
