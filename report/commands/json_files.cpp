#include "report/commands/json_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/tables/dictionary.h"
#include "mysim/base/files.h"
#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/page/template.h"

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

std::vector<Column> columns_of(const std::string& header) {
  std::vector<Column> columns;
  for (const std::string& part : split(header, ',')) {
    const size_t begin = part.find_first_not_of(' '), unit = part.find(" [");
    columns.push_back({part.substr(begin, unit - begin), "1"});
    if (unit != std::string::npos) columns.back().unit = part.substr(unit + 2, part.size() - unit - 3);
  }
  return columns;
}

std::string file_of(const Certificate& c) {
  return file_name_of(fmt::format("certificate-{}-{}", c.scene, c.method)) + ".json";
}

void write_tables(const TableSet& rows, const Provenance& lines, const std::filesystem::path& folder) {
  for (const Table& table : rows.tables) write_csv(table, lines, folder);
  write_csv(dictionary(rows.tables), lines, folder);
  for (const Certificate& c : rows.certificates) write_file(folder / file_of(c), certificate_json(c));
}

Json rows_json(const Table& table) {
  Json rows = Json::array();
  for (const auto& row : table.rows) {
    Json& object = rows.emplace_back(Json::object());
    for (size_t i = 0; i < row.size(); ++i) {
      Json& member = object[table.columns[i].name];  // stays null for an empty cell
      std::visit(
          [&](const auto& value) {
            if constexpr (requires { member = value; }) member = value;
          },
          row[i]);
    }
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

std::string junit_xml(const std::string& suite, const std::vector<TestCase>& cases) {
  Json data{{"suite", suite}, {"tests", cases.size()}, {"cases", Json::array()}};
  for (const char* outcome : {"failure", "error", "skipped"})
    data[outcome] = std::ranges::count(cases, outcome, &TestCase::outcome);
  for (const TestCase& c : cases)
    data["cases"].push_back(
        {{"class", c.group}, {"name", c.name}, {"outcome", c.outcome}, {"message", c.message}, {"text", c.text}});
  return Template("junit.xml", asset("page/templates/junit.xml")).filled(data);
}

}  // namespace crosscheck
