// The page from top to bottom, and report.json.
#include "report/page/page.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/speed_accuracy/work_precision.h"
#include "mysim/base/pattern.h"
#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/base/provenance.h"
#include "report/figures/chart_json.h"
#include "report/figures/plot_layout.h"
#include "report/findings/findings_text.h"
#include "report/page/lab_html.h"
#include "report/page/player_html.h"
#include "report/page/shown_runs.h"
#include "report/page/smaller.h"
#include "report/player/packed_numbers.h"

namespace crosscheck {
namespace {

/// A figure's frame, which chart.js fills; below it what it says, and the ways to its files.
std::string figure_html(const PageFigure& figure, const PageContent& page) {
  std::string ways;
  for (const char* form : {"pdf", "csv", "gp"})
    if (std::filesystem::exists(page.figures / (figure.name + "." + form)))
      ways += fmt::format("<a href=\"figures/{}.{}\">{}</a>", escaped(figure.name), form, form);
  return fmt::format(
      "<figure class=\"chart\" id=\"figure-{0}\"{1}><div class=\"drawn\" data-chart=\"{0}\"></div><figcaption>{2}"
      "</figcaption><p class=\"ways\">{3}</p></figure>\n",
      escaped(figure.name), figure.runs.empty() ? "" : fmt::format(" data-runs=\"{}\"", escaped(figure.runs)),
      prose(figure.caption), ways);
}

/// Contents that stand in the page when they are asked for.
std::string fold_html(const std::string& heading, const std::string& kind, const std::string& contents,
                      const std::string& id = "") {
  return fmt::format(
      "<details class=\"fold\"{}><summary><span>{}</span><span class=\"kind\">{}</span></summary><template>{}"
      "</template></details>\n",
      id.empty() ? "" : fmt::format(" id=\"{}\"", id), prose(heading), kind, contents);
}

std::string findings_html(const std::vector<Finding>& findings) {
  std::string out = "<ul class=\"findings\">\n";
  for (const Finding& f : findings)
    out += fmt::format(
        "<li>{} <span class=\"tier\">{}</span></li>\n", prose(sentence_of(f)),
        tier_of(f) == "measured" || tier_of(f) == "see each scene" ? tier_of(f) : "against: " + escaped(tier_of(f)));
  return out + "</ul>\n";
}

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

}  // namespace

// The first screen.

std::vector<const ScenePart*> first_scenes(const PageContent& c) {
  const ScenePart *main = nullptr, *contact = nullptr;
  for (const ScenePart& part : c.scenes) {
    if (part.motions.empty() || part.thumbnail.empty()) continue;
    if (part.scene->name == c.main_scene || !main) main = &part;
    if (!part.scene->triangles.empty() && part.scene->model.find<Spheres>()) contact = &part;
  }
  std::vector<const ScenePart*> all;
  if (main) all.push_back(main);
  if (contact && contact != main) all.push_back(contact);
  return all;
}

namespace {

/// Whose view it is, and its error: the largest, which the player replaces by that of its time.
std::string readouts(const ScenePart& part) {
  const SceneData& facts = *part.facts;
  std::string out = "<div class=\"readouts\">";
  const auto add = [&](const std::string& whose, const std::string& value) {
    out += fmt::format("<span><span class=\"whose\">{}</span>{}</span>", prose(whose), value);
  };
  for (const ShownRun& run : part.runs)
    if (run.beside)
      add(fmt::format("{}{}, {}", family_of(run.method).is_subject() ? "mysim " : "", reader_name(run.method),
                      run.setting),
          !run.error ? "–"
                     : fmt::format("<span data-key=\"{}\" data-method=\"{}\"><b>{}</b> {}</span>", escaped(run.key),
                                   escaped(run.method), prose(nice_length(*run.error)),
                                   facts.tier.empty() ? "from that limit"
                                   : facts.motion > 0 ? percent(*run.error, facts.motion) + " off"
                                                      : "off"));
  if (!facts.tier.empty())
    add("truth", fmt::format("<b>± {}</b> {}", prose(nice_length(facts.error_bar)), escaped(facts.tier)));
  else if (facts.contact_until)
    add("the contact rule's limit", "as the step goes to zero");
  return out + "</div>\n";
}

std::string hero_html(const PageContent& c) {
  std::string out;
  for (const ScenePart* part : first_scenes(c)) {
    Json keys = Json::list();
    std::vector<std::string> names;
    for (const ShownRun& run : part->runs)
      if (run.beside) keys.push(run.key), names.push_back(run.method);
    if (!part->facts->tier.empty() || part->facts->contact_until) keys.push("truth"), names.emplace_back("truth");
    out += fmt::format(
        "<div class=\"views\"><div class=\"stage\">{}</div><span class=\"where\">{}</span><motion-player "
        "data-scene=\"{}\" data-shown=\"{}\"></motion-player></div>\n{}",
        image_tag({part->hero.empty() ? part->thumbnail : part->hero,
                   fmt::format("{} by {}", part->scene->name, joined(names)), ""}),
        escaped(part->scene->name), escaped(part->scene->name), escaped(keys.dump()), readouts(*part));
  }
  if (out.empty()) return "";
  return "<figure class=\"hero\">" + out +
         "<div class=\"clockwork\"><button type=\"button\" aria-label=\"Play\">▶</button><input type=\"range\" "
         "min=\"0\" "
         "max=\"1000\" value=\"0\" aria-label=\"time\"><span class=\"clock\"></span></div>" +
         live_lab_html(c.main_scene) + "</figure>\n";
}

std::string certificates_matched(const PageContent& c) {
  size_t all = 0, matched = 0;
  const auto read_back = [](const CertificateRow& row) { return row.parity == Parity::match; };
  for (const ScenePart& part : c.scenes)
    for (const Certificate* certificate : part.certificates)
      ++all, matched += !certificate->mismatch() && std::ranges::any_of(certificate->rows, read_back);
  return all == 0 ? "chapter" : fmt::format("certificate, {} of {}", matched, all);
}

/// Whether that chapter shows anything; the first one has the certificates.
bool has_contents(const PageContent& c, std::string_view chapter) {
  const auto at = std::ranges::find(c.chapters, chapter, &Chapter::id);
  return chapter == "same-answer" || (at != c.chapters.end() && !at->entries.empty());
}

/// " beside Bullet and mine": the engines that the scenes were run by.
std::string beside_mysim(const PageContent& c) {
  std::vector<std::string> names;
  for (const ScenePart& part : c.scenes)
    for (const MethodData& m : part.facts->methods)
      if (const std::string name = name_in_sentence(engine_of(m.method));
          is_rival(m.method) && std::ranges::find(names, name) == names.end())
        names.push_back(name);
  return names.empty() ? "" : " beside " + joined(names);
}

std::string first_screen(const PageContent& c) {
  std::string out = "<section class=\"first\" id=\"top\">\n" + hero_html(c) +
                    "<div class=\"questions\"><h1>Two engines, the same scene: which answer can you trust?</h1>\n"
                    "<p>Crosscheck runs its engine mysim" +
                    escaped(beside_mysim(c)) +
                    ", from the same particles and springs, against a "
                    "known answer.</p>\n";
  for (const Question& question : questions())
    if (const Finding* answer = answer_to(question, c.findings))
      out += fmt::format("<div class=\"question\"><h3><span>{}</span><a href=\"#{}\">{} →</a></h3><p>{}</p></div>\n",
                         question.text_before(*answer), has_contents(c, question.chapter) ? question.chapter : "scenes",
                         question.chapter == "same-answer" ? certificates_matched(c) : std::string(question.link),
                         prose_with_bold_numbers(sentence_of(*answer)));
  for (const std::string& problem : c.problems)
    out += fmt::format("<p class=\"problem\">Missing: {}</p>\n", escaped(problem));
  return out + "</div></section>\n";
}

// Chapters.

bool matches(const std::string& name, const std::string& pattern) {
  const size_t star = pattern.find('*');
  if (star == std::string::npos) return name == pattern;
  return name.size() + 1 >= pattern.size() && name.starts_with(pattern.substr(0, star)) &&
         name.ends_with(pattern.substr(star + 1));
}

/// A figure that opens a chapter.
struct Lead {
  const Chapter::Entry* entry;
  size_t figure;       // of the entry's
  std::string choice;  // what its name has in place of the pattern's star
};

/// The figures of the first pattern that any has; that of the main scene before the others.
std::vector<Lead> leads_of(const Chapter& chapter, const PageContent& c) {
  for (const std::string& pattern : chapter.leads) {
    std::vector<Lead> leads;
    for (const Chapter::Entry& entry : chapter.entries)
      for (size_t i = 0; i < entry.figures.size(); ++i)
        if (const std::string& name = entry.figures[i].name; matches(name, pattern))
          leads.push_back({&entry, i, name.substr(0, name.size() + 1 - std::min(name.size() + 1, pattern.size()))});
    std::ranges::stable_partition(leads, [&](const Lead& lead) { return lead.choice == c.main_scene; });
    if (!leads.empty()) return leads;
  }
  return {};
}

/// One of them at a time, with buttons to choose.
std::string leads_html(const std::vector<Lead>& leads, const PageContent& c) {
  std::string out;
  if (leads.size() > 1) {
    out += "<div class=\"choices\">";
    for (const Lead& lead : leads)
      out += fmt::format("<button type=\"button\" data-figure=\"figure-{}\" aria-pressed=\"{}\">{}</button>",
                         escaped(lead.entry->figures[lead.figure].name), &lead == &leads.front(), escaped(lead.choice));
    out += "</div>\n";
  }
  for (const Lead& lead : leads) {
    std::string figure = figure_html(lead.entry->figures[lead.figure], c);
    if (&lead != &leads.front()) figure.insert(std::string_view("<figure").size(), " hidden");
    out += figure;
  }
  return out;
}

std::string entry_html(const Chapter::Entry& entry, const PageContent& c) {
  std::string out = entry.text.empty() ? "" : fmt::format("<p class=\"soft\">{}</p>\n", prose(entry.text));
  for (const PageFigure& figure : entry.figures) out += figure_html(figure, c);
  for (const PageImage& image : entry.images)
    if (std::filesystem::exists(image.file)) out += image_html(image, "render");  // why not, is among the problems
  for (const PageTable& table : entry.tables) out += page_table_html(table);
  return out;
}

/// Pictures in a row, and the chart that belongs to them beside them.
std::string shown_html(const Chapter::Entry& entry, const PageContent& c) {
  std::string pictures;
  for (const PageImage& image : entry.images)
    if (std::filesystem::exists(image.file)) pictures += image_html(image, "render");
  for (const PageFigure& figure : entry.figures) pictures += figure_html(figure, c);
  return fmt::format("<h3>{}</h3>\n{}\n", prose(entry.heading),
                     entry.images.empty() ? "<div class=\"lead\"><div>" + pictures + "</div></div>"
                                          : "<div class=\"moments\">" + pictures + "</div>");
}

std::string kind_of(const Chapter::Entry& entry) {
  return !entry.figures.empty() ? "chart" : !entry.images.empty() ? "picture" : "table";
}

/// The drawing of a lead figure for readers without JavaScript, unchanged.
std::string drawing_without_script(const PageFigure& lead, const PageContent& c) {
  const std::filesystem::path file = c.figures / (lead.name + ".svg");
  if (!std::filesystem::exists(file)) return "";
  return "<noscript>" + svg_element(content_of_file(file), lead.title) + "</noscript>";
}

/// "{critical}" in a formula becomes the fastest frequency and the critical step of the main scene, where both are
/// known: leapfrog's limit is 2 / omega, whatever the drag.
std::string with_critical_step(std::string formula, const PageContent& c) {
  static constexpr std::string_view mark = "{critical}";
  const size_t at = formula.find(mark);
  if (at == std::string::npos) return formula;
  std::string text;
  for (const ScenePart& part : c.scenes) {
    const MethodData* m = part.facts->find(subject_method(is_symplectic_of_second_order));
    if (part.scene->name == c.main_scene && m && m->limit && *m->limit > 0)
      text = fmt::format(". On {}, as it starts: <em>ω</em> = {:.3g} /s, so <em>h</em> &lt; {:.3g} ms",
                         escaped(c.main_scene), 2 / *m->limit, 1e3 * *m->limit);
  }
  return formula.replace(at, mark.size(), text);
}

/// Links to the guided experiments of the lab that belong to a chapter.
std::string experiments_html(const Chapter& chapter) {
  std::string links;
  for (const auto& [name, title] : chapter.experiments)
    links += fmt::format("{}<a href=\"#experiment={}\">{}</a>", links.empty() ? "" : ", ", name, escaped(title));
  return links.empty() ? "" : fmt::format("<p class=\"try\">Try it in the lab: {}.</p>", links);
}

std::string chapter_html(const Chapter& chapter, size_t number, const PageContent& c) {
  std::string out =
      fmt::format("<section class=\"chapter\" id=\"{}\">\n<p class=\"of\">Chapter {} of {}</p><h2>{}</h2>\n",
                  chapter.id, number, c.chapters.size(), prose(chapter.title));
  const auto question = std::ranges::find(questions(), chapter.id, &Question::chapter);
  if (const Finding* answer = question == questions().end() ? nullptr : answer_to(*question, c.findings))
    out += fmt::format("<p class=\"answer\">{}</p>\n", prose_with_bold_numbers(sentence_of(*answer)));
  const std::vector<Lead> leads = leads_of(chapter, c);
  const bool contact =
      std::ranges::any_of(c.scenes, [](const ScenePart& part) { return part.scene->model.find<Spheres>(); });
  const std::string formula = chapter.formula + (contact ? chapter.contact_formula : "");
  // a certificate of a few scenes is a few lines high: the text stands below it
  const bool is_short = chapter.id == "same-answer" && leads.empty() && c.scenes.size() <= 4;
  out += fmt::format("<div class=\"lead{}\"><div>", is_short ? " short" : "");
  if (chapter.id == "same-answer") out += parity_html(c.scenes);
  if (!leads.empty()) out += leads_html(leads, c) + drawing_without_script(leads[0].entry->figures[leads[0].figure], c);
  out += fmt::format(
      "</div><div class=\"teach\">{}{}{}</div></div>\n",
      formula.empty() ? "" : fmt::format("<div class=\"formula\">{}</div>", with_critical_step(formula, c)),
      chapter.teaching + (contact ? chapter.contact_teaching : ""), c.lab.empty() ? "" : experiments_html(chapter));
  for (const Chapter::Entry& entry : chapter.entries)
    if (entry.shown) out += shown_html(entry, c);
  std::string folds;
  std::vector<Finding> said;
  for (const Finding& f : c.findings)
    if (const FindingRule& rule = finding_rule(f.rule);
        rule.topic != "answer" &&
        (rule.chapter == chapter.id || std::ranges::find(chapter.joins, rule.chapter) != chapter.joins.end()))
      said.push_back(f);
  if (!said.empty())
    folds += fold_html("What was found", fmt::format("{} finding{}", said.size(), said.size() == 1 ? "" : "s"),
                       findings_html(said));
  if (chapter.id == "same-answer" && !c.relations.empty())
    folds += fold_html("What must hold without any truth", "table", relations_html(c.relations), "relations");
  for (const Chapter::Entry& entry : chapter.entries) {
    if (entry.shown) continue;
    Chapter::Entry rest = entry;
    if (const auto lead = std::ranges::find(leads, &entry, &Lead::entry); lead != leads.end()) {
      rest.figures.erase(rest.figures.begin() + static_cast<long>(lead->figure)), rest.text.clear();
      if (rest.figures.empty() && rest.images.empty() && rest.tables.empty()) continue;
    }
    folds += fold_html(entry.heading, kind_of(rest), entry_html(rest, c));
  }
  return out + (folds.empty() ? "" : "<div class=\"folds\">\n" + folds + "</div>\n") + "</section>\n";
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
  const std::string predictable =
      facts.measured_window < scene.duration * (1 - 1e-9)
          ? fmt::format("it passes a thousandfold after {:.3g} s: single positions are not predictable from there on",
                        facts.measured_window)
          : "it stays below a thousandfold over the whole run";
  return out +
         fmt::format(
             "<p class=\"note\">{} Step {}, {:.3g} s of motion; pointwise comparison up to {:.3g} s, where a "
             "perturbation of 1e-10 m has grown {}-fold; {}. Scene hash {}.</p>\n<p class=\"call\"><code>./crosscheck "
             "compare {}</code></p>\n",
             prose(scene.parameters), own_step_text(scene), scene.duration, scene.window, nice(facts.growth),
             predictable, scene.hash, escaped(scene.name));
}

std::string scenes_html(const PageContent& c) {
  if (c.scenes.empty()) return "";
  std::string out = fmt::format(
      "<section class=\"chapter\" id=\"scenes\"><h2>Scenes</h2>\n<p class=\"answer\">{} scene{}, each with one "
      "question. A card opens its motion, its charts, all its runs and its certificates.</p>\n<div "
      "class=\"cards\">\n",
      c.scenes.size(), c.scenes.size() == 1 ? "" : "s");
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
      "what the order at which refining goes down leaves of the last change. A difference is the distance between two "
      "engines, or from what the in-house contact rule converges to. The second route is odeint's extrapolation on a "
      "right-hand side written apart from mysim's. Data, figures and scripts lie beside this page in "
      "<code>data/</code> and <code>figures/</code>; <code>report --verify</code> recomputes every sentence from "
      "them.</p>\n";
  for (const std::string& note : with_joined_reasons(c.notes))
    out += fmt::format("<p class=\"note\">{}.</p>\n", prose(note));
  return out + provenance_html(c.provenance);
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

bool opens_a_chapter(const PageContent& c, const std::string& figure) {
  return std::ranges::any_of(c.chapters, [&](const Chapter& chapter) {
    const std::vector<Lead> leads = leads_of(chapter, c);
    return !leads.empty() && leads[0].entry->figures[leads[0].figure].name == figure;
  });
}

namespace {

/// The numbers of charts: of those in sight when the page opens, or is printed at once, as they are; the others packed.
std::string chart_numbers_html(const PageContent& c) {
  Json open = Json::object(), packed = c.charts;
  std::vector<std::string> shown;
  const auto show = [&](const std::string& figure) {
    if (std::ranges::find(shown, figure) != shown.end()) return;
    shown.push_back(figure);
    open[figure] = packed[figure];
    packed.erase(figure);
  };
  for (const Chapter& chapter : c.chapters) {
    if (const std::vector<Lead> leads = leads_of(chapter, c); !leads.empty())
      show(leads[0].entry->figures[leads[0].figure].name);
    for (const Chapter::Entry& entry : chapter.entries)
      for (const PageFigure& figure : entry.figures)
        if (entry.shown) show(figure.name);
  }
  return script_json("id=\"open-charts\"", open.dump()) +
         fmt::format("<script type=\"text/plain\" id=\"charts\">{}</script>\n", base64(gzipped(packed.dump())));
}

}  // namespace

std::string page_html(const PageContent& c) {
  std::string out = page_head("Crosscheck: mysim" + beside_mysim(c), player_styles() + lab_styles()) +
                    contents_html(c) + "<main>\n" + first_screen(c) + changes_html(c);
  for (size_t i = 0; i < c.chapters.size(); ++i)
    if (!c.chapters[i].entries.empty() || c.chapters[i].id == "same-answer")
      out += chapter_html(c.chapters[i], i + 1, c);
  out += recommendation_table_html(c.scenes) + scenes_html(c) +
         "<section class=\"chapter\" id=\"words\"><h2>Words</h2>\n" +
         fold_html("The words that this page uses", "explained", glossary_html()) +
         fold_html("All methods", "table", methods_html(), "methods") +
         fold_html("How this was made", "provenance", made_html(c), "made") + "</section>\n</main>\n";
  out += chart_numbers_html(c);
  out += script_json("id=\"methods-data\"", method_looks_json(c.methods).dump());
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
  return out + player_scripts() + "<script>\n" +
         script_without_comments(asset("page/chart.js") + asset("page/page.js")) + "</script>\n</body></html>\n";
}

namespace {

Json evidence_json(const Evidence& e) { return {{"table", e.table}, {"rows", e.rows}, {"fingerprint", e.fingerprint}}; }

Json finding_json(const Finding& f, const TableSet& result, const std::vector<std::string>& figures) {
  Json json = json_of(f);
  json["figure"] = figure_of(f.rule, f.scene, figures);
  json["evidence"] = Json::list();
  for (const Evidence& e : evidence_of(f, result)) json["evidence"].push(evidence_json(e));
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
  json["findings"] = Json::list();
  for (const Finding* f : findings.each()) json["findings"].push(finding_json(*f, result, figures));
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
