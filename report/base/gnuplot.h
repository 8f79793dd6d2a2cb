// Runs gnuplot on a script, checks the files it wrote, and removes the date from PDFs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crosscheck {

/// Sets the creation date in a PDF written by cairo to 1970, so that two runs write the same bytes (cairo ignores
/// SOURCE_DATE_EPOCH). From version 1.18 on, cairo packs the date with the last objects of the file, before the table
/// of offsets; the function repacks these objects and shifts the offsets of all that follows. Throws InputError if the
/// file cannot be written.
void erase_pdf_date(const std::filesystem::path& pdf);

/// Runs gnuplot, without user settings, on a script in `folder`, which must write these files there. Returns gnuplot's
/// warnings; a warning is not a failure. Throws std::runtime_error that begins with `what` if gnuplot fails, or if a
/// file is missing, empty or truncated.
std::string run_gnuplot(const std::string& script, const std::filesystem::path& folder,
                        const std::vector<std::string>& files, const std::string& what);

/// The text without line feeds, for one line of a script such as a comment (a line feed would start a command).
std::string one_line(const std::string& text);

/// One line in gnuplot's single quotes, where only the quote itself is special.
std::string single_quoted(const std::string& text);

/// Prints gnuplot's warnings about `what` to stderr, one per line; nothing if there are none.
void print_warnings(const std::string& warnings, const std::string& what);

}  // namespace crosscheck
