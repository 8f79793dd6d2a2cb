// Cases of the hunter as a sweep that has no end, and the files of its findings.
#include "report/commands/hunt.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>

#include "experiments/check/agreement.h"
#include "experiments/sweep/sweep.h"
#include "experiments/timing/machine.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/output_folder.h"
#include "mysim/base/text.h"
#include "report/base/provenance.h"
#include "report/pictures/scene_picture.h"

namespace crosscheck {

std::string draw_break(const std::vector<Method>& methods, const Scene& scene, std::optional<double> since,
                       const std::filesystem::path& file) {
  try {
    std::vector<MethodResult> results;
    for (const Method& method : methods) results.push_back(recorded_result(method, scene, run_for_relations(scene)));
    std::vector<const MethodResult*> shown;
    for (const MethodResult& result : results) shown.push_back(&result);
    Shot shot = usual_shot(scene, false);
    shot.at = since.value_or(-1);
    render::write_png(picture_of(scene, shown, shot), file);
    return "";
  } catch (const std::exception& error) {
    return error.what();
  }
}

namespace {

using Clock = std::chrono::steady_clock;

/// A group's files: NAME.toml, NAME.png, NAME.md.
std::string name_of_files(const HuntFindingRow& row) {
  return file_name_of(fmt::format("{}-{}-{}", row.relation, row.methods, row.kind));
}

/// The command that asks the scene's file for the same again.
std::string command_of(const HuntFindingRow& row, const HuntOptions& options, const std::string& file) {
  const std::vector<Method> methods = methods_named(row.methods, options.hunt.methods);
  std::string line = "crosscheck check";
  for (const Method& method : methods) line += " " + shell_quote(method.name);
  line += " " + file;
  if (methods.size() > 1) line += " --pairs";
  if (methods.size() == 1) line += fmt::format(" --seed {}", options.hunt.seed_of(row.index));
  if (!options.known_file.empty()) line += " --known " + shell_quote(options.known_file);
  return line;
}

/// The report text, as it may be sent to whoever makes the engine.
std::string report_text(const FindingGroup& group, const HuntOptions& options, const std::string& no_picture) {
  const HuntFindingRow& row = group.smallest;
  const Relation& relation = find_relation(row.relation);
  const std::string name = name_of_files(row);
  std::string text = fmt::format("# {}: {} is broken\n\n", row.methods, row.relation);
  text += fmt::format("**Expected:** {}. Allowed: {}.\n\n", relation.sentence, relation.allowed);
  text += fmt::format("**Seen:** {}.\n\n", row.sentence);
  text += fmt::format("**To see it again:** `{}`\n\n", command_of(row, options, name + ".toml"));
  if (no_picture.empty())
    text += fmt::format("![{} at {}]({}.png)\n\n", row.methods,
                        row.since ? fmt::format("{:.3g} s", *row.since) : "the end", name);
  else
    text += fmt::format("No picture could be made: {}.\n\n", no_picture);
  text += fmt::format("## The smallest scene ({} particle{}, {} spring{})\n\n```toml\n{}```\n\n", row.particles,
                      row.particles == 1 ? "" : "s", row.springs, row.springs == 1 ? "" : "s", row.scene);
  text += fmt::format(
      "Case {} of seed {}, drawn with {} particle{} and made smaller in {} trials; {} case{} of this hunt show{} the "
      "same relation broken on a scene of these ingredients.\n\n## Versions\n\n",
      row.index, options.hunt.seed, row.particles_drawn, row.particles_drawn == 1 ? "" : "s", row.trials, group.cases,
      group.cases == 1 ? "" : "s", group.cases == 1 ? "s" : "");
  for (const auto& [key, value] : provenance(options.command_line)) text += fmt::format("- {}: {}\n", key, value);
  return text;
}

// The plan of a hunt: its cases as a sweep's points, and what they have in common in its provenance.
constexpr auto plan_id = "hunt", plan_methods = "hunt methods", plan_seed = "hunt seed", plan_known = "hunt known";

PointList plan_of(const HuntOptions& options) {
  Provenance lines = provenance(options.command_line);
  std::string methods;
  for (const Method& method : options.hunt.methods) methods += (methods.empty() ? "" : ",") + method.name;
  // the first case's hash stands for the program, the methods, the list of known breaks and the seed
  lines.emplace_back(plan_id, point_of(options.hunt, 0).hash());
  lines.emplace_back(plan_methods, methods);
  lines.emplace_back(plan_seed, std::to_string(options.hunt.seed));
  lines.emplace_back(plan_known, options.known_file);
  return {{}, {}, lines};
}

/// Cases of the shard from the first that is not finished, until the time is over; those that are finished, in this run
/// or an earlier one, become points of the plan, which is kept beside them.
std::vector<FailedPoint> sweep(const HuntOptions& options, const Shard& shard, const Store& store,
                               ResumableOutput& folder, PointList& plan) {
  const int jobs = options.jobs > 0 ? options.jobs : cores_allowed();
  const auto end = Clock::now() + std::chrono::duration<double>(options.seconds);
  std::vector<FailedPoint> all_failed;
  const LockPatience patience;
  Progress progress(0);
  folder.announce({"plan.json"});
  for (long index = shard.index - 1; Clock::now() < end;) {
    std::vector<Point> batch;
    std::vector<PointList::Entry> cases;
    std::vector<std::string> files;
    for (; static_cast<int>(batch.size()) < jobs; index += shard.count) {
      Point point = point_of(options.hunt, index);
      cases.push_back({point.name, point.hash()});
      if (store.has(point.hash())) continue;
      for (const char* ending : {".json", ".failed"})
        files.push_back(fmt::format("{}/{}{}", store.folder().filename().string(), point.hash(), ending));
      batch.push_back(std::move(point));
    }
    folder.announce(files);
    progress.expect(static_cast<int>(batch.size()));
    const std::vector<FailedPoint> failed = run_points(batch, {patience, options.jobs}, store, progress);
    all_failed.insert(all_failed.end(), failed.begin(), failed.end());
    std::ranges::copy_if(cases, std::back_inserter(plan.points), [&](const auto& c) { return store.has(c.hash); });
    write_point_list(plan, options.out);
  }
  progress.done();
  return all_failed;
}

void print_group(const FindingGroup& group, const std::string& file) {
  const HuntFindingRow& row = group.smallest;
  const bool known = row.mark == RelationMark::known;
  fmt::print("{:<8} {:<17} {:<32} {:>4} case{} {}\n", name_of(row.mark), row.relation, row.methods, group.cases,
             group.cases == 1 ? " " : "s",
             known ? row.sentence : fmt::format("{} particles, {}", row.particles, row.kind));
  if (!known) fmt::print("         {}\n         {}\n", row.sentence, file);
}

/// Writes the tables and the files of each finding into a folder, whose files `announce` is told before, and prints
/// what was found. 0 where something was asked and nothing is broken.
int write_findings(const TableSet& tables, const HuntOptions& options, const std::filesystem::path& out,
                   const std::function<void(const std::vector<std::string>&)>& announce) {
  std::vector<HuntFindingRow> findings;
  HuntCaseRow sum;
  size_t cases = 0;
  if (!tables.tables.empty()) {
    findings = rows_of<HuntFindingRow>(*tables.table(std::string(HuntFindingRow::table)));
    for (const HuntCaseRow& c : rows_of<HuntCaseRow>(*tables.table(std::string(HuntCaseRow::table)))) {
      ++cases;
      sum.holds += c.holds, sum.broken += c.broken, sum.known += c.known, sum.not_asked += c.not_asked;
    }
  }
  const Provenance lines = provenance(options.command_line);
  for (const Table& table : tables.tables) {
    announce({table.name + ".csv"});
    write_csv(table, lines, out);
  }
  for (const FindingGroup& group : grouped(findings)) {
    const std::string name = name_of_files(group.smallest);
    if (group.smallest.mark == RelationMark::broken) {
      announce({name + ".toml", name + ".png", name + ".md"});
      write_file(out / (name + ".toml"), group.smallest.scene);
      const std::vector<Method> methods = methods_named(group.smallest.methods, options.hunt.methods);
      const bool unasked = options.received && std::ranges::any_of(methods, [](const Method& method) {
                             return method.name.starts_with(program_prefix);
                           });
      const std::string no_picture = unasked
                                         ? "the joined parts named a program, not you: it is not run"
                                         : draw_break(methods, parse_scene(group.smallest.scene, group.smallest.kind),
                                                      group.smallest.since, out / (name + ".png"));
      write_file(out / (name + ".md"), report_text(group, options, no_picture));
    }
    print_group(group, (options.out / (name + ".md")).string());
  }
  fmt::print("\n{} cases of seed {}: {} answers hold, {} are broken, {} are known, {} cannot be asked\n{}\n", cases,
             options.hunt.seed, sum.holds, sum.broken, sum.known, sum.not_asked, options.out.string());
  return sum.broken == 0 && sum.holds + sum.known > 0 ? 0 : 1;
}

}  // namespace

int hunt_command(const HuntOptions& options) {
  const Shard shard = options.shard.empty() ? Shard{} : shard_from(options.shard);
  ResumableOutput folder(options.out, "hunt");
  const Store store(store_in(options.out));
  folder.keep(store.folder().filename().string());
  PointList plan = plan_of(options);
  const std::vector<FailedPoint> failed = sweep(options, shard, store, folder, plan);
  std::vector<std::string> missing;
  const int status = write_findings(joined(plan, {&store, 1}, missing), options, options.out,
                                    [&](const auto& files) { folder.announce(files); });
  folder.finish();
  for (const FailedPoint& f : failed) fmt::print(stderr, "crosscheck: {}: {}\n", f.name, f.why);
  return failed.empty() ? status : 1;
}

bool is_hunt(const PointList& plan) { return !value_of(plan.provenance, plan_id).empty(); }

int merge_hunts(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& out,
                const std::string& command_line) {
  PointList plan = read_point_list(folders.at(0));
  const std::string id = value_of(plan.provenance, plan_id);
  std::vector<Store> stores;
  std::map<long, PointList::Entry> cases;  // each once, in the order of their numbers
  for (const auto& folder : folders) {
    const PointList part = read_point_list(folder);
    if (value_of(part.provenance, plan_id) != id)
      throw InputError(
          fmt::format("{}: expected cases of the hunt in {}: the same methods, known breaks, seed and program",
                      (folder / "plan.json").string(), folders[0].string()));
    for (const PointList::Entry& c : part.points) cases.emplace(std::stol(c.name.substr(c.name.find(' ') + 1)), c);
    stores.emplace_back(store_in(folder));
  }
  plan.points.clear();
  for (const auto& [index, entry] : cases) plan.points.push_back(entry);
  std::vector<std::string> missing;
  const TableSet tables = joined(plan, stores, missing);
  if (!missing.empty())
    throw InputError(fmt::format("{}: expected what its plan.json names, {} of {} cases are missing, the first is {}",
                                 folders[0].string(), missing.size(), plan.points.size(), missing[0]));
  HuntOptions options;
  options.hunt.methods = find_methods(value_of(plan.provenance, plan_methods));
  options.hunt.seed = static_cast<unsigned>(std::stoul(value_of(plan.provenance, plan_seed)));
  options.known_file = value_of(plan.provenance, plan_known);
  options.out = out, options.command_line = command_line, options.received = true;
  OutputFolder folder(out, "merge");
  const int status = write_findings(tables, options, folder.path(), [](const auto&) {});
  folder.finish();
  return status;
}

}  // namespace crosscheck
