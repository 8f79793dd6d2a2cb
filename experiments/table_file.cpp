#include "experiments/table_file.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <sstream>

#include "mysim/errors.h"

namespace crosscheck {
namespace {

struct Field {
  std::string text;
  bool quoted = false;
};

/// One character after the other, with the line it stands in.
class Reader {
 public:
  Reader(std::string text, std::filesystem::path file) : text_(std::move(text)), file_(std::move(file)) {}

  bool at_end() const { return at_ == text_.size(); }
  bool comment() const { return !at_end() && text_[at_] == '#'; }
  void skip_line() {
    while (!at_end() && text_[at_] != '\n') ++at_;
    if (!at_end()) ++at_, ++line_;
  }
  std::vector<Field> record() {
    std::vector<Field> fields(1);
    for (; !at_end() && text_[at_] != '\n'; ++at_) {
      if (text_[at_] == ',')
        fields.emplace_back();
      else if (text_[at_] == '"')
        quoted(fields.back());
      else
        fields.back().text += text_[at_];
    }
    if (at_end()) fail("a line feed at the end of the row");
    ++at_, ++line_;
    return fields;
  }
  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError(fmt::format("{}:{}: expected {}", file_.string(), line_, expected));
  }

 private:
  /// From an opening quote to the closing one.
  void quoted(Field& field) {
    field.quoted = true;
    for (++at_;; ++at_) {
      if (at_end()) fail("a closing quote");
      if (text_[at_] == '"' && (at_ + 1 == text_.size() || text_[at_ + 1] != '"')) return;
      if (text_[at_] == '"') ++at_;
      if (text_[at_] == '\n') ++line_;
      field.text += text_[at_];
    }
  }

  std::string text_;
  std::filesystem::path file_;
  size_t at_ = 0;
  int line_ = 1;
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
  std::ifstream in(file, std::ios::binary);
  std::stringstream bytes;
  if (!in || !(bytes << in.rdbuf())) throw InputError(fmt::format("{}: expected a table", file.string()));
  Reader reader(bytes.str(), file);
  while (reader.comment()) reader.skip_line();
  Table table{file.stem().string(), {}, {}};
  for (const Field& head : reader.record()) table.columns.push_back(column_of(reader, head.text));
  std::vector<std::vector<Field>> records;
  std::vector<bool> text(table.columns.size(), false), any(text);
  while (!reader.at_end()) {
    records.push_back(reader.record());
    const std::vector<Field>& record = records.back();
    if (record.size() != table.columns.size()) reader.fail(fmt::format("{} cells in the row", table.columns.size()));
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

}  // namespace crosscheck
