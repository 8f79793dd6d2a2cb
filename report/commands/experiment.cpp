#include "experiments/experiment.h"
#include "experiments/disagreements/upstream.h"
#include "experiments/sweep/sweep.h"
#include "report/commands/command_line.h"
#include "report/commands/json_files.h"

namespace crosscheck {
namespace {

struct ExperimentOptions {
  std::vector<std::string> names;
  std::string methods;
  bool full = false, resume = false;
  std::string shard;  // I/N; empty: all
  int jobs = 0;       // 0: one per core
  std::filesystem::path out = "out/experiment";
  std::string command_line;
};

struct MergeOptions {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path out;
  std::string command_line;
};

/// Names of the tables' files, and of the texts for upstream (experiment `disagreements`).
std::vector<std::string> files_of(const TableSet& rows, const std::vector<UpstreamText>& texts) {
  std::vector<std::string> files{"dictionary.csv"};
  for (const Table& table : rows.tables) files.push_back(table.name + ".csv");
  for (const Certificate& c : rows.certificates) files.push_back(file_of(c));
  for (const UpstreamText& text : texts) files.push_back(text.file);
  return files;
}

/// Writes files into `folder`. Prints the paths that these files will finally have in `out`.
void write_and_print(const TableSet& rows, const std::vector<UpstreamText>& texts, const Provenance& lines,
                     const std::filesystem::path& folder, const std::filesystem::path& out) {
  write_tables(rows, lines, folder);
  for (const Table& table : rows.tables)
    fmt::print("{}  {} rows\n", (out / (table.name + ".csv")).string(), table.rows.size());
  for (const UpstreamText& text : texts) {
    write_file(folder / text.file, text.text);
    fmt::print("{}\n", (out / text.file).string());
  }
  for (const std::string& note : rows.notes) fmt::print("note: {}\n", note);
}

/// A resumed sweep keeps its earlier results.
void announce(ResumableOutput& folder, const PointList& plan, const Store& store, const ExperimentOptions& options) {
  const std::string points = store.folder().filename().string();
  std::vector<std::string> files{"plan.json"};
  for (const PointList::Entry& point : plan.points)
    for (const char* ending : {".json", ".failed"}) files.push_back(fmt::format("{}/{}{}", points, point.hash, ending));
  if (options.resume) folder.keep(points);
  folder.announce(files);
  if (!options.resume)
    for (const std::string& file : files) std::filesystem::remove(options.out / file);
}

int experiment_command(const ExperimentOptions& options) {
  std::vector<const Experiment*> chosen;
  std::vector<std::string> scenes, names;
  Request request;
  request.full = options.full;
  if (!options.methods.empty()) request.methods = find_methods(options.methods);
  for (const std::string& name : options.names) {
    if (const Experiment* found = experiment_named(name)) {
      chosen.push_back(found), names.emplace_back(found->name);
    } else if (!chosen.empty()) {
      scenes.push_back(name);
    } else {
      for (const std::string& other : options.names)
        if (const Experiment* experiment = experiment_named(other))
          throw InputError(
              fmt::format("experiment: '{0}' is not an experiment; did you mean `crosscheck experiment {1} {0}`?", name,
                          experiment->name));
      find_experiment(name);  // throws InputError unless the first word is an experiment
    }
  }
  SweepOptions sweep{LockPatience(), options.jobs, options.shard.empty() ? Shard{} : shard_from(options.shard)};
  std::vector<Point> points;
  std::vector<Scene> looked_at;
  for (const Experiment* experiment : chosen) {
    request.scenes = scenes_for(*experiment, scenes, options.full, options.methods);
    for (const Scene& scene : request.scenes)
      require_resources_to_keep(methods_of(request, scene), scene, run_of(request, scene));
    add_missing(looked_at, request.scenes);
    for (Point& point : experiment->points(request)) points.push_back(std::move(point));
  }
  ResumableOutput folder(options.out, "experiment");
  const Store store(store_in(options.out));
  const PointList plan = point_list_of(names, points, with_scenes(provenance(options.command_line), looked_at));
  announce(folder, plan, store, options);
  write_point_list(plan, options.out);

  Progress progress(static_cast<int>(points.size()));
  const std::vector<FailedPoint> failed = run_points(points, sweep, store, progress);
  progress.done();
  for (const FailedPoint& f : failed) fmt::print(stderr, "crosscheck: {}: {}\n", f.name, f.why);
  if (sweep.shard.count > 1) {
    fmt::print("part {} of {} points is in {}; join the parts with: crosscheck merge DIR... --out DIR\n", options.shard,
               points.size(), store.folder().string());
    folder.finish();
    return failed.empty() ? 0 : 1;
  }
  std::vector<std::string> missing;
  const TableSet rows = joined(plan, {&store, 1}, missing);
  const std::vector<UpstreamText> texts = upstream_texts(rows, value_of(plan.provenance, "engines"));
  folder.announce(files_of(rows, texts));
  write_and_print(rows, texts, plan.provenance, options.out, options.out);
  folder.finish();
  for (const std::string& name : missing) fmt::print(stderr, "crosscheck: missing in the tables: {}\n", name);
  const bool any = std::ranges::any_of(rows.tables, [](const Table& table) { return !table.rows.empty(); });
  if (!any) fmt::print(stderr, "crosscheck: nothing was measured: no method has a row on these scenes\n");
  return any && failed.empty() && missing.empty() ? 0 : 1;
}

int merge_command(const MergeOptions& options) {
  const PointList plan = read_point_list(options.folders.at(0));
  std::vector<Store> stores;
  for (const auto& folder : options.folders) {
    if (read_point_list(folder).points != plan.points)
      throw InputError(fmt::format("{}: expected the points of {}: the same command, scenes and program",
                                   (folder / "plan.json").string(), options.folders[0].string()));
    stores.emplace_back(store_in(folder));
  }
  std::vector<std::string> missing;
  const TableSet rows = joined(plan, stores, missing);
  if (!missing.empty()) {
    for (const std::string& name : missing) fmt::print(stderr, "crosscheck: missing: {}\n", name);
    fmt::print(stderr, "crosscheck: {} of {} points are missing; nothing is written\n", missing.size(),
               plan.points.size());
    return 1;
  }
  OutputFolder folder(options.out, "merge");
  write_and_print(rows, upstream_texts(rows, value_of(plan.provenance, "engines")), plan.provenance, folder.path(),
                  options.out);
  folder.finish();
  return 0;
}

}  // namespace

void add_experiment(CLI::App& app, Invocation& call) {
  auto [experiment, options] =
      add_command(app, call, "experiment", "runs experiments and writes their tables", experiment_command);
  experiment
      .add_option("NAME", options.names,
                  "experiments, then scenes (default: representative scenes; with --full all of them)")
      ->required();
  experiment.add_option("--methods", options.methods, "methods to run: A,B,...");
  experiment.add_option("--out", options.out, "folder (out/experiment)");
  experiment.add_option("--shard", options.shard, "I/N: computes part I of N; `merge` joins the parts");
  experiment.add_flag("--resume", options.resume, "keeps the results of an earlier run that was stopped");
  experiment.add_option("--jobs", options.jobs, "number of processes at a time (default: one per core)")
      ->check(CLI::Range(1, 256));
  add_quick_and_full(experiment, options.full);
}

void add_merge(CLI::App& app, Invocation& call) {
  auto [merge, options] = add_command(app, call, "merge", "joins the shards of an experiment", merge_command);
  merge.add_option("DIR", options.folders, "output folders of `experiment --shard`")->required();
  merge.add_option("--out", options.out, "folder")->required();
}

}  // namespace crosscheck
