// Records and fields of CSV (RFC 4180).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

std::string csv_quoted(const std::string& text);

/// The text as a CSV field, quoted if it contains a comma, a quote or a line break; inner quotes are doubled.
std::string csv_field(const std::string& text);

struct CsvField {
  std::string text;
  bool quoted = false;
};

/// Reads the record at `at`, and advances `at` to the line feed or the end of the text. Returns nothing if a quote is
/// not closed.
std::optional<std::vector<CsvField>> csv_record(std::string_view text, std::size_t& at);

}  // namespace crosscheck
