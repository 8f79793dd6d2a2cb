// A supervised program that says after an interruption how to continue.
#pragma once

#include <functional>
#include <string>

namespace crosscheck {

/// run_supervised() of this_process.h. If a signal ends the work, `when_interrupted` is reported on standard error
/// unless it is empty.
int run_supervised(const std::function<int()>& work, const std::string& when_interrupted);

}  // namespace crosscheck
