// Runs experiments, draws figures and pictures, and writes data, report.json and the page.

#include <deque>

#include "experiments/sweep/sweep.h"
#include "mysim/base/names.h"
#include "reference/engines/engines.h"
#include "report/commands/command_line.h"
#include "report/commands/json_files.h"
#include "report/findings/findings_text.h"
#include "report/findings/verify.h"
#include "report/page/assemble.h"
#include "report/pictures/scene_picture.h"
#include "report/player/runs.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

/// Requested methods, in the order in which the picture of a scene tries them.
std::vector<std::string> methods_pictured(const Request& request, const Scene& scene) {
  std::vector<std::string> names, requested;
  for (const Method& m : methods_of(request, scene)) requested.push_back(m.name);
  for (const std::string& name : pictured_methods(scene))
    if (std::ranges::count(requested, name) > 0) names.push_back(name);
  names.insert(names.end(), requested.begin(), requested.end());
  return names;
}

std::vector<Point> picture_points(const Request& request, const fs::path& folder) {
  std::vector<Point> points;
  for (const Scene& scene : request.scenes)
    points.push_back({"picture: " + scene.name, content_of(request, scene), [&request, &scene, folder](TableSet&) {
                        RunsWriter(folder).keep_truth(scene, run_of(request, scene));
                        MethodResults results;
                        for (const std::string& name : methods_pictured(request, scene)) {
                          const MethodResult& r = result_of(request, scene, find_method(name), results);
                          if (r.outcome.verdict != Verdict::ok || r.trajectory.frames() == 0) continue;
                          draw_scene(scene, r, request.full, folder);
                          break;
                        }
                      }});
  return points;
}

std::string left_out(const Request& request) {
  if (request.scenes_only)
    return "this report covers the named scenes only: experiments with their own scenes (balls, known "
           "disagreements, the stiffness of links, the cost of a step) are in the report without names, and with "
           "--full";
  std::vector<std::string_view> names;
  for (const auto name : shipped_scenes())
    if (std::none_of(request.scenes.begin(), request.scenes.end(), [&](const Scene& s) { return s.name == name; }))
      names.push_back(name);
  return fmt::format(
      "this is the short report: {} have no card of their own, and each chapter uses "
      "representative scenes; --full has all scenes",
      fmt::join(names, ", "));
}

/// For --engines all: adds built engines, and prints how to build the others. By default, selects small
/// scenes, and rules that several engines share.
ReportOptions with_all_engines(ReportOptions options) {
  if (options.engines != "all") throw InputError(fmt::format("--engines {}: expected all", options.engines));
  if (options.methods.empty()) {
    options.methods = "leapfrog,symplectic-euler,rk4,implicit-euler,xpbd";
    for (const Method& method : builtin_methods())
      if (method.family().is_default_peer()) options.methods += "," + method.name;
  }
  if (options.scenes.empty()) options.scenes = {"chain", "cloth-small", "cloth-hang", "slide"};
  for (const OutsideEngine& engine : outside_engines())
    if (const fs::path program = kept_program(engine.name); fs::exists(program))
      options.methods += ",exec:" + program.string();
    else
      fmt::print(stderr, "crosscheck: without {}: {} builds it\n", engine.title, command_to_build(engine));
  return options;
}

/// Returns a function that computes points in separate processes.
Workers workers_of(const Store& store) {
  return [&store, patience = LockPatience()](const std::vector<Point>& points) {
    std::vector<std::string> problems;
    Progress progress(static_cast<int>(points.size()));
    for (const FailedPoint& f : run_points(points, {patience}, store, progress))
      problems.push_back(fmt::format("{}: {}", f.name, f.why));
    progress.done();
    return problems;
  };
}

ReportData data_of_runs(const ReportOptions& options, Request& request, const fs::path& folder, const Store& store,
                        const Workers& workers) {
  ReportData data;
  data.scenes = data.all = request.scenes;
  data.extent = options.full ? Extent::full : options.scenes.empty() ? Extent::quick : Extent::named;
  fs::create_directories(folder / "figures");
  RunsWriter runs(folder);
  request.on_runs = [&](const RecordedRuns& recorded) { runs.keep(recorded, run_of(request, recorded.scene)); };
  std::vector<const Experiment*> chosen;
  std::deque<Request> requests;
  for (const Experiment& e : experiments()) {
    const auto& named = options.experiments;
    if (!named.empty() && std::find(named.begin(), named.end(), e.name) == named.end()) continue;
    chosen.push_back(&e);
    requests.push_back(request);
    requests.back().scenes = scenes_for(e, options.scenes, options.full, options.methods);
    add_missing(data.all, requests.back().scenes);
  }
  data.provenance = with_scenes(provenance(options.command_line), data.all);
  PointList plan{{}, {}, data.provenance};
  std::vector<Point> points = picture_points(request, folder);  // the longest first
  const size_t pictures = points.size();
  for (size_t e = 0; e < requests.size(); ++e) {
    plan.experiments.emplace_back(chosen[e]->name);
    for (Point& point : chosen[e]->points(requests[e])) points.push_back(std::move(point));
  }
  for (size_t i = pictures; i < points.size(); ++i) plan.points.push_back({points[i].name, points[i].hash()});
  data.problems = workers(points);
  std::vector<std::string> missing;  // points without a result; they are already among the problems
  data.rows = joined(plan, {&store, 1}, missing);
  for (const Certificate& c : data.rows.certificates)
    if (c.mismatch())
      data.problems.push_back(fmt::format("{} on {}: it built another scene, see its certificate", c.method, c.scene));
  if (!data.rows.certificates.empty()) data.rows.tables.push_back(certificate_table(data.rows.certificates));
  if (!options.full) data.rows.notes.insert(data.rows.notes.begin(), left_out(request));
  for (const Scene& scene : data.all)
    for (const Method& method : request.methods)
      if (is_left_out(request, method, scene))
        data.rows.notes.push_back(
            fmt::format("{} is omitted on {}: {} particles would take too long; --methods "
                        "without --engines runs it",
                        program_title(method.name), scene.name, scene.model.particles.size()));
  data.runs = take_index(folder);
  write_tables(data.rows, data.provenance, folder / "data");
  for (const Scene& scene : data.scenes)
    write_file(folder / "data/scenes" / (file_name_of(scene.name) + ".toml"), scene.source);
  return data;
}

std::string weight_of_page(const WrittenReport& report) {
  std::vector<std::string> parts;
  double sum = 0;
  for (const auto& [name, count] : report.blocks) {
    const auto bytes = static_cast<double>(count);
    parts.push_back(fmt::format("{} {}", name, format_bytes(bytes)));
    sum += bytes;
  }
  return fmt::format("{} ({})", format_bytes(sum), fmt::join(parts, ", "));
}

int finish(ReportData& data, const ReportOptions& options, OutputFolder& folder, const Store& store,
           const Workers& workers) {
  const WrittenReport report = write_report(data, folder.path(), options.against, workers);
  store.clear();
  folder.finish();
  for (const std::string& problem : report.page.problems)
    fmt::print(stderr, "crosscheck: missing from the report: {}\n", problem);
  for (const Finding& f : report.page.findings) fmt::print("- {}\n", sentence_of(f));
  fmt::print("page: {}\n{}\n", weight_of_page(report), (options.out / "index.html").string());
  return report.page.problems.empty() && report.agree ? 0 : 1;
}

int remake_command(const fs::path& from, const ReportOptions& options) {
  ReportData data = read_report(from);
  const fs::path kept = fs::weakly_canonical(from);
  require_plain_files(path_inside(kept, "figures"));
  OutputFolder folder(options.out, "report");
  for (const char* part : {"data", "runs"})
    if (fs::exists(kept / part)) fs::copy(kept / part, folder.path() / part, fs::copy_options::recursive);
  for (const auto& file : fs::directory_iterator(kept / "figures"))
    if (file.path().extension() == ".png") {
      fs::create_directories(folder.path() / "figures");
      fs::copy(file.path(), folder.path() / "figures" / file.path().filename());
    }
  const Store store{store_in(folder.path())};
  return finish(data, options, folder, store, workers_of(store));
}

int verify_command(const fs::path& folder) {
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
  request.all_engines = !options.engines.empty();
  request.scenes = scenes_for({}, options.scenes, options.full, options.methods);
  for (const Scene& scene : request.scenes)
    require_resources_to_keep(methods_of(request, scene), scene, run_of(request, scene));
  request.scenes_only = !options.scenes.empty() && !options.full;
  if (!options.against.empty()) {
    changes_since(options.against, {});  // called early, because it throws if `against` is not a report
    if (fs::weakly_canonical(options.against) == fs::weakly_canonical(options.out))
      throw InputError("--against: expected a folder other than that of --out, which is overwritten");
  }
  const Store store{store_in(folder.path())};
  const Workers workers = workers_of(store);
  ReportData data = data_of_runs(options, request, folder.path(), store, workers);
  return finish(data, options, folder, store, workers);
}

namespace {

struct CalledReport : ReportOptions {
  fs::path verified, from;
};

int called_report(const CalledReport& options) {
  if (!options.verified.empty()) return verify_command(options.verified);
  if (!options.from.empty()) return remake_command(options.from, options);
  OutputFolder folder(options.out, "report");
  return report_command(options.engines.empty() ? ReportOptions(options) : with_all_engines(options), folder);
}

}  // namespace

void add_report(CLI::App& app, Invocation& call) {
  auto [report, options] =
      add_command(app, call, "report", "writes the comparison report: a page with findings, figures, pictures and data",
                  called_report);
  report.add_option("SCENE", options.scenes, "default: representative scenes; with --full all scenes");
  report.add_option("--methods", options.methods, "A,B,...");
  report.add_option("--engines", options.engines, "all: includes every engine that `engine NAME` has built");
  report.add_option("--out", options.out, "folder (out/report)");
  add_quick_and_full(report, options.full);
  report.add_option("--against", options.against, "an earlier report: the page lists the changes since then");
  report.add_option("--verify", options.verified,
                    "DIR: recomputes every finding of the report in DIR from its data, and writes nothing");
  report.add_option("--from", options.from,
                    "DIR: rebuilds the page of the report in DIR from its data, and runs nothing");
}

}  // namespace crosscheck
