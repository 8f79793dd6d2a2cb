#include "report/page/shown_runs.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/tables/engines.h"
#include "experiments/tables/speed_accuracy.h"
#include "mysim/base/text.h"
#include "mysim/run/contacts.h"
#include "report/findings/findings_text.h"
#include "report/page/page_parts.h"

namespace crosscheck {
namespace {

class Chooser {
 public:
  Chooser(const ScenePart& part, const TableSet& rows, const std::function<bool(const std::string&)>& holds)
      : part_(part), rows_(rows), base_(default_run(*part.scene)), costs_(rows_of<SpeedAccuracyCostRow>(rows)) {
    std::map<std::string, int> places;
    for (const SpeedAccuracyRow& row : rows_of<SpeedAccuracyRow>(rows)) {
      if (row.scene != part.scene->name) continue;
      const int place = places[row.method]++;
      if (row.verdict != Verdict::ok || !holds(row.method)) continue;
      charted_.push_back({fmt::format("{} {}", row.method, place), row.method,
                          setting_text(name_of(row.setting), row.requested), row.error ? row.error : row.difference,
                          cost_of(row), false,
                          Setting{row.setting == SettingKind::tolerance, row.requested}.applied_to(base_)});
    }
  }

  std::vector<ShownRun> all() {
    add_own(ours, true);
    for (const MethodFamily* peer : default_peers()) add_own(std::string(peer->representative), true);
    for (const MethodData& m : part_.facts->methods)
      if (family_of(m.method).role == Role::outside) add_own(m.method, true);
    // if no representative of mysim ran, add another method of mysim; do the same for the other engines, taken together
    for (const bool of_subject : {true, false})
      for (const MethodData& m : part_.facts->methods)
        if (family_of(m.method).is_subject() == of_subject && std::ranges::none_of(chosen_, [&](const ShownRun& run) {
              return family_of(run.method).is_subject() == of_subject;
            }))
          add_own(m.method, true);
    if (const auto& take = part_.take) {
      const Run run = Setting{take->setting == SettingKind::tolerance, take->requested}.applied_to(base_);
      for (const ShownRun& each : charted_)
        if (each.method == take->method && each.run.step == run.step && each.run.tolerance == run.tolerance) add(each);
    }
    std::vector<ShownRun> best = charted_;  // one run per method that is not yet chosen, cheapest first
    std::ranges::stable_sort(best, [this](const ShownRun& a, const ShownRun& b) { return better(a, b); });
    std::set<std::string> methods;
    for (const ShownRun& run : chosen_) methods.insert(run.method);
    std::erase_if(best, [&](const ShownRun& run) { return !methods.insert(run.method).second; });
    std::ranges::stable_sort(best, {}, [](const ShownRun& run) { return run.cpu.value_or(INFINITY); });
    for (const ShownRun& run : best) add(run);
    for (const MethodData& m : part_.facts->methods)
      if (!methods.contains(m.method)) add_own(m.method, false);
    if (chosen_.size() > 9) chosen_.resize(9);
    return std::move(chosen_);
  }

 private:
  void add(ShownRun run) {
    if (std::ranges::find(chosen_, run.key, &ShownRun::key) == chosen_.end()) chosen_.push_back(std::move(run));
  }
  void add_own(const std::string& method, bool beside) {
    const MethodData* m = part_.facts->find(method);
    if (m && m->ok() && family_of(method).role != Role::truth)
      add({method + " own", method, is_adaptive(method) ? "own tolerance" : step_text(m->step),
           m->error ? m->error : m->contact_difference, cost_at(*m), beside, base_, beside ? difference_of(*m) : ""});
  }
  /// "0.81 mm until 480 ms, 2.8 mm at the end", if another engine's method has the rule of mysim's representative.
  std::string difference_of(const MethodData& m) const {
    if (!is_another_engine(m.method) || !m.same_rule.value_or(false) || !m.difference) return "";
    std::string text = nice_length(*m.difference);
    const Scene& scene = *part_.scene;
    if (scene.window > scene.duration * (1 - 1e-9)) return text;
    text += " until " + step_text(scene.window);
    std::optional<double> last;
    if (const Table* over_time = rows_.table(scene.name + "-engines"))
      for (const EngineTimeRow& row : rows_of<EngineTimeRow>(*over_time))
        if (row.method == m.method && row.difference) last = row.difference;
    return last ? fmt::format("{}, {} at the end", text, nice_length(*last)) : text;
  }
  /// Cost of the run with the same step in the method's chart.
  std::optional<double> cost_at(const MethodData& m) const {
    for (const ShownRun& run : charted_)
      if (run.method == m.method && !is_adaptive(m.method) && std::abs(run.run.step / m.step - 1) < 1e-9)
        return run.cpu;
    return std::nullopt;
  }
  bool better(const ShownRun& run, const ShownRun& than) const {
    const auto within = [&](const ShownRun& r) { return r.error && *r.error <= 0.01 * part_.facts->motion; };
    if (within(run) != within(than)) return within(run);
    return within(run) ? run.cpu.value_or(INFINITY) < than.cpu.value_or(INFINITY)
                       : run.error.value_or(INFINITY) < than.error.value_or(INFINITY);
  }
  std::optional<double> cost_of(const SpeedAccuracyRow& run) const {
    for (const SpeedAccuracyCostRow& cost : costs_)
      if (cost.scene == run.scene && cost.method == run.method && cost.setting == run.setting &&
          cost.requested == run.requested)
        return cost.cpu;
    return std::nullopt;
  }

  const ScenePart& part_;
  const TableSet& rows_;
  Run base_;  // at the scene's own step
  std::vector<SpeedAccuracyCostRow> costs_;
  std::vector<ShownRun> charted_, chosen_;
};

/// True for mysim's rules whose options a browser supports.
bool is_of_lab(const std::string& method) {
  const std::vector<std::string> words = split(method, '+');
  return family_of(method).is_subject() && std::all_of(words.begin() + 1, words.end(), [](const std::string& word) {
           return contact_rule_of_option(word) || word == "linear";
         });
}

}  // namespace

std::vector<ShownRun> shown_runs(const ScenePart& part, const TableSet& rows,
                                 const std::function<bool(const std::string&)>& holds) {
  return Chooser(part, rows, holds).all();
}

Json shown_runs_data(const ScenePart& part, bool lab) {
  const double motion = part.facts->motion;
  std::vector<std::string> methods;
  for (const ShownRun& run : part.runs) methods.push_back(run.method);
  Json all = Json::array();
  for (const ShownRun& run : part.runs)
    all.push_back({{"method", run.method},
                   {"name", engine_and_reader_name(run.method, methods)},
                   {"setting", run.setting},
                   {"percent", run.error && motion > 0 ? percent(*run.error, motion) : "–"},
                   {"error", run.error ? nice_length(*run.error) : "–"},
                   {"cpu", run.cpu ? step_text(*run.cpu) : "–"},
                   {"speed", run.cpu ? nice(part.scene->duration / *run.cpu) : "–"},
                   {"key", run.key},
                   {"lab", lab && is_of_lab(run.method)}});
  return all;
}

}  // namespace crosscheck
