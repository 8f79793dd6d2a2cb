// Tests pictures for print: sizes of letters and pages, and accompanying files.

#include <fmt/format.h>

#include "experiments/scenes/scenes.h"
#include "mysim/base/json.h"
#include "mysim/base/text.h"
#include "report/figures/figure_set.h"
#include "report/pictures/layout.h"
#include "report/pictures/picture.h"
#include "tests/unit/report/cli.h"
#include "tests/unit/report/readers.h"
#include "tests/unit/report/render_helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Wrapped, NoLineIsWiderThanItsRoomAndNothingIsLost) {
  for (const std::string text : {"mysim/symplectic-euler+sticky", "t = 0.4 s, blew up at 0.867 s", "rk4", ""})
    for (const double room : {1.0, 8.0, 13.0, 100.0}) {
      std::string joined;
      for (const std::string& line : split(render::wrapped(text, true, room), '\n')) {
        const bool divisible = line.find_first_of("/,+", 1) < line.size() - 1;
        EXPECT_TRUE(render::text_width(line, true) <= room || !divisible) << line;
        joined += line + (line.ends_with(',') ? " " : "");
      }
      EXPECT_EQ(joined, text);
    }
}

TEST(Arrange, LettersKeepTheirSizeAndPanelsTheirOrder) {
  for (const double text : {12.0, 20.0, 33.0})
    for (const size_t count : {1u, 2u, 3u, 4u, 5u}) {
      render::Picture picture;
      picture.width = 1000, picture.text = text;
      picture.rows.emplace_back();
      for (size_t i = 0; i < count; ++i)
        picture.rows[0].push_back({i % 2 ? "bullet/deformable-explicit" : "mysim/symplectic-euler",
                                   fmt::format("t = {} s, blew up at 0.12 s", i),
                                   {},
                                   {}});
      render::arrange(picture, 1.2);
      const render::Layout layout = render::layout_of(picture);
      EXPECT_EQ(layout.title, text);
      EXPECT_EQ(layout.subtitle, text);
      EXPECT_NEAR(layout.panel_width, 1.2 * layout.panel_height, 3);
      size_t seen = 0;
      for (const auto& row : picture.rows)
        for (const render::Panel& panel : row) EXPECT_TRUE(panel.subtitle.starts_with(fmt::format("t = {} s", seen++)));
      EXPECT_EQ(seen, count);
    }
}

TEST(Arrange, SmallLettersLeaveOneRow) {
  render::Picture picture;
  picture.width = 2000, picture.text = 20;
  picture.rows = {{{"mysim/rk4", "", {}, {}}, {"bullet/pbd", "", {}, {}}}};
  render::arrange(picture, 1.2);
  EXPECT_EQ(picture.rows.size(), 1u);
}

TEST(PrintedPicture, ShotsHaveTheWidthOfThePaper) {
  const Scene scene = load_scene("chain");
  const Shot paper = shot_for_print(scene, {8.5, 8, false}, false);
  EXPECT_EQ(paper.width, 1004);
  EXPECT_NEAR(paper.text, 8 / 72.0 * 300, 1e-12);
  // a poster has letters of the same relative size, and at most as many pixels as a page
  EXPECT_EQ(shot_for_print(scene, {100, 8, false}, false).width, shot_for_print(scene, {30, 8, false}, false).width);
}

TEST(PrintedPicture, LettersOnThePageHaveTheSizeThatWasAsked) {
  const auto folder = fs::temp_directory_path() / fmt::format("crosscheck-print-{}", getpid());
  fs::create_directories(folder);
  render::Picture picture = render::small_picture();
  picture.width = 1200, picture.text = 300 * 8 / 72.0;
  picture.scale = render::Scale{"stretch / %", 5};
  render::arrange(picture, 1.2);
  render::write_print(picture, 300, folder / "a.png", folder / "a.pdf");
  std::ifstream in(folder / "a.pdf", std::ios::binary);
  const std::string pdf{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NEAR(page_of(pdf).first, 1200 / 300.0 * 72, 0.01);
  EXPECT_NEAR(page_of(pdf).second, picture.height / 300.0 * 72, 0.01);
  const std::set<double> letters = letters_of(pdf);
  ASSERT_FALSE(letters.empty());
  EXPECT_NEAR(*letters.rbegin(), 8, 0.01);
  EXPECT_GT(*letters.begin(), 7);  // the numbers at the colour bar have the smallest letters

  std::ifstream png(folder / "a.png", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(png), {}};
  const std::string per_metre{"\0\0\x2e\x23", 4};  // 11811
  EXPECT_NE(bytes.find("pHYs" + per_metre + per_metre + '\1'), std::string::npos);
  EXPECT_EQ(render::read_png(folder / "a.png").height, picture.height) << "libpng must still read the file";
  fs::remove_all(folder);
}

TEST_F(Cli, FiguresHoldThePictureOfAScene) {
  write("mine.toml", own_scene);
  for (const char* out : {"one", "two"}) {
    const ProgramResult result =
        call({"figures", "mine-picture", "--scene", "mine.toml", "--width", "50mm", "--out", out});
    ASSERT_EQ(result.status, 0) << result.err;
  }
  const JsonField json = JsonField::parse_file(folder_ / "one/figures.json");
  ASSERT_EQ(json["figures"].size(), 1u);
  const JsonField figure = json["figures"][0];
  EXPECT_EQ(figure["name"].text(), "mine-picture");
  EXPECT_EQ(figure["scene"].text(), "mine");
  EXPECT_EQ(figure["width_cm"].number(), 5.0);
  for (const auto& [ending, file] : figure["files"].items())
    EXPECT_TRUE(fs::exists(folder_ / "one" / file.text())) << ending;
  for (const char* ending : {"png", "pdf", "tex", "txt"})
    EXPECT_TRUE(read(folder_ / (std::string("one/mine-picture.") + ending)) ==
                read(folder_ / (std::string("two/mine-picture.") + ending)))
        << ending;
  EXPECT_EQ(render::read_png(folder_ / "one/mine-picture.png").width, 591);
  EXPECT_NE(read(folder_ / "one/mine-picture.txt").find("Scene mine;"), std::string::npos);
  // one line for the header, and nine for three methods with three particles each
  const std::string positions = rows(folder_ / "one/mine-picture.csv");
  EXPECT_EQ(std::count(positions.begin(), positions.end(), '\n'), 10);
  EXPECT_TRUE(positions.starts_with("method [1],t [s],particle [1],x [m],y [m],z [m]\nmysim/symplectic-euler,0.4"))
      << positions;
}

}  // namespace
}  // namespace crosscheck
