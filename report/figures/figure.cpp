// Curves over two axes, and what all figures share: the look of methods, terminals, the data as CSV, and gnuplot.
#include "report/figures/figure.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "mysim/base/files.h"
#include "reference/method.h"
#include "report/base/assets.h"
#include "report/base/gnuplot.h"
#include "report/figures/charts.h"

namespace crosscheck {
namespace {

struct Terminal {
  std::string set, ending;
};

std::vector<Terminal> terminals_of(const FigureInfo& figure, double height) {
  const double wide = figure.size.units();
  std::string svg_name = figure.name;  // gnuplot takes letters, digits and _ only
  for (char& c : svg_name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return {{fmt::format("svg size {:.0f},{:.0f} dynamic font \"DejaVu Sans,12\" background \"#FFFFFF\" name {}", wide,
                       height, single_quoted(svg_name)),
           ".svg"},
          // a font of 12 is as high as the figure's; 0.75 makes gnuplot's points those of the page
          {fmt::format("pdfcairo size {:.4g}cm,{:.4g}cm font \"DejaVu Sans,12\" fontscale {:.4g} linewidth {:.3g} "
                       "pointscale {:.3g}",
                       figure.size.width, figure.size.width * height / wide, 0.75 * figure.size.font / 12,
                       figure.size.font / 8.5, figure.size.font / 8.5),
           ".pdf"},
          {fmt::format("pngcairo size {:.0f},{:.0f} font \"DejaVu Sans,12\" fontscale 1.6 linewidth 1.7 pointscale 1.6",
                       2 * wide, 2 * height),
           ".png"}};
}

}  // namespace

std::string terminals(const FigureInfo& figure, double tall, const std::string& plot) {
  // title, labels and key take what they take, the plot between them goes with the width
  const double height = 140 + 360 * figure.size.units() / 680 + 500 * (tall - 1);
  std::string out;
  for (const Terminal& t : terminals_of(figure, height))
    out += fmt::format("set term {}\nset output {}\n{}", t.set, single_quoted(figure.name + t.ending),
                       out.empty() ? plot : "replot\n");
  return out + "set output\n";
}

std::string terminals_of_block(const FigureInfo& figure, double height, const std::string& block) {
  std::string out;
  for (const Terminal& t : terminals_of(figure, height))
    out += fmt::format("reset\nload \"style.gp\"\nset term {}\nset output {}\n{}set output\n", t.set,
                       single_quoted(figure.name + t.ending), block);
  return out;
}

std::string single_quoted(const std::string& text) {
  std::string out = "'";
  for (char c : text) out += c == '\'' ? "''" : std::string(1, c);
  return out + "'";
}

std::string axis_commands(const Axis& axis, const std::string& letter) {
  // exponents make numbers below an axis taller
  const char* lower = letter == "x" && axis.logarithmic ? " offset 0,0.2" : "";
  std::string out = fmt::format("set {}label {}{}\n", letter, single_quoted(axis.label), lower);
  if (axis.logarithmic) out += fmt::format("set logscale {0} 10\nset format {0} \"10^{{%L}}\"\n", letter);
  if (axis.low || axis.high)
    out += fmt::format("set {}range [{}:{}]\n", letter, axis.low ? fmt::format("{:.6g}", *axis.low) : "",
                       axis.high ? fmt::format("{:.6g}", *axis.high) : "");
  return out;
}

namespace {

constexpr auto pareto_title = "nothing better at less cost";

/// The words in the key for all crosses of a kind.
std::string kind_in_key(const FailureMark& mark) { return mark.kind + " (in its colour)"; }

/// The name of a curve in the data file: gnuplot splits even quoted fields at commas.
std::string id_of(std::string title) {
  for (char& c : title)
    if (c == ',' || c == '"') c = ';';
  return title;
}

/// Every point as a row: curve, x, y. Throws when there is nothing, or something that cannot be drawn.
Table data_of(const Figure& f) {
  Table table{f.name, {{"curve", "1"}, {f.x.label, "see name"}, {f.y.label, "see name"}}, {}};
  auto add = [&](const std::string& curve, double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y))
      throw std::runtime_error(fmt::format("figure {}: a value is not finite", f.name));
    table.add({id_of(curve), x, y});
  };
  for (const auto& [x, y] : f.pareto) add(pareto_title, x, y);
  for (const Curve& curve : f.curves)
    for (const auto& [x, y] : curve.points) add(curve.title, x, y);
  for (const FailureMark& mark : f.failures) add("failed: " + mark.title, mark.x, mark.y);
  if (table.rows.empty()) throw std::runtime_error(fmt::format("figure {}: nothing to draw", f.name));
  return table;
}

/// Titles in the key: of outside programs the base name, without the folder.
std::string shown(const std::string& title) {
  if (!title.starts_with(program_prefix)) return title;
  const size_t slash = title.rfind('/', title.find('+'));
  return title.substr(slash == std::string::npos ? program_prefix.size() : slash + 1);
}

/// One plot element that picks the rows of one curve from the file.
std::string element(const Figure& f, const std::string& curve, const std::string& with, const std::string& title) {
  return fmt::format("{} using (strcol(1) eq {} ? $2 : NaN):3 with {} title {}", single_quoted(f.name + ".csv"),
                     single_quoted(id_of(curve)), with, single_quoted(shown(title)));
}

/// True when the curve of that method is drawn, and so named in the key with its colour. A mark's title is that of its
/// curve and the kind.
bool in_key(const Figure& f, const FailureMark& mark) {
  return std::any_of(f.curves.begin(), f.curves.end(), [&](const Curve& c) {
    return !c.points.empty() && c.style.colour == mark.style.colour && mark.title.starts_with(c.title);
  });
}

/// Room that the key needs below the plot beyond its first three rows, in parts of the figure's height.
double key_room(const Figure& f) {
  std::set<std::string> entries;
  for (const Curve& c : f.curves)
    if (!c.points.empty()) entries.insert(c.title);
  for (const FailureMark& m : f.failures) entries.insert(in_key(f, m) ? kind_in_key(m) : m.title);
  if (f.floor) entries.insert(f.floor->first);
  if (!f.pareto.empty()) entries.insert(pareto_title);
  size_t longest = 0;
  for (const std::string& e : entries) longest = std::max(longest, shown(e).size());
  // as many columns as gnuplot finds room for in this width, as seen: three of 14 letters, two of 28
  const double column = 114 + 8 * static_cast<double>(longest);
  const int columns = std::clamp(static_cast<int>(f.size.units() / column), 1, 3);
  const int rows = (static_cast<int>(entries.size()) + columns - 1) / columns;
  return 0.036 * std::max(0, rows - 3);
}

/// Degrees by which tick texts are turned so that they do not overlap; 0: not at all.
int turned(const Figure& f) {
  const bool short_ones = std::all_of(f.categories.begin(), f.categories.end(),
                                      [](const auto& category) { return category.second.size() <= 4; });
  if (short_ones) return 0;
  const double apart = 0.8 * f.size.units() / static_cast<double>(f.categories.size());
  const bool narrow = f.size.units() < 600;
  return narrow && apart < 45 ? 65 : f.categories.size() > 10 ? 35 : 20;
}

/// Room that turned tick texts need below the plot beyond that of a few words, in parts of the figure's height.
double category_room(const Figure& f) {
  size_t longest = 0;
  for (const auto& category : f.categories) longest = std::max(longest, category.second.size());
  const double drop = 7 * static_cast<double>(longest) * std::sin(turned(f) * std::numbers::pi / 180);
  return std::max(0.0, drop - 90) / 500;
}

std::string plot_command(const Figure& f) {
  std::vector<std::string> parts;
  if (!f.pareto.empty()) parts.push_back(element(f, pareto_title, "steps lw 7 lc rgb \"#DDDDDD\"", pareto_title));
  for (const Curve& c : f.curves) {
    if (c.points.empty()) continue;
    const int gap = c.markers ? 1 : std::max<int>(1, static_cast<int>(c.points.size()) / 8);
    const std::string look =
        fmt::format("lc rgb \"{}\" pt {} ps {}", c.style.colour, c.style.marker, c.title == scaled_times ? 1.8 : 0.8);
    parts.push_back(element(f, c.title,
                            c.line ? fmt::format("linespoints {} lw 2 dt {} pointinterval {}", look, c.style.dash, gap)
                                   : "points " + look + " lw 2",
                            c.title));
  }
  // crosses stand in the colour of their method: where its curve is in the key they need no line of their own
  std::set<std::string> marked;
  std::map<std::string, int> silent;  // kinds that are named in the key once, and their crosses
  for (const FailureMark& m : f.failures) {
    if (!marked.insert(m.title).second) continue;
    const bool known = in_key(f, m);
    if (known) silent.emplace(kind_in_key(m), m.cross);
    parts.push_back(element(f, "failed: " + m.title,
                            fmt::format("points lc rgb \"{}\" pt {} ps 1.5 lw 3", m.style.colour, m.cross),
                            known ? "" : m.title));
  }
  for (const auto& [kind, cross] : silent)
    parts.push_back(
        fmt::format("keyentry with points lc rgb \"#777777\" pt {} ps 1.5 lw 3 title {}", cross, single_quoted(kind)));
  if (f.floor)
    parts.push_back(fmt::format("{:.6g} with lines lc rgb \"#999999\" lw 1.5 dt (2,3) title {}", f.floor->second,
                                single_quoted(f.floor->first)));
  std::string out = "plot ";
  for (size_t i = 0; i < parts.size(); ++i) out += (i ? ", \\\n     " : "") + parts[i];
  return out + "\n";
}

/// The axis with both ends set where gnuplot must not choose: x always (horizontal lines are sampled over it), y where
/// all values are the same.
Axis closed(const Figure& f, bool of_x) {
  Axis axis = of_x ? f.x : f.y;
  double low = 1e300, high = -1e300;
  auto see = [&](double x, double y) { low = std::min(low, of_x ? x : y), high = std::max(high, of_x ? x : y); };
  for (const Curve& curve : f.curves)
    for (const auto& point : curve.points) see(point.first, point.second);
  for (const FailureMark& mark : f.failures) see(mark.x, mark.y);
  if (!of_x && low < high) return axis;
  const double room = axis.logarithmic ? 1.25 : low < high ? 0.02 * (high - low) : 0.05 * std::abs(high) + 1e-9;
  if (!axis.low) axis.low = axis.logarithmic ? low / room : low - room;
  if (!axis.high) axis.high = axis.logarithmic ? high * room : high + room;
  return axis;
}

std::string script_of(const Figure& f) {
  std::string out = fmt::format("# {}\n# Draw again: gnuplot {}.gp\nreset\nload \"style.gp\"\n", f.title, f.name);
  out += title_command(f);
  out += axis_commands(closed(f, true), "x") + axis_commands(closed(f, false), "y");
  if (!f.categories.empty()) {
    const int angle = turned(f);
    out += angle == 0 ? "set xtics noenhanced (" : fmt::format("set xtics rotate by {} right noenhanced (", angle);
    for (size_t i = 0; i < f.categories.size(); ++i)
      out += fmt::format("{}{} {:g}", i ? ", " : "", single_quoted(f.categories[i].second), f.categories[i].first);
    out += ")\n";
  }
  if (f.window) {
    out += fmt::format(
        "set object 1 rectangle from {:.6g}, graph 0 to graph 1, graph 1 fc rgb \"#F1F1EE\" fs solid noborder behind\n",
        f.window->first);
    out += fmt::format(
        "set label 1 {} at {:.6g}, graph 0.04 offset 0.6,0 left noenhanced font \"DejaVu Sans,9\" textcolor rgb "
        "\"#777777\" front\n",
        single_quoted(f.window->second), f.window->first);
  }
  return out + terminals(f, 1 + key_room(f) + category_room(f), plot_command(f));
}

}  // namespace

MethodStyle style_of(const std::string& method) {
  struct Row {
    const char* name;
    MethodStyle style;
  };
  static const Row table[] = {
      {"mysim/symplectic-euler", {"#0072B2", "1", 7}},
      {"mysim/leapfrog", {"#56B4E9", "(16,3,2,3)", 9}},
      {"mysim/rk4", {"#009E73", "(6,3)", 13}},
      {"mysim/trapezoidal", {"#E69F00", "(2,2)", 11}},
      {"mysim/explicit-euler", {"#CC79A7", "(10,3,2,3)", 15}},
      {"bullet/deformable-explicit", {"#D55E00", "(14,4)", 4}},
      {"bullet/deformable-implicit", {"#AA4499", "(20,3,4,3)", 10}},
      {"bullet/pbd", {"#7A3B00", "(4,2)", 3}},
      {"bullet32/deformable-explicit", {"#F0A070", "(14,2,2,2)", 4}},
      {"bullet32/pbd", {"#B08050", "(4,2,1,2)", 6}},
      {"mysim/suzuki4", {"#332288", "(12,3,3,3)", 12}},
      {"mysim/dopri5", {"#999933", "(3,2)", 6}},
      {"mysim/implicit-euler", {"#882255", "(18,3)", 14}},
      {"mysim/implicit-midpoint", {"#CC6677", "(8,2,2,2)", 2}},
      {"mysim/xpbd", {"#000000", "(5,4)", 1}},
      {"odeint/rk4", {"#44AA99", "(9,3)", 12}},
      {"odeint/dopri5", {"#88CCEE", "(3,4)", 8}},
      {"sundials/arkode", {"#DDCC77", "(12,2,2,2)", 10}},
      {"sundials/cvode", {"#AA8855", "(4,2,2,2)", 8}},
      {"mysim/symplectic-euler+sticky", {"#666666", "(3,3)", 8}},
  };
  for (const Row& row : table)
    if (method == row.name) return row.style;
  // others, like outside programs, are distinguished as far as five styles go
  static const MethodStyle others[] = {{"#333333", "(8,2,2,2,2,2)", 3},
                                       {"#AA3377", "(6,2,2,2)", 10},
                                       {"#117733", "(10,2,4,2)", 8},
                                       {"#44AA99", "(4,3,1,3)", 14},
                                       {"#6699CC", "(12,2,1,2)", 12}};
  unsigned sum = 0;
  for (char c : method) sum = 31 * sum + static_cast<unsigned char>(c);
  return others[sum % std::size(others)];
}

std::vector<std::vector<Tooltip>> tooltips_of(const Figure& figure) {
  std::vector<std::vector<Tooltip>> all;
  if (!figure.pareto.empty()) all.emplace_back();
  for (const Curve& c : figure.curves)
    if (!c.points.empty()) all.push_back(c.tooltips);
  // crosses of one title are one element
  std::map<std::string, size_t> place;
  for (const FailureMark& m : figure.failures) {
    const auto [at, first] = place.emplace(m.title, all.size());
    if (first) all.emplace_back();
    if (!m.tooltips.words.empty()) all[at->second].push_back(m.tooltips);
  }
  return all;
}

Drawing drawing_of(const Figure& figure) { return {figure.name, data_of(figure), script_of(figure)}; }

std::string title_command(const FigureInfo& figure) {
  return figure.size.titled ? fmt::format("set title {}\n", single_quoted(figure.title)) : "";
}

namespace {

/// Writes and draws; what gnuplot warned of is handed to `judge` before any file stands in the folder.
void draw(const Drawing& figure, const Provenance& provenance, const std::filesystem::path& folder,
          void (*judge)(const std::string& what, const std::string& warnings)) {
  // gnuplot writes its files bit by bit: in a folder of its own, so that no half figure is ever seen
  const std::filesystem::path work = folder / fmt::format(".{}.{}.part", figure.name, getpid());
  struct Remove {
    std::filesystem::path path;
    ~Remove() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  } remove{work};
  write_file(work / "style.gp", asset("figures/style.gp"));
  write_csv(figure.data, provenance, work);
  write_file(work / (figure.name + ".gp"), figure.script);
  const std::string what = "figure " + figure.name;
  const std::vector<std::string> forms{figure.name + ".svg", figure.name + ".pdf", figure.name + ".png"};
  judge(what, run_gnuplot(figure.name + ".gp", work, forms, what));
  erase_pdf_date(work / (figure.name + ".pdf"));
  for (const auto& file : std::filesystem::directory_iterator(work))
    std::filesystem::rename(file.path(), folder / file.path().filename());
}

}  // namespace

void draw(const Drawing& figure, const Provenance& provenance, const std::filesystem::path& folder) {
  draw(figure, provenance, folder,
       [](const std::string& what, const std::string& warnings) { print_warnings(warnings, what); });
}

void draw_if_labels_fit(const Drawing& figure, const Provenance& provenance, const std::filesystem::path& folder) {
  draw(figure, provenance, folder, [](const std::string& what, const std::string& warnings) {
    if (warnings.find("difficulty") != std::string::npos)
      throw LabelsOverlap(fmt::format("{}: gnuplot: {}", what, warnings));
    print_warnings(warnings, what);
  });
}

}  // namespace crosscheck
