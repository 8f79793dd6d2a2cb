#include "report/page/lab_html.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/installation.h"
#include "mysim/base/process.h"
#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/figures/chart_json.h"
#include "report/lab/live_run.h"
#include "report/page/page_parts.h"
#include "report/player/packed_numbers.h"

namespace crosscheck {
namespace {

namespace fs = std::filesystem;

/// What the guided experiments open.
constexpr std::string_view guided_scenes[] = {"circle", "pendulum", "cloth-hang", "slide", "cloth-sphere"};

/// A program that knows the command `lab`: this one, or, in tests, the one that they start.
fs::path lab_program() {
  const fs::path self = fs::read_symlink("/proc/self/exe");
  return self.filename().string().starts_with("crosscheck") ? self : programs_folder() / "crosscheck";
}

}  // namespace

fs::path lab_module_file() { return programs_folder() / "lab.wasm"; }
bool has_lab_module() { return fs::exists(lab_module_file()); }

Json lab_fingerprints_json(const std::vector<Scene>& scenes) {
  Json all = Json::object();
  for (const Scene& scene : scenes) {
    Json& own = all[scene.name] = Json::object();
    for (const Stepper& rule : steppers()) {
      if (!has_same_bits_everywhere(rule)) continue;
      try {
        LiveRun run(scene);
        run.start({.rule = std::string(rule.name),
                   .step = scene.step,
                   .tolerance = 1e-6,
                   .duration = scene.duration,
                   .keep_ledger = false});
        run.advance(scene.duration, fingerprinted_steps);
        own[rule.name] = run.fingerprint();
      } catch (const Unsupported&) {
        // the rule does not take the scene, nor does the lab offer it
      }
    }
  }
  return all;
}

LabFingerprints lab_fingerprints(const std::vector<Scene>& scenes) {
  const TemporaryFolder folder("lab");
  std::vector<std::string> call{lab_program().string(), "lab", "--fingerprints"};
  for (const Scene& scene : scenes) {
    const fs::path file = folder.path / (file_name_of(scene.name) + ".toml");
    write_file(file, scene.source);
    call.push_back(file.string());
  }
  const ProgramResult result = run_program(call, folder.path, {"CROSSCHECK_INSTRUCTIONS=baseline"});
  if (result.status != 0)
    throw std::runtime_error(fmt::format("the lab's fingerprints: {}", last_lines(result.err, 1)));
  LabFingerprints all;
  const JsonField json = JsonField::parse(result.out, "the lab's fingerprints");
  for (const Scene& scene : scenes)
    for (const auto& [rule, digits] : json[file_name_of(scene.name)].items()) all[scene.name][rule] = digits.text();
  return all;
}

Json lab_data(const std::vector<Scene>& given) {
  if (!has_lab_module()) return Json::array();
  std::vector<Scene> scenes = given;
  for (const std::string_view name : guided_scenes)
    if (std::ranges::none_of(scenes, [&](const Scene& scene) { return scene.name == name; }))
      scenes.push_back(load_scene(std::string(name)));
  const LabFingerprints fingerprints = lab_fingerprints(scenes);
  Json json = Json::object();
  for (const Scene& scene : scenes) {
    Json& own =
        json[scene.name] = {{"toml", scene.source}, {"fingerprint", Json::object()}, {"steps", fingerprinted_steps}};
    if (const auto known = fingerprints.find(scene.name); known != fingerprints.end())
      for (const auto& [rule, digits] : known->second) own["fingerprint"][rule] = digits;
  }
  return Json::array({data_element("lab", "lab-module", dump(base64(gzipped(content_of_file(lab_module_file()))))),
                      data_element("lab", "lab-scenes", dump(json))});
}

std::string lab_page_html(const std::vector<Scene>& scenes) {
  if (!has_lab_module())
    throw InputError(
        fmt::format("lab: mysim was not compiled to WebAssembly; apt-get install --no-install-recommends "
                    "{}, then start again",
                    lab_packages));
  std::vector<std::string> methods;
  for (const Stepper& rule : steppers()) methods.push_back(fmt::format("mysim/{}", rule.name));
  Json data = lab_data(scenes);
  data.push_back(data_element("lab", "methods-data", dump(method_looks_json(methods))));
  return filled("lab", {{"title", "Crosscheck: the lab"},
                        {"styles", page_styles()},
                        {"data", std::move(data)},
                        {"script", page_script("lab_page")}});
}

}  // namespace crosscheck
