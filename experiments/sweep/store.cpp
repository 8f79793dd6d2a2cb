#include "experiments/sweep/store.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "experiments/tables/dictionary.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "mysim/base/names.h"

namespace crosscheck {

PointList point_list_of(std::vector<std::string> experiments, std::span<const Point> points, Provenance provenance) {
  PointList list{std::move(experiments), {}, std::move(provenance)};
  for (const Point& point : points) list.points.push_back({point.name, point.hash()});
  return list;
}

void write_point_list(const PointList& list, const std::filesystem::path& folder) {
  Json json{{"experiments", list.experiments}, {"provenance", Json::array()}, {"points", {}}};
  for (const auto& [key, value] : list.provenance) json["provenance"].push_back(Json::array({key, value}));
  for (const PointList::Entry& p : list.points) json["points"].push_back({{"name", p.name}, {"hash", p.hash}});
  write_file(folder / "plan.json", dump(json, 1) + "\n");
}

PointList read_point_list(const std::filesystem::path& folder) {
  const auto file = path_inside(folder, "plan.json");
  if (!std::filesystem::exists(file))
    throw InputError(fmt::format("{}: expected the plan of a sweep, written by `experiment --shard`", file.string()));
  if (const auto points = path_inside(folder, "points"); std::filesystem::exists(points)) require_plain_files(points);
  try {
    const JsonField json = JsonField::parse_file(file.string());
    PointList list{json["experiments"].texts(), {}, {}};
    for (const JsonField& line : json["provenance"].elements())
      list.provenance.emplace_back(line[0].text(), line[1].text());
    if (const JsonField points = json["points"]; !points.is_null())
      for (const JsonField& p : points.elements())
        list.points.push_back({p["name"].text(), require_name(p["hash"].text(), "hash of a point")});
    return list;
  } catch (const InputError& error) {
    throw InputError(fmt::format("expected experiments, provenance and points of a sweep: {}", error.what()));
  }
}

std::filesystem::path store_in(const std::filesystem::path& folder) { return folder / "points"; }

// An empty cell is written as null, a word as a string, a whole number as an integer, and any other number as a float.
// JSON has no NaN and no infinity, which are written as {"number": "nan"}.

namespace {

Json json_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<long>(&cell)) return *whole;
  if (const auto* number = std::get_if<double>(&cell)) {
    if (std::isfinite(*number)) return *number;
    return {{"number", fmt::format("{}", *number)}};
  }
  return nullptr;
}

double not_finite(const JsonField& field) {
  const std::string word = field.text();
  for (const double value : {NAN, -NAN, INFINITY, -INFINITY})
    if (word == fmt::format("{}", value)) return value;
  field.fail("nan or inf");
}

Cell cell_of(const JsonField& value) {
  if (value.is_null()) return {};
  if (value.is_text()) return value.text();
  if (value.is_integer()) return value.whole();
  return value.is_object() ? not_finite(value["number"]) : value.number();
}

Parity parity_of(const JsonField& field) {
  const std::string name = field.text();
  for (const Parity p : {Parity::match, Parity::different_law, Parity::mismatch, Parity::unattested})
    if (name_of(p) == name) return p;
  field.fail("match, different law, mismatch or unattested");
}

}  // namespace

std::string table_set_json(const TableSet& set) {
  Json certificates = Json::array(), tables = Json::array();
  for (const Table& table : set.tables) {
    Json columns = Json::array(), lines = Json::array();
    for (const Column& c : table.columns) columns.push_back(Json::array({c.name, c.unit}));
    for (const auto& row : table.rows) {
      Json& line = lines.emplace_back(Json::array());
      for (const Cell& cell : row) line.push_back(json_of(cell));
    }
    tables.push_back({{"columns", std::move(columns)}, {"name", table.name}, {"rows", std::move(lines)}});
  }
  for (const Certificate& c : set.certificates) {
    Json lines = Json::array();
    for (const CertificateRow& r : c.rows)
      lines.push_back(Json::array({r.quantity, r.requested, r.mapped, r.read_back, name_of(r.parity)}));
    certificates.push_back({{"method", c.method}, {"rows", std::move(lines)}, {"scene", c.scene}});
  }
  const Json all{{"certificates", std::move(certificates)}, {"notes", set.notes}, {"tables", std::move(tables)}};
  return dump(all) + "\n";
}

TableSet read_table_set(const std::string& text) {
  try {
    const JsonField in = JsonField::parse(text, "rows");
    TableSet set;
    for (const JsonField& t : in["tables"].elements()) {
      Table table{require_name(t["name"].text(), "table", longest_derived_name), {}, {}};
      for (const JsonField& c : t["columns"].elements()) table.columns.push_back({c[0].text(), c[1].text()});
      for (const JsonField& line : t["rows"].elements()) {
        std::vector<Cell> row;
        for (const JsonField& value : line.elements()) row.push_back(cell_of(value));
        if (row.size() != table.columns.size()) line.fail("as many cells as columns");
        for (size_t i = 0; i < row.size(); ++i)
          if (const auto* cell = std::get_if<std::string>(&row[i])) require_cell(table.columns[i].name, *cell);
        table.rows.push_back(std::move(row));
      }
      set.tables.push_back(with_declared_types(std::move(table)));
    }
    for (const JsonField& c : in["certificates"].elements()) {
      Certificate certificate{c["method"].text(), require_name(c["scene"].text(), "scene"), {}};
      require_cell("method", certificate.method);
      for (const JsonField& r : c["rows"].elements())
        certificate.rows.push_back({r[0].text(), r[1].text(), r[2].text(), r[3].text(), parity_of(r[4])});
      set.certificates.push_back(std::move(certificate));
    }
    set.notes = in["notes"].texts();
    return set;
  } catch (const InputError& error) {
    throw InputError(fmt::format("expected JSON of tables, certificates and notes: {}", error.what()));
  }
}

std::optional<TableSet> Store::find(const std::string& hash, std::string* fault) const {
  if (!std::filesystem::exists(file_of(hash))) return std::nullopt;
  try {
    return read_table_set(try_read_file(file_of(hash)).value_or(""));
  } catch (const InputError& error) {
    if (fault) *fault = fmt::format(": {}: {}", file_of(hash).string(), error.what());
    return std::nullopt;
  }
}

void Store::keep(const std::string& hash, const TableSet& set) const {
  write_file(file_of(hash), table_set_json(set));
  forget_failure(hash);
}

void Store::forget_failure(const std::string& hash) const {
  std::error_code ignored;
  std::filesystem::remove(failure_file_of(hash), ignored);
}

void Store::keep_failure(const std::string& hash, const std::string& why) const {
  write_file(failure_file_of(hash), why);
}

std::optional<std::string> Store::failure_of(const std::string& hash) const {
  return try_read_file(failure_file_of(hash));
}

}  // namespace crosscheck
