#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crosscheck {

/// Sets the creation date in a PDF written by cairo to 1970 (cairo ignores SOURCE_DATE_EPOCH), so that two runs write
/// the same bytes. Throws InputError if the file cannot be written.
void erase_pdf_date(const std::filesystem::path& pdf);

/// Runs gnuplot, without user settings, on a script that must write `files` into `folder`. Returns its warnings. Throws
/// std::runtime_error that begins with `what` if gnuplot fails or a file is missing, empty or truncated.
std::string run_gnuplot(const std::string& script, const std::filesystem::path& folder,
                        const std::vector<std::string>& files, const std::string& what);

/// Replaces line feeds, so that the text fits into a line of a script (a line feed would start a command).
std::string one_line(const std::string& text);

/// Encloses one line in gnuplot's single quotes, inside which only the single quote is special.
std::string single_quoted(const std::string& text);

/// Prints gnuplot's warnings about `what` to stderr, one per line.
void print_warnings(const std::string& warnings, const std::string& what);

}  // namespace crosscheck
