#include "report/commands/bench.h"

#include "experiments/bench/bench.h"
#include "experiments/tables/bench.h"
#include "reference/engines/engines.h"
#include "reference/truth/independent/integrators.h"
#include "report/commands/command_line.h"
#include "report/commands/json_files.h"
#include "report/findings/report_data.h"

namespace crosscheck {
namespace {

std::string best_instructions() { return std::string(name_of(simd::active_instruction_set())); }

/// "32 × 32, two stiffnesses" for "sheet-32x32-two-stiffnesses".
std::string size_text(const std::string& scene) {
  std::string text = scene.substr(scene.find('-') + 1);
  for (const auto& [from, to] : {std::pair{"x", " × "}, {"-", ", "}, {"-", " "}})
    if (const size_t at = text.find(from); at != std::string::npos) text.replace(at, 1, to);
  return text;
}

std::string detail_of(const BenchRow& row) {
  if (!row.ratio) return row.remark;
  std::string text = fmt::format("{} : {} per {}", step_text(*row.peer_time), step_text(*row.time), row.unit);
  if (row.work == bench_work::same_error) text += ", " + short_name(row.mysim);
  if (row.apart) text += fmt::format(", {:.1g} m apart", *row.apart);
  if (row.share)
    text += fmt::format(", {:.0f} % of {}", 100 * *row.share,
                        row.work == bench_work::two_threads ? "two cores" : "the peak rate");
  return text;
}

BenchLine line_of(const BenchRow& row) {
  BenchLine line{row.work, row.scene, row.peer == naive_loop_name ? row.mysim : without_folders(row.peer)};
  line.label = line.subject;
  if (row.work == bench_work::springs_of_scene) line.label = fmt::format("{}: {}", row.scene, row.mysim);
  if (row.work == bench_work::same_error)
    line.label += row.error ? fmt::format(" to {} m", nice(*row.error)) : fmt::format(": {}", name_of(row.verdict));
  if (!row.variant.empty()) line.label += ", " + row.variant, line.subject += ", " + row.variant;
  return line;
}

/// Considers only the last line of each shipped scene.
void keep_least_scene(std::vector<BenchLine>& lines) {
  std::map<std::string, BenchLine> scenes;
  for (const BenchLine& line : lines)
    if (line.work == bench_work::springs_of_scene) scenes.insert_or_assign(line.scene, line);
  std::erase_if(lines, [](const BenchLine& line) { return line.work == bench_work::springs_of_scene; });
  if (scenes.empty()) return;
  const auto ratio = [](const auto& entry) { return entry.second.best->median; };
  BenchLine least = std::ranges::min_element(scenes, {}, ratio)->second;
  least.detail +=
      fmt::format("; slower on {} of {} scenes",
                  std::ranges::count_if(scenes, [&](const auto& s) { return ratio(s) < 1; }), scenes.size());
  lines.push_back(std::move(least));
}

void choose_representatives(std::vector<BenchLine>& lines) {
  std::vector<std::string> cloths;
  for (const BenchLine& line : lines)
    if (line.work == bench_work::springs && std::ranges::count(cloths, line.scene) == 0) cloths.push_back(line.scene);
  for (BenchLine& line : lines) {
    // omit the plain loop, which is not a peer, and runs of two threads, whose times are not CPU times
    line.representative = line.best && line.work != bench_work::two_threads && !line.subject.starts_with("plain loop");
    if (line.work == bench_work::springs) line.representative &= line.scene == cloths[cloths.size() / 2];
    for (const BenchLine& other : lines)
      if (line.work == bench_work::same_error && line.heading() == other.heading() && line.subject == other.subject &&
          other.best && line.best && other.best->median < line.best->median)
        line.representative = false;
  }
}

}  // namespace

std::string BenchLine::heading() const {
  return work == bench_work::springs_of_scene ? work : fmt::format("{}, {}", work, size_text(scene));
}

std::vector<BenchLine> bench_lines(const std::vector<BenchRow>& rows) {
  std::vector<BenchLine> lines;
  const simd::InstructionSet best = simd::active_instruction_set();
  for (const BenchRow& row : rows) {
    if (row.mysim.starts_with(naive_loop_name)) continue;
    const BenchLine made = line_of(row);
    auto line = std::ranges::find_if(lines, [&](const BenchLine& other) {
      return other.work == made.work && other.scene == made.scene && other.label == made.label;
    });
    if (line == lines.end()) line = lines.insert(lines.end(), made);
    if (row.instructions == best || line->detail.empty()) line->detail = detail_of(row);
    if (!row.ratio) continue;
    const Timing ratio{*row.ratio, *row.ratio_low, *row.ratio_high};
    if (row.instructions == best || !line->best) line->best = ratio;
    if (row.instructions == simd::InstructionSet::baseline) line->baseline = ratio;
  }
  keep_least_scene(lines);
  choose_representatives(lines);
  return lines;
}

DotPlot bench_figure(const std::vector<BenchLine>& lines, const std::string& commit) {
  DotPlot f;
  f.name = "bench-ratios";
  f.title = "CPU time relative to mysim";
  f.label = "CPU time / CPU time of mysim";
  f.from_costs = true;
  f.series = {{fmt::format("mysim with {}", best_instructions()), {"#0072B2", "1", 7}, {}},
              {"mysim with baseline instructions", {"#D55E00", "1", 6}, {}}};
  const auto dot_of = [](const std::optional<Timing>& ratio) {
    return ratio ? std::optional(DotPlot::Dot{ratio->median, ratio->low, ratio->high}) : std::nullopt;
  };
  std::string heading;
  const BenchLine* least = nullptr;
  for (const BenchLine& line : lines) {
    if (!line.representative) continue;
    if (line.heading() != heading) f.headings.emplace_back(f.names.size(), line.heading());
    heading = line.heading();
    f.names.push_back(line.label);
    f.series[0].dots.push_back(dot_of(line.best));
    f.series[1].dots.push_back(dot_of(line.baseline));
    if (!least || line.best->median < least->best->median) least = &line;
  }
  if (least)
    f.finding =
        fmt::format("mysim gains least on {} ({}): {:.2g} times.", least->label, least->heading(), least->best->median);
  f.caption = fmt::format(
      "CPU time of one core, medians and 90 % intervals of ratios, round by round; for each peer its best run; "
      "commit {}.",
      commit);
  return f;
}

namespace {

Provenance build_lines() {
  Provenance lines{
      {"build of mysim", CROSSCHECK_COMPILER "; the fused step once for each of x86-64, x86-64-v3 and x86-64-v4, -O3"},
      {"build of Bullet", CROSSCHECK_BULLET_VERSION " (double), Debian's library: generic x86-64, -O2"},
      {"build of odeint", odeint_version() + ", headers compiled in this build: " CROSSCHECK_COMPILER}};
  if (const auto version = sundials_version())
    lines.emplace_back("build of SUNDIALS", *version + ", Debian's library: generic x86-64, -O2");
  return lines;
}

std::string text_of(const std::optional<Timing>& ratio) {
  if (!ratio) return "-";
  const int digits = ratio->median < 9.95 ? 2 : ratio->median < 99.5 ? 1 : 0;
  return fmt::format("{0:.{3}f} ({1:.{3}f} to {2:.{3}f})", ratio->median, ratio->low, ratio->high, digits);
}

void print(const std::vector<BenchLine>& lines) {
  fmt::print("{:<48} {:>22} {:>22}\n", "their CPU time over mysim's (90 % interval)", best_instructions(), "baseline");
  std::string heading;
  for (const BenchLine& line : lines) {
    if (line.heading() != heading) fmt::print("\n{}\n", line.heading());
    heading = line.heading();
    fmt::print("  {:<46} {:>22} {:>22}  {}\n", line.label, text_of(line.best), text_of(line.baseline), line.detail);
  }
}

}  // namespace

int bench_command(const BenchOptions& options, const BenchSuite& plan) {
  OutputFolder folder(options.out, "bench");
  const BenchResult result = bench(plan, LockPatience());
  std::vector<Scene> scenes = load_scenes(plan.scenes);
  for (const BenchSuite::PeerCloth& cloth : plan.cloths) scenes.push_back(cloth.scene());
  for (const int side : plan.threads.sides) scenes.push_back(hanging_cloth(side));
  scenes.push_back(hanging_cloth(plan.same_step.side));
  scenes.push_back(hanging_cloth_of_two_stiffnesses(plan.same_step.side));
  Provenance lines = with_scenes(provenance(options.command_line), scenes);
  for (auto& line : build_lines()) lines.push_back(std::move(line));
  lines.emplace_back("best instructions", best_instructions());

  Table table = table_of<BenchRow>();
  for (const BenchRow& row : result.rows) add(table, row);
  write_csv(table, lines, folder.path());
  TableSet tables;
  tables.add(table), tables.notes = result.notes;
  write_file(folder.path() / "bench.json", tables_json(tables, lines));
  const std::vector<BenchLine> found = bench_lines(result.rows);
  draw(drawing_of(bench_figure(found, value_of(lines, "commit"))), lines, folder.path());
  folder.finish();
  print(found);
  for (const std::string& note : result.notes) fmt::print("note: {}\n", note);
  fmt::print("\n{}\n", (options.out / "bench.json").string());
  return 0;
}

namespace {

int measure(const BenchOptions& options) {
  std::vector<std::string> beside;
  if (!options.methods.empty())
    for (const Method& method : find_methods(options.methods)) beside.push_back(method.name);
  return bench_command(options, bench_suite(options.full, beside));
}

}  // namespace

void add_bench(CLI::App& app, Invocation& call) {
  auto [bench, options] =
      add_command(app, call, "bench", "measures speed as ratios to other implementations, in one session", measure);
  bench.add_option("--out", options.out, "folder (out/bench)");
  bench.add_option("--methods", options.methods,
                   "A,B,...: further methods to compare with, on cloths of 16 and 32 particles a side");
  add_quick_and_full(bench, options.full);
}

}  // namespace crosscheck
