// What tests of the bench share.
#pragma once

#include "experiments/bench/microbenchmarks.h"
#include "mysim/base/errors.h"
#include "tests/unit/helpers.h"

namespace crosscheck::testing_tools {

inline const MicrobenchmarkOptions hasty{3, 1e-4};

/// Left out where the suite was built without Google Benchmark.
class MicrobenchmarkTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      run_microbenchmarks({{"nothing", [] {}}}, {1, 1e-6}, LockPatience(0));
    } catch (const Unsupported& why) {
      GTEST_SKIP() << why.what();
    }
  }
};

}  // namespace crosscheck::testing_tools
