// Which program is running.
#pragma once

#include <string>

namespace crosscheck {

/// The linker's fingerprint of the running program's content, in hexadecimal digits; empty where it has none.
std::string build_id();

}  // namespace crosscheck
