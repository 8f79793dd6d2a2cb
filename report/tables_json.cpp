#include "report/tables_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace crosscheck {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* number = std::get_if<double>(&cell)) return std::isfinite(*number) ? Json(*number) : Json();
  if (const auto* whole = std::get_if<long>(&cell)) return *whole;
  return nullptr;
}

Json json_of(const Table& table) {
  Json columns = Json::array(), rows = Json::array();
  for (const Column& column : table.columns) columns.push_back({{"name", column.name}, {"unit", column.unit}});
  for (const auto& row : table.rows) {
    Json object = Json::object();
    for (size_t i = 0; i < row.size(); ++i) object[table.columns[i].name] = json_of(row[i]);
    rows.push_back(std::move(object));
  }
  return {{"columns", columns}, {"rows", rows}};
}

}  // namespace

std::string tables_json(const Rows& rows, const Provenance& provenance) {
  Json lines = Json::array(), tables = Json::object();
  for (const auto& [key, value] : provenance) lines.push_back({{"key", key}, {"value", value}});
  for (const Table& table : rows.tables) tables[table.name] = json_of(table);
  return Json{{"provenance", lines}, {"notes", rows.notes}, {"tables", tables}}.dump(1) + "\n";
}

}  // namespace crosscheck
