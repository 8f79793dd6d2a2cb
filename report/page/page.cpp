#include <fmt/ranges.h>

#include <algorithm>

#include "mysim/base/installation.h"
#include "mysim/base/text.h"
#include "mysim/model/moduli.h"
#include "report/base/assets.h"
#include "report/figures/chart_json.h"
#include "report/findings/findings_text.h"
#include "report/page/lab_html.h"
#include "report/page/page_parts.h"
#include "report/page/player_html.h"
#include "report/page/shown_runs.h"
#include "report/player/packed_numbers.h"

namespace crosscheck {

size_t Folds::hold(const std::string& template_name, const Json& data) {
  held_.push_back(filled(template_name, data));
  return held_.size() - 1;
}

Json Folds::fold(const std::string& heading, const std::string& kind, const std::string& template_name,
                 const Json& data, const std::string& id) {
  return {{"heading", heading}, {"kind", kind}, {"id", id}, {"held", hold(template_name, data)}};
}

Json provenance_data(const Provenance& lines) {
  Json all = Json::array();
  for (const auto& [key, value] : lines) all.push_back({{"key", key}, {"value", value}});
  return {{"lines", std::move(all)}};
}

std::string page_styles() {
  std::string all;
  for (const char* file : {"page/style.css", "page/player/player.css", "page/lab/lab.css", "page/lab/guide.css"})
    all += asset(file);
  return all;
}

std::string page_script(const std::string& bundle) {
  return content_of_file(programs_folder() / "page" / (bundle + ".js"));
}

std::vector<std::string> figures_of(const PageContent& c) {
  std::vector<std::string> names;
  for (const Chapter& chapter : c.chapters)
    for (const Chapter::Entry& entry : chapter.entries)
      for (const PageFigure& figure : entry.figures) names.push_back(figure.name);
  for (const ScenePart& part : c.scenes)
    for (const PageFigure& figure : part.figures) names.push_back(figure.name);
  return names;
}

namespace {

/// Null without an earlier report.
Json changes_data(const PageContent& c) {
  if (c.against.empty()) return nullptr;
  int timed = 0;
  Json rows = Json::array();
  for (const Change& change : c.changes) {
    timed += change.timed;
    if (!change.timed)
      rows.push_back({{"scene", change.scene.empty() ? "all" : change.scene},
                      {"before", change.before.empty() ? "–" : change.before},
                      {"now", change.now.empty() ? "–" : change.now}});
  }
  return {{"against", c.against}, {"rows", std::move(rows)}, {"timed", timed}};
}

Json scene_data(const ScenePart& part, const PageContent& c) {
  const Scene& scene = *part.scene;
  const SceneData& facts = *part.facts;
  Findings shown = part.findings;
  std::erase_if(shown, [](const Finding& f) { return f.rule == "take"; });  // shown in a table instead
  Json data = findings_data(shown);
  data.update({{"name", scene.name},
               {"question", scene.question},
               {"parameters", scene.parameters},
               {"step", own_step_text(scene)},
               {"duration", fmt::format("{:.3g}", scene.duration)},
               {"window", fmt::format("{:.3g}", scene.window)},
               {"growth", nice(facts.growth)},
               {"predictable", facts.measured_window >= scene.duration * (1 - 1e-9)},
               {"measured_window", fmt::format("{:.3g}", facts.measured_window)},
               {"hash", scene.hash},
               {"player", nullptr},
               {"lab", !c.lab.empty()},
               {"figures", Json::array()},
               {"methods", run_table_data(part)},
               {"statistics", part.statistics ? statistics_data(*part.statistics) : Json()},
               {"certificates", Json::array()},
               {"continuum", Json::array()}});
  if (!part.motions.empty() && !part.runs.empty()) {
    // compare the recommended run with the first run of another engine
    const auto other = std::ranges::find_if(part.runs, [&](const ShownRun& run) {
      return run.beside && family_of(run.method).name != family_of(part.runs[0].method).name;
    });
    data["player"] = {{"a", part.runs[0].key}, {"b", other == part.runs.end() ? "truth" : other->key}};
    data["runs"] = shown_runs_data(part, !c.lab.empty());
  }
  for (const PageFigure& figure : part.figures) data["figures"].push_back(figure_data(figure, c));
  for (const Certificate* certificate : part.certificates)
    data["certificates"].push_back(certificate_data(*certificate));
  if (const auto net = moduli_of(scene.model, scene.start).moduli) {
    for (const std::string& sentence : sentences_of(*net)) data["continuum"].push_back(sentence);
    if (const std::string warning = skip_one_warning(*net); !warning.empty()) data["continuum"].push_back(warning);
  }
  if (const auto bending = bending_length_of(scene.model, scene.start))
    data["continuum"].push_back(sentence_of(*bending));
  return data;
}

Json card_data(const ScenePart& part, const PageContent& c, Folds& folds) {
  Json card{{"name", part.scene->name},
            {"question", part.scene->question},
            {"thumbnail", part.thumbnail.empty() ? Json() : image_data({part.thumbnail, "", ""})},
            {"take", nullptr},
            {"held", folds.hold("scene", scene_data(part, c))}};
  if (part.take)
    card["take"] = {{"method", name_in_sentence(part.take->method)},
                    {"setting", setting_text(name_of(part.take->setting), part.take->requested)},
                    {"error", percent(part.take->error, part.take->motion)}};
  return card;
}

Json words_data(const PageContent& c, Folds& folds) {
  Provenance lines = c.provenance;
  std::erase_if(lines, [](const auto& line) { return line.first == "scene"; });  // each scene's card shows its hash
  Json made = provenance_data(lines);
  made["notes"] = c.notes;
  return Json::array({folds.fold("Glossary", "explained", "glossary", {{"words", glossary_data()}}),
                      folds.fold("All methods", "table", "methods", methods_data(c.methods), "methods"),
                      folds.fold("How this was made", "provenance", "made", made, "made")});
}

std::string packed(const Json& json) { return base64(gzipped(dump(json))); }

/// Stores charts that are visible at the start or in print as plain text, and packs the others.
Json scripts_data(const PageContent& c, const Folds& folds) {
  Json open = Json::object(), folded = c.charts;
  for (const std::string& figure : figures_in_sight(c)) open[figure] = folded[figure], folded.erase(figure);
  Json all = Json::array({data_element("charts", "open-charts", dump(open)),
                          data_element("folds", "held", packed(folds.held()), "text/plain"),
                          data_element("charts", "charts", packed(folded), "text/plain"),
                          data_element("charts", "methods-data", dump(method_looks_json(c.methods)))});
  for (const Json& more : {motions_data(c), c.lab})
    for (const Json& element : more) all.push_back(element);
  return all;
}

std::vector<std::pair<std::string, size_t>> blocks_of(const Json& page, const std::string& html) {
  std::vector<std::pair<std::string, size_t>> blocks{{"text and pictures", html.size()}};
  const auto count = [&](const std::string& block, size_t bytes) {
    blocks[0].second -= bytes;
    auto known = std::ranges::find(blocks, block, &std::pair<std::string, size_t>::first);
    if (known == blocks.end()) known = blocks.insert(known, {block, 0});
    known->second += bytes;
  };
  for (const Json& element : page["data"])
    count(element["block"], element["text"].get_ref<const std::string&>().size());
  count("scripts", page["script"].get_ref<const std::string&>().size());
  count("styles", page["styles"].get_ref<const std::string&>().size());
  return blocks;
}

}  // namespace

Json data_element(const std::string& block, const std::string& id, const std::string& text, const char* type) {
  return {{"block", block}, {"id", id},    {"type", type}, {"text", json_for_script(text)},
          {"class", ""},    {"scene", ""}, {"set", ""}};
}

std::string page_html(const PageContent& c, std::vector<std::pair<std::string, size_t>>* blocks) {
  Folds folds;
  Json cards = Json::array();
  std::vector<std::string> untried;
  for (const ScenePart& part : c.scenes) {
    cards.push_back(card_data(part, c, folds));
    const bool tried = std::ranges::any_of(part.runs, [](const ShownRun& run) { return !run.key.ends_with(" own"); });
    if (!part.take && !tried) untried.push_back(part.scene->name);
  }
  const bool recommends = std::ranges::any_of(c.scenes, [](const ScenePart& part) { return part.take.has_value(); });
  Json data{{"title", "Crosscheck: mysim" + beside_mysim(c)},
            {"styles", page_styles()},
            {"first", first_screen_data(c)},
            {"changes", changes_data(c)},
            {"chapters", chapters_data(c, folds)},
            {"recommendations", recommends ? recommendations_data(c.scenes) : Json()},
            {"untried", joined(untried)},
            {"cards", std::move(cards)},
            {"words", words_data(c, folds)}};
  data["data"] = scripts_data(c, folds);
  data["script"] = page_script("app");
  std::string html = filled("page", data);
  if (blocks) *blocks = blocks_of(data, html);
  return html;
}

namespace {

Json finding_json(const Finding& f, const TableSet& result, const std::vector<std::string>& figures) {
  Json json = json_of(f);
  json["figure"] = figure_of(f.rule, f.scene, figures);
  json["evidence"] = Json::array();
  for (const Evidence& e : evidence_of(f, result)) json["evidence"].push_back(json_of(e));
  return json;
}

}  // namespace

std::string report_json(const PageContent& page, const AllFindings& findings, const std::vector<Chart>& charts,
                        const TableSet& result, std::string_view extent, const Json& runs) {
  Json json;
  json["format"] = report_format;
  json["extent"] = extent;
  for (const auto& [key, value] : page.provenance)
    if (key != "scene") json["provenance"][key] = value;
  const std::vector<std::string> figures = figures_of(page);
  json["findings"] = Json::array();
  for (const Finding* f : findings.each()) json["findings"].push_back(finding_json(*f, result, figures));
  json["scenes"] = Json::object();
  for (const ScenePart& part : page.scenes)
    json["scenes"][part.scene->name] = {
        {"hash", part.scene->hash}, {"truth", part.facts->tier}, {"truth_bar", part.facts->error_bar}};
  json["tables"] = Json::array();
  for (const Table& table : result.tables) {
    const Evidence whole = evidence_of(table);
    json["tables"].push_back({{"name", whole.table}, {"rows", whole.rows.size()}, {"fingerprint", whole.fingerprint}});
  }
  json["figures"] = Json::array();
  for (const Chart& c : charts)
    if (const FigureInfo* f = figure_info(c))
      json["figures"].push_back(
          {{"name", f->name}, {"scene", c.scene}, {"caption", f->caption}, {"tier", f->tier}, {"finding", f->finding}});
  json["notes"] = page.notes;
  json["problems"] = page.problems;
  // write one line per entry: with one line per number, line breaks and blanks would be most of the file
  std::vector<std::string> chart_lines, run_lines;
  for (const auto& [name, chart] : page.charts.items())
    chart_lines.push_back(fmt::format("  {}: {}", dump(Json(name)), dump(chart)));
  for (const Json& entry : runs) run_lines.push_back("  " + dump(entry));
  std::string text = dump(json, 1);
  text.erase(text.rfind('\n'));
  return text + fmt::format(",\n \"charts\": {{\n{}\n }},\n \"runs\": [\n{}\n ]\n}}\n", fmt::join(chart_lines, ",\n"),
                            fmt::join(run_lines, ",\n"));
}

}  // namespace crosscheck
