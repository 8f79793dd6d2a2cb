#include "report/figures/figure_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/base/provenance.h"
#include "report/figures/charts.h"
#include "report/figures/figure.h"

namespace crosscheck {
namespace {

double centimetres(const std::string& width) {
  constexpr std::pair<const char*, double> units[] = {{"cm", 1}, {"mm", 0.1}, {"in", 2.54}};
  double number = 0;
  const auto [end, error] = std::from_chars(width.data(), width.data() + width.size(), number);
  for (const auto& [unit, size] : units)
    if (error == std::errc() && std::string_view(end) == unit && number * size >= 4 && number * size <= 100)
      return number * size;
  throw InputError(fmt::format("--width {}: expected 4cm to 100cm, in cm, mm or in", width));
}

}  // namespace

FigureSize figure_size(const std::string& set, const std::string& width) {
  FigureSize size;
  if (set == "paper")
    size = {8.5, 7.5, false};
  else if (set == "lecture")
    size = {24, 20, true};
  else
    throw InputError(
        fmt::format("--set {}: expected paper or lecture{}", set, did_you_mean(set, {"paper", "lecture"})));
  if (!width.empty()) size.width = centimetres(width);
  return size;
}

std::string latex(const std::string& text) {
  // each line of the file is "CHARACTER LATEX"
  static const std::vector<std::string> table = split(asset("figures/latex.txt"), '\n');
  std::string out;
  for (size_t i = 0; i < text.size();) {
    const std::string character = text.substr(i, std::max<size_t>(1, utf8_length(text, i)));
    const auto line =
        std::ranges::find_if(table, [&](const std::string& each) { return each.starts_with(character + " "); });
    out += line == table.end() ? character : line->substr(character.size() + 1);
    i += character.size();
  }
  return out;
}

bool resize(Chart& chart, const FigureSize& size) {
  return std::visit(
      [&]<class F>(F& figure) {
        if constexpr (std::derived_from<F, FigureInfo>) figure.size = size;
        return std::derived_from<F, FigureInfo>;
      },
      chart.figure);
}

void write_captions(const FigureInfo& figure, const std::filesystem::path& folder) {
  write_file(folder / (figure.name + ".txt"), fmt::format("{}\n{} {}\n", figure.title, figure.finding, figure.caption));
  write_file(folder / (figure.name + ".tex"),
             fmt::format("\\begin{{figure}}\n  \\centering\n  \\includegraphics[width={:g}cm]{{{}.pdf}}\n"
                         "  \\caption{{{}. {} {}}}\n  \\label{{fig:{}}}\n\\end{{figure}}\n",
                         figure.size.width, figure.name, latex(figure.title), latex(figure.finding),
                         latex(figure.caption), figure.name));
}

void write_catalogue(const std::vector<FigureInSet>& figures, const Provenance& provenance,
                     const std::filesystem::path& folder) {
  Json json;
  for (const auto& [key, value] : provenance)
    if (key != "scene") json["provenance"][key] = value;
  json["figures"] = Json::array();
  for (const auto& [f, scene, endings] : figures) {
    Json files;
    for (const char* ending : endings) files[ending] = f.name + "." + ending;
    json["figures"].push_back({{"name", f.name},
                               {"title", f.title},
                               {"scene", scene},
                               {"finding", f.finding},
                               {"caption", f.caption},
                               {"tier", f.tier},
                               {"width_cm", f.size.width},
                               {"font_pt", f.size.font},
                               {"from_timings", f.from_costs},
                               {"files", std::move(files)}});
  }
  write_file(folder / "figures.json", dump(json, 1) + "\n");
  const std::string date = value_of(provenance, "date");
  write_file(folder / "CITATION.cff",
             fmt::format("cff-version: 1.2.0\nmessage: These figures were made with this software.\ntype: software\n"
                         "title: \"Crosscheck: mass-spring and cloth engines side by side\"\nauthors:\n"
                         "  - name: The developers of Crosscheck\nversion: \"{}\"\ndate-released: \"{}\"\n",
                         value_of(provenance, "commit"), date.substr(0, 10)));
}

namespace {

constexpr double inch = 2.54;  // cm

Table positions(const std::string& name, const Scene& scene, const std::vector<const MethodResult*>& answers,
                const Shot& shot) {
  Table table{name, {{"method", "1"}, {"t", "s"}, {"particle", "1"}, {"x", "m"}, {"y", "m"}, {"z", "m"}}, {}};
  for (const MethodResult* a : answers) {
    const int frame = frame_shown(scene, *a, shot);
    const Points& x = a->trajectory.x[frame];
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      table.add({a->method, a->trajectory.t[frame], static_cast<long>(i), x(0, i), x(1, i), x(2, i)});
  }
  return table;
}

}  // namespace

std::string picture_name(const Scene& scene) { return file_name_of(scene.name) + "-picture"; }

Shot shot_for_print(const Scene& scene, const FigureSize& size, bool full) {
  Shot shot = usual_shot(scene, full);
  shot.width = static_cast<int>(std::lround(pixels_per_inch(size) * size.width / inch));
  shot.text = pixels_per_inch(size) * size.font / 72;
  return shot;
}

FigureInfo picture_info(const Scene& scene, const std::vector<const MethodResult*>& answers, const FigureSize& size,
                        const std::string& commit) {
  std::vector<std::string> shown, failed;
  for (const MethodResult* a : answers) {
    shown.push_back(a->method);
    if (a->outcome.verdict != Verdict::ok)
      failed.push_back(fmt::format("{} {} at {:.3g} s", a->method,
                                   failure_class(std::string(name_of(a->outcome.verdict))), a->outcome.end));
  }
  FigureInfo words;
  words.name = picture_name(scene);
  words.title = fmt::format("{} by {}", scene.name, fmt::join(shown, ", "));
  words.finding =
      failed.empty() ? "All of them reach the end of the run." : fmt::format("{}.", fmt::join(failed, "; "));
  words.caption = fmt::format("Side by side in one camera, true sizes; {}. {}",
                              scene.triangles.empty() ? "the line is the path of the last particle"
                                                      : "coloured by the stretch of the structural springs",
                              caption_of(scene, commit));
  words.size = size;
  return words;
}

void write_printed(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                   const FigureInfo& words, const Provenance& provenance, const std::filesystem::path& folder) {
  write_csv(positions(words.name, scene, answers, shot), provenance, folder);
  render::write_print(picture_of(scene, answers, shot), pixels_per_inch(words.size), folder / (words.name + ".png"),
                      folder / (words.name + ".pdf"));
}

}  // namespace crosscheck
