#include "experiments/regress/strict_csv.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "mysim/base/csv.h"
#include "mysim/base/errors.h"

namespace crosscheck {

std::string comment_line_of(const Blessing& b, size_t number) {
  return fmt::format("# blessing {}: {} | {} | {} | {}\n", number, b.date, b.commit, b.build, one_line(b.reason));
}

Blessing blessing_from(const std::string& text) {
  const std::vector<std::string> parts = split_by_bars(text, 4, "DATE | COMMIT | BUILD | REASON");
  return {parts[0], parts[1], parts[2], parts[3]};
}

std::vector<std::string> fields_of(const std::string& line) {
  size_t at = 0;
  const auto record = csv_record(line, at);
  if (!record) throw InputError("expected a closing quote");
  std::vector<std::string> fields;
  for (const CsvField& field : *record) fields.push_back(field.text);
  return fields;
}

double finite_number(const std::string& text, const std::string& what) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw InputError(fmt::format("expected a finite number for the {}, got '{}'", what, text));
  return value;
}

int number_up_to(size_t most, const std::string& text, const std::string& what) {
  const double number = finite_number(text, what);
  if (!(number >= 1 && number <= static_cast<double>(most)) || number != std::floor(number))
    throw InputError(fmt::format("expected the number of a {} from 1 to {}, got {}", what, most, text));
  return static_cast<int>(number);
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

std::string without_prefix(const std::string& begin, const std::string& line) {
  if (!line.starts_with(begin)) throw InputError(fmt::format("expected a line '{}...'", begin));
  return line.substr(begin.size());
}

std::vector<std::string> split_by_bars(const std::string& text, size_t count, const std::string& form) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; parts.size() + 1 < count && std::getline(in, part, '|');) parts.push_back(part);
  std::string last;
  std::getline(in, last);
  parts.push_back(last);
  if (parts.size() != count) throw InputError(fmt::format("expected {}", form));
  for (std::string& part : parts) {
    const size_t from = part.find_first_not_of(' '), to = part.find_last_not_of(' ');
    part = from == std::string::npos ? "" : part.substr(from, to - from + 1);
    if (part.empty()) throw InputError(fmt::format("expected {}, none of them empty", form));
  }
  return parts;
}

void StrictCsvReader::next() {
  ++number_;
  if (!std::getline(in_, line_)) throw InputError("expected more lines");
}

std::vector<Blessing> StrictCsvReader::blessings() {
  std::vector<Blessing> all;
  for (; line_.starts_with("# blessing"); next())
    all.push_back(blessing_from(without_prefix(fmt::format("# blessing {}: ", all.size() + 1), line_)));
  return all;
}

void StrictCsvReader::rows(const std::string& header, const std::function<void(const std::string&)>& add) {
  const double expected = finite_number(without_prefix("# rows: ", line_), "rows");
  while (line_.starts_with("#")) next();
  if (line_ != header) throw InputError(fmt::format("expected the header {}", header));
  long count = 0;
  for (++number_; std::getline(in_, line_); ++number_, ++count) add(line_);
  // without this check, the quantities missing in a truncated file would pass as new ones
  if (count == 0 || static_cast<double>(count) != expected)
    throw InputError(fmt::format("expected {} rows, got {}", expected, count));
}

void read_strictly(const std::filesystem::path& file, const std::function<void(StrictCsvReader&)>& read) {
  StrictCsvReader lines(file);
  try {
    read(lines);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}:{}: {}", file.string(), lines.number(), error.what()));
  }
}

}  // namespace crosscheck
