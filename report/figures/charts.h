// Charts: figures made from the experiments' tables.
#pragma once

#include <fmt/format.h>

#include <ranges>
#include <string>
#include <variant>
#include <vector>

#include "report/figures/figure.h"
#include "report/figures/step_limits.h"
#include "report/findings/report_data.h"
#include "report/pictures/scene_picture.h"

namespace crosscheck {

/// Describes the builds of a chart's methods, which are given by name or as "ENGINE/": "mysim and odeint built here,
/// Bullet by Debian for generic x86-64". Omits engines without a method in the chart.
std::string builds_text(const std::vector<std::string>& methods);

/// Title of the points whose time is scaled from a part of the run. Figures ring the markers of these runs.
inline constexpr auto scaled_times = "time scaled from a part of the run";

// The table of charts is in charts.cpp. To add a chart, write a function and add a row.

struct ChartInput {
  const std::vector<Scene>& scenes;
  const std::vector<SceneData>& facts;  // one per scene
  const TableSet& result;
  std::string commit;
  bool all = true;  // false: only selected scenes have charts of their own
};

struct PageTable {
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

struct Snapshot {
  struct Panel {
    std::string method;
    Run run;
  };
  std::string name;     // file name without extension
  std::string caption;  // also the alternative text
  Scene scene;
  std::vector<Panel> panels;
  Shot shot;
  /// Times (s) with captions. Each gets a picture file of its own; the shot's time is then unused.
  std::vector<std::pair<double, std::string>> moments = {};
};

/// To add a kind of figure, write a struct and an overload of drawing_of().
using AnyFigure = std::variant<Figure, StackedBars, DotPlot, HeatMap, StepLimits, std::monostate>;

/// An element of a scene's card, of a chapter, or of the first screen.
struct Chart {
  std::string scene;  // scene whose card contains it; empty: it is in a chapter, or on the first screen
  AnyFigure figure;
  std::string chapter = {};  // id of the chapter (report/page/texts/)
  std::string text = {};     // above the figure
  std::string heading = {};  // empty: the figure's title
  std::vector<PageTable> tables = {};
  std::vector<Snapshot> snapshots = {};
  bool shown = false;  // true: open in its chapter; false: folded
};

// Texts of figures, from texts.md: below a heading "## NAME OF FIGURE" there is one line "WORD: text" per text, which
// may contain {values}. Words are title, x and y ("log x" makes the axis logarithmic), caption, tier and finding; for
// the figure's chart also chapter, heading and text.

using fmt::literals::operator""_a;

/// A figure's text for `word` with its values inserted, or an empty string.
std::string filled_text(const std::string& key, const std::string& word, fmt::format_args values = {});
Chart described_chart(const std::string& key, AnyFigure figure, fmt::format_args values);
/// Chart of a figure. Texts from texts.md replace the figure's own. A figure with neither curves nor failures is
/// dropped; its caption becomes the chart's text if there is no other.
template <class... Values>
Chart described(const std::string& key, AnyFigure figure, const Values&... values) {
  return described_chart(key, std::move(figure), fmt::make_format_args(values...));
}

Curve& curve_of(Figure& figure, const std::string& title, const MethodStyle& style);

template <class Row, class T>
auto with(T Row::*member, const std::type_identity_t<T>& value) {
  return std::views::filter([=](const Row& row) { return row.*member == value; });
}
/// Distinct values in order of first occurrence.
template <class Row, class T>
std::vector<T> distinct(const std::vector<Row>& rows, T Row::*member) {
  std::vector<T> all;
  for (const Row& row : rows)
    if (std::ranges::find(all, row.*member) == all.end()) all.push_back(row.*member);
  return all;
}

/// Null if the chart has no figure.
const FigureInfo* figure_info(const Chart& chart);
/// Like draw(). Does nothing if the chart has no figure.
void draw_figure(const Chart& chart, const Provenance& provenance, const std::filesystem::path& folder);

/// Writes the data and the script of the chart's figure: NAME.csv and NAME.gp.
void write_figure_data(const Chart& chart, const Provenance& provenance, const std::filesystem::path& folder);
/// The method with which a title begins, or an empty string.
std::string method_in(const std::string& title);
std::vector<std::string> methods_in(const Chart& chart);

std::vector<Chart> scoreboard_charts(const ChartInput& input);  // error of every method on every scene
std::vector<Chart> matrix_charts(const ChartInput& input);      // engines by questions
std::vector<Chart> same_rule_charts(const ChartInput& input);   // differences between engines that use the same rule
std::vector<Chart> error_charts(const ChartInput& input);       // over time, per scene with a truth
std::vector<Chart> agreement_charts(const ChartInput& input);   // Bullet and the same rule of mysim, over time
std::vector<Chart> contact_charts(const ChartInput& input);     // centres of mass, clearance, creep on a sphere
std::vector<Chart> balance_charts(const ChartInput& input);     // balance error or contact loss over time
std::vector<Chart> order_charts(const ChartInput& input);

std::vector<Chart> energy_charts(const ChartInput& input);
std::vector<Chart> probe_charts(const ChartInput& input);
std::vector<Chart> stiffness_charts(const ChartInput& input);
std::vector<Chart> fabric_charts(const ChartInput& input);  // strips compared with the elastica
std::vector<Chart> disagreement_charts(const ChartInput& input);
std::vector<Chart> cheapest_charts(const ChartInput& input);        // the fastest method at 1 % error, over all scenes
std::vector<Chart> speed_accuracy_charts(const ChartInput& input);  // work-precision diagrams
std::vector<Chart> cost_charts(const ChartInput& input);
std::vector<Chart> adequacy_charts(const ChartInput& input);
std::vector<Chart> stability_charts(const ChartInput& input);

std::vector<Chart> all_charts(const ChartInput& input);

/// (x, y) of one method's rows in a per-scene table. Omits rows without the value and, if `positive`, values <= 0.
std::vector<std::pair<double, double>> points_of(const Table& table, const std::string& method,
                                                 const std::string& column, bool positive);

/// "Scene cloth-hang; step 500 µs; commit abc."
std::string caption_of(const Scene& scene, const std::string& commit);
/// Tier of a figure: the scene's truth with its error bar; or another engine, with the effect of round-off alone.
std::string tier_of(const SceneData& facts);
std::string another_engine(const SceneData& facts);

}  // namespace crosscheck
