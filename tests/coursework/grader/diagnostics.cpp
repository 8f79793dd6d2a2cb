// What g++, clang++ and ld write, taken apart.
#include "tests/coursework/grader/diagnostics.h"

#include <optional>
#include <sstream>

namespace coursework {
namespace {

/// N of the first "FILE:N:" in the line.
std::optional<std::string> line_of(const std::string& file, const std::string& line) {
  std::size_t at = line.find(file + ":");
  if (at == std::string::npos) return {};
  at += file.size() + 1;
  const std::size_t end = line.find_first_not_of("0123456789", at);
  if (end == std::string::npos || end == at || (line[end] != ':' && line[end] != ',')) return {};
  return line.substr(at, end - at);
}

/// The name that ld puts between ` and ' after these words.
std::optional<std::string> quoted_after(const std::string& words, const std::string& text) {
  const std::size_t at = text.find(words);
  if (at == std::string::npos) return {};
  const std::size_t begin = text.find_first_of("`'", at);
  const std::size_t end = begin == std::string::npos ? begin : text.find('\'', begin + 1);
  if (end == std::string::npos) return {};
  return text.substr(begin + 1, end - begin - 1);
}

}  // namespace

Remark first_error(const std::string& file, const std::string& said) {
  std::istringstream lines(said);
  std::optional<std::string> number, what;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t error = line.find("error: ");
    if (!what && error != std::string::npos && line.find("ld returned") == std::string::npos) {
      what = line.substr(error + 7, 300);
      if (const auto here = line_of(file, line)) number = here;
    }
    // an error inside a header: the student's line is where the compiler says that it came from
    if (!number) number = line_of(file, line);
    if (what && number) return {"build.compile", {file, *number, *what}};
  }
  if (const auto name = quoted_after("multiple definition of", said)) {
    if (*name == "main") return {"build.main", {file}};
    return {"build.twice", {file, *name}};
  }
  if (const auto name = quoted_after("undefined reference to", said)) return {"build.undefined", {file, *name}};
  if (what) return {"build.no_line", {file, *what}};
  return {"build.other", {file, said.substr(0, said.find('\n')).substr(0, 300)}};
}

}  // namespace coursework
