// Small parsers that say what they expected.
#include "experiments/regress/lines.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "mysim/errors.h"

namespace crosscheck {

std::string line_of(const Blessing& b, size_t number) {
  return fmt::format("# blessing {}: {} | {} | {} | {}\n", number, b.date, b.commit, b.build, one_line(b.reason));
}

Blessing blessing_from(const std::string& text) {
  const std::vector<std::string> parts = parts_of(text, 4, "DATE | COMMIT | BUILD | REASON");
  return {parts[0], parts[1], parts[2], parts[3]};
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields{""};
  bool quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    if (quoted) {
      if (line[i] != '"')
        fields.back() += line[i];
      else if (i + 1 < line.size() && line[i + 1] == '"')
        fields.back() += line[i++];
      else
        quoted = false;
    } else if (line[i] == '"') {
      quoted = true;
    } else if (line[i] == ',') {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  if (quoted) throw InputError("expected a closing quote");
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

std::string after(const std::string& begin, const std::string& line) {
  if (!line.starts_with(begin)) throw InputError(fmt::format("expected a line '{}...'", begin));
  return line.substr(begin.size());
}

std::vector<std::string> parts_of(const std::string& text, size_t count, const std::string& form) {
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

}  // namespace crosscheck
