// Puts the player's files and the kept runs into the page.
#include "report/page/player_html.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/stability/map.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "report/base/assets.h"
#include "report/page/lab_html.h"

namespace crosscheck {
namespace {

/// In the order in which they know each other: pages from a folder cannot load modules.
constexpr const char* scripts[] = {"unpack", "vectors",  "colours", "orbit", "shaders",      "gl",
                                   "shapes", "motion",   "bounds",  "stage", "raster_stage", "pointer_input",
                                   "plot",   "controls", "player",  "runs"};

}  // namespace

std::string player_styles() { return "<style>\n" + asset("player/player.css") + "</style>\n"; }

std::string player_scripts() {
  std::string out = "<script>(() => {\n'use strict';\n";
  for (const char* name : scripts) out += asset(fmt::format("player/{}.js", name));
  return out + lab_scripts() + "})();</script>\n";
}

std::string script_json(const std::string& attributes, const std::string& json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char sign : json) sign == '<' ? safe += "\\u003c" : safe += sign;
  return fmt::format("<script type=\"application/json\" {}>{}</script>\n", attributes, safe);
}

std::string player_html(const std::string& scene, const std::string& a, const std::string& b) {
  return fmt::format(
      "<div class=\"player\">\n<figure class=\"render\"><div class=\"stage\"></div></figure>\n<motion-player "
      "data-scene=\"{}\" data-a=\"{}\" data-b=\"{}\"></motion-player>\n</div>\n",
      escaped(scene), escaped(a), escaped(b));
}

std::string runs_html(const PlayableRuns& runs) {
  const std::string base =
      runs.stage.empty() ? fmt::format("\"scene\":{}", Json(runs.scene).dump()) : "\"stage\":" + runs.stage;
  std::string methods;
  for (const auto& file : runs.methods) methods += (methods.empty() ? "" : ",") + content_of_file(file);
  return script_json(fmt::format("class=\"runs\" data-runs=\"{}\"", escaped(runs.key)),
                     fmt::format("{{{},\"methods\":[{}]}}", base, methods));
}

namespace fs = std::filesystem;

void RunsFolder::keep(const RecordedRuns& recorded, const Run& run) {
  const bool cells = recorded.of.ends_with("-map");
  const std::string& scene = recorded.scene.name;
  if (!cells && !bases_.contains(scene)) bases_.emplace(scene, base_of(recorded.scene, run));
  const std::string json = motions_json(recorded, cells ? MotionBase{} : bases_.at(scene));
  if (json.empty()) return;
  const std::string key = scene + "-" + recorded.of;
  write_file(folder_ / file_name_of(key) / (file_name_of(recorded.method) + ".json"), json);
}

std::optional<PlayableRuns> RunsFolder::of(const std::string& key, const std::string& only,
                                           std::vector<std::string>& notes) const {
  constexpr std::uintmax_t most = 700'000;  // bytes: no set of a quick report weighs as much
  const fs::path own = folder_ / file_name_of(key);
  if (key.empty() || !fs::exists(own)) return std::nullopt;
  PlayableRuns runs{key, "", "", {}};
  for (const auto& file : fs::directory_iterator(own))
    if (only.empty() || file.path().stem() == file_name_of(only)) runs.methods.push_back(file.path());
  const auto weight = [](const fs::path& file) { return std::pair(fs::file_size(file), file); };
  std::ranges::sort(runs.methods, {}, weight);
  std::uintmax_t sum = 0;
  const auto too_much =
      std::ranges::find_if(runs.methods, [&](const fs::path& f) { return (sum += file_size(f)) > most; });
  if (const auto count = runs.methods.end() - too_much; count > 0) {
    const auto note = fmt::format("of {} the runs of {} methods are too large for the page to play", key, count);
    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
  }
  runs.methods.erase(too_much, runs.methods.end());
  if (runs.methods.empty()) return std::nullopt;
  std::ranges::sort(runs.methods);
  for (const auto& file : runs.methods) runs.names.push_back(JsonField::parse_file(file.string())["name"].text());
  return runs;
}

std::string stage_of_map(const std::string& key, const std::vector<Scene>& scenes, bool full) {
  for (const Scene& scene : scenes)
    if (const auto small = map_scene(scene, full))
      for (const MapKind& kind : map_kinds())
        if (key == fmt::format("{}-{}-map", small->name, kind.name)) return stage_json(*small);
  return "";
}

}  // namespace crosscheck
