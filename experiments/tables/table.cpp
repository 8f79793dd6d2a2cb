#include "experiments/tables/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "experiments/tables/typed.h"
#include "mysim/base/csv.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "mysim/base/text.h"

namespace crosscheck {
namespace {

std::string text_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return csv_field(*text);
  if (const auto* number = std::get_if<double>(&cell)) return exact_text(*number);
  if (const auto* whole = std::get_if<long>(&cell)) return fmt::format("{}", *whole);
  return "";
}

/// Escapes line feeds. They would end the comment line, so that the rest of the value would become a row.
std::string in_one_line(const std::string& value) {
  std::string out;
  for (const char c : value) out += c == '\n' ? "\\n" : c == '\r' ? "\\r" : std::string(1, c);
  return out;
}

}  // namespace

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
  write_file(path_inside(folder, table.name + ".csv"), csv(table, provenance));
}

namespace {

class Reader {
 public:
  Reader(std::string text, std::filesystem::path file) : text_(std::move(text)), file_(std::move(file)) {}

  bool at_end() const { return at_ == text_.size(); }
  bool comment() const { return !at_end() && text_[at_] == '#'; }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1; }
  std::vector<CsvField> record() {
    std::optional<std::vector<CsvField>> fields = csv_record(text_, at_);
    if (!fields) fail("a closing quote");
    if (at_end()) fail("a line feed at the end of the row");
    ++at_;
    return *std::move(fields);
  }
  [[noreturn]] void fail(const std::string& expected) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw InputError(fmt::format("{}:{}: expected {}", file_.string(), line, expected));
  }

 private:
  std::string text_;
  std::filesystem::path file_;
  size_t at_ = 0;
};

template <class Number>
std::optional<Number> as(const std::string& text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return number;
}

Column column_of(const Reader& reader, const std::string& head) {
  const size_t open = head.rfind(" [");
  if (open == std::string::npos || !head.ends_with("]")) reader.fail("columns as \"name [unit]\"");
  return {head.substr(0, open), head.substr(open + 2, head.size() - open - 3)};
}

}  // namespace

Table read_csv(const std::filesystem::path& file) {
  const std::string bytes = try_read_file(file).value_or("");
  if (bytes.empty()) throw InputError(fmt::format("{}: expected a table", file.string()));
  Reader reader(bytes, file);
  while (reader.comment()) reader.skip_line();
  Table table{file.stem().string(), {}, {}};
  for (const CsvField& head : reader.record()) table.columns.push_back(column_of(reader, head.text));
  std::vector<std::vector<CsvField>> records;
  std::vector<bool> text(table.columns.size(), false), any(text);
  while (!reader.at_end()) {
    records.push_back(reader.record());
    const std::vector<CsvField>& record = records.back();
    if (record.size() != table.columns.size()) reader.fail(fmt::format("{} cells in the row", table.columns.size()));
    for (size_t i = 0; i < record.size(); ++i) require_cell(table.columns[i].name, record[i].text);
    for (size_t i = 0; i < record.size(); ++i) any[i] = any[i] || !record[i].text.empty();
    for (size_t i = 0; i < record.size(); ++i)
      if (record[i].quoted || (!record[i].text.empty() && !as<double>(record[i].text))) text[i] = true;
  }
  for (const auto& record : records) {
    std::vector<Cell> row;
    for (size_t i = 0; i < record.size(); ++i) {
      const std::string& cell = record[i].text;
      if (text[i] || !any[i])
        row.emplace_back(cell);
      else if (const auto whole = cell == "-0" ? std::nullopt : as<long>(cell))
        row.emplace_back(*whole);
      else
        row.push_back(cell_of(as<double>(cell)));
    }
    table.add(std::move(row));
  }
  return table;
}

std::vector<Column> columns_of(std::span<const TypedColumn> typed) {
  std::vector<Column> columns;
  for (const TypedColumn& c : typed) columns.push_back({std::string(c.name), std::string(c.unit)});
  return columns;
}

std::vector<Cell> cells_of(std::span<const TypedColumn> typed, const void* row) {
  std::vector<Cell> cells;
  cells.reserve(typed.size());
  for (const TypedColumn& c : typed) cells.push_back(c.type->write(static_cast<const std::byte*>(row) + c.offset));
  return cells;
}

namespace {

/// Calls `work` for each column with its index. Adds the names of the table and column to exceptions.
template <class Do>
void with_each(std::span<const TypedColumn> typed, const Table& table, const Do& work) {
  for (size_t i = 0; i < typed.size(); ++i) try {
      work(typed[i], i);
    } catch (const InputError& error) {
      throw InputError(fmt::format("table {}, column {}: {}", table.name, typed[i].name, error.what()));
    }
}

}  // namespace

void read_cells(std::span<const TypedColumn> typed, const Table& table, std::span<const Cell> cells, void* row) {
  with_each(typed, table, [&](const TypedColumn& column, size_t i) {
    column.type->read(static_cast<std::byte*>(row) + column.offset, cells[i]);
  });
}

std::vector<Cell> retyped(std::span<const TypedColumn> typed, const Table& table, std::span<const Cell> cells) {
  std::vector<Cell> out;
  with_each(typed, table, [&](const TypedColumn& column, size_t i) { out.push_back(column.type->retyped(cells[i])); });
  return out;
}

void require_columns(std::span<const TypedColumn> typed, const Table& table, std::string_view declared) {
  if (table.columns != columns_of(typed))
    throw InputError(fmt::format("table {}: expected the columns of table {}", table.name, declared));
}

}  // namespace crosscheck
