// CSV.
#include "experiments/table.h"

#include <fmt/format.h>

#include <stdexcept>

#include "mysim/files.h"

namespace crosscheck {
namespace {

std::string text_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return csv_field(*text);
  if (const auto* number = std::get_if<double>(&cell)) return exact_text(*number);
  if (const auto* whole = std::get_if<long>(&cell)) return fmt::format("{}", *whole);
  return "";
}

/// Line feeds would end the comment, and make a row of what follows.
std::string in_one_line(const std::string& value) {
  std::string out;
  for (const char c : value) out += c == '\n' ? "\\n" : c == '\r' ? "\\r" : std::string(1, c);
  return out;
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::string exact_text(double value) { return fmt::format("{:.17g}", value); }

void Table::add(std::vector<Cell> row) {
  if (row.size() != columns.size())
    throw std::logic_error(
        fmt::format("table {}: a row of {} cells under {} columns", name, row.size(), columns.size()));
  rows.push_back(std::move(row));
}

int Table::column(const std::string& wanted) const {
  for (size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == wanted) return static_cast<int>(i);
  throw std::out_of_range(fmt::format("table {} has no column {}", name, wanted));
}

std::string csv_row(const std::vector<Cell>& row) {
  std::string out;
  for (size_t i = 0; i < row.size(); ++i) out += (i ? "," : "") + text_of(row[i]);
  return out;
}

std::string csv(const Table& table, const Provenance& provenance) {
  std::string out;
  for (const auto& [key, value] : provenance) out += fmt::format("# {}: {}\n", key, in_one_line(value));
  for (size_t i = 0; i < table.columns.size(); ++i)
    out += (i ? "," : "") + csv_field(fmt::format("{} [{}]", table.columns[i].name, table.columns[i].unit));
  out += "\n";
  for (const auto& row : table.rows) out += csv_row(row) + "\n";
  return out;
}

void write_csv(const Table& table, const Provenance& provenance, const std::filesystem::path& folder) {
  write_file(folder / (table.name + ".csv"), csv(table, provenance));
}

}  // namespace crosscheck
