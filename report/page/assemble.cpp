#include "report/page/assemble.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>

#include "experiments/scenes/scenes.h"
#include "experiments/tables/certificates.h"
#include "experiments/tables/dictionary.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "mysim/base/pattern.h"
#include "report/base/assets.h"
#include "report/base/provenance.h"
#include "report/figures/chart_json.h"
#include "report/findings/findings_text.h"
#include "report/page/lab_html.h"
#include "report/page/player_html.h"
#include "report/page/shown_runs.h"
#include "report/pictures/scene_picture.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view extents[] = {"quick", "named", "full"};  // in the order of Extent

}  // namespace

std::string_view name_of(Extent extent) { return extents[static_cast<int>(extent)]; }

Table certificate_table(const std::vector<Certificate>& certificates) {
  Table table = table_of<AttestedRow>();
  for (const Certificate& c : certificates)
    for (const CertificateRow& row : c.rows)
      crosscheck::add(
          table, AttestedRow{c.scene, c.method, row.quantity, row.requested, row.mapped, row.read_back, row.parity});
  return table;
}

namespace {

std::vector<Certificate> certificates_of(const TableSet& rows) {
  std::vector<Certificate> certificates;
  for (const AttestedRow& row : rows_of<AttestedRow>(rows)) {
    if (certificates.empty() || certificates.back().scene != row.scene || certificates.back().method != row.method)
      certificates.push_back({row.method, row.scene, {}});
    certificates.back().rows.push_back({row.quantity, row.requested, row.mapped, row.read_back, row.parity});
  }
  return certificates;
}

}  // namespace

ReportData read_report(const fs::path& folder) {
  const Verification found = verify_report(folder);
  // only the data must agree, because another version may phrase sentences differently
  if (found.of_data > 0)
    throw InputError(fmt::format("{}: its data differ from the report: {}", folder.string(), found.mismatches[0]));
  const JsonField report = JsonField::parse_file((folder / "report.json").string());
  ReportData data;
  for (const auto& [name, ignored] : report["scenes"].items())
    data.scenes.push_back(read_scene(folder / "data" / "scenes" / (file_name_of(name) + ".toml")));
  for (const JsonField& table : report["tables"].elements())
    data.rows.tables.push_back(with_declared_types(read_csv(folder / "data" / (table["name"].text() + ".csv"))));
  data.rows.certificates = certificates_of(data.rows);
  for (const JsonField& note : report["notes"].elements()) data.rows.notes.push_back(note.text());
  for (const JsonField& problem : report["problems"].elements()) data.problems.push_back(problem.text());
  for (const auto& [key, value] : report["provenance"].items()) data.provenance.emplace_back(key, value.text());
  const std::string extent = report["extent"].text();
  const auto at = std::ranges::find(extents, extent);
  if (at == std::end(extents)) throw InputError(fmt::format("{}: extent: unknown word '{}'", folder.string(), extent));
  data.extent = static_cast<Extent>(at - std::begin(extents));
  data.runs = report["runs"].json();
  if (const fs::path runs = path_inside(folder, "runs"); fs::exists(runs)) require_plain_files(runs);
  run_files(report["runs"], folder, true);
  data.received = true;
  data.all = data.scenes;
  if (data.extent != Extent::named)
    for (const Experiment& e : experiments()) add_missing(data.all, scenes_for(e, {}, data.extent == Extent::full));
  data.provenance = with_scenes(std::move(data.provenance), data.all);
  return data;
}

fs::path picture_file(const fs::path& folder, const Scene& scene, const char* which) {
  return folder / "figures" / (file_name_of(scene.name) + which + ".png");
}

namespace {

/// Removes titles and subtitles, which the page writes itself.
render::Picture without_letters(render::Picture picture) {
  for (auto& row : picture.rows)
    for (render::Panel& panel : row) panel.title.clear(), panel.subtitle.clear();
  return picture;
}

void write_bare(const Scene& scene, const std::vector<const MethodResult*>& shown, int width, int height, bool full,
                const fs::path& file) {
  Shot shot = usual_shot(scene, full);
  shot.mode = Mode::shaded, shot.width = width, shot.height = height;
  render::write_png(without_letters(picture_of(scene, shown, shot)), file);
}

}  // namespace

void draw_scene(const Scene& scene, const MethodResult& shown, bool full, const fs::path& folder) {
  write_bare(scene, {&shown}, 304, 171, full, picture_file(folder, scene, "-thumbnail"));
}

namespace {

/// Removes the commit from a caption, because the page names the commit only once.
std::string without_commit(std::string caption) {
  static const Pattern commit(
      "; commit [^ ;]*(, with uncommitted changes)?\\.| Commit [^ ;]*(, with uncommitted changes)?\\.");
  return commit.replaced_in(caption, caption.find("; commit") == std::string::npos ? "" : ".");
}

class Assembly {
 public:
  Assembly(ReportData& data, const fs::path& folder, const fs::path& against)
      : data_(data),
        folder_(folder),
        figures_(folder / "figures"),
        runs_(run_files(JsonField::parse(dump(data.runs), "runs"), folder, false)) {
    findings_ = all_findings(data.scenes, data.rows);
    page_.findings = findings_.overall;
    page_.notes = data.rows.notes, page_.problems = data.problems, page_.provenance = data.provenance;
    page_.chapters = chapters();
    page_.relations = rows_of<RelationRow>(data.rows);
    page_.figures = figures_;
    if (const Scene* main = main_scene(data.scenes, data.rows)) page_.main_scene = main->name;
    if (!against.empty()) {
      page_.against = against.string();
      page_.changes = changes_since(against, findings_);
    }
    for (size_t i = 0; i < data.scenes.size(); ++i) add_part(i);
    charts_ = all_charts(
        {data.scenes, findings_.facts, data.rows, value_of(data.provenance, "commit"), data.each_has_charts()});
  }

  WrittenReport write(const Workers& workers) {
    fs::create_directories(figures_);
    write_file(figures_ / "style.gp", asset("figures/style.gp"));
    // begin with the runs of the first screen, because the page may be too small for all runs
    for (const ScenePart* part : first_scenes(page_)) add_own_runs(*part);
    for (const ScenePart& part : page_.scenes) add_own_runs(part);
    for (const Chart& chart : charts_) add(chart);
    for (ScenePart& part : page_.scenes) add_shown_runs(part);
    draw(workers);
    page_.lab = lab_data(data_.scenes);
    write_file(folder_ / "report.json",
               report_json(page_, findings_, charts_, data_.rows, name_of(data_.extent), data_.runs));
    std::vector<std::pair<std::string, size_t>> blocks;
    write_file(folder_ / "index.html", page_html(page_, &blocks));
    bool agree = true;
    for (const SceneData& facts : findings_.facts)
      for (const MethodData& method : facts.methods) agree &= !same_rule_differs(facts, method);
    return {std::move(page_), std::move(blocks), agree};
  }

 private:
  void add_part(size_t i) {
    const Scene& scene = data_.scenes[i];
    page_.scenes.push_back({&scene, &findings_.facts[i], findings_.of_scenes[i], {}, {}, {}, {}, {}});
    ScenePart& part = page_.scenes.back();
    part.statistics = data_.rows.table(scene.name + "-statistics");
    part.take = recommended_run(scene.name, 0.01, data_.rows);
    for (const Certificate& c : data_.rows.certificates)
      if (c.scene == scene.name) part.certificates.push_back(&c);
    const auto given = [&](const char* which) {
      const fs::path file = picture_file(folder_, scene, which);
      return fs::exists(file) ? file : fs::path();
    };
    part.thumbnail = given("-thumbnail"), part.hero = given("-hero");
    part.motions = stage_of(scene, *part.facts, runs_);
  }

  std::vector<PageImage> images_of(const Snapshot& s) const {
    const auto file = [&](const std::string& name) { return figures_ / (file_name_of(name) + ".png"); };
    if (s.moments.empty()) return {{file(s.name), s.caption, s.caption}};
    std::vector<PageImage> images;
    for (const auto& [t, caption] : s.moments) {
      std::string moment = caption;
      if (const size_t line = moment.find('\n'); line != std::string::npos) moment.replace(line, 1, ", ");
      images.push_back(
          {file(fmt::format("{}-{}", s.name, images.size() + 1)), fmt::format("{}: {}", s.caption, moment), caption});
    }
    return images;
  }

  void draw(const Workers& workers) {
    std::vector<Point> points;
    for (const Chart& chart : charts_) {
      if (const FigureInfo* figure = figure_info(chart); figure && opens_a_chapter(page_, figure->name))
        points.push_back({"figure: " + figure->name, figure->name,
                          [this, &chart](TableSet&) { draw_figure(chart, page_.provenance, figures_); }});
      for (const Snapshot& s : chart.snapshots)
        if (std::ranges::any_of(images_of(s), [](const PageImage& image) { return !fs::exists(image.file); }))
          points.push_back({"picture: " + s.name, s.name, [this, &s](TableSet&) { draw_snapshot(s); }});
    }
    for (ScenePart& part : page_.scenes)
      if (is_first(part) && part.hero.empty() && !part.scene->triangles.empty()) {
        part.hero = picture_file(folder_, *part.scene, "-hero");
        points.push_back({"picture: " + part.scene->name + " by all", part.scene->name,
                          [this, &part](TableSet&) { draw_first(part); }});
      }
    for (const std::string& failed : points.empty() ? std::vector<std::string>() : workers(points))
      page_.problems.push_back(failed);
    for (ScenePart& part : page_.scenes)
      if (!fs::exists(part.hero)) part.hero.clear();
  }

  bool is_first(const ScenePart& part) const {
    const std::vector<const ScenePart*> first = first_scenes(page_);
    return std::ranges::find(first, &part) != first.end();
  }

  bool may_run(const std::string& method) const { return !data_.received || !method.starts_with(program_prefix); }

  /// Draws the truth of a scene, and the runs that the first screen shows, next to each other.
  void draw_first(const ScenePart& part) const {
    const Scene& scene = *part.scene;
    std::deque<MethodResult> results;
    for (const ShownRun& run : part.runs) {
      if (run.beside && may_run(run.method))
        results.push_back(recorded_result(find_method(run.method), scene, run.run));
    }
    if (const auto truth = truth_of(scene, default_run(scene)))
      results.push_back({scene.name, "truth", {}, truth->trajectory});
    std::vector<const MethodResult*> shown;
    for (const MethodResult& result : results) shown.push_back(&result);
    write_bare(scene, shown, 760, 276, data_.extent == Extent::full, part.hero);
  }

  void draw_snapshot(const Snapshot& s) const {
    std::deque<MethodResult> results;
    std::vector<const MethodResult*> shown;
    for (const Snapshot::Panel& panel : s.panels) {
      if (!may_run(panel.method))
        throw InputError(fmt::format("{} is not run, because a report's data name it, not you", panel.method));
      results.push_back(recorded_result(find_method(panel.method), s.scene, panel.run));
      shown.push_back(&results.back());
    }
    const std::vector<PageImage> images = images_of(s);
    if (s.moments.empty()) return render::write_png(picture_of(s.scene, shown, s.shot), images[0].file);
    // all moments share a camera, which fits the first one (the run has not yet diverged) and is moved back slightly
    std::vector<Shot> shots(s.moments.size(), s.shot);
    for (size_t i = 0; i < shots.size(); ++i) shots[i].at = s.moments[i].first;
    CommonView common = common_view(s.scene, shown, shots.front());
    common.view.eye += 0.08 * (common.view.eye - common.view.target);
    for (size_t i = 0; i < shots.size(); ++i)
      render::write_png(without_letters(picture_of(s.scene, shown, shots[i], common)), images[i].file);
  }

  /// Adds a set of runs, unless the page already has the set. Returns false if the set is empty.
  bool add_runs(const std::string& key, const std::string& only = "") {
    if (std::ranges::find(page_.runs, key, &PlayableRuns::key) != page_.runs.end()) return true;
    auto runs = key.empty() ? std::nullopt : runs_.take(key, only, page_.notes);
    if (!runs) return false;
    runs->stage = stage_of_map(key, data_.all, data_.extent == Extent::full);
    for (const ScenePart& part : page_.scenes)
      if (key.starts_with(part.scene->name + "-") && runs->files[0].scene == part.scene->name && !part.motions.empty())
        runs->scene = part.scene->name;
    if (runs->stage.empty() && runs->scene.empty()) return false;
    for (const RunFile& file : runs->files)
      if (file.method != "truth") add_once(page_.methods, file.method);
    page_.runs.push_back(std::move(*runs));
    return true;
  }

  void add(const Chart& chart) {
    Chapter::Entry entry{chart.chapter, chart.heading, chart.text, {}, {}, chart.tables};
    if (const FigureInfo* figure = figure_info(chart)) {
      if (entry.heading.empty()) entry.heading = figure->title;
      write_figure_data(chart, page_.provenance, figures_);
      page_.charts[figure->name] = chart_json(chart);
      for (const std::string& method : methods_in(chart)) add_once(page_.methods, method);
      entry.figures.push_back({figure->name, figure->title, figure->finding + " " + without_commit(figure->caption)});
      if (add_runs(figure->runs)) entry.figures.back().runs = figure->runs;
    }
    entry.shown = chart.shown;
    for (const Snapshot& s : chart.snapshots)
      for (PageImage& image : images_of(s)) entry.images.push_back(std::move(image));
    for (Chapter& chapter : page_.chapters)
      if (chapter.id == chart.chapter || std::ranges::find(chapter.joins, chart.chapter) != chapter.joins.end() ||
          (chart.chapter.empty() && chart.scene.empty() && chapter.id == "speed-accuracy"))
        chapter.entries.push_back(entry);
    for (ScenePart& part : page_.scenes)
      if (part.scene->name == chart.scene)
        part.figures.insert(part.figures.end(), entry.figures.begin(), entry.figures.end());
  }

  void add_own_runs(const ScenePart& part) {
    for (const char* set : {"-truth", "-engines"})
      if (!part.motions.empty()) add_runs(part.scene->name + set);
  }
  void add_shown_runs(ScenePart& part) {
    if (part.motions.empty()) return;
    const std::string marks = part.scene->name + "-speed-accuracy";
    if (part.take) add_runs(marks, part.take->method);
    part.runs = shown_runs(part, data_.rows, [&](const std::string& method) {
      const auto set = std::ranges::find(page_.runs, marks, &PlayableRuns::key);
      return set != page_.runs.end() && std::ranges::find(set->files, method, &RunFile::method) != set->files.end();
    });
  }

  ReportData& data_;
  fs::path folder_, figures_;
  PageRuns runs_;
  AllFindings findings_;
  std::vector<Chart> charts_;
  PageContent page_;
};

}  // namespace

WrittenReport write_report(ReportData& data, const fs::path& folder, const fs::path& against, const Workers& workers) {
  return Assembly(data, folder, against).write(workers);
}

}  // namespace crosscheck
