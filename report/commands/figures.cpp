// figures: a set of figures fit to print, made from the experiments that they need and no others.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "experiments/estimate.h"
#include "experiments/scenes/scenes.h"
#include "experiments/sweep/sweep.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/output_folder.h"
#include "mysim/base/text.h"
#include "report/base/provenance.h"
#include "report/commands/command_line.h"
#include "report/commands/commands.h"
#include "report/figures/figure_set.h"
#include "report/findings/evidence.h"

namespace crosscheck {
namespace {

struct FiguresOptions {
  std::vector<std::string> names;   // of experiments; empty: all
  std::vector<std::string> scenes;  // empty: those that stand for the others
  std::string set = "paper", width;
  bool full = false;
  std::filesystem::path out = "out/figures";
  std::string command_line;
};

struct PictureRequest {
  Scene scene;
  std::string given;  // the scene's name or file, as it was typed
};

struct FigureSelection {
  std::vector<const Experiment*> experiments;
  std::vector<PictureRequest> pictures;
};

constexpr std::string_view picture_suffix = "-picture";

const Experiment* experiment_named(const std::string& name) {
  for (const Experiment& e : experiments())
    if (name == e.name) return &e;
  return nullptr;
}

/// The scenes that the user named, or those that stand for the others.
std::vector<PictureRequest> scenes_asked(const FiguresOptions& options) {
  std::vector<PictureRequest> all;
  const std::vector<Scene> scenes = scenes_for({}, options.scenes, options.full);
  for (size_t i = 0; i < scenes.size(); ++i)
    all.push_back({scenes[i], options.scenes.empty() ? scenes[i].name : options.scenes[i]});
  return all;
}

PictureRequest picture_named(const std::string& name, const FiguresOptions& options) {
  if (options.scenes.empty()) {
    const std::string scene = name.substr(0, name.size() - picture_suffix.size());
    return {load_scene(scene), scene};
  }
  const std::vector<PictureRequest> all = scenes_asked(options);
  std::vector<std::string> names;
  for (const PictureRequest& asked : all) {
    if (name == picture_name(asked.scene)) return asked;
    names.push_back(picture_name(asked.scene));
  }
  throw InputError(fmt::format("{}: expected a picture of a scene that --scene names: {}{}", name,
                               fmt::join(names, ", "), did_you_mean(name, names)));
}

[[noreturn]] void fail(const std::string& name) {
  std::vector<std::string> known;
  for (const Experiment& e : experiments()) known.emplace_back(e.name);
  throw InputError(fmt::format("unknown figures '{}'; expected SCENE-picture or one of {}{}", name,
                               fmt::join(known, ", "), did_you_mean(name, known)));
}

/// Names are experiments, or SCENE-picture of a scene that --scene names or that comes with Crosscheck; no names are
/// all experiments, and pictures of the named scenes or of those that stand for the others. Throws InputError that
/// lists what there is.
FigureSelection select_figures(const FiguresOptions& options) {
  FigureSelection asked;
  if (options.names.empty()) {
    for (const Experiment& e : experiments()) asked.experiments.push_back(&e);
    asked.pictures = scenes_asked(options);
  }
  for (size_t i = 0; i < options.names.size(); ++i) {
    const std::string& name = options.names[i];
    if (std::count(options.names.begin(), options.names.end(), name) > 1)
      throw InputError(fmt::format("{}: expected each name once", name));
    if (const Experiment* experiment = experiment_named(name))
      asked.experiments.push_back(experiment);
    else if (name.ends_with(picture_suffix))
      asked.pictures.push_back(picture_named(name, options));
    else
      fail(name);
  }
  return asked;
}

/// Everything that there is to compute, and what it is of.
struct Work {
  std::vector<std::string> experiments;
  std::vector<Scene> scenes;  // of the experiments
  std::vector<Point> points;  // of the experiments
};

Work work_of(const FigureSelection& asked, const FiguresOptions& options) {
  Work work;
  Request request;
  request.full = options.full;
  request.scenes_only = !options.scenes.empty();
  for (const Experiment* experiment : asked.experiments) {
    work.experiments.emplace_back(experiment->name);
    request.scenes = scenes_for(*experiment, options.scenes, options.full);
    for (const Scene& scene : request.scenes)
      require_resources_to_keep(methods_of(request, scene), scene, run_of(request, scene));
    add_missing(work.scenes, request.scenes);
    for (Point& point : experiment->points(request)) work.points.push_back(std::move(point));
  }
  return work;
}

/// The command that draws a picture again, into a folder of its own.
std::string script_of(const PictureRequest& picture, const FiguresOptions& options, const FigureSize& size) {
  const std::string name = picture_name(picture.scene);
  return fmt::format(
      "#!/bin/sh\n# Draws {0} again; to be started where crosscheck is. $1: the folder\n"
      "./crosscheck figures {0} --scene {1} --set {2} --width {3:g}cm{4} --out \"${{1:-{0}}}\"\n",
      name, shell_quoted(picture.given), options.set, size.width, options.full ? " --full" : "");
}

/// Draws the picture of a scene into the folder, and returns its entry of the catalogue.
Point picture_point(const PictureRequest& picture, const FiguresOptions& options, const FigureSize& size,
                    const Provenance& lines) {
  return {"picture: " + picture_name(picture.scene), content_of(picture.scene), [&, size](Rows& rows) {
            const Scene& scene = picture.scene;
            Results answers;
            std::vector<const Result*> shown;
            for (const std::string& name : pictured_methods(scene)) {
              const Result& a = result_of({}, scene, find_method(name), answers);
              if (a.trajectory.frames() > 0) shown.push_back(&a);
            }
            const FigureInfo words = picture_info(scene, shown, size, value_of(lines, "commit"));
            write_printed(scene, shown, shot_for_print(scene, size, options.full), words, with_scene(lines, scene),
                          options.out);
            const auto script = options.out / (words.name + ".sh");
            write_file(script, script_of(picture, options, size));
            std::filesystem::permissions(script, std::filesystem::perms::owner_exec,
                                         std::filesystem::perm_options::add);
            Table table{"words", {{"title", "1"}, {"finding", "1"}, {"caption", "1"}}, {}};
            table.add({words.title, words.finding, words.caption});
            rows.add(table);
          }};
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

int figures_command(const FiguresOptions& asked_for) {
  FiguresOptions options = asked_for;
  const FigureSize size = figure_size(options.set, options.width);
  const FigureSelection asked = select_figures(options);
  const Work work = work_of(asked, options);
  OutputFolder folder(options.out, "figures");
  options.out = folder.path();
  std::vector<Scene> scenes = work.scenes;
  for (const PictureRequest& picture : asked.pictures) add_missing(scenes, {picture.scene});
  const Provenance plain = provenance(options.command_line), lines = with_scenes(plain, scenes);
  const Store store(store_in(options.out));
  store.clear();
  Problems problems;
  std::vector<Point> points;  // the pictures first, which take longest
  for (const PictureRequest& picture : asked.pictures) points.push_back(picture_point(picture, options, size, plain));
  const size_t pictures = points.size();
  points.insert(points.end(), work.points.begin(), work.points.end());
  problems.compute(points, store);
  std::vector<std::string> missing;  // reported already
  const Rows rows = joined(point_list_of(work.experiments, work.points, lines), {&store, 1}, missing);

  std::vector<FigureInSet> drawn;
  for (size_t i = 0; i < pictures; ++i)
    if (const auto found = store.find(points[i].hash())) {
      const Table& words = *found->table("words");
      const auto text = [&](const char* column) { return std::get<std::string>(words.at(0, column)); };
      const Scene& scene = asked.pictures[i].scene;
      drawn.push_back({{picture_name(scene), text("title"), text("caption"), "", text("finding"), false, size},
                       scene.name,
                       picture_endings});
    }
  std::vector<Chart> charts;
  if (!asked.experiments.empty()) {
    const AllFindings findings = all_findings(work.scenes, rows);
    charts = all_charts(
        {work.scenes, findings.facts, rows, value_of(lines, "commit"), options.full || !options.scenes.empty()});
    std::erase_if(charts, [&](Chart& chart) { return !resize(chart, size); });
  }
  std::vector<Point> drawings;
  for (Chart& chart : charts)
    drawings.push_back({"figure: " + figure_info(chart)->name, figure_info(chart)->name, [&](Rows& letters) {
                          draw_in_size(chart, size, lines, options.out);
                          Table table{"letters", {{"font", "pt"}}, {}};
                          table.add({figure_info(chart)->size.font});
                          letters.add(table);
                        }});
  problems.compute(drawings, store);
  int smaller = 0;  // letters, where there was no room
  for (size_t i = 0; i < charts.size(); ++i)
    if (const auto found = store.find(drawings[i].hash())) {
      FigureSize its = size;
      its.font = std::get<double>(found->table("letters")->at(0, "font"));
      smaller += its.font < size.font;
      resize(charts[i], its);
      drawn.push_back({*figure_info(charts[i]), charts[i].scene, chart_endings});
    }
  store.clear();
  for (const FigureInSet& figure : drawn) write_captions(figure.words, options.out);
  write_catalogue(drawn, lines, options.out);
  folder.finish();
  if (drawn.empty()) problems.tell("there is nothing to draw");
  for (const std::string& note : rows.notes) fmt::print("note: {}\n", note);
  fmt::print("{} figures, {:g} cm wide, letters of {:g} pt{}\n{}\n", drawn.size(), size.width, size.font,
             smaller ? fmt::format(" (smaller in {} that have no room for them)", smaller) : "",
             (asked_for.out / "figures.json").string());
  return problems.any() ? 1 : 0;
}

}  // namespace

void add_figures(CLI::App& app, Invocation& call) {
  const auto options = std::make_shared<FiguresOptions>();
  auto* figures =
      app.add_subcommand("figures", "charts and pictures fit to print, with captions, for a paper or a lecture");
  figures->add_option("NAME", options->names, "experiments whose charts are asked for, or SCENE-picture; default: all");
  figures->add_option("--scene", options->scenes, "a shipped scene or a TOML file; again for more");
  figures->add_option("--set", options->set, "paper (8.5 cm, 8 pt) or lecture (24 cm, 20 pt)");
  figures->add_option("--width", options->width, "8.5cm, 85mm, 3.3in");
  figures->add_option("--out", options->out, "folder (out/figures)");
  add_quick_and_full(*figures, options->full);
  figures->callback([options, &call] {
    options->command_line = call.line;
    call.status = figures_command(*options);
  });
}

}  // namespace crosscheck
