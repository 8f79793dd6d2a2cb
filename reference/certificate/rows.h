// Writes a certificate's rows.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reference/certificate/certificate.h"

namespace crosscheck {

/// The larger value; nan if either is nan, because every comparison with nan fails.
inline double max_or_nan(double a, double b) { return std::isnan(b) || b > a ? b : a; }

class CertificateWriter {
 public:
  /// The outcome needs a read-back.
  CertificateWriter(Certificate& certificate, const Outcome& outcome)
      : certificate_(certificate), outcome_(outcome), readback_(*outcome.readback) {}

  void row(const std::string& quantity, std::string requested, std::string read_back, Parity parity) {
    auto how = readback_.mapped.find(quantity);
    if (how == readback_.mapped.end() && quantity.ends_with("stiffness")) how = readback_.mapped.find("stiffness");
    if (how == readback_.mapped.end() && quantity == "wind") how = readback_.mapped.find("wind on triangles");
    certificate_.rows.push_back({quantity, std::move(requested),
                                 how == readback_.mapped.end() ? "unchanged" : how->second, std::move(read_back),
                                 parity});
  }
  void row(const std::string& quantity, std::string requested, std::string read_back, bool same) {
    row(quantity, std::move(requested), std::move(read_back), same ? Parity::match : Parity::mismatch);
  }
  void add_unattested(const std::string& quantity, std::string requested) {
    row(quantity, std::move(requested), "not reported", Parity::unattested);
  }
  /// Row for a quantity compared by its largest deviation, relative to its scale.
  void deviation(const std::string& quantity, std::string requested, double largest, double scale) {
    row(quantity, std::move(requested), fmt::format("largest deviation {:.2g}", scale > 0 ? largest / scale : largest),
        largest <= tolerance() * scale);
  }
  /// True if the engine itself declares a different law for the ingredient. Such a law has its own row.
  bool has_different_law(std::string_view ingredient) const {
    return std::any_of(outcome_.different_law.begin(), outcome_.different_law.end(), [&](const std::string& law) {
      return law.starts_with(ingredient) && law.substr(ingredient.size()).starts_with(": ");
    });
  }
  double step() const { return outcome_.step; }  // s
  /// Rounding error after a mapping and its inverse: some tens of ulps of the engine's precision.
  double tolerance() const { return readback_.precision == "single" ? 1e-5 : 1e-12; }

 private:
  Certificate& certificate_;
  const Outcome& outcome_;
  const Readback& readback_;
};

/// "200 N/m" or "75 to 300 N/m".
inline std::string range_of(double low, double high, const char* unit) {
  return low == high ? fmt::format("{:.6g} {}", low, unit) : fmt::format("{:.6g} to {:.6g} {}", low, high, unit);
}

void certify_springs(const Scene& scene, const Readback& r, CertificateWriter& w);
void certify_terms(const Scene& scene, const Readback& r, CertificateWriter& w);

}  // namespace crosscheck
