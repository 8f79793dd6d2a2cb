// Exit codes and warnings of gnuplot are unreliable: it exits with 0 on a full disk, and warns about harmless things.
#include "report/base/gnuplot.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "mysim/base/process.h"

namespace crosscheck {

namespace {

/// Returns false if the text contains no date.
bool set_date(std::string& text) {
  const std::string key = "/CreationDate (D:", date = "19700101000000";
  const size_t at = text.find(key);
  if (at == std::string::npos || at + key.size() + date.size() > text.size()) return false;
  text.replace(at + key.size(), date.size(), date);
  return true;
}

/// Returns an empty string if the stream is not zlib data or unpacks to more than 1 MB.
std::string unpacked(const std::string& packed) {
  std::string text(1 << 20, ' ');
  uLongf size = text.size();
  const auto* bytes = reinterpret_cast<const Bytef*>(packed.data());
  if (uncompress(reinterpret_cast<Bytef*>(text.data()), &size, bytes, packed.size()) != Z_OK) size = 0;
  return text.substr(0, size);
}
std::string packed(const std::string& text) {
  uLongf size = compressBound(text.size());
  std::string bytes(size, ' ');
  compress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(text.data()), text.size());
  return bytes.substr(0, size);
}

/// Since version 1.18, cairo packs the date into the last object stream (PDF 1.7, 7.5.7 and 7.5.8). Updates its length
/// and the later offsets.
void set_packed_date(std::string& pdf) {
  static const std::regex tail(
      R"(\nendstream\nendobj\n(\d+) 0 obj\n +\d+\nendobj\n(\d+) 0 obj\n(<< /Type /XRef\n +/Length )\d+([^>]*)"
      R"(/W \[1 (\d+) (\d+)\][^>]*>>\nstream\n))");
  const size_t object = pdf.rfind("<< /Type /ObjStm"), begin = pdf.find("stream\n", object) + 7,
               end = pdf.find("\nendstream\n", begin), last = pdf.rfind("\nendstream\n");
  if (object == std::string::npos || end == std::string::npos || last <= end) return;
  std::string content = unpacked(pdf.substr(begin, end - begin));
  const std::string rest = pdf.substr(end, last - end);
  std::smatch parts;
  if (!set_date(content) || !std::regex_search(rest, parts, tail, std::regex_constants::match_continuous)) return;
  std::string offsets = unpacked(rest.substr(static_cast<size_t>(parts.length())));
  const size_t wide = std::stoul(parts[5]), entry = 1 + wide + std::stoul(parts[6]);
  const auto set_offset = [&](const std::string& number, size_t offset) {
    const size_t at = std::stoul(number) * entry + 1;
    for (size_t i = wide; i-- > 0 && at + i < offsets.size(); offset >>= 8) offsets[at + i] = static_cast<char>(offset);
  };
  const std::string stream = packed(content);
  std::string changed = pdf.substr(0, begin) + stream + "\nendstream\nendobj\n";
  set_offset(parts[1], changed.size());
  changed += fmt::format("{} 0 obj\n   {}\nendobj\n", parts[1].str(), stream.size());
  const size_t table = changed.size();
  set_offset(parts[2], table);
  const std::string packed_offsets = packed(offsets);
  changed += fmt::format("{} 0 obj\n{}{}{}", parts[2].str(), parts[3].str(), packed_offsets.size(), parts[4].str());
  pdf = fmt::format("{}{}\nendstream\nendobj\nstartxref\n{}\n%%EOF\n", changed, packed_offsets, table);
}

}  // namespace

void erase_pdf_date(const std::filesystem::path& pdf) {
  std::string text = try_read_file(pdf).value_or("");
  const std::string before = text;
  if (!set_date(text)) set_packed_date(text);
  if (text != before) write_file(pdf, text);
}

namespace {

/// Returns an empty string for a complete file, which ends with the last bytes of its format.
std::string wrong_with_drawn_file(const std::filesystem::path& file) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 3> formats{
      {{"\x89PNG", "IEND\xAE\x42\x60\x82"}, {"%PDF-", "%%EOF"}, {"<?xml", "</svg>"}}};
  const std::optional<std::string> content = try_read_file(file);
  if (!content) return "was not written";
  if (content->empty()) return "is empty";
  const std::string_view whole = std::string_view(*content).substr(0, content->find_last_not_of("\r\n") + 1);
  for (const auto& [begin, end] : formats)
    if (whole.starts_with(begin) && !whole.ends_with(end)) return "is cut off";
  return "";
}

}  // namespace

std::string run_gnuplot(const std::string& script, const std::filesystem::path& folder,
                        const std::vector<std::string>& files, const std::string& what) {
  const ProgramResult drawn = run_program({"gnuplot", "-d", script}, folder);
  const std::string said = drawn.err.substr(0, drawn.err.find_last_not_of(" \n") + 1);
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
