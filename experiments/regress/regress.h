// Regression: asks, and sets the answers beside baselines or beside another method's.
#pragma once

#include <filesystem>
#include <map>

#include "experiments/regress/questions.h"
#include "experiments/regress/verdicts.h"
#include "experiments/sweep/sweep.h"

namespace crosscheck {

struct Regression {
  Asked asked;
  std::optional<Method> against;    // instead of baselines; then exactly one method is asked
  std::filesystem::path baselines;  // folder
  std::filesystem::path out;        // folder, for what is finished
  int jobs = 0;                     // as SweepOptions
};

struct Regressed {
  std::vector<Compared> rows;         // in the order of the questions; failures of files stand first
  std::vector<FailedPoint> failures;  // questions without an answer: a crash
  bool passed() const;
};

/// Asks all questions and compares. What a baseline expects and nobody asks (dear rows in a quick run, other methods)
/// is left alone; a row that is asked and has no baseline, or one of another scene, fails.
Regressed regress(const Regression& regression, Progress& progress);

struct Blessed {
  std::vector<Compared> changed;                                     // before and after
  std::vector<std::pair<std::filesystem::path, std::string>> files;  // to be written, with their text
  std::map<std::string, int> numbers;                                // of the blessing in each changed scene's baseline
};
/// Asks with tolerances; what moved, is new or is gone stands in the new baselines under this blessing, rows that are
/// the same keep theirs. Nothing is written yet. Throws InputError where a file cannot be read, where a part of a stale
/// one is asked for (the rest would stay stale), and where a question has no answer.
Blessed bless(const Regression& regression, const Blessing& blessing, Progress& progress);

}  // namespace crosscheck
