// The first screen: what moves, and an answer to each question.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "experiments/speed_accuracy/work_precision.h"
#include "report/figures/plot_layout.h"
#include "report/findings/findings_text.h"
#include "report/page/lab_html.h"
#include "report/page/page_parts.h"
#include "report/page/shown_runs.h"

namespace crosscheck {

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
  std::vector<std::string> methods;
  for (const ShownRun& run : part.runs) methods.push_back(run.method);
  for (const ShownRun& run : part.runs)
    if (run.beside)
      add(fmt::format("{}{}, {}", family_of(run.method).is_subject() ? "mysim " : "", reader_name(run.method, methods),
                      run.setting),
          !run.error ? "–"
                     : fmt::format("<span data-key=\"{}\" data-method=\"{}\"><b>{}</b> {}</span>", escaped(run.key),
                                   escaped(run.method), prose(nice_length(*run.error)),
                                   facts.tier.empty() ? "from that limit"
                                   : facts.motion > 0 ? percent(*run.error, facts.motion) + " off"
                                                      : "off"));
  if (!facts.tier.empty())
    add("truth", fmt::format("<b>± {}</b> {}{}", prose(nice_length(facts.error_bar)), escaped(facts.tier),
                             facts.truth_until ? ", until " + step_text(*facts.truth_until) : ""));
  else if (facts.contact_until)
    add("the contact rule's limit", "as the step goes to zero");
  return out + "</div>\n";
}

std::string hero_html(const PageContent& c) {
  std::string out;
  for (const ScenePart* part : first_scenes(c)) {
    Json keys = Json::array();
    std::vector<std::string> names;
    for (const ShownRun& run : part->runs)
      if (run.beside) keys.push_back(run.key), names.push_back(run.method);
    if (!part->facts->tier.empty() || part->facts->contact_until) keys.push_back("truth"), names.emplace_back("truth");
    out += fmt::format(
        "<div class=\"views\"><div class=\"stage\">{}</div><span class=\"where\">{}</span><motion-player "
        "data-scene=\"{}\" data-shown=\"{}\"></motion-player></div>\n{}",
        image_tag({part->hero.empty() ? part->thumbnail : part->hero,
                   fmt::format("{} by {}", part->scene->name, joined(names)), ""}),
        escaped(part->scene->name), escaped(part->scene->name), escaped(dump(keys)), readouts(*part));
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

}  // namespace

std::string beside_mysim(const PageContent& c) {
  std::vector<std::string> names;
  for (const ScenePart& part : c.scenes)
    for (const MethodData& m : part.facts->methods)
      if (const std::string name = name_in_sentence(engine_of(m.method));
          is_rival(m.method) && std::ranges::find(names, name) == names.end())
        names.push_back(name);
  return names.empty() ? "" : " beside " + joined(names);
}

std::string first_screen_html(const PageContent& c) {
  std::string out = "<section class=\"first\" id=\"top\">\n" + hero_html(c) +
                    "<div class=\"questions\"><h1>One scene, several engines: which answer can you trust?</h1>\n"
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

}  // namespace crosscheck
