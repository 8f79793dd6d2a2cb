// One object with an entry per quantity; tables as lists of objects.
#include "report/commands/json_files.h"

#include <nlohmann/json.hpp>

#include "mysim/base/json.h"

namespace crosscheck {

std::string certificate_json(const Certificate& certificate) {
  Json rows = Json::array();
  for (const CertificateRow& r : certificate.rows)
    rows.push_back({{"quantity", r.quantity},
                    {"asked", r.requested},
                    {"mapped", r.mapped},
                    {"read_back", r.read_back},
                    {"verdict", name_of(r.parity)}});
  const Json json{{"scene", certificate.scene},
                  {"method", certificate.method},
                  {"verdict", certificate.mismatch()         ? "mismatch"
                              : certificate.fully_attested() ? "match"
                                                             : "not attested"},
                  {"summary", summary_of(certificate)},
                  {"rows", std::move(rows)}};
  return dump(json, 1) + "\n";
}

namespace {

Json json_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* number = std::get_if<double>(&cell)) return *number;  // null where not finite
  if (const auto* whole = std::get_if<long>(&cell)) return *whole;
  return nullptr;
}

}  // namespace

Json rows_json(const Table& table) {
  Json rows = Json::array();
  for (const auto& row : table.rows) {
    Json& object = rows.emplace_back(Json::object());
    for (size_t i = 0; i < row.size(); ++i) object[table.columns[i].name] = json_of(row[i]);
  }
  return rows;
}

std::string tables_json(const TableSet& rows, const Provenance& provenance) {
  Json lines = Json::array(), tables = Json::object();
  for (const auto& [key, value] : provenance) lines.push_back({{"key", key}, {"value", value}});
  for (const Table& table : rows.tables) {
    Json columns = Json::array();
    for (const Column& column : table.columns) columns.push_back({{"name", column.name}, {"unit", column.unit}});
    tables[table.name] = {{"columns", std::move(columns)}, {"rows", rows_json(table)}};
  }
  return dump(Json{{"provenance", lines}, {"notes", rows.notes}, {"tables", std::move(tables)}}, 1) + "\n";
}

}  // namespace crosscheck
