// Cells: empty is null, words are strings, whole numbers integers, numbers floats; JSON has no nan and no inf, which
// stand as {"number": "nan"}.
#include "experiments/sweep/rows_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "mysim/errors.h"

namespace crosscheck {
namespace {

using nlohmann::json;

json json_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<long>(&cell)) return *whole;
  if (const auto* number = std::get_if<double>(&cell)) {
    if (std::isfinite(*number)) return *number;
    return json{{"number", fmt::format("{}", *number)}};
  }
  return nullptr;
}

Cell cell_of(const json& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return value.get<double>();
  if (value.is_object()) return std::stod(value.at("number").get<std::string>());
  return value.get<long>();
}

Parity parity_named(const std::string& name) {
  for (const Parity p : {Parity::match, Parity::different_law, Parity::mismatch, Parity::unattested})
    if (name_of(p) == name) return p;
  throw InputError(fmt::format("parity: expected match, different law, mismatch or unattested, got '{}'", name));
}

}  // namespace

std::string rows_json(const Rows& rows) {
  json out{{"tables", json::array()}, {"certificates", json::array()}, {"notes", rows.notes}};
  for (const Table& table : rows.tables) {
    json columns = json::array(), lines = json::array();
    for (const Column& c : table.columns) columns.push_back({c.name, c.unit});
    for (const auto& row : table.rows) {
      json line = json::array();
      for (const Cell& cell : row) line.push_back(json_of(cell));
      lines.push_back(std::move(line));
    }
    out["tables"].push_back({{"name", table.name}, {"columns", columns}, {"rows", std::move(lines)}});
  }
  for (const Certificate& c : rows.certificates) {
    json lines = json::array();
    for (const CertificateRow& r : c.rows)
      lines.push_back({r.quantity, r.asked, r.mapped, r.read_back, std::string(name_of(r.parity))});
    out["certificates"].push_back({{"method", c.method}, {"scene", c.scene}, {"rows", std::move(lines)}});
  }
  // what an outside program said may be no UTF-8
  return out.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

Rows read_rows(const std::string& text) {
  try {
    const json in = json::parse(text);
    Rows rows;
    for (const json& t : in.at("tables")) {
      Table table{t.at("name"), {}, {}};
      for (const json& c : t.at("columns")) table.columns.push_back({c.at(0), c.at(1)});
      for (const json& line : t.at("rows")) {
        std::vector<Cell> row;
        for (const json& value : line) row.push_back(cell_of(value));
        if (row.size() != table.columns.size()) throw InputError("rows: expected as many cells as columns");
        table.rows.push_back(std::move(row));
      }
      rows.tables.push_back(std::move(table));
    }
    for (const json& c : in.at("certificates")) {
      Certificate certificate{c.at("method"), c.at("scene"), {}};
      for (const json& r : c.at("rows"))
        certificate.rows.push_back({r.at(0), r.at(1), r.at(2), r.at(3), parity_named(r.at(4))});
      rows.certificates.push_back(std::move(certificate));
    }
    rows.notes = in.at("notes").get<std::vector<std::string>>();
    return rows;
  } catch (const json::exception& error) {
    throw InputError(fmt::format("rows: expected JSON of tables, certificates and notes: {}", error.what()));
  }
}

}  // namespace crosscheck
