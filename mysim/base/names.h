// Validation of names and paths that come from data: safe to print and to use in the file system.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace crosscheck {

/// True for valid UTF-8 without control, line-separating, bidirectional and zero-width characters.
bool is_printable(std::string_view text);

/// The text made safe for a terminal: unprintable characters except line feeds and tabs are replaced by '?'.
std::string printable(std::string_view text);

/// Filters stdout and stderr through printable(), so that scenes, engines and received folders cannot control the
/// terminal.
void print_only_text();

/// Maximum length (bytes) of a file name derived from other names; leaves room for suffixes in the file system's 255
/// bytes.
constexpr std::size_t longest_derived_name = 220;

/// True for a name of a scene, method or student: printable, 1 to 200 (or `most`) bytes, without '/', and not
/// beginning with '-' or '.'.
bool is_name(std::string_view text, std::size_t most = 200);

/// Returns the name if it is valid, otherwise throws InputError "PLACE: expected a name ..., got '...'".
const std::string& require_name(const std::string& name, const std::string& place, std::size_t most = 200);

/// Throws InputError unless the text is printable. Line feeds and tabs are also allowed, except in the columns of scene
/// and method names.
void require_cell(const std::string& column, const std::string& text);

/// True for a path that stays inside a folder: relative, printable, without empty, "." and ".." components, at most 255
/// bytes per component and 1024 in total.
bool is_path_inside(std::string_view path);

/// The file at a path that comes from data. Throws InputError that names the folder and the path if is_path_inside() is
/// false, or if the file or a folder on the way is a symbolic link or a special file (device, pipe, socket).
std::filesystem::path path_inside(const std::filesystem::path& folder, const std::string& path);

/// Throws InputError that names the first symbolic link, special file or unprintable name below a folder.
void require_plain_files(const std::filesystem::path& folder);

}  // namespace crosscheck
