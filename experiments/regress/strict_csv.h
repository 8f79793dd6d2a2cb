// Lines of the files that `regress --bless` writes: read strictly, so that a damaged file is never taken for a good
// one.
#pragma once

#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "mysim/base/files.h"

namespace crosscheck {

/// The author of a blessing, and the reason.
struct Blessing {
  std::string date, commit, build, reason;
};
/// "# blessing 2: DATE | COMMIT | BUILD | REASON"
std::string comment_line_of(const Blessing& blessing, size_t number);
/// From what stands behind the colon. Throws InputError, "expected ...", as the others here.
Blessing blessing_from(const std::string& text);

/// A line of CSV as its fields (RFC 4180; fields hold no line breaks here).
std::vector<std::string> fields_of(const std::string& line);

double finite_number(const std::string& text, const std::string& what);

/// A whole number from 1 to `most`.
int number_up_to(size_t most, const std::string& text, const std::string& what);

/// Line breaks as blanks.
std::string one_line(std::string text);

/// The rest of a line that begins so.
std::string without_prefix(const std::string& begin, const std::string& line);

/// The parts of "A | B | C", so many, none of them empty; `form` is what is expected, for the message.
std::vector<std::string> split_by_bars(const std::string& text, size_t count, const std::string& form);

/// A file of comment lines, a header and rows, line by line. What is thrown inside read_strictly() gets "FILE:LINE: "
/// in front.
class StrictCsvReader {
 public:
  explicit StrictCsvReader(const std::filesystem::path& file) : in_(read_file(file, "a file of baselines")) {}
  const std::string& line() const { return line_; }
  int number() const { return number_; }
  /// Throws InputError where there are no more.
  void next();
  /// The lines "# blessing 1: ...", "# blessing 2: ..." from this one on.
  std::vector<Blessing> blessings();
  /// From the line "# rows: N" on: further comments, the header, and N rows, each of which is handed to `add`.
  void rows(const std::string& header, const std::function<void(const std::string&)>& add);

 private:
  std::istringstream in_;
  std::string line_;
  int number_ = 0;
};
void read_strictly(const std::filesystem::path& file, const std::function<void(StrictCsvReader&)>& read);

}  // namespace crosscheck
