// Cases of the hunter as a sweep that has no end, and the files of its findings.
#include "report/commands/hunt.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "experiments/check/agreement.h"
#include "experiments/sweep/sweep.h"
#include "experiments/timing/machine.h"
#include "mysim/base/files.h"
#include "mysim/base/output_folder.h"
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
  for (const Method& method : methods) line += " " + method.name;
  line += " " + file;
  if (methods.size() > 1) line += " --pairs";
  if (methods.size() == 1) line += fmt::format(" --seed {}", options.hunt.seed_of(row.index));
  if (!options.known_file.empty()) line += " --known " + options.known_file;
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

struct Swept {
  std::vector<long> cases;  // that are finished, in this run or an earlier one
  std::vector<FailedPoint> failed;
};

/// Cases of the shard from the first that is not finished, until the time is over.
Swept sweep(const HuntOptions& options, const Shard& shard, const Store& store, ResumableOutput& folder) {
  const int jobs = options.jobs > 0 ? options.jobs : cores_allowed();
  const auto end = Clock::now() + std::chrono::duration<double>(options.seconds);
  Swept swept;
  Progress progress(0);
  for (long index = shard.index - 1; Clock::now() < end;) {
    std::vector<Point> batch;
    std::vector<long> cases;
    std::vector<std::string> files;
    for (; static_cast<int>(batch.size()) < jobs; index += shard.count) {
      Point point = point_of(options.hunt, index);
      cases.push_back(index);
      if (store.has(point.hash())) continue;
      for (const char* ending : {".json", ".failed"})
        files.push_back(fmt::format("{}/{}{}", store.folder().filename().string(), point.hash(), ending));
      batch.push_back(std::move(point));
    }
    folder.announce(files);
    progress.expect(static_cast<int>(batch.size()));
    const std::vector<FailedPoint> failed = run_points(batch, {options.jobs, {}}, store, progress);
    swept.cases.insert(swept.cases.end(), cases.begin(), cases.end());
    swept.failed.insert(swept.failed.end(), failed.begin(), failed.end());
  }
  progress.done();
  return swept;
}

void print_group(const FindingGroup& group, const std::string& file) {
  const HuntFindingRow& row = group.smallest;
  const bool known = row.mark == RelationMark::known;
  fmt::print("{:<8} {:<17} {:<32} {:>4} case{} {}\n", name_of(row.mark), row.relation, row.methods, group.cases,
             group.cases == 1 ? " " : "s",
             known ? row.sentence : fmt::format("{} particles, {}", row.particles, row.kind));
  if (!known) fmt::print("         {}\n         {}\n", row.sentence, file);
}

}  // namespace

int hunt_command(const HuntOptions& options) {
  const Shard shard = options.shard.empty() ? Shard{} : shard_from(options.shard);
  ResumableOutput folder(options.out, "hunt");
  const Store store(store_in(options.out));
  folder.keep(store.folder().filename().string());
  const Swept swept = sweep(options, shard, store, folder);

  TableSet tables;
  for (const long index : swept.cases)
    if (const auto found = store.find(point_of(options.hunt, index).hash())) tables.append(*found);
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
    folder.announce({table.name + ".csv"});
    write_csv(table, lines, options.out);
  }
  for (const FindingGroup& group : grouped(findings)) {
    const std::string name = name_of_files(group.smallest);
    const auto file = [&](const char* ending) { return options.out / (name + ending); };
    if (group.smallest.mark == RelationMark::broken) {
      folder.announce({name + ".toml", name + ".png", name + ".md"});
      write_file(file(".toml"), group.smallest.scene);
      const std::string no_picture =
          draw_break(methods_named(group.smallest.methods, options.hunt.methods),
                     parse_scene(group.smallest.scene, group.smallest.kind), group.smallest.since, file(".png"));
      write_file(file(".md"), report_text(group, options, no_picture));
    }
    print_group(group, file(".md").string());
  }
  folder.finish();
  for (const FailedPoint& f : swept.failed) fmt::print(stderr, "crosscheck: {}: {}\n", f.name, f.why);
  fmt::print("\n{} cases of seed {}: {} answers hold, {} are broken, {} are known, {} cannot be asked\n{}\n", cases,
             options.hunt.seed, sum.holds, sum.broken, sum.known, sum.not_asked, options.out.string());
  return sum.broken == 0 && swept.failed.empty() && sum.holds + sum.known > 0 ? 0 : 1;
}

}  // namespace crosscheck
