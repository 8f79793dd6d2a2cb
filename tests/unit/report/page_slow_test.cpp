// The page and its player in a browser: drawings, markers, sorted tables, dark mode, paper, motions.

#include "experiments/scenes/scenes.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/stability/map.h"
#include "mysim/base/files.h"
#include "report/base/assets.h"
#include "report/figures/figure.h"
#include "report/page/page.h"
#include "report/page/player_html.h"
#include "report/pictures/scene_picture.h"
#include "report/player/player_data.h"
#include "report/player/run_motions.h"
#include "tests/unit/experiments/helpers.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/in_browser.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class Page : public InBrowser {
 protected:
  /// A page with one chapter: a chart whose markers speak, and a table of eight rows.
  std::filesystem::path page() {
    Figure f;
    f.name = "chart", f.title = "a chart", f.caption = "c", f.finding = "It falls.";
    f.x = {"t / s"}, f.y = {"x / m"};
    f.curves = {{"mysim/leapfrog", style_of("mysim/leapfrog"), {{0, 3}, {1, 2}, {2, 1}}, true, true}};
    f.curves[0].tooltips = {{"first run"}, {"second run"}, {"third run"}};
    draw(drawing_of(f), {}, folder_);
    PageTable table{"sizes", {"method", "error"}, {}};
    const char* sizes[] = {"1.2 mm", "0.5 µm", "< 3.0e-13 m", "2 m", "20 mm", "", "900 µm", "blew up at 2 s"};
    for (int i = 0; i < 8; ++i)
      table.rows.push_back({fmt::format("{}-{}", i % 3 == 0 ? "bullet/pbd" : "mysim/rk4", i), sizes[i]});
    PageContent content;
    content.findings = {{"", "agreement", "They agree.", "measured", "same-rule"}};
    content.chapters = {{"chapter", "A chapter", "What it asks.", {{"heading", "text", {}, {table}}}}};
    content.chapters[0].entries[0].images = {{folder_ / "chart.svg", "It falls.", "a caption", {tooltips_of(f), {}}}};
    std::string html = page_html(content);
    html.insert(html.find("</head>"), scripts({"page_selftest.js"}));
    return write("page.html", html);
  }
};

TEST_F(Page, ChartsSpeakAndTablesSort) {
  NEEDS_CHROMIUM;
  const JsonField saw = seen(page(), {});
  EXPECT_EQ(saw["complaints"].dump(), "[]");
  EXPECT_EQ(saw["charts"].number(), 1);
  EXPECT_TRUE(saw["named"].truth());
  EXPECT_TRUE(saw["drawn"].truth());
  EXPECT_GT(saw["markerSize"].number(), 3) << "pixels: markers are drawn, their shapes stand at the page's beginning";
  EXPECT_EQ(saw["tip"].text(), "first run");
  EXPECT_TRUE(saw["gone"].truth());
  // by size in metres, whatever the unit; words below numbers, either way
  EXPECT_EQ(saw["up"].texts(), (std::vector<std::string>{"< 3.0e-13 m", "0.5 µm", "900 µm", "1.2 mm", "20 mm", "2 m",
                                                         "–", "blew up at 2 s"}));
  EXPECT_EQ(saw["down"][0].text(), "2 m");
  EXPECT_EQ(saw["down"][5].text(), "< 3.0e-13 m");
  EXPECT_EQ(saw["says"].text(), "descending");
  EXPECT_EQ(saw["kept"].texts(), (std::vector<std::string>{"bullet/pbd-3", "bullet/pbd-0", "bullet/pbd-6"}));
  EXPECT_NE(saw["csv"].text().find("\"method\",\"error"), std::string::npos) << saw["csv"].dump();
  EXPECT_EQ(saw["csv"].text().find("mysim/rk4"), std::string::npos) << "rows that are hidden are not saved";
  EXPECT_LE(saw["height"].number(), 0) << "the page is no wider than the window";
}

TEST_F(Page, IsDarkWhereTheReaderWantsIt) {
  NEEDS_CHROMIUM;
  const auto file = page();
  const JsonField light = seen(file, {"--blink-settings=preferredColorScheme=1"}),
                  dark = seen(file, {"--blink-settings=preferredColorScheme=0"});
  EXPECT_EQ(light["background"].text(), "rgb(255, 255, 255)");
  EXPECT_EQ(dark["background"].text(), "rgb(21, 24, 27)");
  // drawings too; what is printed never is
  EXPECT_EQ(light["filter"].text(), "none");
  EXPECT_TRUE(contains(dark["filter"].text(), "invert"));
  EXPECT_TRUE(contains(asset("page/style.css"), "@media screen and (prefers-color-scheme: dark)"));
}

TEST_F(Page, GoesOnPaper) {
  NEEDS_CHROMIUM;
  const auto pdf = folder_ / "page.pdf";
  browse(page(), {"--print-to-pdf=" + pdf.string(), "--no-pdf-header-footer"});
  const std::string bytes = read(pdf);
  EXPECT_EQ(bytes.substr(0, 5), "%PDF-");
  EXPECT_NE(bytes.find("/Type /Page"), std::string::npos);
  EXPECT_GT(bytes.size(), 10'000u);
}

class PlayerPage : public testing_tools::InBrowser {
 protected:
  /// Data of a scene, and the page that plays it: with the poster that a report has, and the self-test.
  std::filesystem::path page(const Scene& scene, const std::vector<std::string>& methods) {
    Request request;
    request.scenes = {scene};
    Results answers;
    std::vector<const Result*> shown;
    for (const std::string& name : methods) shown.push_back(&result_of(request, scene, find_method(name), answers));
    Shot shot{.quality = render::Quality::fast, .width = 720, .height = 280};
    render::write_png(picture_of(scene, shown, shot), folder_ / "poster.png");
    const auto motions = write("motions.json", player_json(scene, shown, truth_of(scene, run_of(request, scene))));
    const std::string test = scripts({"stage_selftest.js", "player_selftest.js"});
    return write("page.html", page_head(scene.name, test + player_head()) +
                                  player_html({folder_ / "poster.png", "the poster", "a caption"}, motions) +
                                  "</body></html>");
  }
};

TEST_F(PlayerPage, PlaysFromAFileAndObeysItsControls) {
  NEEDS_CHROMIUM;
  // one that blows up is shown until then, and says so
  const auto file = page(load_scene("chain"), {"mysim/symplectic-euler", "bullet/pbd", "mysim/explicit-euler"});
  const JsonField saw = seen(file, {});
  ASSERT_TRUE(saw["able"].truth()) << saw.dump();
  EXPECT_EQ(saw["complaints"].dump(), "[]");
  EXPECT_TRUE(saw["poster"].truth());
  EXPECT_EQ(saw["canvases"].number(), 1);
  EXPECT_GT(saw["drawn"].number(), 0.002) << "part of the picture that is not background";
  for (const char* what : {"moves", "returns", "slider", "colours", "springs", "turns", "plays"})
    EXPECT_TRUE(saw[what].truth()) << what;
  EXPECT_EQ(saw["jump"].number(), 0) << "pixels by which the page moved when the player came";
  EXPECT_NE(saw["titles"].text().find("blew up at"), std::string::npos) << saw["titles"].dump();
  EXPECT_NE(saw["list"].text().find("blew up at"), std::string::npos) << saw["list"].dump();
  EXPECT_EQ(saw["lines"].number(), 4) << "energies of the methods, and of the truth beside them";
}

TEST_F(PlayerPage, AClothIsDrawnWithItsSphere) {
  NEEDS_CHROMIUM;
  const JsonField saw = seen(page(load_scene("cloth-sphere"), {"mysim/symplectic-euler", "mysim/leapfrog"}), {});
  EXPECT_EQ(saw["complaints"].dump(), "[]");
  EXPECT_GT(saw["drawn"].number(), 0.1);
  for (const char* what : {"moves", "returns", "slider", "colours", "springs", "turns", "plays"})
    EXPECT_TRUE(saw[what].truth()) << what;
}

/// A page with a chart whose first marker came to its end, whose second blew up; and a map with a cell.
class RunsPage : public PlayerPage {
 protected:
  std::filesystem::path charts() {
    Request request;
    request.scenes = {load_scene("chain")};
    request.methods = find_methods("mysim/leapfrog,mysim/explicit-euler");
    const Scene& scene = request.scenes[0];
    const auto truth = truth_of(scene, run_of(request, scene));
    PageContent content;
    content.runs = {{"chart", "chain", "", {}}, {"map", "", stage_json(scene), {}}};
    request.watch = [&](const WatchedRuns& w) {
      content.runs[0].methods.push_back(write(file_name_of(w.method) + ".json", run_motions_json(w, truth)));
    };
    Rows rows;
    speed_accuracy_on(request, scene, rows);
    add_map(map_kinds()[0], scene, find_method("mysim/leapfrog"), {2, 4, 300, false}, rows, [&](const WatchedRuns& w) {
      content.runs[1].methods.push_back(write("cells.json", cell_motions_json(w)));
    });
    Results answers;
    const Result& answer = result_of(request, scene, request.methods[0], answers);
    render::write_png(picture_of(scene, {&answer}, {.quality = render::Quality::fast, .width = 720, .height = 280}),
                      folder_ / "poster.png");
    const SceneData facts{};
    ScenePart part{&scene, &facts, {}, {{folder_ / "poster.png", "the poster", "a caption"}}};
    part.recommendations.resize(recommendation_columns().size());
    part.motions = write("motions.json", player_json(scene, {&answer}, truth));
    content.scenes.push_back(part);
    content.chapters = {{"chapter", "A chapter", "What it asks.", {{"heading", "text", {}, {}}}}};
    for (const auto& [name, runs] :
         {std::pair{"chart", std::vector<std::string>{"mysim/leapfrog 5", "mysim/explicit-euler 0"}},
          {"map", std::vector<std::string>{"mysim/leapfrog 1"}}}) {
      Figure f;
      f.name = name, f.title = "a chart", f.caption = "c", f.finding = "It falls.";
      f.x = {"t / s"}, f.y = {"x / m"};
      f.curves = {{"mysim/leapfrog", style_of("mysim/leapfrog"), {}, true, true}};
      for (size_t i = 0; i < runs.size(); ++i) {
        f.curves[0].points.emplace_back(i, 1 + i);
        f.curves[0].tooltips.push_back({runs[i] + "\nholds", runs[i]});
      }
      draw(drawing_of(f), {}, folder_);
      content.chapters[0].entries[0].images.push_back(
          {folder_ / (f.name + ".svg"), "It falls.", "a caption", {tooltips_of(f), {}}, name});
    }
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
    EXPECT_TRUE(w["moves"].truth()) << w.dump();
    EXPECT_TRUE(w["closed"].truth()) << w.dump();
  }
  EXPECT_EQ(saw["windows"][0]["panels"].number(), 2) << "the run beside the truth";
  EXPECT_NE(saw["windows"][0]["says"].text().find("./crosscheck run chain --method mysim/leapfrog --step"),
            std::string::npos)
      << saw["windows"][0]["says"].dump();
  EXPECT_LT(saw["windows"][0]["apart"].number(), 1e-3) << "m: as near to the truth as the run is, with its lattice";
  EXPECT_EQ(saw["windows"][1]["panels"].number(), 1);
  EXPECT_NE(saw["windows"][1]["says"].text().find("last"), std::string::npos) << saw["windows"][1]["says"].dump();
  EXPECT_NE(saw["windows"][2]["says"].text().find("Departures"), std::string::npos) << saw["windows"][2]["says"].dump();
  EXPECT_EQ(saw["windows"][3]["says"].text(), saw["windows"][1]["says"].text()) << "the list has the same runs";
}

TEST_F(RunsPage, WithoutWebGlNothingPretendsToPlay) {
  NEEDS_CHROMIUM;
  const JsonField saw = seen(charts(), {"--disable-3d-apis"});
  EXPECT_EQ(saw["windows"].dump(), "[]");
  EXPECT_EQ(saw["lists"].number(), 0);
  EXPECT_EQ(saw["complaints"].dump(), "[]");
}

TEST_F(PlayerPage, WithoutWebGlThePosterStays) {
  NEEDS_CHROMIUM;
  const JsonField saw = seen(page(load_scene("chain"), {"mysim/symplectic-euler"}), {"--disable-3d-apis"});
  EXPECT_FALSE(saw["able"].truth());
  EXPECT_TRUE(saw["poster"].truth());
  EXPECT_EQ(saw["desk"].number(), 0) << "no controls that control nothing";
  EXPECT_EQ(saw["canvases"].number(), 0);
  EXPECT_EQ(saw["complaints"].dump(), "[]");
}

/// Two engines' drapes of 64 x 64 particles in 150 frames, as the page holds them.
TEST(PlayerSize, TwoDrapesOf4096ParticlesFitInto2Point2Megabytes) {
  Scene scene = testing_tools::with_grid("cloth-sphere", 64);
  scene.duration = 1.5;  // s: the fall, the impact and the sliding; at rest nothing is left to be packed
  Request request;
  request.scenes = {scene};
  Results answers;
  std::vector<const Result*> shown;
  for (const char* name : {"mysim/symplectic-euler", "bullet/deformable-explicit"}) {
    shown.push_back(&result_of(request, scene, find_method(name), answers));
    ASSERT_EQ(shown.back()->outcome.verdict, Verdict::ok) << shown.back()->outcome.reason;
  }
  const std::string text = player_json(scene, shown, {});
  const JsonField data = JsonField::parse(text, "player");
  EXPECT_EQ(data["particles"].number(), 4096);
  EXPECT_EQ(data["times"].size(), 151u);
  EXPECT_LE(text.size() + player_head().size(), 2'200'000u);
  RecordProperty("bytes", static_cast<int>(text.size()));
}

}  // namespace
}  // namespace crosscheck
