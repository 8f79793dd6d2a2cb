// Lines of the bench about single steps.
#include "report/bench_lines_parts.h"

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

}  // namespace crosscheck
