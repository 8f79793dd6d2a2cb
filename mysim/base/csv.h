// Records and fields of CSV as RFC 4180 has them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// The text in quotes.
std::string csv_quoted(const std::string& text);

/// The text as a field, in quotes where it needs them.
std::string csv_field(const std::string& text);

struct CsvField {
  std::string text;
  bool quoted = false;
};

/// The record that begins at `at`, which then is the place of its line feed or the end of the text. Nothing where a
/// quote is not closed.
std::optional<std::vector<CsvField>> csv_record(std::string_view text, std::size_t& at);

}  // namespace crosscheck
