#include "report/bench_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/cells.h"
#include "report/bench_lines_parts.h"
#include "report/facts.h"

namespace crosscheck {
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
                                  text_at(table, i, "mysim").substr(6));
    }
    if (!number_at(table, i, "ratio")) continue;
    (text_at(table, i, "path of mysim") == "best" ? lines.back().best : lines.back().plain) =
        ratio_at(table, i, "ratio");
  }
  for (size_t i = begin; i < lines.size(); ++i)
    for (size_t j = begin; j < lines.size(); ++j)
      if (subject[i - begin] == subject[j - begin] && lines[j].best &&
          (!lines[i].best || lines[j].best->ratio < lines[i].best->ratio))
        lines[i].chief = false;
}

}  // namespace

std::string best_instructions(const Rows& rows) {
  for (const char* name : {"bench-same-step-cost", "bench-equal-error-cost"})
    if (const Table* table = rows.table(name))
      for (size_t i = 0; i < table->rows.size(); ++i)
        if (text_at(*table, i, "path of mysim") == "best") return text_at(*table, i, "instructions");
  return plainest;
}

std::vector<BenchLine> bench_lines(const Rows& rows) {
  std::vector<BenchLine> lines;
  const std::string best = best_instructions(rows);
  if (const Table* table = rows.table("bench-kernels-cost")) add_kernels(*table, best, lines);
  if (const Table* table = rows.table("bench-scenes-cost")) add_scenes(*table, best, lines);
  if (const Table* table = rows.table("bench-equal-error-cost")) add_equal_error(*table, lines);
  if (const Table* table = rows.table("bench-same-step-cost")) add_same_step(*table, lines);
  if (const Table* table = rows.table("bench-implicit-step-cost")) add_implicit_steps(*table, lines);
  if (const Table* table = rows.table("bench-threads-cost")) add_threads(*table, lines);
  return lines;
}

}  // namespace crosscheck
