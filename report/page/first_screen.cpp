#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "experiments/speed_accuracy/work_precision.h"
#include "reference/engines/engines.h"
#include "report/figures/plot_layout.h"
#include "report/findings/findings_text.h"
#include "report/page/page_parts.h"

namespace crosscheck {

std::vector<const ScenePart*> first_scenes(const PageContent& c) {
  const ScenePart *main = nullptr, *contact = nullptr;
  for (const ScenePart& part : c.scenes) {
    if (part.motions.empty() || part.thumbnail.empty()) continue;
    if (part.scene->name == c.main_scene || !main) main = &part;
    if (!part.scene->triangles.empty() && has_contact(part.scene->model)) contact = &part;
  }
  std::vector<const ScenePart*> all;
  if (main) all.push_back(main);
  if (contact && contact != main) all.push_back(contact);
  return all;
}

namespace {

/// Method and largest error of each run in a view. While the view plays, it shows the current error instead.
Json readouts_data(const ScenePart& part) {
  const SceneData& facts = *part.facts;
  Json all = Json::array();
  const auto add = [&](const std::string& whose, const std::string& value, const std::string& note) -> Json& {
    return all.emplace_back(Json{{"whose", whose}, {"value", value}, {"note", note}, {"key", ""}, {"method", ""}});
  };
  std::vector<std::string> methods;
  for (const ShownRun& run : part.runs) methods.push_back(run.method);
  for (const ShownRun& run : part.runs) {
    if (!run.beside) continue;
    Json& readout = add(fmt::format("{}, {}", engine_and_reader_name(run.method, methods), run.setting),
                        run.error ? nice_length(*run.error) : "",
                        !run.error           ? "–"
                        : facts.tier.empty() ? "from that limit"
                        : facts.motion > 0   ? percent(*run.error, facts.motion) + " off"
                                             : "off");
    if (run.error) readout["key"] = run.key, readout["method"] = run.method;
  }
  if (!facts.tier.empty())
    add("reference solution", "± " + nice_length(facts.error_bar),
        facts.tier + (facts.truth_until ? ", until " + step_text(*facts.truth_until) : ""));
  else if (facts.contact_until)
    add("the contact rule's limit", "", "as the step goes to zero");
  return all;
}

Json view_data(const ScenePart& part) {
  Json keys = Json::array();
  std::vector<std::string> names;
  std::string difference;
  for (const ShownRun& run : part.runs)
    if (run.beside) {
      keys.push_back(run.key), names.push_back(without_folders(run.method));
      if (difference.empty()) difference = run.difference;
    }
  if (!part.facts->tier.empty() || part.facts->contact_until) keys.push_back("truth"), names.emplace_back("truth");
  return {{"scene", part.scene->name},
          {"shown", dump(keys)},
          {"difference", difference},
          {"still", image_data({part.hero.empty() ? part.thumbnail : part.hero,
                                fmt::format("{} by {}", part.scene->name, joined(names)), ""})},
          {"readouts", readouts_data(part)}};
}

std::string certificates_matched(const PageContent& c) {
  size_t all = 0, matched = 0;
  const auto read_back = [](const CertificateRow& row) { return row.parity == Parity::match; };
  for (const ScenePart& part : c.scenes)
    for (const Certificate* certificate : part.certificates)
      ++all, matched += !certificate->mismatch() && std::ranges::any_of(certificate->rows, read_back);
  return all == 0 ? "chapter" : fmt::format("certificate, {} of {}", matched, all);
}

}  // namespace

std::string engine_and_reader_name(const std::string& method, const std::vector<std::string>& among) {
  const MethodFamily& family = family_of(method);
  if (family.role == Role::outside) return program_title(method, among);  // a program's name may contain spaces
  return (family.is_subject() ? "mysim " : "") + reader_name(method, among);
}

std::string beside_mysim(const PageContent& c) {
  std::vector<std::string> names;
  for (const ScenePart& part : c.scenes)
    for (const MethodData& m : part.facts->methods)
      if (is_rival(m.method)) add_once(names, name_in_sentence(engine_of(m.method)));
  return names.empty() ? "" : " next to " + joined(names);
}

Json first_screen_data(const PageContent& c) {
  Json views = Json::array(), asked = Json::array();
  for (const ScenePart* part : first_scenes(c)) views.push_back(view_data(*part));
  for (const Question& question : questions()) {
    const Finding* answer = answer_to(question, c.findings);
    if (!answer) continue;
    const auto chapter = std::ranges::find(c.chapters, question.chapter, &Chapter::id);
    const bool leads = chapter != c.chapters.end() && has_contents(*chapter);
    asked.push_back({{"text", std::string(question.text)},
                     {"target", leads ? question.chapter : "scenes"},
                     {"link", question.chapter == "same-answer" ? certificates_matched(c) : std::string(question.link)},
                     {"answer", sentence_of(*answer)}});
  }
  return {{"views", std::move(views)},
          {"lab_scene", c.lab.empty() ? "" : c.main_scene},
          {"beside", beside_mysim(c)},
          {"questions", std::move(asked)},
          {"problems", c.problems}};
}

}  // namespace crosscheck
