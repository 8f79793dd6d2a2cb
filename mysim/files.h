// Writing files so that a killed run leaves no half file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace crosscheck {

/// Writes under a temporary name beside the file and renames it. Makes the folder where it is missing.
/// Throws InputError that names the file when it cannot be written.
void write_file(const std::filesystem::path& file, std::string_view content);

/// The whole content of a file. Throws InputError that names it and what was expected there ("a scene file (TOML)").
std::string read_file(const std::filesystem::path& file, std::string_view expected);

/// Makes sure that files can be written into the folder, making it where it is missing. Throws InputError that names
/// it.
void require_writable(const std::filesystem::path& folder);

/// The text with every character outside [A-Za-z0-9._=+-] replaced by '-': how methods appear in file names.
std::string file_name_of(std::string_view text);

}  // namespace crosscheck
