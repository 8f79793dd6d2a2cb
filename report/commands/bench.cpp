// bench: speed, as ratios to other implementations, in one run.
#include "report/commands/bench.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "experiments/bench/bench.h"
#include "experiments/scenes/scenes.h"
#include "experiments/tables/bench.h"
#include "mysim/base/files.h"
#include "mysim/base/output_folder.h"
#include "reference/truth/independent/integrators.h"
#include "report/base/provenance.h"
#include "report/commands/command_line.h"
#include "report/commands/commands.h"
#include "report/commands/json_files.h"
#include "report/findings/report_data.h"

namespace crosscheck {

namespace {

template <class Row>
BenchRatio ratio_of(const Row& row) {
  return {row.ratio, row.ratio_low, row.ratio_high};
}

/// True if a row is of mysim's baseline path; it is then added to the last line.
template <class Row>
bool is_second_path(const Row& row, std::vector<BenchLine>& lines) {
  if (row.path == "best") return false;
  lines.back().plain = ratio_of(row);
  return true;
}

void add_same_step(const TableSet& rows, std::vector<BenchLine>& lines) {
  for (const SameStepRow& row : rows_of<SameStepRow>(rows)) {
    if (is_second_path(row, lines)) continue;
    const bool own = row.force.starts_with("force class");
    BenchLine& line = lines.emplace_back();
    line.group =
        "the same step: Bullet's explicit world and symplectic-euler; springs by a force class of our own, or by "
        "Bullet's";
    line.heading = "the same step as Bullet";
    line.label = fmt::format("{}: {}", size_text(row.scene), own ? "own force class" : "Bullet's force");
    line.detail =
        fmt::format("{} : {}, {:.1g} m apart", nice_seconds(row.bullet_cpu), nice_seconds(row.cpu), row.apart);
    line.best = ratio_of(row);
  }
}

void add_implicit_steps(const TableSet& rows, std::vector<BenchLine>& lines) {
  for (const ImplicitStepRow& row : rows_of<ImplicitStepRow>(rows)) {
    if (is_second_path(row, lines)) continue;
    BenchLine& line = lines.emplace_back();
    const std::string size = size_text(row.scene);
    line.group = "a linear implicit Euler step: Eigen's SimplicialLDLT and implicit-euler+linear";
    line.heading = "implicit step, " + size;
    line.label = fmt::format("{}, {:g} steps a second", size, row.rate);
    line.detail = fmt::format("{} : {}, {:.1g} m apart", nice_seconds(row.eigen_cpu), nice_seconds(row.cpu), row.apart);
    line.best = ratio_of(row);
  }
}

void add_threads(const TableSet& rows, std::vector<BenchLine>& lines) {
  for (const ThreadsRow& row : rows_of<ThreadsRow>(rows)) {
    BenchLine& line = lines.emplace_back();
    line.group = "two threads beside one: leapfrog, time on the wall";
    line.heading = "two threads";
    line.label = size_text(row.scene);
    line.detail = fmt::format("{} : {}", nice_seconds(row.one), nice_seconds(row.two));
    if (row.threads > 1)
      line.detail += fmt::format(", with {:.0f} % of two cores", 100 * row.share);
    else
      line.label += ", too small for a second";
    line.best = ratio_of(row);
    line.wall = true;
  }
}

using simd::InstructionSet;
constexpr auto naive = "naive loop";
constexpr InstructionSet plainest = InstructionSet::baseline;

void add_kernels(const TableSet& all_rows, InstructionSet best, std::vector<BenchLine>& lines) {
  const std::vector<KernelRow> rows = rows_of<KernelRow>(all_rows);
  std::vector<long> sides;
  for (const KernelRow& row : rows)
    if (sides.empty() || sides.back() != row.side) sides.push_back(row.side);
  if (sides.empty()) return;
  const long side = sides[sides.size() / 2];
  std::vector<std::string> seen;
  for (const KernelRow& row : rows) {
    const std::string label = row.kernel + ", " + row.precision;
    if (row.side != side || row.kernel == naive || std::find(seen.begin(), seen.end(), label) != seen.end()) continue;
    seen.push_back(label);
    BenchLine line;
    line.group = fmt::format("springs of a sheet of {0} × {0}, beside the naive loop", side);
    line.heading = fmt::format("naive loop, {0} × {0}", side), line.label = label;
    const KernelRow* chosen = nullptr;
    for (const KernelRow& other : rows) {
      if (other.side != side || other.precision != row.precision) continue;
      // on the baseline the fastest fused step in double is the reproducible one
      const bool same =
          other.kernel == row.kernel || (row.kernel == "sweep, fastest" && row.precision == "double" &&
                                         other.kernel == "sweep, reproducible" && other.instructions == plainest);
      if (!same) continue;
      if (other.instructions == plainest) line.plain = ratio_of(other);
      if (other.instructions == best || (other.kernel == row.kernel && !chosen)) chosen = &other;
    }
    line.best = ratio_of(*chosen);
    line.detail = fmt::format("{:.2f} ns a spring", chosen->time);
    if (row.kernel.starts_with("sweep")) line.detail += fmt::format(", {:.0f} % of peak", 100 * chosen->share_of_peak);
    lines.push_back(std::move(line));
  }
}

/// The scene where the engine's own kernel (the fused step where there is one) gains least over the naive loop.
void add_scenes(const TableSet& all_rows, InstructionSet best, std::vector<BenchLine>& lines) {
  const std::vector<SceneKernelRow> rows = rows_of<SceneKernelRow>(all_rows);
  std::optional<BenchLine> least;
  int slower = 0, all = 0;
  for (size_t begin = 0, end = 0; begin < rows.size(); begin = end) {  // the rows of a scene
    const SceneKernelRow* chosen = nullptr;
    std::optional<BenchRatio> plain;
    for (; end < rows.size() && rows[end].scene == rows[begin].scene; ++end) {
      // the fused step's rows come after the general kernel's
      if (rows[end].instructions == best) chosen = &rows[end];
      if (rows[end].instructions == plainest) plain = ratio_of(rows[end]);
    }
    if (!chosen) continue;
    ++all, slower += chosen->ratio < 1;
    if (least && least->best->ratio <= chosen->ratio) continue;
    least.emplace();
    least->group = "the shipped scene where mysim's kernels gain least on the naive loop";
    least->label = fmt::format("{}, {} spring{}: {}", chosen->scene, chosen->springs, chosen->springs > 1 ? "s" : "",
                               chosen->kernel);
    least->heading = "naive loop, least of the scenes";
    least->detail = fmt::format("{} an evaluation", nice_seconds(1e-9 * chosen->time));
    least->best = ratio_of(*chosen), least->plain = plain;
  }
  if (!least) return;
  least->detail += fmt::format("; slower on {} of {} scenes", slower, all);
  lines.push_back(*least);
}

void add_equal_error(const TableSet& rows, std::vector<BenchLine>& lines) {
  const size_t begin = lines.size();
  std::vector<std::string> subject;  // scene and peer of each line
  for (const EqualErrorRow& row : rows_of<EqualErrorRow>(rows)) {
    if (row.path == "best") {
      BenchLine& line = lines.emplace_back();
      line.group = fmt::format("the same error on a sheet of {}, 1 s", size_text(row.scene));
      line.label = fmt::format("{} {}{}", row.peer,
                               row.error ? fmt::format("to {} m", nice(*row.error)) : std::string(name_of(row.verdict)),
                               row.model == PeerModel::same ? "" : ", other model");
      line.heading = "the same error, " + size_text(row.scene);
      line.remark = row.remark.value_or("");
      subject.push_back(row.scene + " " + row.peer);
      if (row.mysim_cpu)
        line.detail =
            fmt::format("{} : {} {}", nice_seconds(*row.cpu), nice_seconds(*row.mysim_cpu), short_name(*row.mysim));
    }
    if (!row.ratio) continue;
    (row.path == "best" ? lines.back().best : lines.back().plain) =
        BenchRatio{*row.ratio, *row.ratio_low, *row.ratio_high};
  }
  for (size_t i = begin; i < lines.size(); ++i)
    for (size_t j = begin; j < lines.size(); ++j)
      if (subject[i - begin] == subject[j - begin] && lines[j].best &&
          (!lines[i].best || lines[j].best->ratio < lines[i].best->ratio))
        lines[i].representative = false;
}

}  // namespace

static InstructionSet best_of(const TableSet& rows) {
  for (const SameStepRow& row : rows_of<SameStepRow>(rows))
    if (row.path == "best") return row.instructions;
  for (const EqualErrorRow& row : rows_of<EqualErrorRow>(rows))
    if (row.path == "best") return row.instructions;
  return plainest;
}

std::string best_instruction_set(const TableSet& rows) { return std::string(name_of(best_of(rows))); }

std::vector<BenchLine> bench_lines(const TableSet& rows) {
  std::vector<BenchLine> lines;
  const InstructionSet best = best_of(rows);
  add_kernels(rows, best, lines);
  add_scenes(rows, best, lines);
  add_equal_error(rows, lines);
  add_same_step(rows, lines);
  add_implicit_steps(rows, lines);
  add_threads(rows, lines);
  return lines;
}

namespace {

std::optional<DotPlot::Dot> dot_of(const std::optional<BenchRatio>& ratio) {
  if (!ratio) return std::nullopt;
  return DotPlot::Dot{ratio->ratio, ratio->low, ratio->high};
}

}  // namespace

DotPlot bench_figure(const std::vector<BenchLine>& lines, const std::string& instructions, const std::string& commit) {
  DotPlot f;
  f.name = "bench-ratios";
  f.title = "CPU time relative to mysim";
  f.label = "CPU time / CPU time of mysim";
  f.from_costs = true;
  f.series = {{fmt::format("mysim with {}", instructions), {"#0072B2", "1", 7}, {}},
              {"mysim with baseline instructions", {"#D55E00", "1", 6}, {}}};
  std::string heading;
  const BenchLine* least = nullptr;
  for (const BenchLine& line : lines) {
    // the plain loop is no peer, and wall times are not CPU times
    if (!line.representative || !line.best || line.wall || line.label.starts_with("plain loop")) continue;
    if (line.heading != heading) f.headings.emplace_back(f.names.size(), line.heading);
    heading = line.heading;
    f.names.push_back(line.label);
    f.series[0].dots.push_back(dot_of(line.best));
    f.series[1].dots.push_back(dot_of(line.plain));
    if (!least || line.best->ratio < least->best->ratio) least = &line;
  }
  if (least)
    f.finding =
        fmt::format("mysim gains least on {} ({}): {:.2g} times.", least->label, least->heading, least->best->ratio);
  f.caption = fmt::format(
      "CPU time of one core, medians and 90 % intervals of ratios taken round by round; of each peer the run where it "
      "does best; commit {}.",
      commit);
  return f;
}

namespace {

/// The builds of all programs that are timed.
Provenance build_lines() {
  Provenance lines{
      {"build of mysim", CROSSCHECK_COMPILER "; the fused step once for each of x86-64, x86-64-v3 and x86-64-v4, -O3"},
      {"build of Bullet", CROSSCHECK_BULLET_VERSION " (double), Debian's library: generic x86-64, -O2"},
      {"build of odeint", odeint_version() + ", headers compiled in this build: " CROSSCHECK_COMPILER}};
  if (const auto version = sundials_version())
    lines.emplace_back("build of SUNDIALS", *version + ", Debian's library: generic x86-64, -O2");
  return lines;
}

std::string text_of(const std::optional<BenchRatio>& ratio) {
  if (!ratio) return "-";
  const int digits = ratio->ratio < 9.95 ? 2 : ratio->ratio < 99.5 ? 1 : 0;
  return fmt::format("{0:.{3}f} ({1:.{3}f} to {2:.{3}f})", ratio->ratio, ratio->low, ratio->high, digits);
}

void print(const std::vector<BenchLine>& lines, const std::string& instructions) {
  fmt::print("{:<48} {:>22} {:>22}\n", "their CPU time over mysim's (90 % interval)", instructions, "baseline");
  std::string group;
  for (const BenchLine& line : lines) {
    if (line.group != group) fmt::print("\n{}\n", line.group);
    group = line.group;
    fmt::print("  {:<46} {:>22} {:>22}  {}\n", line.label, text_of(line.best), text_of(line.plain),
               line.remark.empty() ? line.detail : line.remark);
  }
}

}  // namespace

int bench_command(const BenchOptions& options, const BenchSuite& plan) {
  OutputFolder folder(options.out, "bench");
  const TableSet rows = bench(plan, LockPatience());
  std::vector<Scene> scenes = load_scenes(plan.scenes);
  for (const BenchSuite::PeerCloth& cloth : plan.cloths) scenes.push_back(cloth.scene());
  for (const int side : plan.threads.sides) scenes.push_back(hanging_cloth(side));
  scenes.push_back(hanging_cloth(plan.same_step.side));
  scenes.push_back(hanging_cloth_of_two_stiffnesses(plan.same_step.side));
  Provenance lines = with_scenes(provenance(options.command_line), scenes);
  for (auto& line : build_lines()) lines.push_back(std::move(line));
  const std::string instructions = best_instruction_set(rows);
  lines.emplace_back("best instructions", instructions);

  for (const Table& table : rows.tables) write_csv(table, lines, folder.path());
  write_file(folder.path() / "bench.json", tables_json(rows, lines));
  const std::vector<BenchLine> found = bench_lines(rows);
  draw(drawing_of(bench_figure(found, instructions, value_of(lines, "commit"))), lines, folder.path());
  folder.finish();
  print(found, instructions);
  for (const std::string& note : rows.notes) fmt::print("note: {}\n", note);
  fmt::print("\n{}\n", (options.out / "bench.json").string());
  return 0;
}

void add_bench(CLI::App& app, Invocation& call) {
  const auto options = std::make_shared<BenchOptions>();
  auto* bench = app.add_subcommand("bench", "measures speed as ratios to other implementations, in one run");
  bench->add_option("--out", options->out, "folder (out/bench)");
  bench->add_option(
      "--methods", options->methods,
      "A,B,...: methods to compare with as well, on cloths of 32 and 64 particles a side, with --full 128");
  add_quick_and_full(*bench, options->full);
  bench->callback([options, &call] {
    options->command_line = call.line;
    std::vector<std::string> beside;
    if (!options->methods.empty())
      for (const Method& method : find_methods(options->methods)) beside.push_back(method.name);
    call.status = bench_command(*options, bench_suite(options->full, beside));
  });
}

}  // namespace crosscheck
