// Asks questions side by side, each in a process of its own.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/regress/tolerance.h"
#include "experiments/sweep/sweep.h"

namespace crosscheck {

/// A question with the name that its answer is found under; tolerances take three more runs.
struct Asking {
  Question question;
  std::string name;
  bool with_tolerances = false;
};

struct AskedAnswers {
  std::map<std::string, std::vector<Toleranced>> answers;  // by name; tolerances are 0 where nobody asked for them
  std::vector<FailedPoint> failures;                       // questions without an answer: a crash
};

/// `out` is the folder for what is finished; `jobs` as in SweepOptions.
AskedAnswers ask(const std::vector<Asking>& all, const std::filesystem::path& out, int jobs, Progress& progress);

/// The one of that name, or null.
const Toleranced* find(const std::vector<Toleranced>& all, const std::string& name);

/// Without their tolerances.
std::vector<Quantity> quantities_in(const std::vector<Toleranced>& all);

}  // namespace crosscheck
