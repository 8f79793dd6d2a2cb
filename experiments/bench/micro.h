// Small pieces of work timed side by side, with Google Benchmark underneath: it chooses how often each is repeated and
// takes their repetitions in random order, so that a slow spell of the machine falls on all.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace crosscheck {

struct Micro {
  std::string name;
  std::function<void()> once;
};

struct MicroPlan {
  int repetitions = 9;
  double seconds = 0.05;  // of each repetition
};

/// CPU time of one run of each, s, one for each repetition; by name. Names must differ.
std::map<std::string, std::vector<double>> measured(const std::vector<Micro>& all, const MicroPlan& plan);

}  // namespace crosscheck
