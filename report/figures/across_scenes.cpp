// Over all scenes: the error of every method as a table, and a chart of the fastest method at 1 % error.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/table.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"

namespace crosscheck {

std::vector<Chart> scoreboard_charts(const ChartInput& input) {
  PageTable table{
      "Largest error over time, RMS over the particles, in % of the motion; no less than the error bar of the "
      "reference solution",
      {"method"},
      {}};
  std::vector<const SceneData*> scenes;
  std::vector<std::string> methods;
  for (const SceneData& scene : input.facts) {
    if (scene.tier.empty() || !(scene.motion > 0)) continue;
    scenes.push_back(&scene), table.header.push_back(scene.scene);
    for (const MethodData& m : scene.methods)
      if (m.supported() && std::ranges::find(methods, m.method) == methods.end()) methods.push_back(m.method);
  }
  if (scenes.empty()) return {};
  for (const std::string& method : methods) {
    std::vector<std::string>& row = table.rows.emplace_back(std::vector{method});
    for (const SceneData* scene : scenes) {
      const MethodData* m = scene->find(method);
      row.push_back(!m || !m->supported() ? ""
                    : m->ok() && m->error ? percent(std::max(*m->error, scene->error_bar), scene->motion)
                    : m->ok()             ? ""
                                          : m->failure());
    }
  }
  return {{.figure = std::monostate(),
           .chapter = "speed-accuracy",
           .heading = "Error of each method at the scene's own time step",
           .tables = {std::move(table)}}};
}

std::vector<Chart> same_rule_charts(const ChartInput& input) {
  DotPlot f;
  f.name = "same-rule-differences";
  f.title = "mysim and other engines under the same rule";
  f.label = "largest RMS position difference / m";
  std::vector<const MethodData*> shown;
  for (const MethodFamily* peer : default_peers()) {
    const std::string method(peer->representative);
    DotPlot::Series difference{method, style_of(method), {}}, bound{"round-off bound", {"#656e78", "1", 6}, {}};
    for (const SceneData& scene : input.facts) {
      const MethodData* m = scene.find(method);
      if (!m || !m->ok() || !m->same_rule.value_or(false) || !m->difference || !(*m->difference > 0)) continue;
      const std::string name = scene.touched() ? scene.scene + " (contact)" : scene.scene;
      if (std::ranges::find(f.names, name) == f.names.end()) f.names.push_back(name);
      const auto dot = [](double value) { return DotPlot::Dot{value, value, value}; };
      difference.dots.resize(f.names.size()), bound.dots.resize(f.names.size());
      difference.dots.back() = dot(*m->difference);
      if (m->round_off_bound && !scene.touched()) bound.dots.back() = dot(*m->round_off_bound);
      shown.push_back(m);
    }
    f.series.push_back(std::move(difference)), f.series.push_back(std::move(bound));
  }
  if (f.names.size() < 2) return {};  // a single scene's answer says it
  for (DotPlot::Series& series : f.series) series.dots.resize(f.names.size());
  const auto agreeing = std::ranges::count_if(
      shown, [](const MethodData* m) { return m->round_off_bound && *m->difference <= *m->round_off_bound; });
  f.finding = fmt::format("Differences below the round-off bound: {} of {} scenes.", agreeing, shown.size());
  f.caption = fmt::format(
      "Largest difference within each scene's predictable window; grey: the most that round-off can make. With contact "
      "the engines apply different rules: no bound; commit {}.",
      input.commit);
  f.tier = "another engine, so that these are differences and no errors";
  return {{.figure = std::move(f), .chapter = "same-answer", .heading = "", .shown = true}};
}

// The fastest method at an accuracy: on every scene the cheapest run of each engine within 1 % of the motion, against
// mysim's.

namespace {

/// An engine's name, and its style.
struct EngineStyle {
  std::string name;
  MethodStyle style;
};
EngineStyle style_of_engine(const std::string& engine) {
  const MethodFamily& family = family_of(engine);
  return family.representative.empty()
             ? EngineStyle{engine, style_of(engine)}
             : EngineStyle{std::string(family.title), style_of(std::string(family.representative))};
}

/// Says how many quotients have a time that was scaled from a part of its run; empty where none has.
std::string scaled_text(const Table& t) {
  int all = 0, scaled = 0;
  for (size_t i = 0; i < t.rows.size(); ++i) {
    if (number_at(t, i, "part of motion") != 0.01 || text_at(t, i, "measure") != "error" ||
        family_of(text_at(t, i, "engine")).is_subject() || !number_at(t, i, "times mysim"))
      continue;
    ++all;
    scaled += number_at(t, i, "part timed", 1) < 1 || number_at(t, i, "part timed of mysim", 1) < 1;
  }
  return scaled == 0
             ? ""
             : fmt::format("in {} of {} quotients a time is scaled from the first part of its run; ", scaled, all);
}

/// The engines that have a marker, and mysim, each as the first part of a method's name.
std::vector<std::string> drawn_engines(const std::vector<std::string>& engines) {
  std::vector<std::string> methods{std::string(subject().name) + "/"};
  for (const std::string& engine : engines) methods.push_back(engine + "/");
  return methods;
}

/// The row at 1 % of the motion.
std::optional<size_t> row_of(const Table& t, const std::string& scene, const std::string& engine) {
  for (size_t i = 0; i < t.rows.size(); ++i)
    if (text_at(t, i, "scene") == scene && number_at(t, i, "part of motion") == 0.01 &&
        text_at(t, i, "engine") == engine)
      return i;
  return std::nullopt;
}

/// "Within 1 % of the motion mysim is the fastest on 10 of 11 scenes; Bullet takes 6.5 (rod) to 78 (spring) times its
/// CPU time, Boost odeint 0.78 (rod) to 20 (cloth-hang)."
std::string summary_of(const DotPlot& f) {
  size_t first = 0;
  for (size_t i = 0; i < f.names.size(); ++i)
    first += std::none_of(f.series.begin(), f.series.end(),
                          [i](const DotPlot::Series& s) { return s.dots[i] && s.dots[i]->low < 1; });
  std::string others;
  for (const DotPlot::Series& series : f.series) {
    std::optional<size_t> least, most;
    for (size_t i = 0; i < series.dots.size(); ++i) {
      if (!series.dots[i]) continue;
      if (!least || series.dots[i]->value < series.dots[*least]->value) least = i;
      if (!most || series.dots[i]->value > series.dots[*most]->value) most = i;
    }
    const auto at = [&](size_t i) { return fmt::format("{} ({})", times_text(series.dots[i]->value), f.names[i]); };
    others +=
        fmt::format("{} {} takes {}{}{}", others.empty() ? ";" : ",", series.title,
                    least == most ? "" : at(*least) + " to ", at(*most), others.empty() ? " times its CPU time" : "");
  }
  return fmt::format("Within 1 % of the motion mysim is the fastest, beyond the intervals, on {} of {} scenes{}.",
                     first, f.names.size(), others);
}

}  // namespace

std::vector<Chart> cheapest_charts(const ChartInput& input) {
  const Table* t = input.result.table("speed-accuracy-engines-cost");
  if (!t) return {};
  std::vector<std::string> engines = distinct(*t, "engine");
  std::erase(engines, subject().name);
  std::ranges::stable_partition(engines, [](const std::string& engine) { return family_of(engine).is_engine(); });
  DotPlot f;
  f.name = "cheapest-1-percent-cost";
  f.title = "CPU time for 1 % error, relative to mysim";
  f.label = "CPU time / CPU time of mysim";
  f.right_of_one = "mysim is faster";
  f.from_costs = true;
  for (const std::string& engine : engines)
    f.series.push_back({style_of_engine(engine).name, style_of_engine(engine).style, {}});
  bool any = false;
  for (const std::string& scene : distinct(*t, "scene")) {
    std::vector<std::optional<DotPlot::Dot>> dots;
    for (const std::string& engine : engines) {
      const auto row = row_of(*t, scene, engine);
      const auto times =
          row && text_at(*t, *row, "measure") == "error" ? number_at(*t, *row, "times mysim") : std::nullopt;
      dots.push_back(times ? std::optional(DotPlot::Dot{*times, *number_at(*t, *row, "times mysim low"),
                                                        *number_at(*t, *row, "times mysim high")})
                           : std::nullopt);
    }
    if (std::none_of(dots.begin(), dots.end(), [](const auto& dot) { return dot.has_value(); })) continue;
    any = true;
    f.names.push_back(scene);
    for (size_t i = 0; i < engines.size(); ++i) f.series[i].dots.push_back(dots[i]);
  }
  if (!any) return {};
  std::erase_if(f.series, [](const DotPlot::Series& s) {
    return std::none_of(s.dots.begin(), s.dots.end(), [](const auto& dot) { return dot.has_value(); });
  });
  f.finding = summary_of(f);
  f.caption = fmt::format(
      "Right of the line mysim is faster. Of each engine the cheapest run, whatever its method, step or tolerance: "
      "some "
      "are far nearer than asked for, as none steps over a sampling interval; medians of thread CPU time, and the "
      "widest "
      "that both 90 % intervals allow; {}a scene without a marker has no such run of that engine; {}; commit {}.",
      scaled_text(*t), builds_text(drawn_engines(engines)), input.commit);
  f.tier = "each scene's truth, its error bar taken off the 1 %";
  return {{"", f, "speed-accuracy", "", "CPU time for 1 % error"}};
}

}  // namespace crosscheck
