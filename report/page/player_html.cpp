// Puts the player's files and the kept runs into the page.
#include "report/page/player_html.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/stability/map.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "report/base/assets.h"
#include "report/player/player_data.h"
#include "report/player/run_motions.h"

namespace crosscheck {
namespace {

/// In the order in which they know each other: pages from a folder cannot load modules.
constexpr const char* scripts[] = {"unpack",   "vectors", "colours", "orbit", "shaders",       "gl",
                                   "shapes",   "motion",  "bounds",  "stage", "pointer_input", "plot",
                                   "controls", "player",  "runs"};

/// JSON inside a script element: the one sign that could end it is written otherwise.
std::string without_brackets(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) c == '<' ? out += "\\u003c" : out += c;
  return out;
}

}  // namespace

std::string player_head() {
  std::string out = "<style>\n" + asset("player/player.css") + "</style>\n<script>(() => {\n'use strict';\n";
  for (const char* name : scripts) out += asset(fmt::format("player/{}.js", name));
  return out + "})();</script>\n";
}

std::string player_html(const PageImage& poster, const std::filesystem::path& motions) {
  return fmt::format(
      "<div class=\"player\">\n<figure class=\"render\"><div class=\"stage\">{}</div><figcaption>{}</figcaption>"
      "</figure>\n<script type=\"application/json\" class=\"motion\">{}</script>\n<motion-player></motion-player>\n"
      "</div>\n",
      image_tag(poster), escaped(poster.caption), without_brackets(content_of_file(motions)));
}

std::string runs_html(const PlayableRuns& runs) {
  const std::string base =
      runs.stage.empty() ? fmt::format("\"scene\":{}", Json(runs.scene).dump()) : "\"stage\":" + runs.stage;
  std::string methods;
  for (const auto& file : runs.methods) methods += (methods.empty() ? "" : ",") + content_of_file(file);
  return fmt::format("<script type=\"application/json\" class=\"runs\" data-runs=\"{}\">{}</script>\n",
                     escaped(runs.key), without_brackets(fmt::format("{{{},\"methods\":[{}]}}", base, methods)));
}

namespace fs = std::filesystem;

void RunsFolder::keep(const WatchedRuns& watched, const Run& run) const {
  const std::string json = watched.of == "speed-accuracy" ? run_motions_json(watched, truth_of(watched.scene, run))
                                                          : cell_motions_json(watched);
  if (json.empty()) return;
  const std::string key = watched.scene.name + "-" + watched.of;
  write_file(folder_ / file_name_of(key) / (file_name_of(watched.method) + ".json"), json);
}

std::optional<PlayableRuns> RunsFolder::of(const std::string& key, std::vector<std::string>& notes) const {
  constexpr std::uintmax_t most = 600'000;  // bytes: no set of a quick report weighs as much
  const fs::path own = folder_ / file_name_of(key);
  if (key.empty() || !fs::exists(own)) return std::nullopt;
  PlayableRuns runs{key, "", "", {}};
  for (const auto& file : fs::directory_iterator(own)) runs.methods.push_back(file.path());
  const auto weight = [](const fs::path& file) { return std::pair(fs::file_size(file), file); };
  std::ranges::sort(runs.methods, {}, weight);
  std::uintmax_t sum = 0;
  const auto too_much =
      std::ranges::find_if(runs.methods, [&](const fs::path& f) { return (sum += file_size(f)) > most; });
  if (const auto count = runs.methods.end() - too_much; count > 0)
    notes.push_back(fmt::format("of {} the runs of {} methods are too large for the page to play", key, count));
  runs.methods.erase(too_much, runs.methods.end());
  std::ranges::sort(runs.methods);
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
