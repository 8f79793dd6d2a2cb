// What tests of the bench share.
#pragma once

#include "experiments/bench/microbenchmarks.h"
#include "experiments/tables/table.h"
#include "mysim/base/errors.h"
#include "tests/unit/helpers.h"

namespace crosscheck::testing_tools {

inline const MicrobenchmarkOptions hasty{3, 1e-4};

/// Every number of the table that is there is finite.
inline void expect_finite(const Table& table) {
  for (const auto& row : table.rows)
    for (size_t i = 0; i < row.size(); ++i)
      if (const auto* number = std::get_if<double>(&row[i])) {
        EXPECT_TRUE(std::isfinite(*number)) << table.name << ": " << table.columns[i].name;
      }
}

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
