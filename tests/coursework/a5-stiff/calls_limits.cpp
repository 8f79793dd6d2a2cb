// Calls of largest_stable_step.
//   limits.step: in: rule (index in the enum), then omega and gamma of each oscillator
//                out: two numbers for each oscillator: 0, 0 if no step is stable; 1 and the largest stable step; or
//                2, 0 if every step is stable
#include <cmath>

#include "calls.h"
#include "stiff.h"

namespace coursework {

bool answer_limits(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "limits.step") return false;
  const Rule rule = static_cast<Rule>(static_cast<int>(in[0]));
  for (std::size_t i = 1; i + 1 < in.size(); i += 2) {
    const double h = largest_stable_step(rule, in[i], in[i + 1]);
    const bool every = std::isinf(h) && h > 0;
    out.push_back(every ? 2 : h == 0 ? 0 : 1);
    out.push_back(every ? 0 : h);
  }
  return true;
}

}  // namespace coursework
