// What some tests need and the suite does not: where it is missing they are skipped, and say which package would help.
#pragma once

#include <gtest/gtest.h>

#include "reference/independent/integrators.h"
#include "report/run_program.h"

// At the head of a test: skips it, with what is not tried then, where Debian's package is not there.
#define NEEDS_PROGRAM(program, package, not_tried) \
  if (!crosscheck::on_path(program)) GTEST_SKIP() << "package " package " is not installed: " not_tried
#define NEEDS_FFMPEG NEEDS_PROGRAM("ffmpeg", "ffmpeg", "no clip is written and looked at")
#define NEEDS_CHROMIUM NEEDS_PROGRAM("chromium", "chromium", "the page is not tried in a browser")
#define NEEDS_SUNDIALS                 \
  if (!crosscheck::sundials_version()) \
  GTEST_SKIP() << "package libsundials-dev was not installed when this was built: its integrators are not tried"
