// Exit codes and warnings of gnuplot mean little: it ends with 0 on a full disk, and warns where all is well.
#include "report/base/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "mysim/base/process.h"

namespace crosscheck {

void erase_pdf_date(const std::filesystem::path& pdf) {
  std::string text = try_read_file(pdf).value_or("");
  const std::string key = "/CreationDate (D:", date = "19700101000000";
  const size_t at = text.find(key);
  if (at == std::string::npos) return;
  text.replace(at + key.size(), date.size(), date);
  write_file(pdf, text);
}

namespace {

/// The fault of a file that gnuplot wrote, or nothing. A format that is known by its first bytes must come to its
/// last ones.
std::string wrong_with_drawn_file(const std::filesystem::path& file) {
  struct Format {
    std::string_view begin, end;
  };
  static constexpr std::array<Format, 3> formats{
      {{"\x89PNG", "IEND\xAE\x42\x60\x82"}, {"%PDF-", "%%EOF"}, {"<?xml", "</svg>"}}};
  const std::optional<std::string> content = try_read_file(file);
  if (!content) return "was not written";
  if (content->empty()) return "is empty";
  for (const Format& format : formats)
    if (content->starts_with(format.begin)) {
      const size_t last = content->find_last_not_of("\r\n");
      return std::string_view(*content).substr(0, last + 1).ends_with(format.end) ? "" : "is cut off";
    }
  return "";
}

std::string without_end_of_line(std::string text) {
  text.erase(text.find_last_not_of(" \n") + 1);
  return text;
}

}  // namespace

std::string run_gnuplot(const std::string& script, const std::filesystem::path& folder,
                        const std::vector<std::string>& files, const std::string& what) {
  const ProgramResult drawn = run_program({"gnuplot", "-d", script}, folder);
  const std::string said = without_end_of_line(drawn.err);
  if (drawn.status != 0)
    throw std::runtime_error(fmt::format("{}: gnuplot (exit code {}): {}", what, drawn.status, said));
  for (const std::string& file : files)
    if (const std::string wrong = wrong_with_drawn_file(folder / file); !wrong.empty())
      throw std::runtime_error(
          fmt::format("{}: gnuplot: {} {}{}{}", what, file, wrong, said.empty() ? "" : ": ", said));
  return said;
}

std::string one_line(const std::string& text) {
  std::string out = printable(text);
  std::ranges::replace_if(
      out, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return out;
}

std::string single_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : one_line(text)) out += c == '\'' ? "''" : std::string(1, c);
  return out + "'";
}

void print_warnings(const std::string& warnings, const std::string& what) {
  std::istringstream in(warnings);
  for (std::string line; std::getline(in, line);)
    if (line.find_first_not_of(" \t^") != std::string::npos)
      fmt::print(stderr, "crosscheck: {}: gnuplot warns: {}\n", what, line);
}

}  // namespace crosscheck
