// The answers of all engines to all questions.
#pragma once

#include <array>

#include "experiments/tables/typed.h"

namespace crosscheck {

enum class EngineQuestion {
  build,
  rule,
  order,
  damping_of_spring,
  damping_of_chain,
  damping_by_forces,
  invariants,
  friction,
  largest_step,
  cost,
  empty_step
};
inline std::string_view name_of(EngineQuestion question) {
  constexpr std::array<std::string_view, 11> names = {"engine",
                                                      "rule",
                                                      "order",
                                                      "damping of a spring",
                                                      "damping of a chain",
                                                      "damping, springs as forces",
                                                      "invariants",
                                                      "sticks or slides",
                                                      "largest step",
                                                      "cost of 1 %",
                                                      "empty step"};
  return names[static_cast<size_t>(question)];
}
template <>
inline constexpr std::pair range_of<EngineQuestion>{EngineQuestion::build, EngineQuestion::empty_step};

/// One cell: a number with its error bar and tier, or a refusal.
template <bool timed>
struct MatrixRow {
  TABLE(timed ? "matrix-cost" : "matrix");
  COLUMN(std::string, method, "method", "1", "method that the answer is for");
  COLUMN(EngineQuestion, question, "question", "1", "question");
  COLUMN(OptionalNumber, value, "value", "unit", "the answer, if it is a number");
  COLUMN(OptionalNumber, bar, "bar", "unit", "error bar of the value");
  COLUMN(std::string, unit, "unit", "1", "unit of value and bar");
  COLUMN(std::string, tier, "tier", "1", "reference that the answer is compared with");
  COLUMN(std::string, words, "words", "1", "the answer in words, or the reason if there is none");
};

}  // namespace crosscheck
