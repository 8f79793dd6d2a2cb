// Files of this room that the program reads while it runs, and Base64 that embeds bytes in a page.
#pragma once

#include <string>

namespace crosscheck {

// Bytes inside text.

/// RFC 4648, with padding, in one line.
std::string base64(const std::string& bytes);

// Files of this room that the program reads while it runs: the figures' style, the page's style sheet.

/// Content of a file in report/. Throws std::runtime_error that names it.
std::string asset(const std::string& name);

}  // namespace crosscheck
