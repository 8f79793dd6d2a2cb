// Tests the page and its player in a browser: charts, folds, sorted tables, scenes, dark mode, paper, motions.

#include <algorithm>
#include <cmath>

#include "experiments/scenes/scenes.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/stability/map.h"
#include "mysim/base/files.h"
#include "report/base/assets.h"
#include "report/figures/chart_json.h"
#include "report/figures/figure.h"
#include "report/page/lab_html.h"
#include "report/page/page_parts.h"
#include "report/page/player_html.h"
#include "report/pictures/scene_picture.h"
#include "report/player/runs.h"
#include "report/player/stage.h"
#include "tests/unit/experiments/helpers.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/in_browser.h"
#include "tests/unit/report/made_up_findings.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

const std::string outside = "exec:/tools/my engine";

/// A scene and its runs for the page. The external program gets the first method's runs.
struct Played {
  Scene scene;
  std::string motions;
  std::vector<const MethodResult*> shown;
  std::vector<RunFile> files = {};
  std::vector<std::string> names = {};
  MethodResults results = {};
  TemporaryFolder folder{"played"};

  Played(Scene of, const std::vector<std::string>& methods) : scene(std::move(of)) {
    Request request;
    request.scenes = {scene};
    RunsWriter writer(folder.path);
    const Run run = run_of(request, scene);
    writer.keep_truth(scene, run);
    const auto add = [&](const std::string& name, const MethodResult& r) {
      names.push_back(name);
      writer.keep({"engines", scene, name, {{r.outcome, r.trajectory}}}, run);
    };
    for (const std::string& name : methods) {
      shown.push_back(&result_of(request, scene, find_method(name), results));
      add(name, *shown.back());
    }
    add(outside, *shown[0]);
    files = run_files(JsonField::parse(dump(take_index(folder.path)), "index"), folder.path, true);
    const auto truth = truth_of(scene, run);
    motions = stage_json(
        scene, shown[0]->trajectory.x,
        truth ? std::optional(StageTruth{"truth, converged", false, truth->error_bar, motion_of(truth->trajectory)})
              : std::nullopt);
  }
  std::vector<PlayableRuns> runs() const {
    std::vector<PlayableRuns> all;
    for (const RunFile& file : files) {
      if (all.empty() || all.back().key != file.set) all.push_back({file.set, scene.name, "", {}});
      all.back().files.push_back(file);
    }
    return all;
  }
  std::string html() const {
    const SceneData facts{};
    ScenePart part{&scene, &facts, {}};
    part.motions = motions;
    PageContent content;
    content.scenes = {part};
    content.runs = runs();
    return filled("data", {{"data", motions_data(content)}});
  }
  void draw(int width, int height, const std::filesystem::path& file) const {
    render::write_png(picture_of(scene, shown, {.quality = render::Quality::fast, .width = width, .height = height}),
                      file);
  }
};

class Page : public InBrowser {
 protected:
  void SetUp() override {
    InBrowser::SetUp();
    const std::filesystem::path poster = folder_ / "poster.png";
    chain_.draw(304, 171, poster);
    content_.main_scene = "chain";
    content_.chapters = chapters();
    content_.figures = folder_;
    content_.provenance = {{"commit", "abc"}};
    for (const Question& question : questions())
      content_.findings.push_back(made_up(finding_rule(question.rules[0]), "5 mm on 3 scenes"));
    // the chapter has a chart of each kind: the curves open it, and the others are folded
    Figure curves;
    curves.name = "chain-speed-accuracy-cost", curves.x = {"CPU time / s", true}, curves.y = {"error / m", true};
    curves.curves = {{"mysim/leapfrog", style_of("mysim/leapfrog"), {{1e-3, 3}, {1e-2, 2}, {1e-1, 1}}, true, true},
                     {"bullet/pbd", style_of("bullet/pbd"), {{1e-3, 5}, {1e-2, 4}}, true, true}};
    curves.curves[0].tooltips = {{"first run"}, {"second run"}, {"third run"}};
    curves.curves[1].tooltips = {{"fourth run"}, {"fifth run"}};
    curves.failures = {{"mysim/rk4: blew up", style_of("mysim/rk4"), 5e-3, 0.5, "blew up", 2, {"at 2 s"}}};
    curves.pareto = {{1e-3, 3}, {1e-2, 2}, {1e-1, 1}};
    curves.on_page = {.take = OnPage::Take{1e-2, 2, "take this: 1 ms", "50 %, 10 ms"}};
    curves.guides = {{true, 5e-3, "leapfrog blows up left of here"}};
    Figure other = curves;
    other.name = "rod-speed-accuracy-cost";
    StepLimits limits;
    limits.name = "limits", limits.names = {"bullet/pbd", "mysim/leapfrog"}, limits.columns_of = "chain";
    limits.scenes = {{"spring", 10}, {"chain", 100}};
    limits.rows = {{80, true, "every step tried", {}, "", ""},
                   {2, false, "h ω = 2", {{0, 2.001, 2., "on spring"}, {1, 1.999, {}, "on chain"}}, "20.01", "20.00"}};
    StackedBars bars;
    bars.name = "bars", bars.label = "energy / J", bars.names = {"mysim/leapfrog", "bullet/pbd"};
    bars.parts = {{"drag", "#0072B2", false, {2, 1}}, {"gravity", "#999999", true, {-1.5, 0.5}}};
    DotPlot dots;
    dots.name = "dots", dots.label = "CPU time of mysim's", dots.names = {"cloth", "rod"};
    dots.series = {{"Bullet", style_of("bullet/pbd"), {DotPlot::Dot{30, 22.5, 40}, std::nullopt}}};
    HeatMap map;
    map.name = "map", map.x_label = "time step / s", map.y_label = "stiffness / (N/m)";
    map.kinds = {{"stable", "#D8E8F0"}, {"fails", "#D55E00"}};
    map.panels = {{"mysim/leapfrog", {}, {{1e-3, 1}, {2e-3, 8}}, {}}};
    for (int i = 0; i < 16; ++i)
      map.panels[0].cells.push_back(
          {1e-3 * std::pow(2, i % 4), std::pow(2, i / 4), i % 2, {fmt::format("cell {}", i)}});
    Chapter& chapter = content_.chapters[1];
    const auto show = [&](auto& figure) {
      figure.title = "A chart of " + figure.name, figure.caption = "c", figure.finding = "It falls.";
      const Chart chart{"", figure};
      content_.charts[figure.name] = chart_json(chart);
      for (const std::string& method : methods_in(chart))
        if (std::ranges::find(content_.methods, method) == content_.methods.end()) content_.methods.push_back(method);
      chapter.entries.push_back({chapter.id, "Of " + figure.name, "", {{figure.name, figure.title, "c"}}});
    };
    show(curves), show(other), show(bars), show(dots), show(map), show(limits);
    PageTable table{"sizes", {"method", "error"}, {}};
    const char* sizes[] = {"1.2 mm", "0.5 µm", "< 3.0e-13 m", "2 m", "20 mm", "", "900 µm", "blew up at 2 s"};
    for (int i = 0; i < 16; ++i)
      table.rows.push_back({fmt::format("{}-{}", i % 3 == 0 ? "bullet/pbd" : "mysim/rk4", i), sizes[i % 8]});
    chapter.entries.push_back({chapter.id, "A table", "", {}, {}, {table}});
    facts_.scene = "chain", facts_.tier = "converged", facts_.motion = 1;
    for (const MethodResult* result : chain_.shown) {
      facts_.methods.emplace_back();
      facts_.methods.back().method = result->method, facts_.methods.back().verdict = result->outcome.verdict;
    }
    ScenePart part{&chain_.scene, &facts_, {made_up(finding_rule("nearest"), "chain")}};
    part.thumbnail = part.hero = poster;
    part.motions = chain_.motions;
    part.figures = {{"chain-speed-accuracy-cost", "t", "c"}};
    for (const std::string& method : {std::string("mysim/symplectic-euler"), std::string("bullet/deformable-explicit")})
      part.runs.push_back({method + " own", method, "1 ms", 2e-3, {}, true});
    content_.runs = chain_.runs();
    for (const std::string& method : chain_.names)
      if (std::ranges::find(content_.methods, method) == content_.methods.end()) content_.methods.push_back(method);
    content_.scenes = {part};
  }
  std::filesystem::path page() {
    std::string html = page_html(content_);
    html.insert(html.find("</head>"), scripts({"stage_selftest.js", "page_selftest.js"}));
    return write("page.html", html);
  }
  Played chain_{load_scene("chain"), {"mysim/symplectic-euler", "bullet/deformable-explicit"}};
  SceneData facts_;
  PageContent content_;
};

void expect_charts_are_drawn_and_speak(const JsonField& saw) {
  SCOPED_TRACE("ChartsAreDrawnAndSpeak");
  const JsonField charts = saw["charts"];
  ASSERT_EQ(charts.size(), 5u) << charts.dump();
  for (const char* name : {"chain-speed-accuracy-cost", "bars", "dots", "map", "limits"}) {
    SCOPED_TRACE(name);
    const JsonField chart = charts[name];
    EXPECT_TRUE(contains(chart["says"].text(), std::string("A chart of ") + name));
    EXPECT_GT(chart["height"].number(), 100);
    EXPECT_GT(chart["shapes"].number(), 3);
    EXPECT_EQ(chart["unseen"].number(), 0) << "another style of the page hides its shapes";
    EXPECT_GE(chart["letters"].number(), 12) << "font size in pixels";
    EXPECT_EQ(chart["outside"].number(), 0) << "texts beyond the chart's edge: " << chart.dump();
  }
  EXPECT_EQ(charts["chain-speed-accuracy-cost"]["marks"].number(), 3 + 2 + 1) << "every run, including the failed one";
  EXPECT_EQ(charts["map"]["cells"].number(), 16);
  EXPECT_EQ(charts["limits"]["marks"].number(), 2) << "one per scene";
  EXPECT_EQ(saw["walked"].texts(), (std::vector<std::string>{"first run", "second run", "fourth run", "third run"}));
  EXPECT_EQ(saw["played"].number(), 1);
  EXPECT_EQ(saw["chosen"].texts(), (std::vector<std::string>{"rod", "true", "true", "true"}));
  EXPECT_TRUE(saw["back"].boolean());
  EXPECT_EQ(saw["tip"].text(), "first run");
  EXPECT_TRUE(saw["gone"].boolean());
  EXPECT_GT(saw["lit"].number(), 0) << "its method is highlighted";
  EXPECT_LE(saw["width"].number(), 0) << "the page must not be wider than the window";
  EXPECT_LE(saw["words"].number(), 3000);
  EXPECT_GT(saw["words"].number(), 50);
}

void expect_folds_open_and_their_tables_sort(const JsonField& saw) {
  SCOPED_TRACE("FoldsOpenAndTheirTablesSort");
  EXPECT_EQ(saw["tablesBefore"].number(), 0) << "folded contents must not be in the document";
  EXPECT_EQ(saw["templates"].number(), 0) << "after the fold is opened";
  // cells are sorted by size in metres; in ascending order, words follow numbers
  const std::vector<std::string> up{"< 3.0 × 10−13 m", "0.5 µm", "900 µm", "1.2 mm",
                                    "20 mm",           "2 m",    "–",      "blew up at 2 s"};
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(saw["up"][i].text(), up[i / 2]) << i;
  EXPECT_EQ(saw["down"][0].text(), "2 m");
  EXPECT_EQ(saw["down"][11].text(), "< 3.0 × 10−13 m");
  EXPECT_EQ(saw["says"].text(), "descending");
  ASSERT_EQ(saw["kept"].size(), 6u) << "rows that contain the word";
  for (const JsonField& method : saw["kept"].elements()) EXPECT_TRUE(begins(method.text(), "bullet/pbd"));
  EXPECT_TRUE(begins(saw["csv"].text(), "method,error\nbullet/pbd-"));
  EXPECT_EQ(saw["csv"].text().find("mysim/rk4"), std::string::npos) << "hidden rows are not saved";
}

void expect_a_card_opens_its_scene_and_back_closes_it(const JsonField& saw) {
  SCOPED_TRACE("ACardOpensItsSceneAndBackClosesIt");
  EXPECT_FALSE(saw["openBefore"].boolean());
  EXPECT_TRUE(saw["opened"].boolean());
  EXPECT_EQ(saw["address"].text(), "#chain");
  EXPECT_TRUE(saw["here"].boolean()) << "the card is marked as open";
  EXPECT_EQ(saw["sceneCharts"].number(), 1);
  EXPECT_TRUE(saw["scenePlays"].boolean());
  EXPECT_TRUE(saw["sameIsZero"].boolean()) << "the difference of a run to itself is zero";
  EXPECT_TRUE(saw["apart"].boolean()) << "the difference of two runs is not zero";
  EXPECT_TRUE(saw["cursor"].boolean()) << "the cursor must follow the time in each small chart";
  EXPECT_EQ(saw["smallCharts"].number(), 3);
  EXPECT_TRUE(contains(saw["engines"].text(), "my engine")) << saw["engines"].dump();
  EXPECT_TRUE(saw["outsidePlays"].boolean());
  EXPECT_TRUE(saw["buttonChooses"].boolean()) << "the button in the table chooses its run";
  EXPECT_LE(saw["nodes"].number(), 8000);
  EXPECT_TRUE(saw["closed"].boolean());
  EXPECT_TRUE(saw["again"].boolean()) << "an address opens the scene too";
  EXPECT_TRUE(saw["closedByLink"].boolean());
}

void expect_the_first_screen_moves(const JsonField& saw) {
  SCOPED_TRACE("TheFirstScreenMoves");
  EXPECT_EQ(saw["questions"].number(), 6);
  EXPECT_TRUE(saw["still"].boolean()) << "with reduced motion the picture does not move until requested";
  EXPECT_TRUE(saw["heroMoves"].boolean());
  EXPECT_EQ(saw["heroPanels"].number(), 3) << "both engines and the truth";
  EXPECT_TRUE(saw["heroStops"].boolean());
  EXPECT_TRUE(contains(saw["readout"].text(), "now"))
      << "expected the error at the current time: " << saw["readout"].text();
  EXPECT_TRUE(saw["litTitle"].boolean()) << "a method highlighted in a chart is highlighted in the player";
}

// this is a single test, because starting a browser takes seconds
TEST_F(Page, IsUsedAsAReaderWouldInLightAndInTheDark) {
  NEEDS_CHROMIUM;
  const auto file = page();
  const JsonField light = seen(file, {"--blink-settings=preferredColorScheme=1"}),
                  dark = seen(file, {"--blink-settings=preferredColorScheme=0"});
  EXPECT_EQ(light["complaints"].dump(), "[]");
  EXPECT_EQ(dark["complaints"].dump(), "[]");
  expect_charts_are_drawn_and_speak(light);
  expect_folds_open_and_their_tables_sort(light);
  expect_a_card_opens_its_scene_and_back_closes_it(light);
  expect_the_first_screen_moves(light);
  EXPECT_EQ(light["background"].text(), "rgb(255, 255, 255)");
  EXPECT_EQ(dark["background"].text(), "rgb(17, 21, 26)");
  EXPECT_NE(light["colour"].text(), dark["colour"].text()) << "colour of a method in a chart";
  EXPECT_TRUE(contains(asset("page/style.css"), "@media screen and (prefers-color-scheme: dark)"))
      << "printed pages are never dark";
}

TEST_F(Page, GoesOnPaper) {
  NEEDS_CHROMIUM;
  const auto pdf = folder_ / "page.pdf";
  const std::string html = page_html(content_);
  browse(write("paper.html", html), {"--print-to-pdf=" + pdf.string(), "--no-pdf-header-footer"});
  const std::string bytes = read(pdf);
  EXPECT_EQ(bytes.substr(0, 5), "%PDF-");
  EXPECT_NE(bytes.find("/Type /Page"), std::string::npos);
  EXPECT_GT(bytes.size(), 10'000u);
}

class PlayerPage : public testing_tools::InBrowser {
 protected:
  /// A scene with a poster, as in a report.
  std::filesystem::path page(const Scene& scene, const std::vector<std::string>& methods) {
    const Played played(scene, methods);
    played.draw(720, 280, folder_ / "poster.png");
    const std::string player = fmt::format(
        "<div class=\"player\">\n<figure class=\"render\"><div class=\"stage\">{}</div></figure>\n<motion-player "
        "data-scene=\"{}\" data-a=\"{} own\" data-b=\"{} own\"></motion-player>\n</div>\n",
        filled("image", image_data({folder_ / "poster.png", "the poster", ""})), scene.name, methods.back(),
        methods.front());
    const std::string test = scripts({"stage_selftest.js", "player_selftest.js"});
    std::string html = filled("head", {{"title", scene.name}, {"styles", page_styles()}}) + player + played.html() +
                       "<script>" + page_script("app") + "</script></body></html>";
    return write("page.html", html.insert(html.find("</head>"), test));
  }
};

TEST_F(PlayerPage, PlaysFromAFileAndObeysItsControls) {
  NEEDS_CHROMIUM;
  // a run that blows up is shown until its end
  const auto file = page(load_scene("chain"), {"mysim/symplectic-euler", "bullet/pbd", "mysim/explicit-euler"});
  const JsonField saw = seen(file, {});
  ASSERT_TRUE(saw["able"].boolean()) << saw.dump();
  EXPECT_EQ(saw["complaints"].dump(), "[]");
  EXPECT_TRUE(saw["poster"].boolean());
  EXPECT_EQ(saw["canvases"].number(), 1);
  EXPECT_GT(saw["drawn"].number(), 0.002) << "fraction of the picture that is not background";
  for (const char* what : {"moves", "returns", "slider", "colours", "springs", "turns", "plays"})
    EXPECT_TRUE(saw[what].boolean()) << what;
  EXPECT_EQ(saw["jump"].number(), 0) << "pixels by which the page moved when the player appeared";
  EXPECT_NE(saw["titles"].text().find("blew up at"), std::string::npos) << saw["titles"].dump();
  EXPECT_NE(saw["says"].text().find("blew up at"), std::string::npos) << saw["says"].dump();
  EXPECT_EQ(saw["lines"].number(), 5) << "errors and energies of both, and their difference";
}

TEST_F(PlayerPage, AClothIsDrawnWithItsSphere) {
  NEEDS_CHROMIUM;
  const JsonField saw = seen(page(load_scene("cloth-sphere"), {"mysim/symplectic-euler", "mysim/leapfrog"}), {});
  EXPECT_EQ(saw["complaints"].dump(), "[]");
  EXPECT_GT(saw["drawn"].number(), 0.1);
  for (const char* what : {"moves", "returns", "slider", "colours", "springs", "turns", "plays"})
    EXPECT_TRUE(saw[what].boolean()) << what;
}

/// A chart with a complete run and one that blew up, and a map.
class RunsPage : public PlayerPage {
 protected:
  std::filesystem::path charts(bool lab = false) {
    Request request;
    request.scenes = {load_scene("chain")};
    request.methods = find_methods("mysim/leapfrog,mysim/explicit-euler");
    const Scene& scene = request.scenes[0];
    const Played played(scene, {"mysim/leapfrog"});
    RunsWriter writer(folder_);
    const RunCallback keep = [&](const RecordedRuns& w) { writer.keep(w, run_of(request, scene)); };
    request.on_runs = keep;
    TableSet rows;
    speed_accuracy_on(request, scene, rows);
    add_map(map_kinds()[0], scene, find_method("mysim/leapfrog"), {2, 4, 300, false}, rows, keep);
    PageContent content;
    content.runs = played.runs();
    content.runs.push_back({"chain-speed-accuracy", "chain", "", {}});
    content.runs.push_back({"map", "", stage_json(scene, lab), {}});
    for (RunFile& file : run_files(JsonField::parse(dump(take_index(folder_)), "index"), folder_, true))
      content.runs[content.runs.size() - (file.set == "chain-speed-accuracy" ? 2 : 1)].files.push_back(file);
    const SceneData facts{};
    ScenePart part{&scene, &facts, {}};
    part.motions = played.motions;
    content.scenes.push_back(part);
    content.chapters = chapters();
    Chapter& chapter = content.chapters[1];
    const auto show = [&](const auto& figure) {
      content.charts[figure.name] = chart_json({"", figure});
      chapter.entries.push_back(
          {chapter.id,
           "heading",
           "",
           {{figure.name, figure.title, "a caption", figure.name == "chart" ? "chain-speed-accuracy" : figure.name}}});
    };
    Figure f;
    f.name = "chart", f.title = "a chart", f.caption = "c", f.finding = "It falls.";
    f.x = {"t / s"}, f.y = {"x / m"};
    f.curves = {{"mysim/leapfrog", style_of("mysim/leapfrog"), {}, true, true}};
    for (const char* run : {"mysim/leapfrog 5", "mysim/explicit-euler 0"}) {
      f.curves[0].points.emplace_back(f.curves[0].points.size(), 1 + f.curves[0].points.size());
      f.curves[0].tooltips.push_back({std::string(run) + "\nholds", run});
    }
    chapter.leads = {"chart"};
    show(f);
    HeatMap map;
    map.name = "map", map.title = "a map", map.caption = "c", map.finding = "It fails.";
    map.x_label = "x", map.y_label = "y", map.kinds = {{"stable", "#D8E8F0"}};
    map.panels = {{"mysim/leapfrog", {}, {}, {}}};
    for (int i = 0; i < 4; ++i)
      map.panels[0].cells.push_back(
          {1. + i % 2,
           1. + i / 2,
           0,
           {fmt::format("mysim/leapfrog {}\nholds", i + 1), fmt::format("mysim/leapfrog {}", i + 1)}});
    show(map);
    content.methods = {"mysim/leapfrog", "mysim/explicit-euler"};
    if (lab) content.lab = lab_data({scene});
    std::string html = page_html(content);
    html.insert(html.find("</head>"), scripts({"stage_selftest.js", "runs_selftest.js"}));
    return write("runs.html", html);
  }
};

TEST_F(RunsPage, AClickOnAMarkerOrAChoiceInTheListPlaysItsRun) {
  NEEDS_CHROMIUM;
  const JsonField saw = seen(charts(), {});
  EXPECT_EQ(saw["complaints"].dump(), "[]");
  ASSERT_EQ(saw["windows"].size(), 4u) << saw.dump();
  for (const JsonField& w : saw["windows"].elements()) {
    EXPECT_GT(w["drawn"].number(), 0.001) << w.dump();
    EXPECT_TRUE(w["closed"].boolean()) << w.dump();
    EXPECT_EQ(w["says"].text().find("Open in the lab"), std::string::npos) << "no link to the lab without a lab";
  }
  for (const size_t run : {0, 1, 3}) EXPECT_TRUE(saw["windows"][run]["moves"].boolean()) << run;
  EXPECT_EQ(saw["windows"][0]["panels"].number(), 3) << "the run, the truth, and their difference";
  EXPECT_NE(saw["windows"][0]["says"].text().find("crosscheck run chain --method mysim/leapfrog --step"),
            std::string::npos)
      << saw["windows"][0]["says"].dump();
  EXPECT_LT(saw["windows"][0]["apart"].number(), 1e-3)
      << "m: the run's error, plus the resolution of its packed positions";
  EXPECT_EQ(saw["windows"][2]["panels"].number(), 1);
  EXPECT_FALSE(saw["windows"][2]["moves"].boolean()) << "a still picture";
  EXPECT_NE(saw["windows"][1]["says"].text().find("last"), std::string::npos) << saw["windows"][1]["says"].dump();
  EXPECT_EQ(saw["windows"][3]["says"].text(), saw["windows"][1]["says"].text()) << "the list plays the same runs";
}

TEST_F(RunsPage, WithTheLabEachRunOfMysimHasADoorToIt) {
  NEEDS_CHROMIUM;
  if (!has_lab_module()) GTEST_SKIP() << "mysim was not compiled to WebAssembly";
  const JsonField saw = seen(charts(true), {});
  EXPECT_EQ(saw["complaints"].dump(), "[]");
  ASSERT_EQ(saw["windows"].size(), 4u) << saw.dump();
  for (const JsonField& w : saw["windows"].elements())
    EXPECT_NE(w["says"].text().find("Open in the lab"), std::string::npos) << w["says"].dump();
}

TEST_F(RunsPage, WithoutWebGlNothingPretendsToPlay) {
  NEEDS_CHROMIUM;
  const JsonField saw = seen(charts(), {"--disable-3d-apis"});
  EXPECT_EQ(saw["windows"].dump(), "[]");
  EXPECT_EQ(saw["lists"].number(), 0) << "after the first click, which reveals the missing WebGL";
  EXPECT_EQ(saw["dialogs"].number(), 0);
  EXPECT_EQ(saw["complaints"].dump(), "[]");
}

TEST_F(PlayerPage, WithoutWebGlThePosterStays) {
  NEEDS_CHROMIUM;
  const JsonField saw = seen(page(load_scene("chain"), {"mysim/symplectic-euler"}), {"--disable-3d-apis"});
  EXPECT_FALSE(saw["able"].boolean());
  EXPECT_TRUE(saw["poster"].boolean());
  EXPECT_EQ(saw["height"].number(), 0) << "no controls without a function";
  EXPECT_EQ(saw["canvases"].number(), 0);
  EXPECT_EQ(saw["complaints"].dump(), "[]");
}

TEST_F(PlayerPage, TheFirstScreenOfAClothMoves) {
  NEEDS_CHROMIUM;
  const Played played(load_scene("cloth-sphere"), {"mysim/symplectic-euler", "mysim/leapfrog"});
  played.draw(304, 171, folder_ / "poster.png");
  PageContent content;
  content.chapters = chapters();
  content.main_scene = played.scene.name;
  const SceneData facts{.scene = played.scene.name, .tier = "converged"};
  ScenePart part{&played.scene, &facts, {}};
  part.thumbnail = part.hero = folder_ / "poster.png";
  part.motions = played.motions;
  for (const char* method : {"mysim/symplectic-euler", "mysim/leapfrog"})
    part.runs.push_back({std::string(method) + " own", method, "1 ms", 2e-3, {}, true});
  content.scenes = {part};
  content.runs = played.runs();
  std::string html = page_html(content);
  html.insert(html.find("</head>"), scripts({"stage_selftest.js", "hero_selftest.js"}));
  const auto page = write("page.html", html);
  const JsonField still = seen(page, {"--disable-3d-apis"});
  EXPECT_EQ(still["complaints"].dump(), "[]");
  EXPECT_FALSE(still["able"].boolean());
  EXPECT_TRUE(still["poster"].boolean()) << "without WebGL the still picture remains";
  EXPECT_EQ(still["button"].text(), "▶") << "the clock must not run";
  const JsonField saw = seen(page, {});
  EXPECT_EQ(saw["complaints"].dump(), "[]");
  EXPECT_GT(saw["drawn"].number(), 0.05) << "fraction of the picture that is not background";
  EXPECT_EQ(saw["panels"].number(), 3) << "both runs and the truth";
  for (const char* what : {"moves", "returns", "turns", "poster"}) EXPECT_TRUE(saw[what].boolean()) << what;
}

}  // namespace
}  // namespace crosscheck
