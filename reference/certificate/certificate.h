// The parity certificate verifies that an engine built the same scene. Each row contains a quantity's value in the
// scene, its mapping, the value read back, and the verdict.
#pragma once

#include <string>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck {

enum class Parity {
  match,          // equal within the engine's precision
  different_law,  // the engine models the ingredient by another law
  mismatch,       // the engine built another scene: no comparison
  unattested,     // the engine does not report the quantity
};
std::string_view name_of(Parity parity);

struct CertificateRow {
  std::string quantity, requested, mapped, read_back;
  Parity parity;
};

struct Certificate {
  std::string method, scene;
  std::vector<CertificateRow> rows;
  bool mismatch() const;
  bool fully_attested() const;
};

/// One line: the number of quantities read back, the mismatches, the number under another law, and those not attested.
std::string summary_of(const Certificate& certificate);

/// Compares the engine's read-back with the scene. Quantities that the engine does not report are marked as such in
/// their rows. Ingredients that the scene lacks, and whose absence the engine does not report, share a row.
Certificate certify(const std::string& method, const Scene& scene, const Outcome& outcome);

}  // namespace crosscheck
