// gnuplot: run on a script, its files checked, its PDF without a date.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crosscheck {

/// Sets the one date in a PDF that cairo writes (it knows no SOURCE_DATE_EPOCH) to 1970, so that two runs write the
/// same bytes. From version 1.18 on cairo packs the date with the last objects of the file, before the table of
/// offsets: these are packed again, and the offsets behind them follow. Throws InputError when the file cannot be
/// written.
void erase_pdf_date(const std::filesystem::path& pdf);

/// Runs gnuplot, without user settings, on a script in `folder`, which must leave these files there. Returns
/// what it warned of; a warning is no failure. Throws std::runtime_error that begins with `what` when gnuplot fails, or
/// a file is missing, empty or cut off.
std::string run_gnuplot(const std::string& script, const std::filesystem::path& folder,
                        const std::vector<std::string>& files, const std::string& what);

/// The text for a line of a script, such as a comment: a line feed would begin a command.
std::string one_line(const std::string& text);

/// One line in gnuplot's single quotes, in which nothing is special but the quote itself.
std::string single_quoted(const std::string& text);

/// Says on stderr, on a line each, what gnuplot warned of while it drew `what`; nothing where it did not.
void print_warnings(const std::string& warnings, const std::string& what);

}  // namespace crosscheck
