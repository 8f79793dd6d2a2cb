// Tables as structs: a row type declares its columns in one place, for writers and readers.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "experiments/tables/table.h"
#include "mysim/base/errors.h"
#include "mysim/run/run.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// First and last value of an enum whose cells contain name_of(value). Specialised next to each enum.
template <class Enum>
inline constexpr std::pair<Enum, Enum> range_of;
template <>
inline constexpr std::pair range_of<Verdict>{Verdict::ok, Verdict::unsupported};
template <>
inline constexpr std::pair range_of<Tier>{Tier::exact, Tier::another_engine};

template <class T>
struct CellOf;

/// Converts a value to a cell: enums as name_of(value), bool as 1 or 0, an empty optional as an empty cell.
template <class T>
Cell to_cell(const T& value) {
  return CellOf<T>::write(value);
}

template <>
struct CellOf<std::string> {
  static Cell write(const std::string& value) { return value; }
  static std::string read(const Cell& cell) {
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    if (std::holds_alternative<std::monostate>(cell)) return "";
    throw InputError("expected a text");
  }
};
template <>
struct CellOf<double> {
  static Cell write(double value) { return value; }
  static double read(const Cell& cell) {  // whole numbers in a file are read as long
    if (const auto* number = std::get_if<double>(&cell)) return *number;
    if (const auto* whole = std::get_if<long>(&cell)) return static_cast<double>(*whole);
    throw InputError("expected a number");
  }
};
template <>
struct CellOf<long> {
  static Cell write(long value) { return value; }
  static long read(const Cell& cell) {
    if (const auto* whole = std::get_if<long>(&cell)) return *whole;
    throw InputError("expected a whole number");
  }
};
template <>
struct CellOf<int> {
  static Cell write(int value) { return static_cast<long>(value); }
  static int read(const Cell& cell) { return static_cast<int>(CellOf<long>::read(cell)); }
};
template <>
struct CellOf<bool> {
  static Cell write(bool value) { return static_cast<long>(value); }
  static bool read(const Cell& cell) { return CellOf<long>::read(cell) != 0; }
};
template <class Enum>
requires std::is_enum_v<Enum>
struct CellOf<Enum> {
  static Cell write(Enum value) { return std::string(name_of(value)); }
  static Enum read(const Cell& cell) {
    // read_csv() reads a column in which all cells are "nan" as numbers
    const auto* number = std::get_if<double>(&cell);
    const std::string word = number && std::isnan(*number) ? "nan" : CellOf<std::string>::read(cell);
    for (int i = static_cast<int>(range_of<Enum>.first); i <= static_cast<int>(range_of<Enum>.second); ++i)
      if (name_of(static_cast<Enum>(i)) == word) return static_cast<Enum>(i);
    throw InputError(fmt::format("unknown word '{}'", word));
  }
};
/// read_csv() reads a column without content as text; the text "" counts as empty here.
template <class T>
struct CellOf<std::optional<T>> {
  static Cell write(const std::optional<T>& value) { return value ? CellOf<T>::write(*value) : Cell(); }
  static std::optional<T> read(const Cell& cell) {
    if (std::holds_alternative<std::monostate>(cell)) return std::nullopt;
    if (!std::is_same_v<T, std::string> && std::holds_alternative<std::string>(cell) &&
        std::get<std::string>(cell).empty())
      return std::nullopt;
    return CellOf<T>::read(cell);
  }
};

/// Type-erased functions for all members of one type.
struct CellType {
  Cell (*write)(const void* member);
  void (*read)(void* member, const Cell& cell);
  Cell (*retyped)(const Cell& cell);  // converts to the member's type, because 2.0 in a file looks like a count
  std::string (*name)();              // name of the type for the data dictionary
};

template <class T>
std::string type_name() {
  if constexpr (std::is_same_v<T, bool>) return "0 or 1";
  if constexpr (std::is_integral_v<T>) return "whole number";
  if constexpr (std::is_floating_point_v<T>) return "number";
  if constexpr (std::is_enum_v<T>) {
    std::string words;
    for (int i = static_cast<int>(range_of<T>.first); i <= static_cast<int>(range_of<T>.second); ++i)
      words.append(words.empty() ? "one of: " : " | ").append(name_of(static_cast<T>(i)));
    return words;
  }
  return "text";
}
template <class T>
struct TypeName {
  static std::string of() { return type_name<T>(); }
};
template <class T>
struct TypeName<std::optional<T>> {
  static std::string of() { return type_name<T>() + ", or empty"; }
};

template <class T>
inline constexpr CellType cell_type = {
    [](const void* member) { return to_cell(*static_cast<const T*>(member)); },
    [](void* member, const Cell& cell) { *static_cast<T*>(member) = CellOf<T>::read(cell); },
    [](const Cell& cell) { return to_cell(CellOf<T>::read(cell)); }, &TypeName<T>::of};

/// A column: its name and unit in the header, its description in the data dictionary, and the offset of its member.
struct TypedColumn {
  std::string_view name, unit, description;
  const CellType* type;
  std::ptrdiff_t offset;  // bytes
};

// Type-erased, because templates would take a tenth of the suite's compile time.

std::vector<Column> columns_of(std::span<const TypedColumn> typed);
std::vector<Cell> cells_of(std::span<const TypedColumn> typed, const void* row);
/// Throws InputError with the names of the table and column if a cell has another type.
void read_cells(std::span<const TypedColumn> typed, const Table& table, std::span<const Cell> cells, void* row);
std::vector<Cell> retyped(std::span<const TypedColumn> typed, const Table& table, std::span<const Cell> cells);
/// Throws InputError with the names of both tables if the columns differ.
void require_columns(std::span<const TypedColumn> typed, const Table& table, std::string_view declared);

template <class T>
constexpr T initial_value() {
  if constexpr (std::is_enum_v<T>)
    return range_of<T>.first;
  else
    return T{};
}

using OptionalNumber = std::optional<double>;

/// The line number in a header at which a column is declared. It identifies the column and defines the order of
/// columns.
template <int line>
using Line = std::integral_constant<int, line>;
inline constexpr int most_lines = 100;  // largest number of lines in the declaration of a row type

// A row type declares the name of its table, and then each member together with its column, one per line:
//   struct ReboundRow {
//     TABLE("sphere-rebound");
//     COLUMN(std::string, method, "method", "1", "method that was run");
//     COLUMN(double, height, "height", "m", "height of the fall");
//   };
// The members are ordinary ones: `ReboundRow{.method = name, .height = 1}`.
#define TABLE(name_of_table)                               \
  static constexpr std::string_view table = name_of_table; \
  static constexpr int first_line = __LINE__
#define COLUMN(type_of_member, member, name, unit, description)                                       \
  type_of_member member = initial_value<type_of_member>();                                            \
  static_assert(__LINE__ < first_line + most_lines);                                                  \
  template <class Row>                                                                                \
  static TypedColumn column(Line<__LINE__>, const Row& row) {                                         \
    const auto at = reinterpret_cast<const char*>(&row.member) - reinterpret_cast<const char*>(&row); \
    return {name, unit, description, &cell_type<type_of_member>, at};                                 \
  }                                                                                                   \
  static_assert(true)

/// The columns of a row type in the order of their lines.
template <class Row>
std::span<const TypedColumn> typed_columns() {
  static const std::vector<TypedColumn> declared = [] {
    std::vector<TypedColumn> list;
    const Row row{};
    const auto add_column = [&]<int line>(Line<line> at) {
      if constexpr (requires { Row::column(at, row); }) list.push_back(Row::column(at, row));
    };
    const auto add_columns = [&]<int... i>(std::integer_sequence<int, i...>) {
      (add_column(Line<Row::first_line + i>{}), ...);
    };
    add_columns(std::make_integer_sequence<int, most_lines>{});
    return list;
  }();
  return declared;
}

template <class Row>
std::vector<Column> columns_of() {
  return columns_of(typed_columns<Row>());
}

/// An empty table with the columns of a row type. Tables that exist once per scene need a name.
template <class Row>
Table table_of(std::string name = std::string(Row::table)) {
  return {std::move(name), columns_of<Row>(), {}};
}

template <class Row>
void add(Table& table, const Row& row) {
  table.rows.push_back(cells_of(typed_columns<Row>(), &row));
}

/// Converts a table to rows. Throws InputError with the name of the table if its columns differ, and also with that of
/// the column if a cell has another type.
template <class Row>
std::vector<Row> rows_of(const Table& table) {
  require_columns(typed_columns<Row>(), table, Row::table);
  std::vector<Row> rows(table.rows.size());
  for (size_t i = 0; i < rows.size(); ++i) read_cells(typed_columns<Row>(), table, table.rows[i], &rows[i]);
  return rows;
}

}  // namespace crosscheck
