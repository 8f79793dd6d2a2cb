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

// Remarks on timings in captions: the builds, and which times are scaled.

/// Builds of the methods in a chart, given by name or as "ENGINE/": "mysim and odeint built here, Bullet by Debian for
/// generic x86-64". Absent engines are not mentioned.
std::string builds_text(const std::vector<std::string>& methods);

/// Title of the points whose time is scaled from a part of the run. Figures draw them as rings around the markers of
/// their methods.
inline constexpr auto scaled_times = "time scaled from a part of the run";

// The table of charts is in charts.cpp; a new chart is a function and a row.

struct ChartInput {
  const std::vector<Scene>& scenes;
  const std::vector<SceneData>& facts;  // one per scene
  const TableSet& result;
  std::string commit;
  bool all = true;  // every scene has charts of its own: scenes were named, or the run is full
};

/// A small table on the page, with words and formatted numbers.
struct PageTable {
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// A picture in a chapter: runs of a scene side by side.
struct Snapshot {
  struct Panel {
    std::string method;
    Run run;
  };
  std::string name;     // file name without ending
  std::string caption;  // also the alternative text
  Scene scene;
  std::vector<Panel> panels;
  Shot shot;
  /// If not empty: pictures at these times (s) instead of the shot's, each a separate file with its caption.
  std::vector<std::pair<double, std::string>> moments = {};
};

/// A new kind of figure is a struct and an overload of drawing_of().
using AnyFigure = std::variant<Figure, StackedBars, DotPlot, HeatMap, StepLimits, std::monostate>;

/// A piece of a scene's card, of a chapter, or of the first screen: a figure, a small table, pictures, or several of
/// these.
struct Chart {
  std::string scene;  // the scene whose card shows it; empty: the first screen, or a chapter
  AnyFigure figure;
  std::string chapter = {};  // id of the chapter (report/page/texts/); empty: none
  std::string text = {};     // text above it in a chapter
  std::string heading = {};  // heading in a chapter; empty: the figure's title
  std::vector<PageTable> tables = {};
  std::vector<Snapshot> snapshots = {};
  bool shown = false;  // true: open in its chapter, not folded
};

// Texts of figures, from texts.md: below "## KEY" one line "WORD: text" each, with {values}. The key is the figure's
// name. The words are title, x and y ("log x" makes the axis logarithmic), caption, tier, finding, and, for its chart,
// chapter, heading and text.

using fmt::literals::operator""_a;

/// The text of a word with its values; empty if the figure has no such text.
std::string filled_text(const std::string& key, const std::string& word, fmt::format_args values = {});
Chart described_chart(const std::string& key, AnyFigure figure, fmt::format_args values);
/// The chart of a figure, which keeps its own name and texts for words that are not in texts.md. If the figure has
/// neither curves nor failures, the chart keeps only the text, or else the caption.
template <class... Values>
Chart described(const std::string& key, AnyFigure figure, const Values&... values) {
  return described_chart(key, std::move(figure), fmt::make_format_args(values...));
}

/// The curve with this title; adds it if there is none.
Curve& curve_of(Figure& figure, const std::string& title, const MethodStyle& style);

/// Selects the rows with this value.
template <class Row, class T>
auto with(T Row::*member, const std::type_identity_t<T>& value) {
  return std::views::filter([=](const Row& row) { return row.*member == value; });
}
/// The distinct values of a member, in order of first occurrence.
template <class Row, class T>
std::vector<T> distinct(const std::vector<Row>& rows, T Row::*member) {
  std::vector<T> all;
  for (const Row& row : rows)
    if (std::ranges::find(all, row.*member) == all.end()) all.push_back(row.*member);
  return all;
}

/// Name, title and texts of the chart's figure, or null.
const FigureInfo* figure_info(const Chart& chart);
/// Writes and draws its figure, if it has one, like draw().
void draw_figure(const Chart& chart, const Provenance& provenance, const std::filesystem::path& folder);

/// Writes only its data and its script: NAME.csv and NAME.gp.
void write_figure_data(const Chart& chart, const Provenance& provenance, const std::filesystem::path& folder);
/// The method at the start of a title, or the whole title; empty if there is none.
std::string method_in(const std::string& title);
/// The methods that its figure shows.
std::vector<std::string> methods_in(const Chart& chart);

std::vector<Chart> scoreboard_charts(const ChartInput& input);  // table: error of every method on every scene
std::vector<Chart> matrix_charts(const ChartInput& input);      // table: engines by questions
std::vector<Chart> same_rule_charts(const ChartInput& input);   // difference of engines with the same rule, by scene
std::vector<Chart> error_charts(const ChartInput& input);       // error over time, per scene with a truth
std::vector<Chart> agreement_charts(const ChartInput& input);   // Bullet compared with the same rule of mysim, over
                                                                // time
std::vector<Chart> contact_charts(const ChartInput& input);     // centres of mass, clearance, creep on a sphere
std::vector<Chart> balance_charts(const ChartInput& input);     // balance error or contact loss over time
std::vector<Chart> order_charts(const ChartInput& input);       // error against step

std::vector<Chart> energy_charts(const ChartInput& input);        // budget, drift, numerical damping
std::vector<Chart> probe_charts(const ChartInput& input);         // friction, rebound, depth, drapes
std::vector<Chart> stiffness_charts(const ChartInput& input);     // position-based links
std::vector<Chart> fabric_charts(const ChartInput& input);        // strips compared with the elastica
std::vector<Chart> disagreement_charts(const ChartInput& input);  // different problems solved by Bullet
std::vector<Chart> cheapest_charts(const ChartInput& input);      // the fastest method at an accuracy, over all scenes
std::vector<Chart> speed_accuracy_charts(const ChartInput& input);  // work-precision diagrams
std::vector<Chart> cost_charts(const ChartInput& input);            // cost of a step
std::vector<Chart> adequacy_charts(const ChartInput& input);        // errors from removals and grids
std::vector<Chart> stability_charts(const ChartInput& input);       // critical time steps, stability maps

std::vector<Chart> all_charts(const ChartInput& input);

/// (x, y) of one method's rows in a per-scene table. Omits rows without the value and, if `positive`, rows where it is
/// not above zero.
std::vector<std::pair<double, double>> points_of(const Table& table, const std::string& method,
                                                 const std::string& column, bool positive);

/// "Scene cloth-hang; step 500 µs; commit abc."
std::string caption_of(const Scene& scene, const std::string& commit);
/// Tiers of figures: the scene's truth with its error bar; another engine, with the round-off bound.
std::string tier_of(const SceneData& facts);
std::string another_engine(const SceneData& facts);

}  // namespace crosscheck
