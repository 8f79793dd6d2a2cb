// Calls of spectral_radius, factor and slower_from.
//   rate.radius       n, B (n x n), error (n)         the spectral radius
//   rate.factor       rho, then mu of each error      the factor of each error
//   rate.slower       lowest, highest eigenvalue      the result of slower_from for each pair
#include "calls_read.h"

namespace coursework {

bool answer_rate(const std::string& call, const Numbers& in, Numbers& out) {
  Reader reader(in);
  if (call == "rate.radius") {
    const std::size_t n = reader.count();
    const Numbers b = reader.numbers(n * n);
    out.push_back(spectral_radius(
        [&](const std::vector<double>& error) {
          calling("pass");
          if (error.size() != n) throw Unusable("pass_size", {error.size(), n});
          std::vector<double> after(n, 0.0);
          for (std::size_t i = 0; i < n * n; ++i) after[i / n] += b[i] * error[i % n];
          return after;
        },
        reader.numbers(n)));
  } else if (call == "rate.factor") {
    const double rho = reader.number();
    for (std::size_t left = in.size() - 1; left > 0; --left) out.push_back(factor(reader.number(), rho));
  } else if (call == "rate.slower") {
    for (std::size_t left = in.size() / 2; left > 0; --left) {
      const double lowest = reader.number();
      out.push_back(slower_from(lowest, reader.number()));
    }
  } else {
    return false;
  }
  return true;
}

}  // namespace coursework
