// Experiment `disagreements`: runs them all, measures, writes tables.
#include "experiments/disagreements/disagreements.h"

#include <fmt/format.h>

#include "experiments/scenes.h"

namespace crosscheck {

Scene scene_of(const Disagreement& disagreement) { return read_scene(file_of_disagreement(disagreement.name)); }

std::vector<Series> play(const Disagreement& disagreement, const Scene& scene) {
  std::vector<Series> all;
  Trajectory first;
  for (const Variant& variant : disagreement.variants) {
    Scene own = scene;
    if (auto* springs = own.model.find<Springs>()) springs->law = variant.law;
    Run run = default_run(own);
    if (variant.step > 0) run.step = variant.step;
    Recorder recorder;
    Series series{variant, run_method(find_method(variant.method), own, run, {&recorder}), {}};
    const Trajectory& path = recorder.trajectory;
    if (all.empty()) first = path;
    for (int i = 0; i < path.frames() && i < first.frames(); ++i)
      series.points.emplace_back(path.t[i], disagreement.value
                                                ? disagreement.value(own, {path.t[i], path.x[i], path.v[i]})
                                                : largest_column(path.x[i] - first.x[i]));
    all.push_back(std::move(series));
  }
  return all;
}

std::vector<Point> disagreements_points(const Request& request) {
  if (request.scenes_only) return {};
  std::vector<Point> points;
  for (const Disagreement& d : disagreements())
    points.push_back(
        {"disagreement: " + d.name, scene_of(d).hash, [d](Rows& rows) {
           const Scene scene = scene_of(d);
           const std::vector<Series> all = play(d, scene);
           Table table{
               d.name + "-disagreement",
               {{"curve", "1"}, {"method", "1"}, {"step", "s"}, {"verdict", "1"}, {"t", "s"}, {d.quantity, d.unit}},
               {}};
           for (const Series& s : all)
             for (const auto& [t, value] : s.points)
               table.add({s.variant.label, s.variant.method, s.outcome.step, std::string(name_of(s.outcome.verdict)), t,
                          value});
           Table summary{
               "disagreements",
               {{"name", "1"}, {"world", "1"}, {"what", "1"}, {"cause", "1"}, {"effect", "1"}, {"scene hash", "1"}},
               {}};
           std::string effect = d.effect(all);
           if (d.measured) {
             const TableTold more = d.measured(d);
             rows.add(more.table);
             effect += " " + more.sentence;
           }
           summary.add({d.name, d.world, d.what, d.cause, effect, scene.hash});
           rows.add(table);
           rows.add(summary);
         }});
  return points;
}

}  // namespace crosscheck
