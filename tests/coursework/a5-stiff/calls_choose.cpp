// Calls of predicted_step and measured_step.
//   choose.predicted: rule (index in the enum), then omega, duration, tolerance of each run     the step of each run
//   choose.measured: order p, h, tolerance, n, y (n), c (n); the run ends at y + c h^p          the step
#include <cmath>

#include "calls.h"
#include "stiff.h"

namespace coursework {

bool answer_choose(const std::string& call, const Numbers& in, Numbers& out) {
  if (call == "choose.predicted") {
    const Rule rule = static_cast<Rule>(static_cast<int>(in[0]));
    for (std::size_t i = 1; i + 2 < in.size(); i += 3) out.push_back(predicted_step(rule, in[i], in[i + 1], in[i + 2]));
    return true;
  }
  if (call != "choose.measured") return false;
  const int order = static_cast<int>(in[0]);
  const std::size_t n = static_cast<std::size_t>(in[3]);
  auto run = [&](double h) {
    Vector end(n);
    for (std::size_t i = 0; i < n; ++i) end[i] = in[4 + i] + in[4 + n + i] * std::pow(h, order);
    return end;
  };
  out.push_back(measured_step(run, order, in[1], in[2]));
  return true;
}

}  // namespace coursework
