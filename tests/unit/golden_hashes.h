// Hashes of the state after 1000 steps of every shipped scene, for every rule with identical results on every machine
// (has_same_bits_everywhere), stored in reference/baselines/golden-hashes.csv.
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "mysim/base/files.h"
#include "mysim/base/text.h"
#include "tests/unit/helpers.h"

namespace crosscheck::testing_tools {

using GoldenHashes = std::map<std::pair<std::string, std::string>, std::string>;  // by scene and rule

inline std::filesystem::path golden_hash_file() { return CROSSCHECK_SOURCE "/reference/baselines/golden-hashes.csv"; }

inline GoldenHashes golden_hashes() {
  GoldenHashes table;
  std::istringstream lines(read_file(golden_hash_file(), "the table of golden hashes"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#') || line.starts_with("scene")) continue;
    const std::vector<std::string> words = split(line, ',');
    table[{words.at(0), words.at(1)}] = words.at(2);
  }
  return table;
}

inline constexpr int golden_steps = 1000;
/// Duration (s) of at least golden_steps steps, and a multiple of the sampling interval.
inline double golden_duration(const Scene& scene) {
  const double interval = scene.duration / scene.samples;
  return std::max(scene.duration, std::ceil(golden_steps * scene.step / interval) * interval);
}

}  // namespace crosscheck::testing_tools
