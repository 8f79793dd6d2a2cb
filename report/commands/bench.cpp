// bench: speed, as ratios against the peers, in one run.
#include <fmt/format.h>

#include "experiments/bench/bench.h"
#include "experiments/scenes.h"
#include "mysim/files.h"
#include "mysim/output_folder.h"
#include "reference/independent/integrators.h"
#include "report/charts/bench.h"
#include "report/commands/commands.h"
#include "report/provenance.h"
#include "report/tables_json.h"

namespace crosscheck {
namespace {

/// Who compiled what is timed, and how.
Provenance builds() {
  Provenance lines{
      {"build of mysim", CROSSCHECK_COMPILER "; the sweep once for each of x86-64, x86-64-v3 and x86-64-v4, -O3"},
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
  fmt::print("{:<48} {:>22} {:>22}\n", "their CPU time over mysim's (90 % interval)", instructions, "SSE2 alone");
  std::string group;
  for (const BenchLine& line : lines) {
    if (line.group != group) fmt::print("\n{}\n", line.group);
    group = line.group;
    fmt::print("  {:<46} {:>22} {:>22}  {}\n", line.label, text_of(line.best), text_of(line.plain),
               line.remark.empty() ? line.detail : line.remark);
  }
}

}  // namespace

int bench_command(const BenchOptions& options) { return bench_command(options, bench_plan(options.full)); }

int bench_command(const BenchOptions& options, const BenchPlan& plan) {
  OutputFolder folder(options.out, "bench");
  const Rows rows = bench(plan);
  std::vector<Scene> scenes = load_scenes(plan.scenes);
  for (const BenchPlan::Sheet& asked : plan.sheets) scenes.push_back(asked.scene());
  for (const int side : plan.threads.sides) scenes.push_back(sheet(side));
  scenes.push_back(sheet(plan.same_step.side));
  scenes.push_back(sheet_of_two_stiffnesses(plan.same_step.side));
  Provenance lines = with_scenes(provenance(options.command_line), scenes);
  for (auto& line : builds()) lines.push_back(std::move(line));
  const std::string instructions = best_instructions(rows);
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

}  // namespace crosscheck
