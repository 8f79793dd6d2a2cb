// The page from top to bottom, and report.json.
#include "report/page/page_parts.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>

#include "mysim/base/pattern.h"
#include "mysim/base/text.h"
#include "mysim/model/moduli.h"
#include "report/base/assets.h"
#include "report/base/provenance.h"
#include "report/figures/chart_json.h"
#include "report/findings/findings_text.h"
#include "report/page/lab_html.h"
#include "report/page/player_html.h"
#include "report/page/shown_runs.h"
#include "report/page/smaller.h"
#include "report/player/packed_numbers.h"

namespace crosscheck {
namespace {

/// The changes against an earlier report.
std::string changes_html(const PageContent& c) {
  if (c.against.empty()) return "";
  std::string out =
      fmt::format("<section class=\"chapter\" id=\"changes\"><h2>What changed since {}</h2>\n", escaped(c.against));
  int timed = 0;
  std::string rows;
  for (const Change& change : c.changes) {
    timed += change.timed;
    if (change.timed) continue;
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"text\">{}</td><td class=\"text\">{}</td></tr>\n",
                        change.scene.empty() ? "all" : escaped(change.scene),
                        change.before.empty() ? "(nothing)" : prose(change.before),
                        change.now.empty() ? "(nothing any more)" : prose(change.now));
  }
  out += rows.empty()
             ? fmt::format("<p>Every finding{} reads as it did.</p>\n", timed > 0 ? " that rests on no timing" : "")
             : "<table class=\"changes\"><thead><tr><th>scene</th><th>before</th><th>now</th></tr></thead><tbody>\n" +
                   rows + "</tbody></table>\n";
  if (timed > 0)
    out += fmt::format(
        "<p class=\"note\">{} finding{} that rest{} on timings read otherwise, as in every run; "
        "<code>regress</code> tells changes of speed from noise.</p>\n",
        timed, timed == 1 ? "" : "s", timed == 1 ? "s" : "");
  return out + "</section>\n";
}

// Scenes.

std::string card_html(const ScenePart& part) {
  const std::string name = escaped(part.scene->name);
  return fmt::format(
      "<a class=\"card\" href=\"#{0}\" data-scene=\"{0}\">{1}<b>{0}</b><span>{2}</span>{3}</a>\n", name,
      part.thumbnail.empty() ? "" : image_tag({part.thumbnail, part.scene->name, ""}), prose(part.scene->question),
      part.take ? fmt::format("<span class=\"take\"><span>{}, {}</span><span>{}</span></span>",
                              escaped(name_in_sentence(part.take->method)),
                              prose(setting_text(std::string(name_of(part.take->setting)), part.take->requested)),
                              prose(percent(part.take->error, part.take->motion)))
                : "");
}

std::string scene_html(const ScenePart& part, const PageContent& c) {
  const Scene& scene = *part.scene;
  std::string out =
      fmt::format("<header><h3>{}</h3><span class=\"soft\">{}</span><a href=\"#scenes\">all scenes</a></header>\n",
                  escaped(scene.name), prose(scene.question));
  std::vector<Finding> shown = part.findings;
  std::erase_if(shown, [](const Finding& f) { return finding_rule(f.rule).topic == recommendation_topic; });
  out += findings_html(shown);
  if (!part.motions.empty() && !part.runs.empty()) {
    // the run recommended beside the first other engine's
    const auto other = std::ranges::find_if(part.runs, [&](const ShownRun& run) {
      return run.beside && family_of(run.method).name != family_of(part.runs[0].method).name;
    });
    out += player_html(scene.name, part.runs[0].key, other == part.runs.end() ? "truth" : other->key) +
           shown_runs_html(part, !c.lab.empty());
  }
  out += live_lab_html(scene.name);
  out += "<div class=\"charts\">\n";
  for (const PageFigure& figure : part.figures) out += figure_html(figure, c);
  out += "</div>\n" + run_table_html(part);
  if (part.statistics) out += statistics_html(*part.statistics);
  for (const Certificate* certificate : part.certificates) out += certificate_html(*certificate);
  const SceneData& facts = *part.facts;
  std::string moduli;
  if (const auto net = moduli_of(scene.model, scene.start).moduli) {
    moduli = fmt::format(" As a continuum: {}.", prose(fmt::format("{}", fmt::join(sentences_of(*net), ". "))));
    if (const std::string warning = skip_one_warning(*net); !warning.empty())
      moduli += fmt::format(" Note: {}.", prose(warning));
  }
  if (const auto bending = bending_length_of(scene.model, scene.start))
    moduli += fmt::format(" Bending: {}.", prose(sentence_of(*bending)));
  const std::string predictable =
      facts.measured_window < scene.duration * (1 - 1e-9)
          ? fmt::format("it passes a thousandfold after {:.3g} s: single positions are not predictable from there on",
                        facts.measured_window)
          : "it stays below a thousandfold over the whole run";
  return out + fmt::format(
                   "<p class=\"note\">{} Step {}, {:.3g} s of motion; pointwise comparison up to {:.3g} s, where a "
                   "perturbation of 1e-10 m has grown {}-fold; {}. Scene hash {}.{}</p>\n<p "
                   "class=\"call\"><code>crosscheck "
                   "compare {}</code></p>\n",
                   prose(scene.parameters), own_step_text(scene), scene.duration, scene.window, nice(facts.growth),
                   predictable, scene.hash, moduli, escaped(scene.name));
}

std::string scenes_html(const PageContent& c) {
  if (c.scenes.empty()) return "";
  std::string out = fmt::format(
      "<section class=\"chapter\" id=\"scenes\"><h2>Scenes</h2>\n<p class=\"answer\">{} with one "
      "question. A card opens its motion, its charts, all its runs and its certificates.</p>\n<div "
      "class=\"cards\">\n",
      c.scenes.size() == 1 ? "One scene," : fmt::format("{} scenes, each", c.scenes.size()));
  for (const ScenePart& part : c.scenes) out += card_html(part);
  out += "</div>\n";
  for (const ScenePart& part : c.scenes)
    out += fmt::format("<template data-scene=\"{}\">{}</template>\n", escaped(part.scene->name), scene_html(part, c));
  return out + "</section>\n";
}

/// "order leaves out slide, bounce: contact": notes of one experiment with the same reason as one.
std::vector<std::string> with_joined_reasons(const std::vector<std::string>& notes) {
  constexpr std::string_view verb = " leaves out ";
  std::vector<std::string> joined_notes;
  std::map<std::pair<std::string, std::string>, size_t> place;  // by experiment and reason
  for (const std::string& note : notes) {
    const size_t begins = note.find(verb), ends = note.find(": ");
    if (begins == std::string::npos || ends == std::string::npos || ends < begins) {
      joined_notes.push_back(note);
      continue;
    }
    const auto [at, is_new] = place.emplace(std::pair{note.substr(0, begins), note.substr(ends)}, joined_notes.size());
    const size_t from = begins + verb.size();
    if (is_new)
      joined_notes.push_back(note);
    else  // before the reason
      joined_notes[at->second].insert(joined_notes[at->second].size() - (note.size() - ends),
                                      ", " + note.substr(from, ends - from));
  }
  return joined_notes;
}

std::string made_html(const PageContent& c) {
  std::string out =
      "<p>The error bar of a converged truth is the difference of its two routes, or, where that is more, three times "
      "what the order at which refining goes down leaves of the last change. "
      "The second route is written apart from mysim. Data, figures and scripts lie beside this page in "
      "<code>data/</code> and <code>figures/</code>; <code>report --verify</code> recomputes every sentence from "
      "them.</p>\n";
  size_t left_to_full = 0;
  for (const std::string& note : with_joined_reasons(c.notes))
    if (!note.starts_with("this is ") && note.find("--full has ") != std::string::npos)
      ++left_to_full;
    else
      out += fmt::format("<p class=\"note\">{}.</p>\n", prose(note));
  if (left_to_full > 0)
    out += fmt::format(
        "<p class=\"note\">Runs that a report with <code>--full</code> has beside these are named in {} notes of "
        "<code>report.json</code>.</p>\n",
        left_to_full);
  // the hash of each scene stands on its card
  Provenance lines = c.provenance;
  std::erase_if(lines, [](const auto& line) { return line.first == "scene"; });
  return out + provenance_html(lines);
}

}  // namespace

std::string prose_with_bold_numbers(const std::string& text) {
  // a number that stands by itself, with its unit
  static const Pattern number(
      "(^|[ (±])(\\d+(?:\\.\\d+)?(?:<span "
      "class=\"n\">[^/]*</sup></span>)?(?:\u00a0(?:%|mm|µm|nm|ms|µs|m|s|times))?)(?![\\w</])");
  return number.replaced_in(prose(text), "$1<b>$2</b>");
}

std::string page_head(const std::string& title, const std::string& more) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, "
      "initial-scale=1\"><meta name=\"color-scheme\" content=\"light dark\"><title>{}</title>\n<style>\n{}</style>"
      "{}</head>\n<body>\n",
      escaped(title), asset("page/style.css"), more);
}

std::string provenance_html(const Provenance& lines) {
  std::string out = "<table class=\"provenance\">\n";
  for (const auto& [key, value] : lines)
    out += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"text\">{}</td></tr>\n", escaped(key), escaped(value));
  return out + "</table>";
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

/// The numbers of charts: of those in sight when the page opens, or is printed at once, as they are; the others packed.
std::string chart_numbers_html(const PageContent& c) {
  Json open = Json::object(), packed = c.charts;
  for (const std::string& figure : figures_in_sight(c)) {
    open[figure] = packed[figure];
    packed.erase(figure);
  }
  return script_json("id=\"open-charts\"", dump(open)) +
         fmt::format("<script type=\"text/plain\" id=\"charts\">{}</script>\n", base64(gzipped(dump(packed))));
}

}  // namespace

std::string page_html(const PageContent& c) {
  std::string out = page_head("Crosscheck: mysim" + beside_mysim(c), player_styles() + lab_styles()) +
                    contents_html(c) + "<main>\n" + first_screen_html(c) + changes_html(c);
  for (size_t i = 0; i < c.chapters.size(); ++i)
    if (!c.chapters[i].entries.empty() || c.chapters[i].id == "same-answer")
      out += chapter_html(c.chapters[i], i + 1, c);
  out += recommendation_table_html(c.scenes) + scenes_html(c) +
         "<section class=\"chapter\" id=\"words\"><h2>Words</h2>\n" +
         fold_html("The words that this page uses", "explained", glossary_html()) +
         fold_html("All methods", "table", methods_html(c.methods), "methods") +
         fold_html("How this was made", "provenance", made_html(c), "made") + "</section>\n</main>\n";
  out += chart_numbers_html(c);
  out += script_json("id=\"methods-data\"", dump(method_looks_json(c.methods)));
  for (const ScenePart& part : c.scenes)
    if (!part.motions.empty())
      out += script_json(fmt::format("class=\"motion\" data-scene=\"{}\"", escaped(part.scene->name)),
                         content_of_file(part.motions));
  std::map<std::string, std::set<std::string>> shown;
  for (const ScenePart* part : first_scenes(c))
    for (const ShownRun& run : part->runs)
      if (run.beside) shown[part->scene->name].insert(run.key);
  out += all_runs_html(c.runs, !c.lab.empty(), shown);
  out += c.lab;
  return out + script_element("app.js") + "</body></html>\n";
}

namespace {

Json evidence_json(const Evidence& e) { return {{"table", e.table}, {"rows", e.rows}, {"fingerprint", e.fingerprint}}; }

Json finding_json(const Finding& f, const TableSet& result, const std::vector<std::string>& figures) {
  Json json = json_of(f);
  json["figure"] = figure_of(f.rule, f.scene, figures);
  json["evidence"] = Json::array();
  for (const Evidence& e : evidence_of(f, result)) json["evidence"].push_back(evidence_json(e));
  return json;
}

}  // namespace

std::string report_json(const PageContent& page, const AllFindings& findings, const std::vector<Chart>& charts,
                        const TableSet& result, std::string_view extent) {
  Json json;
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
  return dump(json, 1) + "\n";
}

}  // namespace crosscheck
