// Tests charts (stacked bars, fastest methods at an accuracy, distances to a method's own finest run) and their numbers
// on the page.

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/experiment.h"
#include "experiments/scenes/scenes.h"
#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/sweep/sweep.h"
#include "experiments/tables/fabric.h"
#include "mysim/base/json.h"
#include "report/base/assets.h"
#include "report/figures/chart_json.h"
#include "report/figures/charts.h"
#include "report/figures/figure.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

StackedBars two_bars() {
  StackedBars bars;
  bars.name = "test-bars", bars.title = "bars", bars.label = "energy / J";
  bars.names = {"mysim/a", "bullet/b"};
  bars.parts = {{"drag", "#0072B2", false, {2, 1}},
                {"contact (inferred)", "#D55E00", true, {0, 3}},
                {"gravity", "#999999", false, {-1.5, 0.5}},
                {"wind", "#E69F00", false, {-0.5, -4.5}}};
  return bars;
}

TEST(StackedBars, StackEachSignFromZero) {
  const Table data = drawing_of(two_bars()).data;
  // a part of height zero has no row
  const std::vector<std::vector<Cell>> expected = {{"drag", "mysim/a", 1., 0., 2.},
                                                   {"drag", "bullet/b", 2., 0., 1.},
                                                   {"contact (inferred)", "bullet/b", 2., 1., 4.},
                                                   {"gravity", "mysim/a", 1., 0., -1.5},
                                                   {"gravity", "bullet/b", 2., 4., 4.5},
                                                   {"wind", "mysim/a", 1., -1.5, -2.},
                                                   {"wind", "bullet/b", 2., 0., -4.5}};
  EXPECT_EQ(data.rows, expected);
}

TEST(StackedBars, InferredPartsAreHatchedAndOthersAreNot) {
  const std::string script = drawing_of(two_bars()).script;
  size_t hatched = 0, solid = 0;
  for (size_t at = 0; (at = script.find("boxxyerror", at)) != std::string::npos; ++at) {
    const size_t begin = script.rfind(" using ", at);
    const std::string element = script.substr(begin, script.find("notitle", at) - begin);
    const bool inferred = contains(element, "inferred");
    EXPECT_EQ(contains(element, "pattern"), inferred) << element;
    (inferred ? hatched : solid) += 1;
  }
  EXPECT_EQ(hatched, 1u);  // plotted by one command, which other file formats repeat by `replot`
  EXPECT_EQ(solid, 3u);
}

TEST(StackedBars, NothingAndWhatIsNotFiniteAreRefused) {
  const auto message = [](const StackedBars& bars) -> std::string {
    try {
      drawing_of(bars);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  StackedBars empty = two_bars(), bad = two_bars();
  for (StackedBars::Part& part : empty.parts) part.height = {0, 0};
  bad.parts[1].height[1] = NAN;
  EXPECT_EQ(message(empty), "figure test-bars: nothing to draw");
  EXPECT_EQ(message(bad), "figure test-bars: a value is not finite");
  EXPECT_EQ(message(two_bars()), "");
}

using namespace testing_tools;

WorkPrecisionPoint point(const std::string& method, double error, double seconds, bool ok = true) {
  const Timing time{seconds, 0.9 * seconds, 1.2 * seconds, 5};
  return {method, SettingKind::step, 0.01, ok, error, seconds, time};
}

double number(const Table& t, size_t row, const char* column) { return std::get<double>(t.at(row, column)); }
std::string word(const Table& t, size_t row, const char* column) { return std::get<std::string>(t.at(row, column)); }

const std::vector<WorkPrecisionPoint> runs = {point("mysim/rk4", 1e-6, 8),
                                              point("mysim/leapfrog", 5e-3, 2),
                                              point("mysim/xpbd", 0.05, 1),
                                              point("odeint/rk4", 1e-6, 4),
                                              point("bullet/pbd", 0.5, 3),
                                              point("bullet/deformable-explicit", 8e-3, 60),
                                              point("sundials/arkode", 1e-6, 0.5, false)};

TEST(ByEngine, TheCheapestRunOfEachWithinTheBoundBesideMysims) {
  Table t = table_of<EngineSpeedRow>();
  add_by_engine("s", 0.01, Measure::error, 0.01, runs, t);
  ASSERT_EQ(t.rows.size(), 3u) << "ARKODE failed and must not count";
  EXPECT_EQ(word(t, 0, "method"), "mysim/leapfrog");
  EXPECT_EQ(number(t, 0, "times mysim"), 1);
  EXPECT_EQ(word(t, 1, "method"), "odeint/rk4");
  EXPECT_EQ(number(t, 1, "times mysim"), 2);
  EXPECT_EQ(word(t, 2, "engine"), "bullet");
  EXPECT_EQ(number(t, 2, "times mysim"), 30);
  // each time may be 0.9 to 1.2 times its stated value: 60 x 0.9 / (2 x 1.2), and 60 x 1.2 / (2 x 0.9)
  EXPECT_DOUBLE_EQ(number(t, 2, "times mysim low"), 22.5);
  EXPECT_DOUBLE_EQ(number(t, 2, "times mysim high"), 40);
}

TEST(ByEngine, WithoutARunOfMysimThereIsNoQuotient) {
  Table t = table_of<EngineSpeedRow>();
  add_by_engine("s", 1e-5, Measure::error, 1e-7, runs, t);
  EXPECT_TRUE(t.rows.empty()) << "no method is as accurate";
  add_by_engine("s", 0.1, Measure::error, 0.1, {runs[3]}, t);
  ASSERT_EQ(t.rows.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(t.at(0, "times mysim")));
}

std::vector<Chart> charts_of(const Table& t) {
  TableSet rows;
  rows.add(t);
  const std::vector<Scene> scenes;
  const std::vector<SceneData> facts;
  return cheapest_charts({scenes, facts, rows, "commit"});
}

TEST(SameRuleChart, PutsEachEnginesDotsOnTheirScenes) {
  const auto of = [](const std::string& method, double difference) {
    MethodData m;
    m.method = method, m.verdict = Verdict::ok, m.same_rule = true, m.difference = difference;
    return m;
  };
  std::vector<SceneData> facts(3);
  facts[0].scene = "chain", facts[0].methods = {of(theirs, 1e-15), of("exec:./mine", 2e-15)};
  facts[1].scene = "cloth", facts[1].methods = {of(theirs, 3e-15)};
  facts[2].scene = "rope", facts[2].methods = {of("exec:./mine", 4e-15)};
  const TableSet none;
  const std::vector<Chart> charts = same_rule_charts({{}, facts, none, "commit"});
  ASSERT_EQ(charts.size(), 1u);
  const auto& plot = std::get<DotPlot>(charts[0].figure);
  EXPECT_EQ(plot.names, (std::vector<std::string>{"chain", "cloth", "rope"}));
  for (const auto& [method, expected] :
       {std::pair{theirs, std::array{1e-15, 3e-15, 0.}}, {std::string("exec:./mine"), std::array{2e-15, 0., 4e-15}}}) {
    const auto series = std::ranges::find(plot.series, method, &DotPlot::Series::title);
    ASSERT_NE(series, plot.series.end()) << method;
    ASSERT_EQ(series->dots.size(), 3u);
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(series->dots[i] ? series->dots[i]->value : 0, expected[i]) << method << i;
  }
}

bool same(const MethodStyle& a, const MethodStyle& b) {
  return a.colour == b.colour && a.dash == b.dash && a.marker == b.marker;
}

TEST(Styles, StandInTheMethodsRows) {
  EXPECT_TRUE(same(style_of("mysim/symplectic-euler"), {"#1D6FB5", "(12,3,2,3)", 7}));
  EXPECT_TRUE(same(style_of("mysim/symplectic-euler+sticky"), {"#666666", "(3,3)", 8}));
  EXPECT_TRUE(same(style_of("bullet/pbd"), {"#B05200", "(8,4)", 13}));
  EXPECT_TRUE(same(style_of("bullet32/pbd"), {"#B08050", "(4,2,1,2)", 6}));
  EXPECT_TRUE(same(style_of("sundials/cvode"), {"#7A6A4A", "(4,2,2,2)", 13}));
  std::vector<MethodStyle> all;
  for (const Method& m : builtin_methods())
    if (m.family().role != Role::truth) all.push_back(style_of(m.name));
  for (size_t place = 0; place < 20; ++place) all.push_back(spare_style(place));  // for engines without styles
  for (size_t i = 0; i < all.size(); ++i)
    for (size_t j = 0; j < i; ++j) EXPECT_FALSE(same(all[i], all[j])) << i << " " << j;
}

TEST(CheapestChart, SaysWhoIsFastestWhereTheClockCanTell) {
  Table t = table_of<EngineSpeedRow>();
  for (const double part : {0.1, 0.01, 0.001}) add_by_engine("cloth", part, Measure::error, part, runs, t);
  // here the intervals of odeint's and mysim's times overlap, so neither is faster
  add_by_engine("rod", 0.01, Measure::error, 0.01, {point("mysim/xpbd", 1e-3, 2), point("odeint/rk4", 1e-6, 2.1)}, t);
  // these rows measure differences from a rule of mysim, which are not errors, so the figure omits them
  add_by_engine("drape", 0.01, Measure::difference, 0.01, runs, t);
  const auto charts = charts_of(t);
  ASSERT_EQ(charts.size(), 1u);
  const DotPlot& f = std::get<DotPlot>(charts[0].figure);
  EXPECT_EQ(f.names, (std::vector<std::string>{"cloth", "rod"}));
  ASSERT_EQ(f.series.size(), 2u);
  EXPECT_EQ(f.series[0].title, "Bullet");
  EXPECT_EQ(f.series[0].dots[0]->value, 30);
  EXPECT_FALSE(f.series[0].dots[1]);
  EXPECT_TRUE(says(f.finding, {"1 %", "1 of 2 scenes", "Bullet", "30 (cloth)", "odeint", "1.1 (rod) to 2 (cloth)"}));
  EXPECT_NO_THROW(drawing_of(f));
}

TEST(CheapestChart, WithoutAnotherEngineThereIsNone) {
  Table t = table_of<EngineSpeedRow>();
  add_by_engine("cloth", 0.01, Measure::error, 0.01, {runs[0], runs[1]}, t);
  EXPECT_TRUE(charts_of(t).empty());
  EXPECT_TRUE(cheapest_charts({{}, {}, {}, "commit"}).empty());
}

TEST(CheapestChart, NamesWhoIsThereAndWhichTimesAreScaled) {
  EXPECT_EQ(builds_text({"mysim/rk4", "bullet/pbd"}), "mysim built here, Bullet by Debian for generic x86-64");
  EXPECT_EQ(builds_text({"mysim/", "odeint/", "bullet/", "sundials/"}),
            "mysim and odeint built here, Bullet and SUNDIALS by Debian for generic x86-64");
  EXPECT_EQ(builds_text({"mysim/rk4", "exec:./a"}), "mysim built here, external programs as they were built");
  const auto caption_of = [](const std::vector<WorkPrecisionPoint>& points) {
    Table t = table_of<EngineSpeedRow>();
    add_by_engine("cloth", 0.01, Measure::error, 0.01, points, t);
    return figure_info(charts_of(t).at(0))->caption;
  };
  std::vector<WorkPrecisionPoint> whole{point("mysim/rk4", 1e-3, 1), point("bullet/pbd", 1e-3, 8)}, part = whole;
  EXPECT_FALSE(contains(caption_of(whole), "scaled"));
  EXPECT_FALSE(contains(caption_of(whole), "SUNDIALS")) << "methods without a run are not named";
  EXPECT_FALSE(contains(caption_of(whole), "odeint"));
  part[1].part = 0.1;
  EXPECT_TRUE(contains(caption_of(part), "1 of 1 ratios"));
}

TEST(FabricCharts, SayTheDeviationOnTheFinestGridAndItsOrder) {
  Table drops = table_of<CantileverRow>(), frequencies = table_of<StripVibrationRow>(), nets = table_of<SkipOneRow>();
  for (const long cells : {8, 16, 32}) {
    const double part = 64. / static_cast<double>(cells * cells);
    add(drops, CantileverRow{"its own weight", cells, 5, 0, 0.5 - 0.005 * part, 0.5, -0.01 * part});
    add(frequencies, StripVibrationRow{cells, 1, 2, 2, 0.02 * part});
    add(nets, SkipOneRow{"bending term", cells, 0, 0.5, 0.5});
    add(nets, SkipOneRow{"skip-one springs", cells, 100, 0.01 * static_cast<double>(cells), 0.5});
  }
  TableSet rows;
  for (const Table& table : {drops, frequencies, nets}) rows.add(table);
  const auto charts = fabric_charts({{}, {}, rows, "commit"});
  ASSERT_EQ(charts.size(), 2u);
  for (const Chart& chart : charts) EXPECT_NO_THROW(drawing_of(std::get<Figure>(chart.figure)));
  EXPECT_TRUE(contains(figure_info(charts[0])->finding, "accurate to 0.125 %")) << figure_info(charts[0])->finding;
  EXPECT_TRUE(contains(figure_info(charts[0])->finding, "power 2.00 to 2.00"));
  EXPECT_TRUE(contains(figure_info(charts[1])->finding, "hangs 8 % to 32 % of its length"));
  EXPECT_TRUE(fabric_charts({{}, {}, {}, "commit"}).empty());
}

TEST(FabricCharts, SayTheDrapeAndWhatItDependsOn) {
  Table drapes = table_of<DrapedDiscRow>(), strips = table_of<HangingStripRow>(), shapes = table_of<HangingShapeRow>();
  add(drapes, DrapedDiscRow{"5 waves", 8, 2e-5, 40, 5, 71, -2e-4});
  add(drapes, DrapedDiscRow{"6 waves", 8, 2e-5, 40, 6, 74, -1e-4});
  add(drapes, DrapedDiscRow{"5 waves", 8, 2e-5, 160, 5, 76, -1e-4});
  add(drapes, DrapedDiscRow{"5 waves", 16, 2e-5, 40, 5, 71.5, -2e-4});
  for (const double gamma : {0., 60.}) {
    add(strips, HangingStripRow{8, gamma, 0.3, 0.3, 0.04});
    add(strips, HangingStripRow{16, gamma, 0.3, 0.3, 0.01});
    for (const double x : {-1., 0., 1.}) add(shapes, HangingShapeRow{gamma, x, x * x, x, x * x});
  }
  TableSet rows;
  for (const Table& table : {drapes, strips, shapes}) rows.add(table);
  const auto charts = fabric_charts({{}, {}, rows, "commit"});
  ASSERT_EQ(charts.size(), 2u);
  for (const Chart& chart : charts) EXPECT_NO_THROW(drawing_of(std::get<Figure>(chart.figure)));
  EXPECT_TRUE(contains(figure_info(charts[0])->finding, "accurate to 1 %")) << figure_info(charts[0])->finding;
  EXPECT_TRUE(contains(figure_info(charts[0])->finding, "power 2.00 to 2.00"));
  EXPECT_TRUE(
      says(figure_info(charts[1])->finding, {"5 nodes", "71.5 %", "0.5 percentage points", "8 rings", "71 to 74 %"}))
      << figure_info(charts[1])->finding;
  EXPECT_TRUE(
      contains(figure_info(charts[1])->caption, "with four times this C66, the coefficient is 76.0 % on 8 rings"));
}

TEST(OwnCharts, AreOfScenesThatTheExperimentLooksAt) {
  for (const Experiment& e : experiments())
    for (const std::string_view scene : e.quick_charts) {
      SCOPED_TRACE(fmt::format("{} {}", e.name, scene));
      const std::string name(scene);
      EXPECT_NO_THROW(load_scene(name));
      EXPECT_NE(std::find(e.quick_scenes.begin(), e.quick_scenes.end(), scene), e.quick_scenes.end());
      EXPECT_TRUE(has_own_charts(std::string(e.name), name, false));
    }
  EXPECT_FALSE(has_own_charts("speed-accuracy", "spring", false));
  EXPECT_TRUE(has_own_charts("speed-accuracy", "spring", true));
  EXPECT_TRUE(has_own_charts("order", "spring", false)) << "all scenes have charts unless a selection is given";
}

using namespace testing_tools;

JsonField json_of(const Chart& chart) { return JsonField::parse(dump(chart_json(chart)), "chart"); }

/// One oscillating curve.
Chart swinging(int count) {
  Figure f;
  f.name = "swing", f.title = "a swing", f.caption = "c", f.finding = "It swings.";
  f.x = {"time / s"}, f.y = {"error / m", true, 1e-9};
  Curve curve{"mysim/leapfrog", style_of("mysim/leapfrog"), {}};
  for (int i = 0; i < count; ++i) curve.points.emplace_back(1e-3 * i, 1.5 + std::sin(0.37 * i));
  f.curves = {curve};
  return {"", f};
}

TEST(ChartJson, CurvesOfUpTo600PointsAreWhole) {
  for (const int count : {1, 2, 599, 600}) {
    const Chart chart = swinging(count);
    const JsonField points = json_of(chart)["parts"][0]["series"][0]["points"];
    ASSERT_EQ(points.size(), static_cast<size_t>(count));
    const auto& drawn = std::get<Figure>(chart.figure).curves[0].points;
    for (int i = 0; i < count; ++i) {
      ASSERT_NEAR(points[i][0].number(), drawn[i].first, 1e-4 * drawn.back().first) << "relative to the axis range";
      ASSERT_NEAR(points[i][1].number(), drawn[i].second, 5e-4 * drawn[i].second)
          << "four digits on a logarithmic axis";
    }
  }
}

TEST(ChartJson, LongerCurvesKeepTheirEndsAndExtremes) {
  for (const int count : {601, 1501, 20000}) {
    SCOPED_TRACE(count);
    Chart chart = swinging(count);
    auto& drawn = std::get<Figure>(chart.figure).curves[0].points;
    drawn[static_cast<size_t>(count) / 2].second = 90, drawn[static_cast<size_t>(count) / 3].second = 1e-4;
    const JsonField points = json_of(chart)["parts"][0]["series"][0]["points"];
    EXPECT_LE(points.size(), 600u);
    EXPECT_GT(points.size(), 300u);
    double low = INFINITY, high = 0, last = -1;
    for (const JsonField& point : points.elements()) {
      EXPECT_GT(point[0].number(), last) << "strictly ascending";
      last = point[0].number();
      low = std::min(low, point[1].number()), high = std::max(high, point[1].number());
    }
    EXPECT_EQ(points[0][0].number(), 0);
    EXPECT_NEAR(last, drawn.back().first, 1e-6 * last);
    EXPECT_EQ(high, 90);
    EXPECT_EQ(low, 1e-4);
  }
}

TEST(ChartJson, OfCurvesSaysWhatIsDrawnBesideThem) {
  Figure f;
  f.name = "all", f.title = "everything", f.caption = "c", f.finding = "It falls.";
  f.x = {"CPU time, ringed: scaled from a part of it / s", true}, f.y = {"error / m", true, 1e-6, 1.};
  f.curves = {{"mysim/leapfrog, twice", style_of("mysim/leapfrog"), {{1, 0.1}, {2, 0.05}}, true, true},
              {"theory", style_of("mysim/rk4"), {{1, 1}, {2, 1e-5}}},
              {scaled_times, style_of("mysim/rk4"), {{2, 0.05}}, false},
              {"nothing", style_of("mysim/rk4"), {}}};
  f.curves[0].tooltips = {{"first", "mysim/leapfrog 0"}, {"second"}};
  f.failures = {{"mysim/rk4: blew up", style_of("mysim/rk4"), 5, 0.5, "blew up", 2, {"at 2 s", "mysim/rk4 3"}}};
  f.pareto = {{1, 0.1}, {2, 0.05}};
  f.floor = {"error bar", 1e-5};
  f.window = {3, "not predictable"};
  f.categories = {{1, "spring"}};
  f.guides = {{true, 1.5, "limit"}, {false, 0.2, "1 %"}};
  f.cut = 1e-4;
  f.on_page = {.take = OnPage::Take{1, 0.1, "take this: 1 ms", "11 %"}};
  const JsonField json = json_of({"", f});
  EXPECT_EQ(json["kind"].text(), "curves");
  EXPECT_EQ(json["name"].text(), "all");
  EXPECT_EQ(json["title"].text(), "everything");
  EXPECT_EQ(json["finding"].text(), "It falls.");
  EXPECT_EQ(json["caption"].text(), "c");
  EXPECT_EQ(json["x"]["label"].text(), "CPU time") << "points ringed on paper are open marks on the page";
  EXPECT_EQ(json["x"]["unit"].text(), "s");
  EXPECT_TRUE(json["x"]["log"].boolean());
  EXPECT_EQ(json["y"]["low"].number(), 1e-4) << "lower values are drawn on the axis";
  EXPECT_EQ(json["y"]["high"].number(), 1);
  ASSERT_EQ(json["parts"].size(), 3u) << "no rings around other marks, and no empty curves";
  const JsonField leapfrog = json["parts"][0], first = leapfrog["series"][0], theory = json["parts"][1];
  EXPECT_EQ(leapfrog["method"].text(), "mysim/leapfrog");
  EXPECT_EQ(leapfrog["colour"].text(), "mysim") << "style.css defines it for both modes";
  EXPECT_TRUE(leapfrog["hero"].boolean());
  EXPECT_EQ(first["mark"].text(), "circle");
  EXPECT_FALSE(first.find("open"));
  EXPECT_FALSE(first.find("dash"));
  EXPECT_EQ(first["tips"][0]["words"].text(), "first");
  EXPECT_EQ(first["tips"][0]["run"].text(), "mysim/leapfrog 0");
  EXPECT_FALSE(first["tips"][1].find("run"));
  EXPECT_EQ(first["scaled"].dump(), "[0,1]") << "its second time is scaled";
  EXPECT_FALSE(theory.find("method")) << "theory is not a method";
  EXPECT_EQ(theory["series"][0]["dash"].text(), "6 3");
  EXPECT_TRUE(theory["series"][0]["few"].boolean());
  const JsonField failed = json["parts"][2];
  EXPECT_EQ(failed["method"].text(), "mysim/rk4");
  EXPECT_EQ(failed["failures"][0]["run"].text(), "mysim/rk4 3");
  EXPECT_EQ(failed["failures"][0]["kind"].text(), "blew up");
  EXPECT_EQ(failed["failures"][0]["mark"].text(), "cross");
  std::set<std::string> key;
  for (const JsonField& entry : json["key"].elements()) key.insert(entry["text"].text());
  EXPECT_EQ(key, (std::set<std::string>{"Pareto front", "blew up", "time scaled from a part", "lower than the axis"}));
  EXPECT_EQ(json["pareto"].size(), 2u);
  EXPECT_EQ(json["window"].number(), 3);
  EXPECT_EQ(json["categories"][0][1].text(), "spring");
  ASSERT_EQ(json["guides"].size(), 4u) << "including the names of the window and the floor";
  EXPECT_EQ(json["guides"][0]["axis"].text(), "x");
  EXPECT_EQ(json["guides"][1]["text"].text(), "1 %");
  EXPECT_EQ(json["guides"][3]["kind"].text(), "floor");
  EXPECT_EQ(json["take"]["name"].text(), "take this: 1 ms");
  EXPECT_FALSE(json.find("flat"));
}

/// Names of the marks, which begin with "open " if the marks are not filled.
std::vector<std::string> marks_of(const JsonField& chart) {
  std::vector<std::string> marks;
  for (const JsonField& part : chart["parts"].elements())
    for (const JsonField& series : part["series"].elements())
      marks.push_back((series.find("open") ? "open " : "") + series["mark"].text());
  return marks;
}

TEST(ChartJson, MarksAreThoseOfThePaperWithTheirFilling) {
  Figure f;
  f.name = "marks", f.title = "t", f.x = {"slope / degrees"}, f.y = {"friction"};
  for (const int marker : {7, 6, 9})
    f.curves.push_back({fmt::format("bullet/pbd kind {}", marker), {"#B05200", "1", marker}, {{1, 1}}, false, true});
  f.curves.push_back({"mysim/rk4 sticks", {"#009E73", "1", 12}, {{1, 2}}, false, true});
  const JsonField json = json_of({"", f});
  EXPECT_EQ(marks_of(json), (std::vector<std::string>{"circle", "open circle", "triangle", "open diamond"}));
  ASSERT_EQ(json["parts"].size(), 2u) << "one name per method";
  EXPECT_EQ(json["parts"][0]["name"].text(), "Bullet pbd");
  EXPECT_TRUE(json["parts"][0]["keyed"].boolean()) << "scattered marks have no end to put a name at";
  EXPECT_TRUE(contains(drawing_of(f).script, "Bullet pbd"));
}

TEST(ChartJson, UnitsAreNotTheLowerPartsOfRatios) {
  for (const auto& [label, unit] : {std::pair{"time step / s", "s"},
                                    {"sliding speed / (mm/s)", "mm/s"},
                                    {"drag rate / (1/s)", "1/s"},
                                    {"effective stiffness by sag / % of specified", "% of specified"},
                                    {"dimensionless stiffness k h² / μ", ""},
                                    {"equivalent drag rate / ω", ""},
                                    {"CPU time / CPU time of mysim", ""}}) {
    Figure f;
    f.name = "unit", f.x = {label}, f.y = {"y"}, f.curves = {{"a", style_of("mysim/rk4"), {{1, 1}, {2, 2}}}};
    const JsonField x = json_of({"", f})["x"];
    EXPECT_EQ(x.find("unit") ? x["unit"].text() : "", unit) << label;
    EXPECT_EQ(x["label"].text() == label, !*unit) << label;
  }
}

TEST(ChartJson, EnginesHaveTheSameColoursInEveryChartOnPaperAndOnThePage) {
  const std::string styles = asset("page/style.css");
  for (const auto& [method, name] : {std::pair{"mysim/leapfrog", "mysim"},
                                     {"mysim/symplectic-euler", "mysim2"},
                                     {"bullet/deformable-explicit", "bullet"},
                                     {"bullet/pbd", "bullet2"},
                                     {"odeint/rk4", "outside"}}) {
    std::string paper = style_of(method).colour;
    std::ranges::transform(paper, paper.begin(), [](unsigned char c) { return std::tolower(c); });
    EXPECT_TRUE(contains(styles, fmt::format("--{}: {};", name, paper))) << method;
    Figure curve;
    curve.name = "curve", curve.x = {"t / s"}, curve.y = {"y"}, curve.curves = {{method, style_of(method), {{1, 1}}}};
    EXPECT_EQ(json_of({"", curve})["parts"][0]["colour"].text(), name);
    DotPlot dots;
    dots.name = "dots", dots.label = "CPU time", dots.names = {"rod"};
    dots.series = {{"an engine", style_of(method), {DotPlot::Dot{2, 1, 3}}}};
    EXPECT_EQ(json_of({"", dots})["series"][0]["colour"].text(), name);
  }
}

std::vector<std::string> names_in(const JsonField& chart) {
  std::vector<std::string> names;
  for (const JsonField& name : chart["names"].elements()) names.push_back(name["name"].text());
  return names;
}

TEST(ChartJson, OfBarsHasAHeightForEachPartOfEachBar) {
  const StackedBars bars = two_bars();
  const JsonField json = json_of({"", bars, "energy"});
  EXPECT_EQ(json["kind"].text(), "bars");
  EXPECT_EQ(names_in(json), bars.names);
  ASSERT_EQ(json["parts"].size(), bars.parts.size());
  for (size_t i = 0; i < bars.parts.size(); ++i) {
    EXPECT_EQ(json["parts"][i]["height"].numbers(), bars.parts[i].height);
    EXPECT_EQ(json["parts"][i]["hatched"].boolean(), bars.parts[i].hatched);
  }
}

TEST(ChartJson, OfDotsHasAnIntervalOrNothingForEachName) {
  DotPlot dots;
  dots.name = "dots", dots.title = "t", dots.caption = "c", dots.finding = "f", dots.label = "CPU time of mysim's";
  dots.names = {"cloth", "rod"}, dots.headings = {{1, "without cloth"}};
  dots.series = {{"Bullet", style_of("bullet/pbd"), {DotPlot::Dot{30, 22.5, 40}, std::nullopt}}};
  dots.right_of_one = "mysim is faster";
  const JsonField json = json_of({"", dots});
  EXPECT_EQ(json["kind"].text(), "dots");
  EXPECT_EQ(names_in(json), dots.names);
  EXPECT_EQ(json["guides"][0]["text"].text(), "mysim is faster");
  EXPECT_TRUE(contains(drawing_of(dots).script, "mysim is faster")) << "also next to its line on paper";
  EXPECT_EQ(json["headings"][0][1].text(), "without cloth");
  EXPECT_EQ(json["series"][0]["dots"].size(), 2u);
  EXPECT_EQ(json["series"][0]["dots"][0].numbers(), (std::vector<double>{30, 22.5, 40}));
  EXPECT_TRUE(json["series"][0]["dots"][1].is_null());
  EXPECT_TRUE(json["x"]["log"].boolean());
}

TEST(ChartJson, OfAMapHasEveryCellWithItsRun) {
  HeatMap map;
  map.name = "map", map.title = "t", map.caption = "c", map.finding = "f";
  map.x_label = "time step / s", map.y_label = "stiffness / nominal stiffness";
  map.kinds = {{"stable", "#D8E8F0"}, {"fails", "#D55E00"}};
  HeatMap::Panel panel{"mysim/rk4", {}, {{1, 1}, {2, 4}}, {{1, 1}}};
  for (int i = 0; i < 12; ++i)
    panel.cells.push_back(
        {std::pow(2, i % 4), std::pow(2, i / 4), i % 2, {fmt::format("cell {}", i), fmt::format("mysim/rk4 {}", i)}});
  map.panels = {panel};
  const JsonField json = json_of({"", map});
  EXPECT_EQ(json["kind"].text(), "map");
  EXPECT_EQ(json["x"]["unit"].text(), "s");
  EXPECT_EQ(json["y"]["label"].text(), map.y_label) << "a ratio is not a unit";
  EXPECT_FALSE(json["y"].find("unit"));
  EXPECT_EQ(json["kinds"].size(), 2u);
  const JsonField cells = json["panels"][0]["cells"];
  ASSERT_EQ(cells.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(cells[i][0].number(), panel.cells[i].x);
    EXPECT_EQ(cells[i][1].number(), panel.cells[i].y);
    EXPECT_EQ(cells[i][2].whole(), i % 2);
    EXPECT_EQ(cells[i][3].text(), fmt::format("cell {}", i));
    EXPECT_EQ(cells[i][4].text(), fmt::format("mysim/rk4 {}", i));
  }
  EXPECT_EQ(json["panels"][0]["predicted"].size(), 2u);
  EXPECT_EQ(json["panels"][0]["measured"].size(), 1u);
}

/// Limits of one rule on two scenes, and of three others: one needs drag, one is stable at every step, and one has no
/// theory.
std::vector<LimitRow> limit_rows() {
  const auto row = [](const char* scene, const char* method, PredictionKind theory, double predicted, double omega,
                      MeasuredLimit::Kind found, double measured, double held) {
    LimitRow r{.scene = scene, .method = method, .prediction = theory, .measurement = found};
    if (predicted >= 0) r.predicted = predicted;
    if (omega > 0) r.omega = omega;
    if (measured > 0) r.measured = measured;
    if (held > 0) r.held = held;
    return r;
  };
  constexpr auto limit = PredictionKind::limit, none = PredictionKind::none;
  constexpr auto found = MeasuredLimit::found;
  return {row("spring", "mysim/explicit-euler", PredictionKind::no_step, 0, 10, MeasuredLimit::no_step, 0, 0),
          row("cloth", "mysim/explicit-euler", limit, 2e-6, 1000, found, 2.01e-6, 2e-6),
          row("spring", "mysim/leapfrog", limit, 0.2, 10, found, 0.199, 0.198),
          row("cloth", "mysim/leapfrog", limit, 2e-3, 1000, found, 2.004e-3, 2e-3),
          row("spring", "mysim/implicit-euler", PredictionKind::every_step, -1, 0, MeasuredLimit::every_step, 0, 12.8),
          row("spring", "bullet/pbd", none, -1, 0, found, 0.31, 0.3)};
}

TEST(StepLimits, FallOnOneLineWhateverTheScene) {
  const StepLimits f = step_limits_of(limit_rows(), "cloth");
  EXPECT_EQ(f.names,
            (std::vector<std::string>{"mysim/implicit-euler", "bullet/pbd", "mysim/leapfrog", "mysim/explicit-euler"}))
      << "stable at every step, then in descending order of limits";
  EXPECT_EQ(f.columns_of, "cloth");
  ASSERT_EQ(f.scenes.size(), 2u);
  EXPECT_EQ(f.scenes[0].name, "spring") << "in ascending order of omega";
  EXPECT_TRUE(f.rows[0].open);
  EXPECT_EQ(f.rows[0].words, "every step tried, up to h ω = 128");
  EXPECT_FALSE(f.rows[1].marks.at(0).predicted) << "without theory there is no tick";
  const StepLimits::Row& leapfrog = f.rows[2];
  ASSERT_EQ(leapfrog.marks.size(), 2u);
  EXPECT_NEAR(leapfrog.marks[0].measured, 1.99, 1e-12);
  EXPECT_NEAR(leapfrog.marks[1].measured, 2.004, 1e-12);
  EXPECT_NEAR(*leapfrog.marks[1].predicted, 2, 1e-12);
  EXPECT_NEAR(leapfrog.held, 1.99, 1e-12) << "stable on all scenes up to here";
  EXPECT_EQ(leapfrog.measured, "2.0040");
  EXPECT_EQ(leapfrog.predicted, "2.0000");
  EXPECT_EQ(f.rows[3].words, "0 without drag; 0.00201 with the drag of cloth");
  EXPECT_EQ(f.rows[0].measured, "") << "no search was made there";
  EXPECT_EQ(step_limits_of(limit_rows(), "rod").columns_of, "cloth") << "the fastest scene with rows";
  EXPECT_TRUE(step_limits_of({}, "cloth").rows.empty());
  EXPECT_THROW(drawing_of(step_limits_of({}, "cloth")), std::runtime_error);
}

TEST(StepLimits, OfManyScenesMarkFourThatLieFarApart) {
  std::vector<LimitRow> rows;
  for (const auto& [scene, omega] :
       {std::pair{"a", 1.}, {"b", 1.1}, {"c", 30.}, {"d", 1000.}, {"e", 1100.}, {"f", 9e4}})
    rows.push_back(
        {.scene = scene, .method = "mysim/leapfrog", .predicted = 2 / omega, .omega = omega, .measured = 2 / omega});
  const StepLimits f = step_limits_of(rows, "e");
  ASSERT_EQ(f.scenes.size(), 4u);
  EXPECT_EQ(f.scenes.front().name, "a");
  EXPECT_EQ(f.scenes.back().name, "f");
  EXPECT_TRUE(std::ranges::count(f.scenes, "e", &StepLimits::SceneMark::name))
      << "the scene of the columns is always marked";
  EXPECT_EQ(f.rows.at(0).marks.size(), 4u);
}

TEST(StepLimits, AreTheSameOnPaperAndOnThePage) {
  StepLimits f = step_limits_of(limit_rows(), "cloth");
  f.caption = "c", f.finding = "f";
  const JsonField json = json_of({"", f, "stability"});
  const Drawing drawing = drawing_of(f);
  EXPECT_EQ(json["kind"].text(), "limits");
  for (size_t i = 0; i < f.names.size(); ++i) EXPECT_EQ(json["rows"][i]["method"].text(), f.names[i]);
  EXPECT_EQ(json["columns"].text(), "cloth");
  EXPECT_EQ(json["scenes"][1][0].text(), "cloth");
  size_t measured = 0, predicted = 0;
  for (size_t i = 0; i < drawing.data.rows.size(); ++i) {
    const auto& what = std::get<std::string>(drawing.data.at(i, "what"));
    measured += what == "measured", predicted += what == "predicted";
    if (what != "measured") continue;
    const JsonField marks =
        json["rows"][static_cast<size_t>(std::get<double>(drawing.data.at(i, "place"))) - 1]["marks"];
    bool found = false;
    for (const JsonField& mark : marks.elements())
      found |= std::abs(mark[1].number() / std::get<double>(drawing.data.at(i, "h omega")) - 1) < 1e-5;
    EXPECT_TRUE(found) << "every mark of the CSV must be on the page";
  }
  EXPECT_EQ(measured, 4u);
  EXPECT_EQ(predicted, 3u);
  EXPECT_EQ(methods_in({"", f, "stability"}), f.names);
}

/// Relative luminance as defined by WCAG 2.
double luminance(const std::string& colour) {
  double sum = 0;
  constexpr double weights[] = {0.2126, 0.7152, 0.0722};
  for (int i = 0; i < 3; ++i) {
    const double part = std::stoi(colour.substr(static_cast<size_t>(1 + 2 * i), 2), nullptr, 16) / 255.;
    sum += weights[i] * (part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4));
  }
  return sum;
}

TEST(MethodLooks, StandOutFromThePageInBothModes) {
  const std::string styles = asset("page/style.css");
  size_t at = 0;
  for (const char* mode : {"light", "dark"}) {
    SCOPED_TRACE(mode);
    at = styles.find(":root {", at) + 1;
    const std::string table = styles.substr(at, styles.find('}', at) - at);
    const auto colour = [&](const std::string& name) {
      const size_t found = table.find("--" + name + ": ");
      EXPECT_NE(found, std::string::npos) << name;
      return table.substr(found + name.size() + 4, 7);
    };
    for (const char* name :
         {"mysim", "mysim2", "bullet", "bullet2", "truth", "outside", "grey", "difference", "bad", "soft"}) {
      const double a = luminance(colour(name)), b = luminance(colour("back"));
      EXPECT_GE((std::max(a, b) + 0.05) / (std::min(a, b) + 0.05), 3) << name;
    }
  }
}

TEST(ChartJson, OfAChartOfTablesAloneIsNull) {
  EXPECT_TRUE(chart_json({"", std::monostate(), "stability"}).is_null());
  EXPECT_TRUE(methods_in({"", std::monostate(), "stability"}).empty());
}

TEST(ChartJson, TitlesBeginWithTheirMethods) {
  EXPECT_EQ(method_in("mysim/leapfrog"), "mysim/leapfrog");
  EXPECT_EQ(method_in("mysim/rk4: blew up"), "mysim/rk4");
  EXPECT_EQ(method_in("mysim/rk4, order 4"), "mysim/rk4");
  EXPECT_EQ(method_in("bullet/pbd"), "bullet/pbd");
  EXPECT_EQ(method_in("exec:./engine"), "exec:./engine");
  for (const char* none : {"theory", "1/2 of the limit", "and/or", "Bullet", "", "https://x"})
    EXPECT_EQ(method_in(none), "") << none;
  EXPECT_EQ(methods_in(swinging(3)), std::vector<std::string>{"mysim/leapfrog"});
}

TEST(MethodLooks, FamiliesHaveTheirColours) {
  const std::vector<std::string> names{
      "mysim/symplectic-euler", "mysim/rk4",       "bullet/deformable-explicit", "bullet/pbd", "odeint/rk4",
      "truth/converged",        "exec:./my/engine"};
  const JsonField looks = JsonField::parse(dump(method_looks_json(names)), "looks");
  ASSERT_EQ(looks.size(), names.size());
  std::map<std::string, std::string> families;
  for (const std::string& name : names) {
    const JsonField look = looks[name];
    EXPECT_FALSE(look["title"].text().empty()) << name;
    const std::string colour = look["colour"].text(), family(family_of(name).name);
    EXPECT_TRUE(contains(asset("page/style.css"), "--" + colour + ":"))
        << "the page's style sheet must define each of them";
    if (colour == "outside") continue;
    const auto [known, fresh] = families.emplace(colour, family);
    EXPECT_TRUE(fresh || known->second == family) << colour << " belongs to " << known->second << " and " << family;
  }
  EXPECT_TRUE(begins(looks["mysim/rk4"]["colour"].text(), "mysim"));
  EXPECT_TRUE(begins(looks["mysim/symplectic-euler"]["colour"].text(), "mysim"));
  EXPECT_TRUE(begins(looks["bullet/pbd"]["colour"].text(), "bullet"));
  EXPECT_TRUE(begins(looks["bullet/deformable-explicit"]["colour"].text(), "bullet"));
  EXPECT_NE(looks["bullet/pbd"]["mark"].text(), looks["bullet/deformable-explicit"]["mark"].text());
  EXPECT_EQ(looks["truth/converged"]["colour"].text(), "truth");
  for (const char* in_question :
       {"mysim/symplectic-euler", "bullet/deformable-explicit", "bullet/pbd", "exec:./my/engine"})
    EXPECT_TRUE(looks[in_question]["hero"].boolean()) << in_question;
  EXPECT_FALSE(looks["mysim/rk4"]["hero"].boolean());
  EXPECT_EQ(looks["mysim/symplectic-euler"]["title"].text(), "symplectic Euler");
  EXPECT_EQ(looks["exec:./my/engine"]["title"].text(), "engine");
}

TEST(MethodLooks, ProgramsHaveNamesWithOptionsAndColoursOfTheirOwn) {
  const std::vector<std::string> names{"exec:./my-mujoco+n=1", "exec:./my-mujoco+n=4", "exec:a/engine",
                                       "exec:b/engine",        "exec:./ode.py",        "odeint/rk4",
                                       "exec:/x/c/bin/tool",   "exec:/x/d/bin/tool"};
  const JsonField looks = JsonField::parse(dump(method_looks_json(names)), "looks");
  std::set<std::string> titles, colours;
  for (const std::string& name : names) {
    titles.insert(looks[name]["title"].text());
    colours.insert(looks[name]["colour"].text() + looks[name]["mark"].text());
    if (name != "odeint/rk4") {
      EXPECT_NE(looks[name]["colour"].text(), looks["odeint/rk4"]["colour"].text()) << name;
    }
    EXPECT_TRUE(contains(asset("page/style.css"), "--" + looks[name]["colour"].text() + ":"));
  }
  EXPECT_EQ(titles, (std::set<std::string>{"my-mujoco, n=1", "my-mujoco, n=4", "a/engine", "b/engine", "ode",
                                           "Boost odeint rk4", "c/bin/tool", "d/bin/tool"}));
  EXPECT_EQ(colours.size(), names.size());
  Figure f;
  f.name = "two-engines", f.title = "two programs of one name", f.x = {"t / s"}, f.y = {"error / m"};
  for (const char* name : {"exec:a/engine", "exec:b/engine"})
    f.curves.push_back({name, style_of(name), {{0, 1}, {1, name[5] == 'a' ? 2. : 3.}}, false, true});
  for (const char* name : {"a/engine", "b/engine"}) EXPECT_TRUE(contains(drawing_of(f).script, name));
}

struct Row {
  double step, error;
  std::optional<double> own;
};

/// Rows of experiment `order`, from long steps to short ones.
std::vector<Row> rows_of(const Scene& scene, const std::string& method, TableSet& result) {
  Request request;
  request.scenes = {scene};
  request.methods = find_methods(method);
  result.append(computed(order_points(request)));
  const Table& table = *result.table("order");
  std::vector<Row> rows;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const auto* own = std::get_if<double>(&table.at(i, "distance to own finest"));
    rows.push_back({std::get<double>(table.at(i, "step")), std::get<double>(table.at(i, "error")),
                    own ? std::optional<double>(*own) : std::nullopt});
  }
  return rows;
}

TEST(OwnFinest, TellsWhoConvergesToAnotherLaw) {
  Scene of_their_law = load_scene("chain-link");
  Scene of_hooke = of_their_law;
  of_hooke.model.find<Springs>()->law = SpringLaw::hooke;
  for (const auto& [scene, same_law] : {std::pair{&of_their_law, true}, std::pair{&of_hooke, false}}) {
    SCOPED_TRACE(same_law);
    TableSet result;
    const std::vector<Row> rows = rows_of(*scene, "bullet/pbd", result);
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_FALSE(rows.back().own);
    const Row& last = rows[3];
    EXPECT_DOUBLE_EQ(last.step, scene->step / 2);
    // order 1: errors e and e/2 differ by e/2; with a different force law, the distance falls but the error does not
    if (same_law) {
      EXPECT_NEAR(last.error / *last.own, 2, 0.1);
      EXPECT_NEAR(slope(rows[3].error, rows[4].error), 1, 0.05);
    } else {
      EXPECT_GT(last.error / *last.own, 8);
      EXPECT_NEAR(rows[3].error / rows[4].error, 1, 0.1);
    }
    // order 1: errors are 4 e, 2 e and e, and distances from the finest run are 3 e and e
    EXPECT_NEAR(*rows[2].own / *rows[3].own, 3, 0.1);
    // no order is stated for errors due to a different force law
    EXPECT_EQ(result.table("order-slopes")->rows.size(), same_law ? 1u : 0u);
  }
}

TEST(OrderCharts, AreDrawnFromTheirOwnTablesAlone) {
  const Scene scene = load_scene("spring");
  Request request;
  request.scenes = {scene};
  request.methods = find_methods("leapfrog,rk4,explicit-euler");
  const TableSet alone = computed(order_points(request));
  TableSet both = alone;
  both.append(computed(engines_points(request)));
  std::vector<std::vector<Chart>> drawn;
  for (const TableSet* rows : {&alone, static_cast<const TableSet*>(&both)}) {
    const std::vector<Scene> scenes{scene};
    const std::vector<SceneData> facts{scene_data(scene.name, *rows)};
    drawn.push_back(order_charts({scenes, facts, *rows, "commit"}));
    ASSERT_EQ(drawn.back().size(), 1u);
  }
  const Figure &a = std::get<Figure>(drawn[0][0].figure), &b = std::get<Figure>(drawn[1][0].figure);
  EXPECT_EQ(a.curves.size(), 3u);
  EXPECT_EQ(drawing_of(a).script, drawing_of(b).script);
  EXPECT_EQ(a.tier, b.tier);
  EXPECT_TRUE(contains(a.tier, "the exact solution, error bar ")) << a.tier;
}

TEST(OwnFinest, OfAStepperFallsWithItsErrorAndRulesOfToleranceAreNamed) {
  TableSet result;
  const std::vector<Row> rows = rows_of(load_scene("pendulum"), "leapfrog,dopri5,odeint/dopri5", result);
  ASSERT_EQ(rows.size(), 7u);
  // order 2: the distance from the finest run is the difference of the errors
  for (int i = 2; i + 1 < 7; ++i) EXPECT_NEAR((rows[i].error - rows.back().error) / *rows[i].own, 1, 0.02);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_TRUE(contains(result.notes[0], "mysim/dopri5, odeint/dopri5: adaptive steps"));
}

}  // namespace
}  // namespace crosscheck
