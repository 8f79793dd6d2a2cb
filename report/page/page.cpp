// The page from top to bottom, and report.json.
#include "report/page/page.h"

#include <fmt/format.h>

#include <algorithm>

#include "mysim/base/json.h"
#include "report/base/assets.h"
#include "report/base/provenance.h"
#include "report/findings/evidence.h"
#include "report/page/inline_svg.h"
#include "report/page/player_html.h"

namespace crosscheck {
namespace {

/// Sentences with their tiers, each with a way to what shows it.
std::string finding_list(const std::vector<Finding>& findings, const std::vector<std::string>& figures,
                         const std::string& css_class) {
  std::string out = fmt::format("<ul class=\"{}\">\n", css_class);
  for (const Finding& f : findings) {
    const std::string figure = figure_of(f.rule, f.scene, figures);
    const std::string link = !figure.empty()     ? fmt::format("; <a href=\"#figure-{}\">figure</a>", escaped(figure))
                             : !f.scene.empty()  ? ""
                             : f.chapter.empty() ? "; <a href=\"#scenes\">scenes</a>"
                                                 : fmt::format("; <a href=\"#{}\">figures</a>", f.chapter);
    out +=
        fmt::format("<li class=\"{}\">{} <span class=\"tier\">{}{}</span></li>\n", f.topic, prose(f.sentence),
                    f.tier == "measured" || f.tier == "see each scene" ? f.tier : "against: " + escaped(f.tier), link);
  }
  return out + "</ul>\n";
}

/// The findings on the front: those of no chapter, and the first of each chapter.
std::vector<Finding> front_of(const std::vector<Finding>& findings) {
  std::vector<Finding> front;
  for (const Finding& f : findings)
    if (f.chapter.empty() ||
        std::none_of(front.begin(), front.end(), [&](const Finding& other) { return other.chapter == f.chapter; }))
      front.push_back(f);
  return front;
}

std::vector<Finding> of_chapter(const std::vector<Finding>& findings, const std::string& id) {
  std::vector<Finding> own;
  for (const Finding& f : findings)
    if (f.chapter == id) own.push_back(f);
  return own;
}

/// A question and the findings that answer it: of a chapter, or of a topic where they have none.
struct Question {
  const char* text;
  std::vector<std::string> topics, chapters;
  bool answered_by(const Finding& f) const {
    const std::vector<std::string>& asked = f.chapter.empty() ? topics : chapters;
    return std::find(asked.begin(), asked.end(), f.chapter.empty() ? f.topic : f.chapter) != asked.end();
  }
};
const std::vector<Question>& questions() {
  static const std::vector<Question> all = {{"Do they agree?", {"agreement", "contact"}, {"sphere"}},
                                            {"Who is more accurate?", {"accuracy", "order"}, {}},
                                            {"Who is faster?", {"cost"}, {"speed-accuracy", "cost"}},
                                            {"Where does each fail?", {"failure"}, {"stability", "disagreements"}},
                                            {"Who keeps the energy?", {"energy"}, {"energy"}},
                                            {"How little model is enough?", {"adequacy"}, {"adequacy"}}};
  return all;
}

/// The changes against an earlier report.
std::string changes_html(const PageContent& c) {
  if (c.against.empty()) return "";
  std::string out = fmt::format("<section id=\"changes\"><h2>What changed since {}</h2>\n", escaped(c.against));
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

/// Contact is where engines differ most: the picture of its chapter, where there is one.
const PageImage* front_picture(const PageContent& c) {
  for (const Chapter& chapter : c.chapters)
    for (const Chapter::Entry& entry : chapter.entries)
      for (const PageImage& image : entry.images)
        if (chapter.id == "sphere" && image.file.extension() == ".png") return &image;
  return c.hero.empty() ? nullptr : &c.hero[0];
}

std::string first_screen(const PageContent& c) {
  std::string out =
      "<header><h1>Crosscheck: mysim beside Bullet</h1>\n<p class=\"lead\">An in-house mass-spring and cloth engine "
      "beside Bullet's soft bodies, each built from the same particles and springs.</p></header>\n" +
      contents_html(c) + "<main>\n";
  if (!c.scenes.empty()) out += recommendation_table_html(c.scenes);
  out += "<section class=\"answer\"><div class=\"questions\">\n";
  const std::vector<Finding> front = front_of(c.findings);
  // the picture ends the left column
  size_t before_picture = 2;
  for (const Question& question : questions()) {
    std::vector<Finding> answers;
    for (const Finding& f : front)
      if (question.answered_by(f)) answers.push_back(f);
    if (!answers.empty())
      out +=
          fmt::format("<div><h2>{}</h2>\n{}</div>\n", question.text, finding_list(answers, figures_of(c), "findings"));
    if (--before_picture == 0)
      if (const PageImage* picture = front_picture(c)) out += image_html(*picture, "hero");
  }
  out += "</div>\n";
  for (const std::string& problem : c.problems)
    out += fmt::format("<p class=\"problem\">Missing: {}</p>\n", escaped(problem));
  out += "<div class=\"heroes\">\n";
  for (size_t i = 1; i < c.hero.size(); ++i) out += image_html(c.hero[i], "hero");
  return out + "</div></section>\n" + changes_html(c);
}

std::string scene_section(const ScenePart& part, const std::vector<std::string>& figures) {
  const Scene& scene = *part.scene;
  std::string out = fmt::format("<section class=\"scene\" id=\"{0}\">\n<h2>{0}</h2>\n<p class=\"question\">{1}</p>\n",
                                escaped(scene.name), prose(scene.question));
  std::vector<Finding> shown = part.findings;
  std::erase_if(shown, [](const Finding& f) { return f.topic == recommendation_topic; });  // its table has it
  out += finding_list(shown, figures, "findings");
  for (const PageImage& image : part.pictures)
    out += &image == part.pictures.data() && !part.motions.empty() ? player_html(image, part.motions)
                                                                   : image_html(image, "render");
  out += "<div class=\"figures\">\n";
  for (const PageImage& image : part.figures) out += image_html(image, "chart");
  out += "</div>\n" + run_table_html(part);
  if (part.statistics) out += statistics_html(*part.statistics);
  for (const Certificate* certificate : part.certificates) out += certificate_html(*certificate);
  const SceneData& facts = *part.facts;
  const std::string predictable =
      facts.measured_window < scene.duration * (1 - 1e-9)
          ? fmt::format("it passes a thousandfold after {:.3g} s: single positions are not predictable from there on",
                        facts.measured_window)
          : "it stays below a thousandfold over the whole run";
  out += fmt::format(
      "<p class=\"parameters\"><b>Parameters.</b> {} Step {}, {:.3g} s of motion; pointwise comparison up to {:.3g} "
      "s, where a perturbation of 1e-10 m has grown {}-fold; {}. Scene hash {}.</p>\n</section>\n",
      prose(scene.parameters), own_step_text(scene), scene.duration, scene.window, nice(facts.growth), predictable,
      scene.hash);
  return out;
}

std::string chapter_section(const Chapter& chapter, const std::vector<Finding>& findings,
                            const std::vector<std::string>& figures) {
  std::string out = fmt::format("<section class=\"chapter\" id=\"{}\">\n<h2>{}</h2>\n<p class=\"question\">{}</p>\n",
                                chapter.id, prose(chapter.title), prose(chapter.intro));
  if (const auto own = of_chapter(findings, chapter.id); !own.empty()) out += finding_list(own, figures, "findings");
  out += "<div class=\"figures\">\n";
  for (const Chapter::Entry& entry : chapter.entries) {
    // a long table with nothing above it is open, and has the whole width
    const bool wide = entry.images.empty() && std::any_of(entry.tables.begin(), entry.tables.end(),
                                                          [](const PageTable& t) { return t.rows.size() > 6; });
    out += fmt::format("<article{}><h3>{}</h3><p>{}</p>\n", wide ? " class=\"wide\"" : "", prose(entry.heading),
                       prose(entry.text));
    for (const PageImage& image : entry.images)
      out += image_html(image, image.file.extension() == ".png" ? "render" : "chart");
    for (const PageTable& table : entry.tables) out += page_table_html(table, entry.images.empty());
    out += "</article>\n";
  }
  return out + "</div>\n</section>\n";
}

}  // namespace

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
  const auto add = [&](const std::vector<PageImage>& images) {
    for (const PageImage& image : images)
      if (image.file.extension() == ".svg") names.push_back(image.file.stem().string());
  };
  add(c.hero);
  for (const ScenePart& part : c.scenes) add(part.figures);
  for (const Chapter& chapter : c.chapters)
    for (const Chapter::Entry& entry : chapter.entries) add(entry.images);
  return names;
}

std::string page_html(const PageContent& c) {
  const std::vector<std::string> figures = figures_of(c);
  const bool plays = !c.runs.empty() || std::any_of(c.scenes.begin(), c.scenes.end(),
                                                    [](const ScenePart& part) { return !part.motions.empty(); });
  std::string out = page_head("Crosscheck: mysim beside Bullet", plays ? player_head() : "") + first_screen(c);
  for (const Chapter& chapter : c.chapters)
    if (!chapter.entries.empty()) out += chapter_section(chapter, c.findings, figures);
  for (const ScenePart& part : c.scenes) out += scene_section(part, figures);

  out +=
      glossary_html() +
      "<section class=\"made\" id=\"made\"><h2>How this was made</h2>\n<p>The error bar of a converged truth is the "
      "difference of its two routes, or, where that is more, three times what the order at which refining goes down "
      "leaves of the last change. A difference is the "
      "distance between two engines, or from what the in-house contact rule converges to. Data, figures and scripts "
      "lie beside this page in <code>data/</code> and <code>figures/</code>; <code>report --verify</code> recomputes "
      "every sentence from them.</p>\n";
  out += "<p>The second route is odeint's extrapolation on a right-hand side written apart from mysim's.</p>\n";
  for (const std::string& note : c.notes) out += fmt::format("<p class=\"note\">Note: {}.</p>\n", prose(note));
  out += provenance_html(c.provenance) + "</section>\n</main>\n";
  for (const PlayableRuns& runs : c.runs) out += runs_html(runs);
  return deduplicate_pictures(
      deduplicate_markers(out + "<script>\n" + asset("page/page.js") + "</script>\n</body></html>\n"));
}

namespace {

Json evidence_json(const Evidence& e) { return {{"table", e.table}, {"rows", e.rows}, {"fingerprint", e.fingerprint}}; }

Json finding_json(const Finding& f, const Rows& result, const std::vector<std::string>& figures) {
  Json json = {{"scene", f.scene},       {"topic", f.topic},
               {"sentence", f.sentence}, {"tier", f.tier},
               {"chapter", f.chapter},   {"figure", figure_of(f.rule, f.scene, figures)},
               {"rule", f.rule},         {"formula", finding_rule(f.rule).formula}};
  json["evidence"] = Json::list();
  for (const Evidence& e : evidence_of(f, result)) json["evidence"].push(evidence_json(e));
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
        {"hash", part.scene->hash}, {"truth", part.facts->tier}, {"truth_bar", part.facts->error_bar}};
  json["tables"] = Json::list();
  for (const Table& table : result.tables) {
    const Evidence whole = evidence_of(table);
    json["tables"].push({{"name", whole.table}, {"rows", whole.rows.size()}, {"fingerprint", whole.fingerprint}});
  }
  json["figures"] = Json::list();
  for (const Chart& c : charts)
    if (const FigureInfo* f = figure_info(c))
      json["figures"].push(
          {{"name", f->name}, {"scene", c.scene}, {"caption", f->caption}, {"tier", f->tier}, {"finding", f->finding}});
  json["notes"] = page.notes;
  json["problems"] = page.problems;
  return json.dump(1) + "\n";
}

}  // namespace crosscheck
