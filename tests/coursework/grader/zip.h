// Zip files of our own making.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace coursework {

/// Files by their path inside the archive; those that begin with "#!" can be executed. Throws std::runtime_error where
/// it cannot be written.
void write_zip(const std::filesystem::path& zip, const std::map<std::string, std::string>& files);

/// Unpacks into the folder. Throws std::runtime_error where the zip cannot be read or names a file outside.
void unpack_zip(const std::filesystem::path& zip, const std::filesystem::path& folder);

}  // namespace coursework
