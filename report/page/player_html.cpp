#include "report/page/player_html.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

#include "experiments/stability/map.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/findings/findings_text.h"
#include "report/page/lab_html.h"
#include "report/page/page_parts.h"
#include "report/player/stage.h"

namespace crosscheck {
namespace {

/// Size (bytes) that a file takes in the page.
size_t weight_of(const RunFile& file) {
  return (std::filesystem::file_size(file.file) + 2) / 3 * 4 + dump(file.entry).size();
}

Json runs_data(const PlayableRuns& runs, const std::vector<RunFile>& files, const char* block) {
  std::vector<std::string> methods;
  for (const RunFile& file : files) {
    Json entry = file.entry;
    entry["data"] = base64(read_file(file.file, "packed runs"));
    methods.push_back(dump(entry));
  }
  const std::string text = fmt::format("{{\"scene\":{},\"stage\":{},\"methods\":[{}]}}", dump(Json(runs.scene)),
                                       runs.stage.empty() ? "null" : runs.stage, fmt::join(methods, ","));
  Json element = data_element(block, "", text);
  element["class"] = "runs", element["scene"] = runs.scene, element["set"] = runs.key;
  return element;
}

}  // namespace

Json motions_data(const PageContent& content) {
  Json all = Json::array();
  for (const ScenePart& part : content.scenes)
    if (!part.motions.empty()) {
      Json element = data_element("scenes", "", part.motions);
      element["class"] = "motion", element["scene"] = part.scene->name;
      all.push_back(std::move(element));
    }
  std::set<std::pair<std::string, std::string>> first;  // scene and method
  for (const ScenePart* part : first_scenes(content)) {
    first.emplace(part->scene->name, "truth");
    for (const ShownRun& run : part->runs)
      if (run.beside) first.emplace(part->scene->name, run.method);
  }
  for (const PlayableRuns& runs : content.runs) {
    const bool own = runs.key.ends_with("-engines") || runs.key.ends_with("-truth");
    std::vector<RunFile> now, later;
    for (const RunFile& file : runs.files)
      (own && first.contains({file.scene, file.method}) ? now : later).push_back(file);
    if (!now.empty()) all.push_back(runs_data(runs, now, "runs of the first screen"));
    if (!later.empty())
      all.push_back(runs_data(runs, later, own ? "own runs" : runs.stage.empty() ? "runs of marks" : "stills"));
  }
  return all;
}

std::optional<PlayableRuns> PageRuns::take(const std::string& key, const std::string& only,
                                           std::vector<std::string>& notes) {
  PlayableRuns runs{key, "", "", {}};
  for (const RunFile& file : files_)
    if (file.set == key && (only.empty() || file.method == only)) runs.files.push_back(file);
  // begin with the representatives of engines
  std::ranges::stable_partition(runs.files, [](const RunFile& file) {
    return file.method == "truth" || file.method == family_of(file.method).representative;
  });
  const size_t count = runs.files.size();
  std::erase_if(runs.files, [&](const RunFile& file) {
    const size_t weight = weight_of(file);
    if (weight > room_) return true;
    room_ -= weight;
    return false;
  });
  if (runs.files.size() < count)  // add_once, because a report that is read again already has the note
    add_once(notes, fmt::format("{}: the runs of {} methods are too large for the page to play", key,
                                count - runs.files.size()));
  if (runs.files.empty()) return std::nullopt;
  return runs;
}

std::vector<Points> PageRuns::seen_in(const Scene& scene) const {
  std::vector<Points> seen;
  const RunFile* whole = nullptr;  // run of a representative, or else the first run
  for (const RunFile& file : files_) {
    if (file.scene != scene.name || file.particles != scene.model.particles.size()) continue;
    if (file.set == scene.name + "-truth") seen = positions_of(file, 0);
    const Json& run = file.entry["runs"][0];
    if (file.set == scene.name + "-engines" && run.is_object() && run["verdict"] == name_of(Verdict::ok))
      if (!whole || file.method == family_of(file.method).representative) whole = &file;
  }
  if (whole) std::ranges::move(positions_of(*whole, 0), std::back_inserter(seen));
  return seen;
}

std::string stage_of(const Scene& scene, const SceneData& facts, const PageRuns& runs) {
  const std::vector<Points> seen = runs.seen_in(scene);
  if (seen.empty()) return "";
  const bool rule = facts.tier.empty();
  std::optional<StageTruth> truth;
  if (!rule || facts.contact_until)
    truth = {rule ? "converged contact rule" : "truth, " + facts.tier, rule, facts.error_bar, facts.motion};
  return stage_json(scene, seen, truth);
}

std::string stage_of_map(const std::string& key, const std::vector<Scene>& scenes, bool full) {
  for (const Scene& scene : scenes)
    if (const auto small = map_scene(scene, full))
      for (const MapKind& kind : map_kinds())
        if (key == fmt::format("{}-{}-map", small->name, kind.name)) return stage_json(*small, has_lab_module());
  return "";
}

}  // namespace crosscheck
