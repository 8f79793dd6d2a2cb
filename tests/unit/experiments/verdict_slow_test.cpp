// A fixed sample of the verdict trials. verdict_trials.cpp runs all trials; its output is in tests/data.

#include <filesystem>

#include "experiments/tables/table.h"
#include "tests/unit/experiments/verdict_trials.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr unsigned first_seed = 1, seeds = 540;

TEST(VerdictTrials, AFixedSampleIsJudgedRightly) {
  std::map<std::string, long> cells;
  long good = 0, bad = 0, condemned = 0, passed = 0;
  for (unsigned seed = first_seed; seed < first_seed + seeds; ++seed) {
    const auto t = tried(seed, false);
    if (!t) continue;
    ++cells[t->family];
    ++(t->within ? good : bad);
    const bool wrong = t->wrong(t->verdict);
    (t->within ? condemned : passed) += wrong;
    if (wrong)
      fmt::print("seed {}: {} on {}, {:.4g} of the limit: {}, stretch {:.3g}, speed {:.3g} of truth's\n", seed,
                 t->method, t->kind, t->share, name_of(t->verdict), t->stretch, t->speed);
  }
  for (const TrialFamily& family : trial_families()) EXPECT_GE(cells[std::string(family.name)], 10) << family.name;
  EXPECT_GE(good, 200);
  EXPECT_GE(bad, 40);
  // 0.5 %, plus one run to allow for sampling
  EXPECT_LE(static_cast<double>(condemned), 1 + 0.005 * static_cast<double>(good));
  // 1 %, plus one run to allow for sampling
  EXPECT_LE(static_cast<double>(passed), 1 + 0.01 * static_cast<double>(bad));
}

}  // namespace
}  // namespace crosscheck
