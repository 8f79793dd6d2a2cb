// Programs that only some tests require. A test whose program is missing is skipped with the name of the missing
// package.
#pragma once

#include <gtest/gtest.h>

#include "mysim/base/process.h"
#include "reference/method.h"
#include "reference/truth/independent/integrators.h"
#include "reference/truth/truth.h"
#include "tests/unit/helpers.h"

// Skips a test if Debian's `package` is not installed. Call it first. `not_tried` says what remains untested.
#define NEEDS_PROGRAM(program, package, not_tried) \
  if (!crosscheck::on_path(program)) GTEST_SKIP() << "package " package " is not installed: " not_tried
#define NEEDS_CHROMIUM NEEDS_PROGRAM("chromium", "chromium", "the page is not tested in a browser")
#define NEEDS_SUNDIALS                 \
  if (!crosscheck::sundials_version()) \
  GTEST_SKIP() << "package libsundials-dev was not installed when this was built: its integrators are not tested"

namespace crosscheck::testing_tools {

/// Trajectory and outcome of a method given by name.
struct MethodRun {
  Trajectory trajectory;
  Outcome outcome;
};
inline MethodRun run_and_record(const std::string& method, const Scene& scene, const Run& run) {
  Recorder r;
  MethodRun a{{}, run_method(find_method(method), scene, run, {&r})};
  a.trajectory = r.trajectory;
  return a;
}

}  // namespace crosscheck::testing_tools
