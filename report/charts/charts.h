// Charts: from the experiments' tables to figures. The table of charts is in charts.cpp; a new one is a function and a
// row.
#pragma once

#include <string>
#include <vector>

#include "report/facts.h"
#include "report/figure.h"

namespace crosscheck {

struct ChartInput {
  const std::vector<Scene>& scenes;
  const std::vector<SceneFacts>& facts;  // one per scene
  const Result& result;
  std::string commit;
};

struct Chart {
  std::string scene;  // where it belongs; empty: the front of the report, or a chapter
  Figure figure;
  std::string chapter;  // of the report, by its id; empty: none
  std::string text;     // in a chapter: what the figure is about, before it
};

std::vector<Chart> scoreboard_charts(const ChartInput& input);  // error of every method on every scene
std::vector<Chart> error_charts(const ChartInput& input);       // error over time, per scene with a truth
std::vector<Chart> agreement_charts(const ChartInput& input);   // Bullet against the same rule of mysim, over time
std::vector<Chart> contact_charts(const ChartInput& input);     // centres of mass, clearance, creep on a sphere
std::vector<Chart> energy_charts(const ChartInput& input);      // balance error or contact loss over time
std::vector<Chart> order_charts(const ChartInput& input);       // error against step

std::vector<Chart> stiffness_charts(const ChartInput& input);     // of position-based links
std::vector<Chart> disagreement_charts(const ChartInput& input);  // where Bullet answers otherwise than it is asked

std::vector<Chart> all_charts(const ChartInput& input);

/// x and y of one method's rows in a per-scene table; rows without the value, or not above zero where `positive`, left
/// out.
std::vector<std::pair<double, double>> points_of(const Table& table, const std::string& method,
                                                 const std::string& column, bool positive);

/// "scene cloth-hang; truth: converged, error bar 2e-9 m; step 0.5 ms; commit abc"
std::string caption_of(const Scene& scene, const SceneFacts& facts, const std::string& commit, bool with_truth);

}  // namespace crosscheck
