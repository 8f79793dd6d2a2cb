// CSV, JSON and JUnit of speeds.
#include "report/regress/speed_files.h"

#include <fmt/format.h>

#include "report/page/page.h"

namespace crosscheck {
namespace {

bool was_compared(const SpeedCompared& row) { return row.change.repetitions > 0; }

}  // namespace

Table table_of(const Speeds& speeds) {
  Table table{"speed-cost",
              {{"scene", "1"},
               {"method", "1"},
               {"was", "1"},
               {"is", "1"},
               {"change", "1"},
               {"change low", "1"},
               {"change high", "1"},
               {"noise", "1"},
               {"measurements", "1"},
               {"state", "1"},
               {"sentence", "1"},
               {"note", "1"}},
              {}};
  for (const SpeedCompared& row : speeds.rows) {
    const auto where_compared = [&](double value) { return was_compared(row) ? Cell(value) : Cell(); };
    table.add({row.scene, row.method, cell_of(row.was), row.is > 0 ? Cell(row.is) : Cell(),
               where_compared(row.change.median), where_compared(row.change.low), where_compared(row.change.high),
               where_compared(row.noise), static_cast<long>(row.seen), std::string(name_of(row.state)), row.sentence,
               row.note});
  }
  return table;
}

void add_speeds(Json& verdict, const Speeds& speeds) {
  verdict["speed"] = Json::list();
  for (const SpeedCompared& row : speeds.rows) {
    Json json{{"scene", row.scene}, {"method", row.method}, {"state", name_of(row.state)}};
    if (row.was) json["was"] = *row.was;
    if (row.state != Pace::gone) json["is"] = row.is;
    if (was_compared(row))
      json["change"] = row.change.median, json["change_low"] = row.change.low, json["change_high"] = row.change.high,
      json["noise"] = row.noise, json["measurements"] = row.seen;
    if (!row.sentence.empty()) json["sentence"] = row.sentence;
    if (!row.note.empty()) json["note"] = row.note;
    verdict["speed"].push(json);
  }
  verdict["speed_notes"] = speeds.notes;
  verdict["speed_failures"] = Json::list();
  for (const FailedPoint& f : speeds.failures) verdict["speed_failures"].push({{"what", f.name}, {"why", f.why}});
}

SpeedCases cases_of(const Speeds& speeds) {
  SpeedCases all;
  for (const SpeedCompared& row : speeds.rows) {
    if (!row.was) continue;
    ++all.cases;
    all.body += fmt::format("  <testcase classname=\"{}\" name=\"{}: speed\"", escaped(row.scene), escaped(row.method));
    all.failures += failed(row.state);
    all.body += failed(row.state) ? fmt::format("><failure message=\"{}\"/></testcase>\n",
                                                escaped(row.state == Pace::gone ? row.note : row.sentence))
                                  : "/>\n";
  }
  for (const FailedPoint& f : speeds.failures) {
    ++all.cases, ++all.errors;
    all.body += fmt::format("  <testcase classname=\"speed\" name=\"{}\"><error message=\"{}\"/></testcase>\n",
                            escaped(f.name), escaped(f.why));
  }
  return all;
}

}  // namespace crosscheck
