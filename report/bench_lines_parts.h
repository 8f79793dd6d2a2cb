// What the files of bench_lines share.
#pragma once

#include <fmt/format.h>

#include "experiments/cells.h"
#include "report/bench_lines.h"

namespace crosscheck {

inline BenchRatio ratio_at(const Table& table, size_t row, const char* column) {
  return {*number_at(table, row, column), *number_at(table, row, "ratio low"), *number_at(table, row, "ratio high")};
}

inline std::string nice_seconds(double seconds) {
  if (seconds >= 0.1) return fmt::format("{:.2f} s", seconds);
  if (seconds >= 1e-4) return fmt::format("{:.3g} ms", 1e3 * seconds);
  return fmt::format("{:.3g} µs", 1e6 * seconds);
}

/// "sheet-32x32-two-stiffnesses" as "32 × 32, two stiffnesses".
inline std::string size_text(const std::string& scene) {
  std::string text = scene.substr(scene.find('-') + 1);
  for (const auto& [from, to] : {std::pair{"x", " × "}, {"-", ", "}, {"-", " "}})
    if (const size_t at = text.find(from); at != std::string::npos) text.replace(at, 1, to);
  return text;
}

/// Lines from the tables of single steps: beside Bullet's, beside a factorisation, and on two threads.
void add_same_step(const Table& table, std::vector<BenchLine>& lines);
void add_implicit_steps(const Table& table, std::vector<BenchLine>& lines);
void add_threads(const Table& table, std::vector<BenchLine>& lines);

}  // namespace crosscheck
