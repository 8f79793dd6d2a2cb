// list: scenes, methods, experiments, assignments.
#include <fmt/format.h>

#include "experiments/disagreements/disagreements.h"
#include "experiments/experiment.h"
#include "experiments/scenes.h"
#include "mysim/errors.h"
#include "mysim/json.h"
#include "mysim/nearest.h"
#include "report/commands/commands.h"

namespace crosscheck {
namespace {

/// For people also what is no name yet; programs get names that can be run.
std::vector<std::pair<std::string, std::string>> method_rows(bool json) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const Method& method : all_methods()) rows.emplace_back(method.name, method.what);
  if (!json)
    rows.emplace_back("exec:PATH", "any program that speaks the engine protocol (reference/protocol/PROTOCOL.md)");
  return rows;
}

}  // namespace

int list_command(const std::string& what, bool json) {
  std::vector<std::pair<std::string, std::string>> rows;
  if (what == "scenes") {
    for (const auto name : shipped_scenes()) rows.emplace_back(name, load_scene(std::string(name)).question);
    for (const Disagreement& d : disagreements()) rows.emplace_back(d.name, scene_of(d).question);
  } else if (what == "methods")
    rows = method_rows(json);
  else if (what == "experiments")
    for (const Experiment& experiment : experiments()) rows.emplace_back(experiment.name, experiment.question);
  else if (what == "assignments")
    grader_command(json ? std::vector<std::string>{"list", "--json"} : std::vector<std::string>{"list"});
  else
    throw InputError(fmt::format("list {}: expected scenes, methods, experiments or assignments{}", what,
                                 did_you_mean(what, {"scenes", "methods", "experiments", "assignments"})));

  if (json) {
    Json list = Json::list();
    for (const auto& [name, text] : rows) list.push({{"name", name}, {"what", text}});
    fmt::print("{}\n", list.dump(2));
    return 0;
  }
  for (const auto& [name, text] : rows) fmt::print("{:<38} {}\n", name, text);
  return 0;
}

}  // namespace crosscheck
