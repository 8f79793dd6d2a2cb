#pragma once

#include <filesystem>
#include <string>

namespace crosscheck {

/// Content of a file in report/, such as the figures' style or the page's style sheet. Throws std::runtime_error with
/// the file's name.
std::string asset(const std::string& name);

/// All bytes of a file. Throws std::runtime_error with the file's name if the file is empty or unreadable.
std::string content_of_file(const std::filesystem::path& file);

}  // namespace crosscheck
