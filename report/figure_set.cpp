#include "report/figure_set.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/json.h"
#include "mysim/nearest.h"
#include "report/fitting_figure.h"
#include "report/provenance.h"

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
    size = {8.5, 8, false};
  else if (set == "lecture")
    size = {24, 20, true};
  else
    throw InputError(
        fmt::format("--set {}: expected paper or lecture{}", set, did_you_mean(set, {"paper", "lecture"})));
  if (!width.empty()) size.width = centimetres(width);
  return size;
}

std::string latex(const std::string& text) {
  constexpr std::pair<const char*, const char*> table[] = {{"\\", "\\textbackslash{}"},
                                                           {"%", "\\%"},
                                                           {"_", "\\_"},
                                                           {"&", "\\&"},
                                                           {"#", "\\#"},
                                                           {"$", "\\$"},
                                                           {"{", "\\{"},
                                                           {"}", "\\}"},
                                                           {"~", "\\textasciitilde{}"},
                                                           {"^", "\\textasciicircum{}"},
                                                           {"<", "$<$"},
                                                           {">", "$>$"},
                                                           {"µ", "$\\mu$"},
                                                           {"ω", "$\\omega$"},
                                                           {"±", "$\\pm$"},
                                                           {"×", "$\\times$"},
                                                           {"Δ", "$\\Delta$"},
                                                           {"²", "$^2$"},
                                                           {"–", "--"}};
  std::string out;
  for (size_t i = 0; i < text.size();) {
    bool found = false;
    for (const auto& [from, to] : table)
      if (const std::string_view word(from); text.compare(i, word.size(), word) == 0) {
        out += to, i += word.size(), found = true;
        break;
      }
    if (!found) out += text[i++];
  }
  return out;
}

bool resize(Chart& chart, const FigureSize& size) {
  return std::visit(
      [&]<class F>(F& figure) {
        if constexpr (std::derived_from<F, FigureWords>) figure.size = size;
        return std::derived_from<F, FigureWords>;
      },
      chart.figure);
}

void draw_in_size(Chart& chart, FigureSize size, const Provenance& provenance, const std::filesystem::path& folder) {
  constexpr double least = 5;  // pt
  for (;;) {
    resize(chart, size);
    const double smaller = std::round(9.2 * size.font) / 10;
    if (smaller < least) return draw_figure(chart, provenance, folder);  // gnuplot says what does not fit
    try {
      return std::visit(
          [&]<class F>(const F& figure) {
            if constexpr (std::derived_from<F, FigureWords>) draw_if_it_fits(drawing_of(figure), provenance, folder);
          },
          chart.figure);
    } catch (const Crowded&) {
      size.font = smaller;
    }
  }
}

std::string shell_quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

void write_words(const FigureWords& figure, const std::filesystem::path& folder) {
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
  json["figures"] = Json::list();
  for (const auto& [f, scene, endings] : figures) {
    Json files;
    for (const char* ending : endings) files[ending] = f.name + "." + ending;
    json["figures"].push({{"name", f.name},
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
  write_file(folder / "figures.json", json.dump(1) + "\n");
  const std::string date = value_of(provenance, "date");
  write_file(folder / "CITATION.cff",
             fmt::format("cff-version: 1.2.0\nmessage: These figures were made with this software.\ntype: software\n"
                         "title: \"Crosscheck: mass-spring and cloth engines side by side\"\nauthors:\n"
                         "  - name: The developers of Crosscheck\nversion: \"{}\"\ndate-released: \"{}\"\n",
                         value_of(provenance, "commit"), date.substr(0, 10)));
}

}  // namespace crosscheck
