// Files of this room that the program reads while it runs: the figures' style, the page's style sheet.
#pragma once

#include <string>

namespace crosscheck {

/// Content of a file in report/. Throws std::runtime_error that names it.
std::string asset(const std::string& name);

}  // namespace crosscheck
