// report: the main job. Runs the experiments, draws figures and pictures, writes data, report.json and the page.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "experiments/scenes.h"
#include "mysim/errors.h"
#include "mysim/files.h"
#include "report/certificate_json.h"
#include "report/commands/commands.h"
#include "report/findings_text.h"
#include "report/page/page.h"
#include "report/pictures.h"
#include "report/provenance.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

/// Files of an earlier report in the same folder would pass for this one's.
void clear_former_report(const fs::path& out) {
  if (!fs::exists(out / "report.json")) return;
  for (const char* part : {"data", "figures"}) fs::remove_all(out / part);
}

void write_data(const Result& result, const Provenance& lines, const fs::path& folder) {
  for (const Table& table : result.tables) write_csv(table, lines, folder);
  for (const Certificate& c : result.certificates)
    write_file(folder / fmt::format("certificate-{}-{}.json", c.scene, file_name_of(c.method)), certificate_json(c));
}

nlohmann::ordered_json finding_json(const Finding& f) {
  return {{"scene", f.scene}, {"topic", f.topic}, {"sentence", f.sentence}, {"tier", f.tier}};
}

std::string report_json(const PageContent& page, const std::vector<Chart>& charts) {
  nlohmann::ordered_json json;
  for (const auto& [key, value] : page.provenance)
    if (key != "scene") json["provenance"][key] = value;
  json["findings"] = nlohmann::ordered_json::array();
  for (const Finding& f : page.findings) json["findings"].push_back(finding_json(f));
  for (const ScenePart& part : page.scenes) {
    json["scenes"][part.scene->name] = {
        {"hash", part.scene->hash}, {"truth", part.facts->tier}, {"truth_bar", part.facts->bar}};
    for (const Finding& f : part.findings) json["findings"].push_back(finding_json(f));
  }
  json["figures"] = nlohmann::ordered_json::array();
  for (const Chart& c : charts)
    json["figures"].push_back(
        {{"name", c.figure.name}, {"scene", c.scene}, {"caption", c.figure.caption}, {"finding", c.figure.finding}});
  json["notes"] = page.notes;
  json["problems"] = page.problems;
  return json.dump(1) + "\n";
}

class Builder {
 public:
  Builder(const ReportOptions& options, Request request) : options_(options), request_(std::move(request)) {
    page_.provenance = with_scenes(provenance(options.command_line), request_.scenes);
    fs::create_directories(options.out / "figures");
    page_.chapters = {
        {"disagreements",
         "What cannot be matched, and why",
         "Where Bullet's worlds answer otherwise than the scene asks, or fail: each in the smallest scene that shows "
         "it, "
         "with its cause and the size of its effect, measured in this run.",
         {}},
        {"stiffness", "How stiff a position-based link is", "Bullet's position-based world beside the formula.", {}}};
  }

  int build() {
    int steps = static_cast<int>(request_.scenes.size()) + 1;
    for (const Experiment& e : experiments()) steps += e.steps(request_);
    Progress progress(steps);
    for (const Experiment& e : experiments()) e.run(request_, progress, result_);
    for (const Certificate& c : result_.certificates)
      if (c.mismatch())
        page_.problems.push_back(
            fmt::format("{} on {}: it built another scene, see its certificate", c.method, c.scene));
    write_data(result_, page_.provenance, options_.out / "data");
    for (const Scene& scene : request_.scenes) facts_.push_back(facts_of(scene.name, result_));
    page_.notes = result_.notes;
    page_.findings = overall_findings(request_.scenes, facts_, result_);
    for (size_t i = 0; i < request_.scenes.size(); ++i) {
      const Scene& scene = request_.scenes[i];
      page_.scenes.push_back({&scene, &facts_[i], findings_of(scene, facts_[i]), {}, {}, {}});
      page_.scenes.back().statistics = result_.table(scene.name + "-statistics");
      for (const Certificate& c : result_.certificates)
        if (c.scene == scene.name) page_.scenes.back().certificates.push_back(&c);
      progress.begin("picture: " + scene.name);
      attempt("picture of " + scene.name, [&] { take_picture(scene, page_.scenes.back()); });
    }
    progress.begin("figures");
    charts_ = all_charts({request_.scenes, facts_, result_, value_of(page_.provenance, "commit")});
    for (const Chart& chart : charts_) attempt("figure " + chart.figure.name, [&] { draw(chart); });
    // beside the answer stands the last scene that Bullet answers too
    const ScenePart* shown = nullptr;
    for (const ScenePart& part : page_.scenes) {
      const MethodFacts* bullet = part.facts->find("bullet/deformable-explicit");
      if (!part.pictures.empty() && (!shown || (bullet && bullet->ok()))) shown = &part;
    }
    if (shown) page_.hero.insert(page_.hero.begin(), shown->pictures[0]);
    progress.done();

    write_file(options_.out / "report.json", report_json(page_, charts_));
    write_file(options_.out / "index.html", page_html(page_));
    for (const std::string& problem : page_.problems)
      fmt::print(stderr, "crosscheck: missing in the report: {}\n", problem);
    for (const Finding& f : page_.findings) fmt::print("- {}\n", f.sentence);
    fmt::print("{}\n", (options_.out / "index.html").string());
    bool agree = true;  // where the same rule must agree, it does
    for (const SceneFacts& facts : facts_) agree &= !same_rule_differs(facts);
    return page_.problems.empty() && agree ? 0 : 1;
  }

 private:
  template <class F>
  void attempt(const std::string& what, F make) {
    try {
      make();
    } catch (const std::exception& error) {
      page_.problems.push_back(what + ": " + error.what());
    }
  }

  void take_picture(const Scene& scene, ScenePart& part) {
    std::vector<const Answer*> shown;
    for (const std::string& name : pictured_methods(scene))
      for (const Answer& a : result_.answers)
        if (a.scene == scene.name && a.method == name) shown.push_back(&a);
    if (shown.empty())
      for (const Answer& a : result_.answers)
        if (a.scene == scene.name && a.trajectory.frames() > 0 && shown.size() < 3) shown.push_back(&a);
    Shot shot;
    shot.at = scene.camera && scene.camera->at ? *scene.camera->at : -1;
    // soft light is worth its seconds on cloth; a few beads look the same without
    shot.quality = options_.full || !scene.triangles.empty() ? render::Quality::still : render::Quality::fast;
    shot.mode = scene.triangles.empty() ? Mode::shaded : Mode::stretch;
    shot.width = 1440;
    shot.height = 560;
    const fs::path file = options_.out / "figures" / (file_name_of(scene.name) + "-picture.png");
    render::write_png(picture_of(scene, shown, shot), file, studio_);
    std::string names;
    for (const Answer* a : shown) names += (names.empty() ? "" : ", ") + a->method;
    part.pictures.push_back(
        {file, fmt::format("{} by {} side by side, seen by one camera", scene.name, names),
         fmt::format("{}, one camera, true sizes; {}", scene.name,
                     scene.triangles.empty() ? "the line is the path of the last particle"
                                             : "coloured by the stretch of the structural springs")});
  }

  void draw(const Chart& chart) {
    draw_figure(chart.figure, page_.provenance, options_.out / "figures");
    const PageImage image{options_.out / "figures" / (chart.figure.name + ".svg"),
                          chart.figure.title + ". " + chart.figure.finding,
                          chart.figure.finding + " " + chart.figure.caption};
    if (chart.scene.empty() && chart.chapter.empty()) page_.hero.push_back(image);
    for (Chapter& chapter : page_.chapters)
      if (chapter.id == chart.chapter) chapter.entries.push_back({chart.figure.title, chart.text, image});
    for (ScenePart& part : page_.scenes)
      if (part.scene->name == chart.scene) part.figures.push_back(image);
  }

  const ReportOptions& options_;
  Request request_;
  Result result_;
  std::vector<SceneFacts> facts_;
  std::vector<Chart> charts_;
  PageContent page_;
  render::Studio studio_;  // keeps compiled shaders from picture to picture
};

}  // namespace

int report_command(const ReportOptions& options) {
  Request request;
  request.full = options.full;
  if (!options.methods.empty()) request.methods = find_methods(options.methods);
  request.scenes = load_scenes(options.scenes);
  require_writable(options.out);
  clear_former_report(options.out);
  return Builder(options, std::move(request)).build();
}

}  // namespace crosscheck
