// figures: a set of figures fit to print, made from the experiments that they need and no others.
#include <fmt/format.h>

#include <algorithm>

#include "experiments/sweep/sweep.h"
#include "mysim/errors.h"
#include "mysim/files.h"
#include "report/commands/commands.h"
#include "report/figure_set.h"
#include "report/grounds.h"
#include "report/provenance.h"

namespace crosscheck {
namespace {

/// The experiments of these names, or all.
std::vector<const Experiment*> experiments_named(const std::vector<std::string>& names) {
  std::vector<const Experiment*> all;
  if (names.empty())
    for (const Experiment& e : experiments()) all.push_back(&e);
  for (const std::string& name : names) all.push_back(&find_experiment(name));
  return all;
}

struct Asked {
  std::vector<std::string> experiments;
  std::vector<Scene> scenes;
  std::vector<Point> points;
};

Asked asked_by(const FiguresOptions& options) {
  Asked asked;
  Request request;
  request.full = options.full;
  request.scenes_only = !options.scenes.empty();
  for (const Experiment* experiment : experiments_named(options.names)) {
    asked.experiments.emplace_back(experiment->name);
    request.scenes = scenes_for(*experiment, options.scenes, options.full);
    unite(asked.scenes, request.scenes);
    for (Point& point : experiment->points(request)) asked.points.push_back(std::move(point));
  }
  return asked;
}

class Problems {
 public:
  void tell(const std::string& problem) {
    fmt::print(stderr, "crosscheck: missing among the figures: {}\n", problem);
    any_ = true;
  }
  void compute(const std::vector<Point>& points, const Store& store) {
    Progress progress(static_cast<int>(points.size()));
    for (const FailedPoint& f : run_points(points, {}, store, progress)) tell(f.name + ": " + f.why);
    progress.done();
  }
  bool any() const { return any_; }

 private:
  bool any_ = false;
};

}  // namespace

int figures_command(const FiguresOptions& options) {
  const FigureSize size = figure_size(options.set, options.width);
  const Asked asked = asked_by(options);
  require_writable(options.out);
  const Provenance lines = with_scenes(provenance(options.command_line), asked.scenes);
  const Store store(store_in(options.out));
  store.clear();
  Problems problems;
  problems.compute(asked.points, store);
  std::vector<std::string> missing;  // told already
  const Rows rows = joined(plan_of(asked.experiments, asked.points, lines), {&store, 1}, missing);

  const AllFindings findings = all_findings(asked.scenes, rows);
  std::vector<Chart> charts = all_charts({asked.scenes, findings.facts, rows, value_of(lines, "commit")});
  std::erase_if(charts, [&](Chart& chart) { return !resize(chart, size); });
  std::vector<Point> drawings;
  for (const Chart& chart : charts)
    drawings.push_back({"figure: " + words_of(chart)->name, words_of(chart)->name,
                        [&](Rows&) { draw_figure(chart, lines, options.out); }});
  problems.compute(drawings, store);
  store.clear();
  std::vector<const Chart*> drawn;
  for (const Chart& chart : charts)
    if (std::filesystem::exists(options.out / (words_of(chart)->name + ".pdf"))) drawn.push_back(&chart);
  for (const Chart* chart : drawn) write_words(*words_of(*chart), options.out);
  write_catalogue(drawn, lines, options.out);
  if (drawn.empty()) problems.tell("there is nothing to draw");
  for (const std::string& note : rows.notes) fmt::print("note: {}\n", note);
  fmt::print("{} figures, {:g} cm wide, letters of {:g} pt\n{}\n", drawn.size(), size.width, size.font,
             (options.out / "figures.json").string());
  return problems.any() ? 1 : 0;
}

}  // namespace crosscheck
