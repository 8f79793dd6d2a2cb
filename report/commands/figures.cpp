#include "experiments/sweep/sweep.h"
#include "report/commands/command_line.h"
#include "report/figures/figure_set.h"
#include "report/findings/evidence.h"
#include "report/findings/findings_text.h"
#include "report/page/assemble.h"

namespace crosscheck {
namespace {

struct FiguresOptions {
  std::vector<std::string> names;
  std::vector<std::string> scenes;  // empty: the representative scenes
  std::string set = "paper", width, methods;
  bool full = false;
  std::filesystem::path from = {};  // a report to draw instead of running experiments
  std::filesystem::path out = "out/figures";
  std::string command_line;
};

struct FigureSelection {
  std::vector<const Experiment*> experiments;
  std::vector<Scene> pictures;
};

constexpr std::string_view picture_suffix = "-picture";

Scene pictured_scene(const std::string& name, const FiguresOptions& options) {
  if (options.scenes.empty()) return load_scene(name.substr(0, name.size() - picture_suffix.size()));
  std::vector<std::string> names;
  for (const Scene& scene : scenes_for({}, options.scenes, options.full, options.methods)) {
    names.push_back(picture_name(scene));
    if (name == names.back()) return scene;
  }
  throw InputError(fmt::format("{}: expected a picture of a scene given by --scene: {}{}", name, fmt::join(names, ", "),
                               did_you_mean(name, names)));
}

/// Names are experiments, or SCENE-picture. Without names, selects all experiments, and pictures of the given scenes or
/// of the representative cloths. Throws InputError that lists the valid names.
FigureSelection select_figures(const FiguresOptions& options) {
  FigureSelection selection;
  if (options.names.empty()) {
    for (const Experiment& e : experiments()) selection.experiments.push_back(&e);
    selection.pictures = scenes_for({}, options.scenes, options.full, options.methods);
    // pictures without a cloth say little on paper, and are drawn on request only
    if (options.scenes.empty() && !options.full)
      std::erase_if(selection.pictures, [](const Scene& scene) { return scene.triangles.empty(); });
  }
  for (const std::string& name : options.names) {
    if (std::ranges::count(options.names, name) > 1) throw InputError(fmt::format("{}: expected each name once", name));
    std::vector<std::string> known;
    for (const Experiment& e : experiments()) known.emplace_back(e.name);
    if (const Experiment* found = experiment_named(name))
      selection.experiments.push_back(found);
    else if (name.ends_with(picture_suffix))
      selection.pictures.push_back(pictured_scene(name, options));
    else
      throw InputError(unknown_name("figure", name, known, "crosscheck list experiments") +
                       "; pictures are called SCENE-picture");
  }
  return selection;
}

struct Work {
  std::vector<std::string> experiments;
  std::vector<Scene> scenes;
  std::vector<Point> points;
};

Work work_of(const FigureSelection& selection, const FiguresOptions& options, const RunCallback& on_engines) {
  Work work;
  Request request;
  request.full = options.full;
  request.scenes_only = !options.scenes.empty();
  if (!options.methods.empty()) request.methods = find_methods(options.methods);
  for (const Experiment* experiment : selection.experiments) {
    work.experiments.emplace_back(experiment->name);
    request.scenes = scenes_for(*experiment, options.scenes, options.full, options.methods);
    request.on_runs = experiment->points == engines_points ? on_engines : RunCallback();
    for (const Scene& scene : request.scenes)
      require_resources_to_keep(methods_of(request, scene), scene, run_of(request, scene));
    add_missing(work.scenes, request.scenes);
    // omit small systems that an experiment adds to the given scenes
    for (Point& point : experiment->points(request))
      if (options.scenes.empty() || std::ranges::any_of(request.scenes, [&](const Scene& scene) {
            return point.name.find(scene.name) != std::string::npos;
          }))
        work.points.push_back(std::move(point));
  }
  return work;
}

/// Draws scenes. Reuses the runs of experiment `engines` if it has the scene, which saves a third of the work.
class Pictures {
 public:
  Pictures(const std::vector<Scene>& scenes, const FiguresOptions& options, const FigureSize& size,
           const Provenance& lines)
      : scenes_(scenes), options_(options), size_(size), lines_(lines), runs_(std::make_shared<MethodResults>()) {}

  RunCallback keeping() const {
    return [this, runs = runs_](const RecordedRuns& recorded) {
      const bool pictured = std::ranges::any_of(
          scenes_, [&](const Scene& scene) { return content_of(scene) == content_of(recorded.scene); });
      if (pictured && std::ranges::count(pictured_methods(recorded.scene), recorded.method) > 0)
        runs->push_back({recorded.scene.name, recorded.method, recorded.runs[0].outcome, recorded.runs[0].path});
    };
  }

  /// One point per scene, whose result is the picture's entry in the catalogue.
  std::vector<Point> points() const {
    std::vector<Point> points;
    for (const Scene& scene : scenes_)
      points.push_back({"picture: " + picture_name(scene), content_of(scene),
                        [this, &scene](TableSet& rows) { draw(scene, rows); }});
    return points;
  }

  /// Makes the points of `engines` draw their scenes, too. A picture that fails is drawn again with the other figures.
  void draw_with_engines(std::vector<Point>& points, const Store& store) const {
    const std::vector<Point> own = this->points();
    for (Point& point : points)
      for (size_t i = 0; i < own.size(); ++i)
        if (point.name == "engines: " + scenes_[i].name)
          point.compute = [compute = std::move(point.compute), picture = own[i], &store](TableSet& rows) {
            compute(rows);
            try {
              TableSet entry;
              picture.compute(entry);
              store.keep(picture.hash(), entry);
            } catch (const std::exception&) {
            }
          };
  }

 private:
  void draw(const Scene& scene, TableSet& rows) const {
    MethodResults runs = std::exchange(*runs_, {});
    std::vector<const MethodResult*> shown;
    for (const std::string& name : pictured_methods(scene)) {
      const MethodResult& a = result_of({}, scene, find_method(name), runs);
      if (a.trajectory.frames() > 0) shown.push_back(&a);
    }
    const FigureInfo words = picture_info(scene, shown, size_, value_of(lines_, "commit"));
    write_printed(scene, shown, shot_for_print(scene, size_, options_.full), words, with_scene(lines_, scene),
                  options_.out);
    Table table{"words", {{"title", "1"}, {"finding", "1"}, {"caption", "1"}}, {}};
    table.add({words.title, words.finding, words.caption});
    rows.add(table);
  }

  const std::vector<Scene>& scenes_;
  const FiguresOptions& options_;
  const FigureSize& size_;
  const Provenance& lines_;
  std::shared_ptr<MethodResults> runs_;  // kept for the next picture of this process
};

class Problems {
 public:
  void tell(const std::string& problem) {
    fmt::print(stderr, "crosscheck: missing figure: {}\n", problem);
    any_ = true;
  }
  void compute(const std::vector<Point>& points, const Store& store) {
    Progress progress(static_cast<int>(points.size()));
    for (const FailedPoint& f : run_points(points, {patience_}, store, progress)) tell(f.name + ": " + f.why);
    progress.done();
  }
  bool any() const { return any_; }

 private:
  LockPatience patience_;
  bool any_ = false;
};

std::vector<Chart> charts_of(const std::vector<Scene>& scenes, const TableSet& rows, const Provenance& lines,
                             bool of_each) {
  const AllFindings findings = all_findings(scenes, rows);
  std::vector<Chart> charts = all_charts({scenes, findings.facts, rows, value_of(lines, "commit"), of_each});
  std::erase_if(charts, [](const Chart& chart) { return !figure_info(chart); });
  return charts;
}

/// Keeps the charts with these names; keeps all if no names are given. Throws InputError that lists the valid names.
void keep_named(std::vector<Chart>& charts, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::vector<std::string> known;
  for (const Chart& chart : charts) known.push_back(figure_info(chart)->name);
  for (const std::string& name : names)
    if (std::ranges::find(known, name) == known.end())
      throw InputError(fmt::format("unknown figure '{}'; the report has: {}{}", name, fmt::join(known, ", "),
                                   did_you_mean(name, known)));
  std::erase_if(charts, [&](const Chart& chart) { return std::ranges::count(names, figure_info(chart)->name) == 0; });
}

/// Draws charts in parallel, after `drawings`. Returns the charts' entries in the catalogue.
std::vector<FigureInSet> draw_charts(std::vector<Chart>& charts, const FigureSize& size, const Provenance& lines,
                                     const std::filesystem::path& folder, const Store& store, Problems& problems,
                                     std::vector<Point> drawings = {}) {
  const size_t begin = drawings.size();
  for (Chart& chart : charts) {
    resize(chart, size);
    drawings.push_back({"figure: " + figure_info(chart)->name, figure_info(chart)->name,
                        [&](TableSet&) { draw_figure(chart, lines, folder); }});
  }
  problems.compute(drawings, store);
  std::vector<FigureInSet> drawn;
  for (size_t i = 0; i < charts.size(); ++i)
    if (store.find(drawings[begin + i].hash()))
      drawn.push_back({*figure_info(charts[i]), charts[i].scene, chart_endings});
  return drawn;
}

int finish(std::vector<FigureInSet>& drawn, const FigureSize& size, const Provenance& lines,
           const FiguresOptions& given, OutputFolder& folder, const std::vector<std::string>& notes,
           Problems& problems) {
  for (const FigureInSet& figure : drawn) write_captions(figure.words, folder.path());
  write_catalogue(drawn, lines, folder.path());
  folder.finish();
  if (drawn.empty()) problems.tell("there is nothing to draw");
  for (const std::string& note : notes) fmt::print("note: {}\n", note);
  fmt::print("{}, {:g} cm wide, font size {:g} pt\n{}\n", counted(drawn.size(), "figure"), size.width, size.font,
             (given.out / "figures.json").string());
  return problems.any() ? 1 : 0;
}

int figures_from_report(const FiguresOptions& options) {
  const FigureSize size = figure_size(options.set, options.width);
  const ReportData data = read_report(options.from);
  std::vector<Chart> charts = charts_of(data.scenes, data.rows, data.provenance, data.each_has_charts());
  keep_named(charts, options.names);
  OutputFolder folder(options.out, "figures");
  const Store store(store_in(folder.path()));
  store.clear();
  Problems problems;
  std::vector<FigureInSet> drawn = draw_charts(charts, size, data.provenance, folder.path(), store, problems);
  store.clear();
  return finish(drawn, size, data.provenance, options, folder, {}, problems);
}

int figures_command(const FiguresOptions& given) {
  if (!given.from.empty()) return figures_from_report(given);
  FiguresOptions options = given;
  const FigureSize size = figure_size(options.set, options.width);
  const FigureSelection selection = select_figures(options);
  const Provenance plain = provenance(options.command_line);
  const Pictures pictures(selection.pictures, options, size, plain);
  Work work = work_of(selection, options, pictures.keeping());
  OutputFolder folder(options.out, "figures");
  options.out = folder.path();
  std::vector<Scene> scenes = work.scenes;
  add_missing(scenes, selection.pictures);
  const Provenance lines = with_scenes(plain, scenes);
  const Store store(store_in(options.out));
  store.clear();
  pictures.draw_with_engines(work.points, store);
  Problems problems;
  problems.compute(work.points, store);
  std::vector<std::string> missing;
  const TableSet rows = joined(point_list_of(work.experiments, work.points, lines), {&store, 1}, missing);

  std::vector<Chart> charts;
  if (!selection.experiments.empty())
    charts = charts_of(work.scenes, rows, lines, options.full || !options.scenes.empty());
  const std::vector<Point> pictured = pictures.points();
  std::vector<FigureInSet> drawn, of_charts = draw_charts(charts, size, lines, options.out, store, problems, pictured);
  for (size_t i = 0; i < pictured.size(); ++i)
    if (const auto found = store.find(pictured[i].hash())) {
      const Table& words = *found->table("words");
      const auto text = [&](const char* column) { return std::get<std::string>(words.at(0, column)); };
      const Scene& scene = selection.pictures[i];
      drawn.push_back({{picture_name(scene), text("title"), text("caption"), "", text("finding"), false, size},
                       scene.name,
                       picture_endings});
    }
  std::ranges::move(of_charts, std::back_inserter(drawn));
  store.clear();
  return finish(drawn, size, lines, given, folder, rows.notes, problems);
}

}  // namespace

void add_figures(CLI::App& app, Invocation& call) {
  auto [figures, options] = add_command(
      app, call, "figures", "draws charts and pictures with captions, for a paper or a lecture", figures_command);
  figures.add_option("NAME", options.names,
                     "experiments whose charts are drawn, or SCENE-picture for a picture of a scene (default: all)");
  figures.add_option("--scene", options.scenes,
                     "a shipped scene or a TOML file, whose charts and picture are drawn; may be repeated");
  auto* methods = figures.add_option("--methods", options.methods, "methods that the experiments run: A,B,...");
  figures.add_option("--set", options.set, "paper (8.5 cm, 7.5 pt) or lecture (24 cm, 20 pt)");
  figures.add_option("--width", options.width, "width on paper, such as 8.5cm, 85mm or 3.3in");
  figures.add_option("--out", options.out, "folder (out/figures)");
  add_quick_and_full(figures, options.full);
  figures
      .add_option("--from", options.from, "DIR: draws figures of the report in DIR, by their names, and runs nothing")
      ->excludes(methods);
}

}  // namespace crosscheck
