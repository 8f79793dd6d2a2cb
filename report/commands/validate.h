// validate: what scenes are, without running them.
#pragma once

#include <string>
#include <vector>

namespace crosscheck {

/// Checks every scene and prints what it is: particles, springs by family, pins, the fastest vibration, the critical
/// time step of each explicit rule, what its default run will take. Faults are told one line each on standard error; 2
/// where there was one, 0 otherwise.
int validate_command(const std::vector<std::string>& scenes, bool json);

}  // namespace crosscheck
