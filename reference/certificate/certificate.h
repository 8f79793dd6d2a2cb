// The parity certificate: was the same scene built? For each quantity the scene's value, as mapped, as read back, and
// the verdict.
#pragma once

#include <string>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck {

enum class Parity {
  match,          // read back as in the scene, within the engine's precision
  different_law,  // the ingredient is there under another law
  mismatch,       // another scene was built: no comparison
  unattested,     // the engine does not report it
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

/// One line: how many quantities were read back, and what does not match, has another law or is not attested.
std::string summary_of(const Certificate& certificate);

/// Compares what the engine read back with the scene. What the scene has and the engine does not report has a row
/// that says so; so has, in one row, what the scene does not have and the engine does not deny.
Certificate certify(const std::string& method, const Scene& scene, const Outcome& outcome);

}  // namespace crosscheck
