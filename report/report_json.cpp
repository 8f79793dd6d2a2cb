#include "report/report_json.h"

#include "mysim/json.h"
#include "report/finding_rules.h"

namespace crosscheck {
namespace {

Json grounds_json(const Grounds& e) { return {{"table", e.table}, {"rows", e.rows}, {"fingerprint", e.fingerprint}}; }

Json finding_json(const Finding& f, const Rows& result, const std::vector<std::string>& figures) {
  Json json = {{"scene", f.scene},       {"topic", f.topic},
               {"sentence", f.sentence}, {"tier", f.tier},
               {"chapter", f.chapter},   {"figure", figure_of(f.rule, f.scene, figures)},
               {"rule", f.rule},         {"formula", finding_rule(f.rule).formula}};
  json["evidence"] = Json::list();
  for (const Grounds& e : grounds_of(f, result)) json["evidence"].push(grounds_json(e));
  return json;
}

}  // namespace

std::string report_json(const PageContent& page, const AllFindings& findings, const std::vector<Chart>& charts,
                        const Rows& result) {
  Json json;
  for (const auto& [key, value] : page.provenance)
    if (key != "scene") json["provenance"][key] = value;
  const std::vector<std::string> figures = figures_of(page);
  json["findings"] = Json::list();
  for (const Finding& f : findings.overall) json["findings"].push(finding_json(f, result, figures));
  for (const auto& of_scene : findings.of_scenes)
    for (const Finding& f : of_scene) json["findings"].push(finding_json(f, result, figures));
  json["scenes"] = Json::object();
  for (const ScenePart& part : page.scenes)
    json["scenes"][part.scene->name] = {
        {"hash", part.scene->hash}, {"truth", part.facts->tier}, {"truth_bar", part.facts->bar}};
  json["tables"] = Json::list();
  for (const Table& table : result.tables) {
    const Grounds whole = grounds_of(table);
    json["tables"].push({{"name", whole.table}, {"rows", whole.rows.size()}, {"fingerprint", whole.fingerprint}});
  }
  json["figures"] = Json::list();
  for (const Chart& c : charts)
    if (const FigureWords* f = words_of(c))
      json["figures"].push(
          {{"name", f->name}, {"scene", c.scene}, {"caption", f->caption}, {"tier", f->tier}, {"finding", f->finding}});
  json["notes"] = page.notes;
  json["problems"] = page.problems;
  return json.dump(1) + "\n";
}

}  // namespace crosscheck
