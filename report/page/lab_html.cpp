#include "report/page/lab_html.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/installation.h"
#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/figures/chart_json.h"
#include "report/page/page_parts.h"
#include "report/player/packed_numbers.h"

namespace crosscheck {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view guided_scenes[] = {"circle", "pendulum", "cloth-hang", "slide", "cloth-sphere"};

}  // namespace

fs::path lab_module_file() { return programs_folder() / "lab.wasm"; }
bool has_lab_module() { return fs::exists(lab_module_file()); }

Json lab_data(const std::vector<Scene>& given) {
  if (!has_lab_module()) return Json::array();
  std::vector<Scene> scenes = given;
  for (const std::string_view name : guided_scenes)
    if (std::ranges::none_of(scenes, [&](const Scene& scene) { return scene.name == name; }))
      scenes.push_back(load_scene(std::string(name)));
  Json texts = Json::object();
  for (const Scene& scene : scenes) texts[scene.name] = scene.source;
  return Json::array({data_element("lab", "lab-module", dump(base64(gzipped(content_of_file(lab_module_file()))))),
                      data_element("lab", "lab-scenes", dump(texts))});
}

std::string lab_page_html(const std::vector<Scene>& scenes) {
  if (!has_lab_module())
    throw InputError(
        fmt::format("lab: mysim was not compiled to WebAssembly; apt-get install --no-install-recommends "
                    "{}, then run crosscheck again",
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
