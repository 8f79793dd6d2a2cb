// What programs that we start find in their environment.
#pragma once

#include <string>
#include <vector>

namespace crosscheck {

/// The entries "NAME=value" for a program that we start, whatever it is: those of this program, but a locale that
/// exists everywhere (C.UTF-8: letters in UTF-8, points in numbers, English messages) and the time zone UTC, so that
/// what it writes does not depend on whose terminal or job it was started from. `extra` wins over both.
std::vector<std::string> program_environment(const std::vector<std::string>& extra = {});

}  // namespace crosscheck
