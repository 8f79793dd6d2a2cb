// report: the main job. Runs the experiments, draws figures and pictures, writes data, report.json and the page.

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "experiments/estimate.h"
#include "experiments/scenes/scenes.h"
#include "experiments/sweep/sweep.h"
#include "experiments/tables/dictionary.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/output_folder.h"
#include "report/base/provenance.h"
#include "report/commands/command_line.h"
#include "report/commands/commands.h"
#include "report/commands/json_files.h"
#include "report/findings/findings_text.h"
#include "report/findings/verify.h"
#include "report/page/page.h"
#include "report/page/player_html.h"
#include "report/pictures/scene_picture.h"
#include "report/player/player_data.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

void write_data(const Rows& result, const Provenance& lines, const fs::path& folder) {
  for (const Table& table : result.tables) write_csv(table, lines, folder);
  write_csv(dictionary(result.tables), lines, folder);
  for (const Certificate& c : result.certificates)
    write_file(folder / fmt::format("certificate-{}-{}.json", c.scene, file_name_of(c.method)), certificate_json(c));
}

void write_picture(const Scene& scene, const std::vector<const Result*>& shown, const Shot& shot,
                   const fs::path& file) {
  render::OffscreenRenderer renderer;
  render::write_png(picture_of(scene, shown, shot), file, renderer);
}

class Builder {
 public:
  Builder(const ReportOptions& options, Request request, OutputFolder& folder)
      : options_(options),
        request_(std::move(request)),
        folder_(folder),
        figures_(folder.path() / "figures"),
        runs_(folder.path() / "data" / "runs") {
    request_.watch = [this](const WatchedRuns& watched) {
      if (watched.of != "speed-accuracy" || has_own_charts(watched.of, watched.scene.name, all()))
        runs_.keep(watched, run_of(request_, watched.scene));
    };
    for (const Experiment& e : experiments()) {
      const auto& asked = options.experiments;
      if (!asked.empty() && std::find(asked.begin(), asked.end(), e.name) == asked.end()) continue;
      experiments_.push_back(&e);
      requests_.push_back(request_);
      requests_.back().scenes = scenes_for(e, options.scenes, options.full);
    }
    page_.provenance = with_scenes(provenance(options.command_line), scenes_of_all());
    fs::create_directories(figures_);
    page_.chapters = chapters();
  }

  int build() {
    PointList plan{{}, {}, page_.provenance};
    std::vector<Point> points = picture_points();  // the longest first
    const size_t pictures = points.size();
    for (size_t e = 0; e < requests_.size(); ++e) {
      plan.experiments.emplace_back(experiments_[e]->name);
      for (Point& point : experiments_[e]->points(requests_[e])) points.push_back(std::move(point));
    }
    for (size_t i = pictures; i < points.size(); ++i) plan.points.push_back({points[i].name, points[i].hash()});
    compute(points);
    std::vector<std::string> missing;  // named already as what failed
    rows_ = joined(plan, {&store_, 1}, missing);

    for (const Certificate& c : rows_.certificates)
      if (c.mismatch())
        page_.problems.push_back(
            fmt::format("{} on {}: it built another scene, see its certificate", c.method, c.scene));
    write_data(rows_, page_.provenance, folder_.path() / "data");
    for (const Scene& scene : request_.scenes)
      write_file(folder_.path() / "data" / "scenes" / (file_name_of(scene.name) + ".toml"), scene.source);
    findings_ = all_findings(request_.scenes, rows_);
    page_.notes = rows_.notes;
    if (!options_.full) page_.notes.insert(page_.notes.begin(), left_out());
    page_.findings = findings_.overall;
    if (!options_.against.empty()) {
      page_.against = options_.against.string();
      page_.changes = changes_since(options_.against, findings_);
    }
    for (size_t i = 0; i < request_.scenes.size(); ++i) add_part(i);
    charts_ = all_charts({request_.scenes, findings_.facts, rows_, value_of(page_.provenance, "commit"), all()});
    draw_charts();
    for (const Chart& chart : charts_) add(chart);
    // next to the summary stands the last scene that Bullet runs too
    const ScenePart* shown = nullptr;
    for (const ScenePart& part : page_.scenes) {
      const MethodData* bullet = part.facts->find(theirs);
      if (!part.pictures.empty() && (!shown || (bullet && bullet->ok()))) shown = &part;
    }
    if (shown) page_.hero.insert(page_.hero.begin(), shown->pictures[0]);

    write_file(folder_.path() / "report.json", report_json(page_, findings_, charts_, rows_));
    write_file(folder_.path() / "index.html", page_html(page_));
    store_.clear();
    folder_.finish();
    for (const std::string& problem : page_.problems)
      fmt::print(stderr, "crosscheck: missing in the report: {}\n", problem);
    for (const Finding& f : page_.findings) fmt::print("- {}\n", f.sentence);
    fmt::print("{}\n", (options_.out / "index.html").string());
    bool agree = true;  // where the same rule must agree, it does
    for (const SceneData& facts : findings_.facts) agree &= !same_rule_differs(facts);
    return page_.problems.empty() && agree ? 0 : 1;
  }

 private:
  void compute(const std::vector<Point>& points) {
    Progress progress(static_cast<int>(points.size()));
    for (const FailedPoint& f : run_points(points, {}, store_, progress))
      page_.problems.push_back(fmt::format("{}: {}", f.name, f.why));
    progress.done();
  }

  /// Whether each scene has charts of its own.
  bool all() const { return options_.full || !options_.scenes.empty(); }

  /// Every scene of some experiment.
  std::vector<Scene> scenes_of_all() const {
    std::vector<Scene> all = request_.scenes;
    for (const Request& request : requests_) add_missing(all, request.scenes);
    return all;
  }

  std::string left_out() const {
    if (request_.scenes_only)
      return "this is the report of the named scenes: what experiments ask of scenes of their own (balls, known "
             "disagreements, the stiffness of links, the cost of a step) is in the report without names, and with "
             "--full";
    std::vector<std::string_view> names;
    for (const auto name : shipped_scenes())
      if (std::none_of(request_.scenes.begin(), request_.scenes.end(), [&](const Scene& s) { return s.name == name; }))
        names.push_back(name);
    return fmt::format(
        "this is the short form of the report: {} have no part of their own, and each chapter looks at "
        "the scenes that stand for the others; --full has all of them",
        fmt::join(names, ", "));
  }

  fs::path picture_of_scene(const Scene& scene) const { return figures_ / (file_name_of(scene.name) + "-picture.png"); }

  fs::path motions_of_scene(const Scene& scene) const {
    return folder_.path() / "data" / (file_name_of(scene.name) + "-motions.json");
  }

  std::vector<std::string> methods_pictured(const Scene& scene) const {
    std::vector<std::string> names, asked;
    for (const Method& m : methods_of(request_, scene)) asked.push_back(m.name);
    for (const std::string& name : pictured_methods(scene))
      if (std::find(asked.begin(), asked.end(), name) != asked.end()) names.push_back(name);
    if (names.empty()) names.assign(asked.begin(), asked.begin() + std::min<long>(3, std::ssize(asked)));
    return names;
  }

  /// Those of them that the scene's picture shows: of what a method refused there is nothing to see.
  std::vector<std::string> pictured(const ScenePart& part) const {
    std::vector<std::string> names = methods_pictured(*part.scene);
    std::erase_if(names, [&](const std::string& name) {
      const MethodData* m = part.facts->find(name);
      return m && !m->supported();
    });
    return names;
  }

  /// Pictures are work like any other: drawn by the same processes, kept as files.
  std::vector<Point> picture_points() const {
    std::vector<Point> points;
    for (const Scene& scene : request_.scenes)
      points.push_back({"picture: " + scene.name, content_of(request_, scene), [this, &scene](Rows&) {
                          Results answers;
                          std::vector<const Result*> shown;
                          for (const std::string& name : methods_pictured(scene)) {
                            const Result& a = result_of(request_, scene, find_method(name), answers);
                            if (a.trajectory.frames() > 0) shown.push_back(&a);
                          }
                          write_picture(scene, shown, usual_shot(scene, options_.full), picture_of_scene(scene));
                          const auto motions = player_json(scene, shown, truth_of(scene, run_of(request_, scene)));
                          if (!motions.empty()) write_file(motions_of_scene(scene), motions);
                        }});
    return points;
  }

  /// The runs that a figure plays, once for all figures that play them; false where there are none.
  bool add_runs(const std::string& key) {
    if (std::ranges::find(page_.runs, key, &PlayableRuns::key) != page_.runs.end()) return true;
    auto runs = runs_.of(key, page_.notes);
    if (!runs) return false;
    runs->stage = stage_of_map(key, scenes_of_all(), options_.full);
    for (const Scene& scene : request_.scenes)
      if (key == scene.name + "-speed-accuracy" && fs::exists(motions_of_scene(scene))) runs->scene = scene.name;
    if (runs->stage.empty() && runs->scene.empty()) return false;
    page_.runs.push_back(std::move(*runs));
    return true;
  }

  void add_part(size_t i) {
    const Scene& scene = request_.scenes[i];
    page_.scenes.push_back({&scene, &findings_.facts[i], findings_.of_scenes[i], {}, {}, {}});
    ScenePart& part = page_.scenes.back();
    part.statistics = rows_.table(scene.name + "-statistics");
    part.recommendations = recommendations_of(scene, findings_.facts[i], rows_);
    for (const Certificate& c : rows_.certificates)
      if (c.scene == scene.name) part.certificates.push_back(&c);
    if (!fs::exists(picture_of_scene(scene))) return;  // why not, is among the problems
    part.pictures.push_back(
        {picture_of_scene(scene),
         fmt::format("{} by {} side by side, seen by one camera", scene.name, fmt::join(pictured(part), ", ")),
         fmt::format("{}, one camera, true sizes; {}", scene.name,
                     scene.triangles.empty() ? "the line is the path of the last particle"
                                             : "coloured by the stretch of the structural springs")});
    if (fs::exists(motions_of_scene(scene))) part.motions = motions_of_scene(scene);
  }

  fs::path file_of(const Snapshot& s) const { return figures_ / (file_name_of(s.name) + ".png"); }

  /// Figures, and the pictures next to them.
  void draw_charts() {
    std::vector<Point> points;
    for (const Chart& chart : charts_) {
      if (const FigureInfo* words = figure_info(chart))
        points.push_back({"figure: " + words->name, words->name,
                          [this, &chart](Rows&) { draw_figure(chart, page_.provenance, figures_); }});
      for (const Snapshot& s : chart.snapshots)
        points.push_back(
            {"picture: " + s.name, content_of(request_, s.scene), [this, &s](Rows&) {
               std::deque<Result> answers;
               std::vector<const Result*> shown;
               for (const Snapshot::Panel& panel : s.panels) {
                 Recorder recorder;
                 Outcome out = run_method(find_method(panel.method), s.scene, panel.run, {&recorder});
                 answers.push_back({s.scene.name, panel.method, std::move(out), std::move(recorder.trajectory)});
                 shown.push_back(&answers.back());
               }
               write_picture(s.scene, shown, s.shot, file_of(s));
             }});
    }
    if (!points.empty()) compute(points);
  }

  void add(const Chart& chart) {
    Chapter::Entry entry{chart.heading, chart.text, {}, chart.tables};
    if (const FigureInfo* words = figure_info(chart)) {
      if (entry.heading.empty()) entry.heading = words->title;
      if (const fs::path file = figures_ / (words->name + ".svg"); fs::exists(file)) {
        entry.images.push_back({file, words->title + ". " + words->finding, words->finding + " " + words->caption});
        Tooltips& tooltips = entry.images.back().tooltips;
        if (const auto* figure = std::get_if<Figure>(&chart.figure)) tooltips.markers = tooltips_of(*figure);
        if (const auto* map = std::get_if<HeatMap>(&chart.figure)) tooltips.boxes = tooltips_of(*map);
        if (add_runs(words->runs)) entry.images.back().runs = words->runs;
      }
    }
    for (const Snapshot& s : chart.snapshots)
      if (fs::exists(file_of(s))) entry.images.push_back({file_of(s), s.caption, s.caption});
    if (chart.scene.empty() && chart.chapter.empty())
      page_.hero.insert(page_.hero.end(), entry.images.begin(), entry.images.end());
    for (Chapter& chapter : page_.chapters)
      if (chapter.id == chart.chapter) chapter.entries.push_back(entry);
    for (ScenePart& part : page_.scenes)
      if (part.scene->name == chart.scene)
        part.figures.insert(part.figures.end(), entry.images.begin(), entry.images.end());
  }

  const ReportOptions& options_;
  Request request_;  // of the scenes that have a part of their own
  std::vector<const Experiment*> experiments_;
  std::vector<Request> requests_;  // one per experiment, with its scenes
  OutputFolder& folder_;
  fs::path figures_;
  RunsFolder runs_;
  Store store_{store_in(folder_.path())};
  Rows rows_;
  AllFindings findings_;
  std::vector<Chart> charts_;
  PageContent page_;
};

/// Whether all findings of a report follow from its data.
int verify_command(const fs::path& folder) {
  recover_output(folder);
  const Verification found = verify_report(folder);
  for (const std::string& mismatch : found.mismatches) fmt::print("{}\n", mismatch);
  fmt::print(
      "{} findings recomputed from {} rows: {}\n", found.findings, found.rows,
      found.mismatches.empty() ? "all follow from the data" : fmt::format("{} mismatches", found.mismatches.size()));
  return found.mismatches.empty() ? 0 : 1;
}

}  // namespace

int report_command(const ReportOptions& options, OutputFolder& folder) {
  Request request;
  request.full = options.full;
  if (!options.methods.empty()) request.methods = find_methods(options.methods);
  request.scenes = scenes_for({}, options.scenes, options.full);
  for (const Scene& scene : request.scenes)
    require_resources_to_keep(methods_of(request, scene), scene, run_of(request, scene));
  request.scenes_only = !options.scenes.empty() && !options.full;
  if (!options.against.empty()) {
    changes_since(options.against, {});  // is it a report? Checked before the work
    if (fs::weakly_canonical(options.against) == fs::weakly_canonical(options.out))
      throw InputError("--against: expected another folder than that of --out, which is written anew");
  }
  return Builder(options, std::move(request), folder).build();
}

void add_report(CLI::App& app, Invocation& call) {
  struct Options : ReportOptions {
    fs::path verified;
  };
  const auto options = std::make_shared<Options>();
  auto* report = app.add_subcommand("report", "the main job: a page with findings, figures, pictures and data");
  report->add_option("SCENE", options->scenes, "default: those that stand for the others; all with --full");
  report->add_option("--methods", options->methods, "A,B,...");
  report->add_option("--out", options->out, "folder (out/report)");
  add_quick_and_full(*report, options->full);
  report->add_option("--against", options->against, "an earlier report: the page says what changed since");
  report->add_option("--verify", options->verified,
                     "DIR: recomputes every finding of the report in it from its data, no more");
  report->callback([options, &call] {
    options->command_line = call.line;
    if (!options->verified.empty()) {
      call.status = verify_command(options->verified);
    } else {
      OutputFolder folder(options->out, "report");
      call.status = report_command(*options, folder);
    }
  });
}

}  // namespace crosscheck
