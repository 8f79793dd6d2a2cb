// What becomes of the energy that does not add up in a long run, in words that a finding and a figure share.
#pragma once

#include <string>

#include "experiments/cells.h"
#include "report/facts.h"

namespace crosscheck {

inline constexpr auto residual_bounded = "bounded", residual_none = "zero to round-off";

/// Of a row of table `energy` whose closure is claimed; of a run that failed, the word for its failure.
inline std::string residual_word(const Table& energy, size_t row) {
  const double worst = number_at(energy, row, "largest residual", 0),
               turned = number_at(energy, row, "energy turned over", 0),
               growth = number_at(energy, row, "growth of the residual", 0),
               last = number_at(energy, row, "residual", 0);
  if (const std::string& verdict = text_at(energy, row, "verdict"); verdict != "ok") return failure_word(verdict);
  // a hundred thousand roundings of the energies that are added up
  if (worst < 1e-11 * turned) return residual_none;
  if (worst > 0.3 * turned) return last < 0 ? "takes much of the energy" : "makes much energy";
  // half a decade more than in the first tenth: in proportion to time it is a whole one
  if (growth > 0.5) return last < 0 ? "drifts down" : "drifts up";
  return residual_bounded;
}
inline bool stays(const std::string& word) { return word == residual_bounded || word == residual_none; }

}  // namespace crosscheck
