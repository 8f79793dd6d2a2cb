// Curves, marks and fillings are distinguishable in grey and with colour blindness. Tests that create reports
// (cli_slow_test, adding_slow_test) check the figures in them.

#include <fmt/format.h>

#include "tests/unit/report/telling_apart.h"

#include "reference/method.h"
#include "report/figures/chapter_parts.h"
#include "report/figures/charts.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(TellingApart, SimulatesWhatIsKnownOfColourBlindness) {
  EXPECT_NEAR(lab(linear_light("#FFFFFF"))[0], 100, 1e-3);
  EXPECT_NEAR(lab(linear_light("#777777"))[0], 50.03, 0.01);
  for (const Eigen::Matrix3d& m : colour_blindness())
    // the rows of each matrix sum to one (to the six digits of the table), so that greys do not change
    EXPECT_LT((m * Rgb::Ones() - Rgb::Ones()).cwiseAbs().maxCoeff(), 2e-6);
  EXPECT_LT(colour_apart("#CC6677", "#009E73"), least_colour) << "red and green of the same lightness";
  EXPECT_GT(colour_apart("#0072B2", "#D55E00"), 60) << "blue and orange, with any colour blindness";
}

/// Script of a figure with two curves.
std::string script(const std::string& one, const std::string& other) {
  return "plot 'a.csv' using (strcol(1) eq 'one' ? $2 : NaN):3 with " + one +
         " notitle, \\\n     'a.csv' using (strcol(1) eq 'other' ? $2 : NaN):3 with " + other + " notitle\n";
}

TEST(TellingApart, FindsWhatLooksAlike) {
  const auto red = "linespoints lc rgb \"#CC6677\" lw 2 dt 1 pt 7 ps 1",
             green = "linespoints lc rgb \"#009E73\" lw 2 dt 1 pt 7 ps 1";
  EXPECT_TRUE(contains(looking_alike(script(red, green)), "'other' #009E73 and 'one' #CC6677: lightness 2."));
  EXPECT_EQ(looking_alike(script(red, "linespoints lc rgb \"#009E73\" lw 2 dt (2,2) pt 7 ps 1")), "") << "dash";
  EXPECT_EQ(looking_alike(script(red, "linespoints lc rgb \"#009E73\" lw 2 dt 1 pt 5 ps 1")), "") << "mark";
  EXPECT_EQ(looking_alike(script(red, "linespoints lc rgb \"#0B2A20\" lw 2 dt 1 pt 7 ps 1")), "") << "lightness";
  EXPECT_FALSE(alike_dashes("1", "(8,4)"));
  EXPECT_TRUE(alike_dashes("(12,3,2,3)", "(12,3,3,3)"));
  EXPECT_NE(looking_alike(script("boxxyerror lc rgb \"#999999\" fs solid", "boxxyerror lc rgb \"#CC79A7\" fs solid")),
            "");
  EXPECT_EQ(looking_alike(script("boxxyerror lc rgb \"#999999\" fs solid",
                                 "boxxyerror lc rgb \"#CC79A7\" fs transparent pattern 4")),
            "");
}

TEST(TellingApart, CrossesOfTwoMethodsHaveTheirMarksBesideThem) {
  Figure f;
  f.name = "fails", f.title = "two fail", f.x = {"time step / s", true}, f.y = {"error / m", true};
  for (const char* method : {"mysim/leapfrog", "mysim/suzuki4"}) {
    f.curves.push_back({method, style_of(method), {{1e-4, 1e-6}, {1e-3, 1e-4}}, true, true});
    f.failures.push_back({std::string(method) + ": blew up", style_of(method), 0.1, 1, "blew up"});
  }
  EXPECT_EQ(looking_alike(drawing_of(f).script), "");
  std::string bare;
  std::istringstream lines(drawing_of(f).script);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("set label ''")) bare += line + "\n";
  EXPECT_TRUE(contains(looking_alike(bare), "failed: mysim/"));
}

TEST(TellingApart, AllMethodsInOneFigure) {
  for (size_t first = 0; first < builtin_methods().size(); ++first) {
    Figure f;
    f.name = "methods", f.title = "six in colour", f.x = {"t / s"}, f.y = {"error / m"};
    for (const Method& m : builtin_methods().subspan(first)) {
      if (m.family().role == Role::truth || f.curves.size() == 6) continue;
      f.curves.push_back({m.name, style_of(m.name), {{0, 1}, {1, static_cast<double>(f.curves.size())}}, true, true});
    }
    if (f.curves.empty()) break;
    EXPECT_EQ(looking_alike(drawing_of(f).script), "");
  }
}

TEST(TellingApart, EveryVerdictInOneMap) {
  std::vector<MapRow> cells;
  for (int i = 0; i <= static_cast<int>(Verdict::unsupported); ++i)
    cells.push_back({.scene = "s",
                     .method = "mysim/rk4",
                     .map = "drag",
                     .value = std::pow(10., i / 3),
                     .step = std::pow(10., i % 3),
                     .verdict = static_cast<Verdict>(i),
                     .end = 1});
  const std::vector<Chart> maps = map_charts(cells, {}, "commit");
  ASSERT_EQ(maps.size(), 1u);
  const std::string drawn = drawing_of(std::get<HeatMap>(maps[0].figure)).script;
  EXPECT_EQ(looks_of(drawn).size(), cells.size());
  EXPECT_EQ(looking_alike(drawn), "");
}

}  // namespace
}  // namespace crosscheck
