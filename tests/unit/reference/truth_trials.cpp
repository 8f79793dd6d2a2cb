// Trials of the error bars of converged truth, not part of the suite. `truth_trials FIRST COUNT` runs random exact
// scenes by seed, and prints a row for each and a summary. Exits with 1 if fewer than 99 % of the errors are covered or
// if, for errors above ten times round-off, the bars exceed 5 times the error in the median or 20 times at the 95th
// percentile.
#include "tests/unit/reference/truth_trials.h"

#include <cstdio>
#include <cstdlib>

using namespace crosscheck;
using namespace crosscheck::testing_tools;

int main(int count_of_arguments, char** arguments) {
  const auto number = [&](int at, unsigned otherwise) {
    return at < count_of_arguments ? static_cast<unsigned>(std::strtoul(arguments[at], nullptr, 10)) : otherwise;
  };
  const unsigned first = number(1, 0), count = number(2, 200);
  std::vector<BarTrial> trials;
  fmt::print("scene,bar [m],error [m],round-off [m],ratio\n");
  for (unsigned seed = first; seed < first + count; ++seed) {
    const BarTrial t = bar_trial(random_exact_scene(seed));
    if (t.known)
      fmt::print("{},{:.3g},{:.3g},{:.3g},{:.3g}\n", t.scene, t.error_bar, t.error, t.round_off, t.ratio());
    else
      fmt::print("{},,,,\n", t.scene);
    std::fflush(stdout);
    trials.push_back(t);
  }
  const BarSummary s = summary_of(trials);
  fmt::print("# {}\n", text_of(s));
  return static_cast<double>(s.covered) >= 0.99 * static_cast<double>(s.scenes) && s.median <= 5 && s.high <= 20 ? 0
                                                                                                                 : 1;
}
