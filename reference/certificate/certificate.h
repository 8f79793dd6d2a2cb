// The parity certificate verifies that an engine built the same scene. For each quantity it holds the scene's value,
// how it was mapped, the value read back, and the verdict.
#pragma once

#include <string>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck {

enum class Parity {
  match,          // equals the scene's value within the engine's precision
  different_law,  // the ingredient is modelled by another law
  mismatch,       // a different scene was built: no comparison
  unattested,     // not reported by the engine
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
  bool fully_attested() const;  // no row is Parity::unattested
};

/// One line: how many quantities were read back, and which do not match, follow another law or are not attested.
std::string summary_of(const Certificate& certificate);

/// Compares the engine's read-back with the scene. Quantities of the scene that the engine does not report have a row
/// that says so. Ingredients that the scene lacks and the engine does not deny share a single row.
Certificate certify(const std::string& method, const Scene& scene, const Outcome& outcome);

}  // namespace crosscheck
