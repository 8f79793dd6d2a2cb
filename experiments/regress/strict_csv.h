// Strict parsing of the files that `regress --bless` writes, so that a damaged file is never accepted.
#pragma once

#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "mysim/base/files.h"

namespace crosscheck {

struct Blessing {
  std::string date, commit, build, reason;
};
/// The line "# blessing 2: DATE | COMMIT | BUILD | REASON".
std::string comment_line_of(const Blessing& blessing, size_t number);
/// Parses the text that follows the colon. Throws InputError "expected ...", as do the functions below.
Blessing blessing_from(const std::string& text);

/// The fields of a CSV line (RFC 4180, without line breaks inside fields).
std::vector<std::string> fields_of(const std::string& line);

double finite_number(const std::string& text, const std::string& what);

/// A whole number from 1 to `most`.
int number_up_to(size_t most, const std::string& text, const std::string& what);

std::string one_line(std::string text);

std::string without_prefix(const std::string& begin, const std::string& line);

/// The `count` non-empty parts of "A | B | C". `form`: the expected form, which the message contains.
std::vector<std::string> split_by_bars(const std::string& text, size_t count, const std::string& form);

/// Reads comment lines, a header and rows. Inside read_strictly(), "FILE:LINE: " is prepended to the messages of
/// exceptions.
class StrictCsvReader {
 public:
  explicit StrictCsvReader(const std::filesystem::path& file) : in_(read_file(file, "a file of baselines")) {}
  const std::string& line() const { return line_; }
  int number() const { return number_; }
  /// Throws InputError if there are no more lines.
  void next();
  /// Reads consecutive lines "# blessing 1: ...", "# blessing 2: ...", of which the current line is the first.
  std::vector<Blessing> blessings();
  /// Reads from the current line "# rows: N": further comments, the header, and N rows, which are passed to `add`.
  void rows(const std::string& header, const std::function<void(const std::string&)>& add);

 private:
  std::istringstream in_;
  std::string line_;
  int number_ = 0;
};
void read_strictly(const std::filesystem::path& file, const std::function<void(StrictCsvReader&)>& read);

}  // namespace crosscheck
