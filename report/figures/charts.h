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

// Remarks on measured times in captions: the builds, and which times are scaled.

/// Of the methods in a chart, by name or "ENGINE/": "mysim and odeint built here, Bullet by Debian for generic x86-64".
/// Only engines that are there are named.
std::string builds_text(const std::vector<std::string>& methods);

/// The points of a chart whose time is that of a part of the run, scaled. A figure draws them as rings around the
/// markers of their methods.
inline constexpr auto scaled_times = "time scaled from a part of the run";

// The table of charts is in charts.cpp; a new one is a function and a row.

struct ChartInput {
  const std::vector<Scene>& scenes;
  const std::vector<SceneData>& facts;  // one per scene
  const TableSet& result;
  std::string commit;
  bool all = true;  // every scene has charts of its own: scenes were named, or the run is full
};

/// A small table on the page, in words and numbers as people read them.
struct PageTable {
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// A render that belongs to a chapter: runs of a scene side by side.
struct Snapshot {
  struct Panel {
    std::string method;
    Run run;
  };
  std::string name;     // of the file, without ending
  std::string caption;  // and alternative text
  Scene scene;
  std::vector<Panel> panels;
  Shot shot;
  /// Not at the shot's time but at these (s), each a bare picture in a file of its own with its caption.
  std::vector<std::pair<double, std::string>> moments = {};
};

/// A new kind of figure is a struct and its drawing_of().
using AnyFigure = std::variant<Figure, StackedBars, DotPlot, HeatMap, StepLimits, std::monostate>;

/// A piece of a scene's part, of a chapter, or of the front: a figure, a small table, renders, or several of these.
struct Chart {
  std::string scene;  // the scene whose part shows it; empty: the first screen, or a chapter
  AnyFigure figure;
  std::string chapter = {};  // id of the chapter (report/page/texts/); empty: none
  std::string text = {};     // in a chapter: the text before it
  std::string heading = {};  // in a chapter; empty: the figure's title
  std::vector<PageTable> tables = {};
  std::vector<Snapshot> snapshots = {};
  bool shown = false;  // in its chapter, not folded away
};

// Words of figures, from texts.md: below "## KEY" a line "WORD: text" for each, with {values}. The key is the figure's
// name; the words are title, x and y ("log x" makes the axis logarithmic), caption, tier, finding, and of its chart
// chapter, heading and text.

using fmt::literals::operator""_a;

/// The text of a word with its values; empty where the figure has none.
std::string filled_text(const std::string& key, const std::string& word, fmt::format_args values = {});
Chart described_chart(const std::string& key, AnyFigure figure, fmt::format_args values);
/// The chart of a figure that has its name and words, except those that are not in texts.md. Of a figure without curves
/// and failures the chart keeps the text, or else the caption.
template <class... Values>
Chart described(const std::string& key, AnyFigure figure, const Values&... values) {
  return described_chart(key, std::move(figure), fmt::make_format_args(values...));
}

/// The curve of this title, which is added where there is none.
Curve& curve_of(Figure& figure, const std::string& title, const MethodStyle& style);

/// Selects the rows with this value.
template <class Row, class T>
auto with(T Row::*member, const std::type_identity_t<T>& value) {
  return std::views::filter([=](const Row& row) { return row.*member == value; });
}
/// The values of a member, each once, in the order in which they come first.
template <class Row, class T>
std::vector<T> distinct(const std::vector<Row>& rows, T Row::*member) {
  std::vector<T> all;
  for (const Row& row : rows)
    if (std::ranges::find(all, row.*member) == all.end()) all.push_back(row.*member);
  return all;
}

/// Name, title and texts of the chart's figure, or null.
const FigureInfo* figure_info(const Chart& chart);
/// Writes and draws its figure, if it has one, as draw() does.
void draw_figure(const Chart& chart, const Provenance& provenance, const std::filesystem::path& folder);

/// Writes its data and its script alone: NAME.csv and NAME.gp.
void write_figure_data(const Chart& chart, const Provenance& provenance, const std::filesystem::path& folder);
/// The method that a title names, or begins with; empty where it names none.
std::string method_in(const std::string& title);
/// The methods that its figure shows.
std::vector<std::string> methods_in(const Chart& chart);

std::vector<Chart> scoreboard_charts(const ChartInput& input);  // error of every method on every scene, a table
std::vector<Chart> matrix_charts(const ChartInput& input);      // engines by questions, a table
std::vector<Chart> same_rule_charts(const ChartInput& input);   // difference of engines with the same rule, by scene
std::vector<Chart> error_charts(const ChartInput& input);       // error over time, per scene with a truth
std::vector<Chart> agreement_charts(const ChartInput& input);   // Bullet against the same rule of mysim, over time
std::vector<Chart> contact_charts(const ChartInput& input);     // centres of mass, clearance, creep on a sphere
std::vector<Chart> balance_charts(const ChartInput& input);     // balance error or contact loss over time
std::vector<Chart> order_charts(const ChartInput& input);       // error against step

std::vector<Chart> energy_charts(const ChartInput& input);        // budget, drift, numerical damping
std::vector<Chart> probe_charts(const ChartInput& input);         // friction, rebound, depth, drapes
std::vector<Chart> stiffness_charts(const ChartInput& input);     // of position-based links
std::vector<Chart> fabric_charts(const ChartInput& input);        // strips against the elastica
std::vector<Chart> disagreement_charts(const ChartInput& input);  // where Bullet solves another problem
std::vector<Chart> cheapest_charts(const ChartInput& input);      // the fastest method at an accuracy, over all scenes
std::vector<Chart> speed_accuracy_charts(const ChartInput& input);  // work-precision diagrams
std::vector<Chart> cost_charts(const ChartInput& input);            // of a step
std::vector<Chart> adequacy_charts(const ChartInput& input);        // errors from removals and grids
std::vector<Chart> stability_charts(const ChartInput& input);       // critical time steps, stability maps

std::vector<Chart> all_charts(const ChartInput& input);

/// x and y of one method's rows in a per-scene table; rows without the value, or not above zero where `positive`, left
/// out.
std::vector<std::pair<double, double>> points_of(const Table& table, const std::string& method,
                                                 const std::string& column, bool positive);

/// "Scene cloth-hang; step 500 µs; commit abc."
std::string caption_of(const Scene& scene, const std::string& commit);
/// Tiers of figures: the scene's truth with its error bar; differences from another engine.
std::string tier_of(const SceneData& facts);
std::string another_engine(const SceneData& facts);

}  // namespace crosscheck
