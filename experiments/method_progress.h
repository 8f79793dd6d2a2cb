// The progress of runs.
#pragma once

#include "mysim/progress.h"
#include "reference/method.h"

namespace crosscheck {

/// The method, each run of which is announced as a step of work and tells at its samples how far it has come. Its
/// answers are the same.
Method with_progress(const Method& method, Progress& progress);

}  // namespace crosscheck
