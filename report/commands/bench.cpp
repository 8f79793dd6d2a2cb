// bench: speed, as ratios against the peers, in one run.
#include "report/commands/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/bench/bench.h"
#include "experiments/scenes/scenes.h"
#include "experiments/tables/table.h"
#include "mysim/base/files.h"
#include "mysim/base/output_folder.h"
#include "reference/truth/independent/integrators.h"
#include "report/base/provenance.h"
#include "report/commands/commands.h"
#include "report/commands/json_files.h"
#include "report/findings/report_data.h"

namespace crosscheck {

/// A row of the other path of mysim belongs to the last line.
static bool is_second_path(const Table& table, size_t row, std::vector<BenchLine>& lines) {
  if (text_at(table, row, "path of mysim") == "best") return false;
  lines.back().plain = ratio_at(table, row, "ratio");
  return true;
}

void add_same_step(const Table& table, std::vector<BenchLine>& lines) {
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (is_second_path(table, i, lines)) continue;
    const bool own = text_at(table, i, "force of Bullet").starts_with("force class");
    BenchLine& line = lines.emplace_back();
    line.group =
        "the same step: Bullet's explicit world and symplectic-euler; springs by a force class of our own, or by "
        "Bullet's";
    line.heading = "the same step as Bullet";
    line.label =
        fmt::format("{}: {}", size_text(text_at(table, i, "scene")), own ? "own force class" : "Bullet's force");
    line.detail = fmt::format("{} : {}, {:.1g} m apart", nice_seconds(*number_at(table, i, "cpu per step of Bullet")),
                              nice_seconds(*number_at(table, i, "cpu per step of mysim")),
                              *number_at(table, i, "farthest particle"));
    line.best = ratio_at(table, i, "ratio");
  }
}

void add_implicit_steps(const Table& table, std::vector<BenchLine>& lines) {
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (is_second_path(table, i, lines)) continue;
    BenchLine& line = lines.emplace_back();
    const std::string size = size_text(text_at(table, i, "scene"));
    line.group = "a linear implicit Euler step: Eigen's SimplicialLDLT and implicit-euler+linear";
    line.heading = "implicit step, " + size;
    line.label = fmt::format("{}, {:g} steps a second", size, *number_at(table, i, "rate"));
    line.detail = fmt::format("{} : {}, {:.1g} m apart", nice_seconds(*number_at(table, i, "cpu per step of Eigen")),
                              nice_seconds(*number_at(table, i, "cpu per step of mysim")),
                              *number_at(table, i, "farthest particle"));
    line.best = ratio_at(table, i, "ratio");
  }
}

void add_threads(const Table& table, std::vector<BenchLine>& lines) {
  for (size_t i = 0; i < table.rows.size(); ++i) {
    BenchLine& line = lines.emplace_back();
    line.group = "two threads beside one: leapfrog, time on the wall";
    line.heading = "two threads";
    line.label = size_text(text_at(table, i, "scene"));
    line.detail = fmt::format("{} : {}", nice_seconds(*number_at(table, i, "wall per step of one")),
                              nice_seconds(*number_at(table, i, "wall per step of two")));
    if (*number_at(table, i, "threads at work") > 1)
      line.detail += fmt::format(", with {:.0f} % of two cores", 100 * *number_at(table, i, "share of the cores"));
    else
      line.label += ", too small for a second";
    line.best = ratio_at(table, i, "ratio");
    line.wall = true;
  }
}

namespace {

constexpr auto naive = "naive loop", plainest = "sse2";

void add_kernels(const Table& table, const std::string& best, std::vector<BenchLine>& lines) {
  std::vector<double> sides;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (const double side = *number_at(table, i, "particles a side"); sides.empty() || sides.back() != side)
      sides.push_back(side);
  if (sides.empty()) return;
  const double side = sides[sides.size() / 2];
  std::vector<std::string> seen;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const std::string kernel = text_at(table, i, "kernel"), precision = text_at(table, i, "precision");
    const std::string label = kernel + ", " + precision;
    if (*number_at(table, i, "particles a side") != side || kernel == naive ||
        std::find(seen.begin(), seen.end(), label) != seen.end())
      continue;
    seen.push_back(label);
    BenchLine line;
    line.group = fmt::format("springs of a sheet of {0:.0f} × {0:.0f}, beside the naive loop", side);
    line.heading = fmt::format("naive loop, {0:.0f} × {0:.0f}", side), line.label = label;
    std::optional<size_t> chosen;
    for (size_t j = 0; j < table.rows.size(); ++j) {
      if (*number_at(table, j, "particles a side") != side || text_at(table, j, "precision") != precision) continue;
      const std::string &other = text_at(table, j, "kernel"), &instructions = text_at(table, j, "instructions");
      // with SSE2 the fastest double sweep is the reproducible one
      const bool same = other == kernel || (kernel == "sweep, fastest" && precision == "double" &&
                                            other == "sweep, reproducible" && instructions == plainest);
      if (!same) continue;
      if (instructions == plainest) line.plain = ratio_at(table, j, "times the naive loop");
      if (instructions == best || (other == kernel && !chosen)) chosen = j;
    }
    line.best = ratio_at(table, *chosen, "times the naive loop");
    line.detail = fmt::format("{:.2f} ns a spring", *number_at(table, *chosen, "time per spring"));
    if (kernel.starts_with("sweep"))
      line.detail += fmt::format(", {:.0f} % of peak", 100 * *number_at(table, *chosen, "share of peak"));
    lines.push_back(std::move(line));
  }
}

/// The scene where the engine's own way (the sweep where there is one) gains least over the naive loop.
void add_scenes(const Table& table, const std::string& best, std::vector<BenchLine>& lines) {
  std::optional<BenchLine> least;
  int slower = 0, all = 0;
  for (const std::string& scene : distinct(table, "scene")) {
    std::optional<size_t> chosen;
    std::optional<BenchRatio> plain;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "scene") != scene) continue;
      const std::string& instructions = text_at(table, i, "instructions");
      // the sweep's rows come after the general kernel's
      if (instructions == best) chosen = i;
      if (instructions == plainest) plain = ratio_at(table, i, "times the naive loop");
    }
    if (!chosen) continue;
    const BenchRatio ratio = ratio_at(table, *chosen, "times the naive loop");
    ++all, slower += ratio.ratio < 1;
    if (least && least->best->ratio <= ratio.ratio) continue;
    const double springs = *number_at(table, *chosen, "springs");
    least.emplace();
    least->group = "the shipped scene where mysim's kernels gain least on the naive loop";
    least->label =
        fmt::format("{}, {:g} spring{}: {}", scene, springs, springs > 1 ? "s" : "", text_at(table, *chosen, "kernel"));
    least->heading = "naive loop, least of the scenes";
    least->detail = fmt::format("{} an evaluation", nice_seconds(1e-9 * *number_at(table, *chosen, "time")));
    least->best = ratio, least->plain = plain;
  }
  if (!least) return;
  least->detail += fmt::format("; slower on {} of {} scenes", slower, all);
  lines.push_back(*least);
}

void add_equal_error(const Table& table, std::vector<BenchLine>& lines) {
  const size_t begin = lines.size();
  std::vector<std::string> subject;  // scene and peer of each line
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const std::string &scene = text_at(table, i, "scene"), &peer = text_at(table, i, "peer");
    if (text_at(table, i, "path of mysim") == "best") {
      const auto error = number_at(table, i, "error");
      BenchLine& line = lines.emplace_back();
      line.group = fmt::format("the same error on a sheet of {}, 1 s", size_text(scene));
      line.label =
          fmt::format("{} {}{}", peer, error ? fmt::format("to {} m", nice(*error)) : text_at(table, i, "verdict"),
                      text_at(table, i, "model") == "same" ? "" : ", other model");
      line.heading = "the same error, " + size_text(scene);
      line.remark = text_or_none(table, i, "remark");
      subject.push_back(scene + " " + peer);
      if (const auto own = number_at(table, i, "cpu of mysim"))
        line.detail = fmt::format("{} : {} {}", nice_seconds(*number_at(table, i, "cpu")), nice_seconds(*own),
                                  short_name(text_at(table, i, "mysim")));
    }
    if (!number_at(table, i, "ratio")) continue;
    (text_at(table, i, "path of mysim") == "best" ? lines.back().best : lines.back().plain) =
        ratio_at(table, i, "ratio");
  }
  for (size_t i = begin; i < lines.size(); ++i)
    for (size_t j = begin; j < lines.size(); ++j)
      if (subject[i - begin] == subject[j - begin] && lines[j].best &&
          (!lines[i].best || lines[j].best->ratio < lines[i].best->ratio))
        lines[i].representative = false;
}

}  // namespace

std::string best_instruction_set(const Rows& rows) {
  for (const char* name : {"bench-same-step-cost", "bench-equal-error-cost"})
    if (const Table* table = rows.table(name))
      for (size_t i = 0; i < table->rows.size(); ++i)
        if (text_at(*table, i, "path of mysim") == "best") return text_at(*table, i, "instructions");
  return plainest;
}

std::vector<BenchLine> bench_lines(const Rows& rows) {
  std::vector<BenchLine> lines;
  const std::string best = best_instruction_set(rows);
  if (const Table* table = rows.table("bench-kernels-cost")) add_kernels(*table, best, lines);
  if (const Table* table = rows.table("bench-scenes-cost")) add_scenes(*table, best, lines);
  if (const Table* table = rows.table("bench-equal-error-cost")) add_equal_error(*table, lines);
  if (const Table* table = rows.table("bench-same-step-cost")) add_same_step(*table, lines);
  if (const Table* table = rows.table("bench-implicit-step-cost")) add_implicit_steps(*table, lines);
  if (const Table* table = rows.table("bench-threads-cost")) add_threads(*table, lines);
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
  f.title = "CPU time of others over mysim's";
  f.label = "how many times mysim's time";
  f.from_costs = true;
  f.series = {{fmt::format("mysim with {}", instructions), {"#0072B2", "1", 7}, {}},
              {"mysim with SSE2 alone", {"#D55E00", "1", 6}, {}}};
  std::string heading;
  const BenchLine* least = nullptr;
  for (const BenchLine& line : lines) {
    // the plain loop is nothing that mysim runs, and the axis is one of CPU time
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

/// Who compiled what is timed, and how.
Provenance build_lines() {
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

int bench_command(const BenchOptions& options) { return bench_command(options, bench_suite(options.full)); }

int bench_command(const BenchOptions& options, const BenchSuite& plan) {
  OutputFolder folder(options.out, "bench");
  const Rows rows = bench(plan);
  std::vector<Scene> scenes = load_scenes(plan.scenes);
  for (const BenchSuite::PeerCloth& asked : plan.sheets) scenes.push_back(asked.scene());
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

}  // namespace crosscheck
