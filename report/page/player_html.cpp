// Puts the player's files and the kept runs into the page.
#include "report/page/player_html.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "experiments/stability/map.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "report/base/assets.h"
#include "report/page/lab_html.h"
#include "report/player/computed_runs.h"

namespace crosscheck {
std::string script_json(const std::string& attributes, const std::string& json) {
  return fmt::format("<script type=\"application/json\" {}>{}</script>\n", attributes, json_for_script(json));
}

namespace {

std::string runs_html(const PlayableRuns& runs, const std::vector<std::string>& files) {
  const std::string base =
      runs.stage.empty() ? fmt::format("\"scene\":{}", dump(Json(runs.scene))) : "\"stage\":" + runs.stage;
  return script_json(fmt::format("class=\"runs\" data-runs=\"{}\"", escaped(runs.key)),
                     fmt::format("{{{},\"methods\":[{}]}}", base, fmt::join(files, ",")));
}

std::vector<std::string> contents_of(const PlayableRuns& runs) {
  std::vector<std::string> files;
  for (const auto& file : runs.methods) files.push_back(content_of_file(file));
  return files;
}

}  // namespace

std::string runs_html(const PlayableRuns& runs) { return runs_html(runs, contents_of(runs)); }

std::string all_runs_html(const std::vector<PlayableRuns>& runs, bool lab,
                          const std::map<std::string, std::set<std::string>>& shown) {
  std::vector<std::vector<std::string>> files;
  for (const PlayableRuns& each : runs) files.push_back(contents_of(each));
  std::set<std::string> scenes;
  for (const PlayableRuns& each : runs)
    if (lab && each.stage.empty()) scenes.insert(each.scene);
  for (const std::string& scene : scenes) {
    std::vector<FileOfRuns> own;
    for (size_t i = 0; i < runs.size(); ++i)
      for (std::string& file : files[i])
        if (runs[i].stage.empty() && runs[i].scene == scene) own.push_back({runs[i].key.ends_with("-engines"), &file});
    const auto stay = shown.find(scene);
    leave_out_computed(own, stay == shown.end() ? std::set<std::string>() : stay->second);
  }
  for (size_t i = 0; i < runs.size(); ++i)
    if (!runs[i].stage.empty())
      for (std::string& file : files[i]) file = cells_for_page(file, lab);
  std::string out;
  for (size_t i = 0; i < runs.size(); ++i) out += runs_html(runs[i], files[i]);
  return out;
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
        if (key == fmt::format("{}-{}-map", small->name, kind.name)) return stage_json(*small, has_lab_module());
  return "";
}

}  // namespace crosscheck
