#include "report/tables_json.h"

#include "mysim/json.h"

namespace crosscheck {
namespace {

Json json_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* number = std::get_if<double>(&cell)) return *number;  // null where not finite
  if (const auto* whole = std::get_if<long>(&cell)) return *whole;
  return nullptr;
}

Json json_of(const Table& table) {
  Json columns = Json::list(), rows = Json::list();
  for (const Column& column : table.columns) columns.push({{"name", column.name}, {"unit", column.unit}});
  for (const auto& row : table.rows) {
    Json& object = rows.push(Json::object());
    for (size_t i = 0; i < row.size(); ++i) object[table.columns[i].name] = json_of(row[i]);
  }
  return {{"columns", std::move(columns)}, {"rows", std::move(rows)}};
}

}  // namespace

std::string tables_json(const Rows& rows, const Provenance& provenance) {
  Json lines = Json::list(), tables = Json::object();
  for (const auto& [key, value] : provenance) lines.push({{"key", key}, {"value", value}});
  for (const Table& table : rows.tables) tables[table.name] = json_of(table);
  return Json{{"provenance", lines}, {"notes", rows.notes}, {"tables", std::move(tables)}}.dump(1) + "\n";
}

}  // namespace crosscheck
