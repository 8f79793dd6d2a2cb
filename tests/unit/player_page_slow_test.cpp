// The player in a browser: a page opened from a file, used by player_selftest.js, and read back. Chromium is optional.
#include "experiments/scenes.h"
#include "report/base64.h"
#include "report/pictures.h"
#include "report/player/player_data.h"
#include "report/player/player_html.h"
#include "tests/unit/in_browser.h"
#include "tests/unit/resized.h"

namespace crosscheck {
namespace {

using nlohmann::json;

class PlayerPage : public testing_tools::InBrowser {
 protected:
  /// Data of a scene, and the page that plays it: with the poster that a report has, and the self-test.
  std::filesystem::path page(const Scene& scene, const std::vector<std::string>& methods) {
    Request request;
    request.scenes = {scene};
    Answers answers;
    std::vector<const Answer*> shown;
    for (const std::string& name : methods) shown.push_back(&answer_of(request, scene, find_method(name), answers));
    Shot shot{.quality = render::Quality::fast, .width = 720, .height = 280};
    render::write_png(picture_of(scene, shown, shot), folder_ / "poster.png");
    const auto motions = write("motions.json", player_json(scene, shown, truth_of(scene, run_of(request, scene))));
    const std::string test = read(std::filesystem::path(CROSSCHECK_SOURCE) / "tests/unit/player_selftest.js");
    return write("page.html", page_head(scene.name, "<script>" + test + "</script>" + player_head()) +
                                  player_html({folder_ / "poster.png", "the poster", "a caption"}, motions) +
                                  "</body></html>");
  }
};

TEST_F(PlayerPage, PlaysFromAFileAndObeysItsControls) {
  NEEDS_CHROMIUM;
  // one that blows up is shown until then, and says so
  const auto file = page(load_scene("chain"), {"mysim/symplectic-euler", "bullet/pbd", "mysim/explicit-euler"});
  const json saw = seen(file, {});
  ASSERT_TRUE(saw.value("able", false)) << saw;
  EXPECT_EQ(saw["complaints"], json::array());
  EXPECT_TRUE(saw["poster"]);
  EXPECT_EQ(saw["canvases"], 1);
  EXPECT_GT(saw.value("drawn", 0.), 0.002) << "part of the picture that is not background";
  for (const char* what : {"moves", "returns", "slider", "colours", "springs", "turns", "plays"})
    EXPECT_TRUE(saw.value(what, false)) << what;
  EXPECT_EQ(saw["jump"], 0) << "pixels by which the page moved when the player came";
  EXPECT_NE(saw.value("titles", "").find("blew up at"), std::string::npos) << saw["titles"];
  EXPECT_NE(saw.value("list", "").find("blew up at"), std::string::npos) << saw["list"];
  EXPECT_EQ(saw["lines"], 4) << "energies of the methods, and of the truth beside them";
}

TEST_F(PlayerPage, AClothIsDrawnWithItsSphere) {
  NEEDS_CHROMIUM;
  const json saw = seen(page(load_scene("cloth-sphere"), {"mysim/symplectic-euler", "mysim/leapfrog"}), {});
  EXPECT_EQ(saw["complaints"], json::array());
  EXPECT_GT(saw.value("drawn", 0.), 0.1);
  for (const char* what : {"moves", "returns", "slider", "colours", "springs", "turns", "plays"})
    EXPECT_TRUE(saw.value(what, false)) << what;
}

TEST_F(PlayerPage, WithoutWebGlThePosterStays) {
  NEEDS_CHROMIUM;
  const json saw = seen(page(load_scene("chain"), {"mysim/symplectic-euler"}), {"--disable-3d-apis"});
  EXPECT_FALSE(saw.value("able", true));
  EXPECT_TRUE(saw.value("poster", false));
  EXPECT_EQ(saw["desk"], 0) << "no controls that control nothing";
  EXPECT_EQ(saw["canvases"], 0);
  EXPECT_EQ(saw["complaints"], json::array());
}

/// Two engines' drapes of 64 x 64 particles in 150 frames, as the page holds them.
TEST(PlayerSize, TwoDrapesOf4096ParticlesFitInto2Point2Megabytes) {
  Scene scene = testing_tools::with_grid("cloth-sphere", 64);
  scene.duration = 1.5;  // s: the fall, the impact and the sliding; at rest nothing is left to be packed
  Request request;
  request.scenes = {scene};
  Answers answers;
  std::vector<const Answer*> shown;
  for (const char* name : {"mysim/symplectic-euler", "bullet/deformable-explicit"}) {
    shown.push_back(&answer_of(request, scene, find_method(name), answers));
    ASSERT_EQ(shown.back()->outcome.verdict, Verdict::ok) << shown.back()->outcome.reason;
  }
  const std::string text = player_json(scene, shown, {});
  const json data = json::parse(text);
  EXPECT_EQ(data["particles"], 4096);
  EXPECT_EQ(data["times"].size(), 151u);
  EXPECT_LE(text.size() + player_head().size(), 2'200'000u);
  RecordProperty("bytes", static_cast<int>(text.size()));
}

}  // namespace
}  // namespace crosscheck
