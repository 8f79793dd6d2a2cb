// What is known of a failed question beyond its numbers: both runs over time, and where they part.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/regress/regress.h"

namespace crosscheck {

using Series = std::vector<std::pair<double, double>>;  // over time, s

struct Evidence {
  Question question;
  std::vector<Compared> rows;                    // of the question, those that failed first
  Series was, is;                                // RMS distance of the particles from where they started, m
  bool was_at_samples = false;                   // of the old run the whole curve is known, not a few points of it
  Series apart, tolerance;                       // how far the two differ, and what they may, m
  std::optional<double> first_part;              // s: the first time at which they part by more than the tolerance
  std::optional<Answer> old_answer, new_answer;  // for pictures; of a baseline the scene's own method only
};

/// Runs the question again, with --against under both methods. Everything may be empty: a refused run has no curve.
Evidence evidence_of(const Question& question, const std::vector<Compared>& rows, const Regression& regression);

/// The failed questions that are worth a picture, at most `most`: of each scene one first, its own method before
/// others, of scenes as they are before those without an ingredient, then those that are off most.
std::vector<Question> worth_a_picture(const std::vector<Question>& all, const std::vector<Compared>& rows, int most);

}  // namespace crosscheck
