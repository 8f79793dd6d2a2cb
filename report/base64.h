// Bytes inside text.
#pragma once

#include <string>

namespace crosscheck {

/// RFC 4648, with padding, in one line.
std::string base64(const std::string& bytes);

}  // namespace crosscheck
