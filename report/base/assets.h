// Files of this room that the program reads while it runs.
#pragma once

#include <filesystem>
#include <string>

namespace crosscheck {

/// Content of a file in report/, such as the figures' style or the page's style sheet. Throws std::runtime_error that
/// names it.
std::string asset(const std::string& name);

/// All bytes of a file that holds some. Throws std::runtime_error that names it.
std::string content_of_file(const std::filesystem::path& file);

}  // namespace crosscheck
