// Pictures: determinism, what must be seen and what must not crash, and the PNG with its letters.
#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>

#include "render_helpers.h"
#include "report/render/picture.h"
#include "report/run_program.h"

namespace crosscheck::render {
namespace {

namespace fs = std::filesystem;

struct Scratch {
  fs::path path = fs::temp_directory_path() / ("render_test_" + std::to_string(getpid()));
  Scratch() { fs::create_directories(path); }
  ~Scratch() { fs::remove_all(path); }
};

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Image read_png(const fs::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_file(&png, file.c_str())) << file;
  png.format = PNG_FORMAT_RGB;
  Image image{int(png.width), int(png.height), std::vector<unsigned char>(PNG_IMAGE_SIZE(png))};
  png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr);
  return image;
}

TEST(Render, SamePictureSameBytes) {
  for (const Quality quality : {Quality::fast, Quality::still}) {
    const Picture picture = small_picture(quality);
    const Image first = draw(picture);
    EXPECT_EQ(first.rgb, draw(picture).rgb);
  }
}

TEST(Render, StudioKeepsNothingOfTheLastPicture) {
  Picture picture = small_picture(), other = small_picture();
  other.rows[0][0].balls.clear();
  Studio studio, another;
  studio.draw(other);
  another.draw(picture);
  EXPECT_EQ(studio.draw(picture).rgb, draw(picture).rgb);
}

TEST(Render, IsNotBlankAndEndsInBackground) {
  Studio studio;
  const Image image = studio.draw(small_picture());
  const auto [least, most] = std::minmax_element(image.rgb.begin(), image.rgb.end());
  EXPECT_GT(*most - *least, 80);
  // no seam: the rim of the picture is the background to the last bit
  for (int x = 0; x < image.width; ++x) {
    for (const int y : {0, image.height - 1}) {
      const unsigned char* pixel = &image.rgb[3 * std::size_t(y * image.width + x)];
      ASSERT_TRUE(pixel[0] == 0xF7 && pixel[1] == 0xF7 && pixel[2] == 0xF5) << x << ", " << y;
    }
  }
}

TEST(Render, BothQualitiesShowTheSameScene) {
  Studio studio;
  // light and shadow differ, places do not: the difference stays far below that of a picture with nothing in it
  Picture empty = small_picture();
  empty.rows[0][0].bodies.clear(), empty.rows[0][0].balls.clear();
  const Image fast = studio.draw(small_picture(Quality::fast)), still = studio.draw(small_picture(Quality::still));
  double apart = 0, seen = 0;
  const Image nothing = studio.draw(empty);
  for (std::size_t i = 0; i < fast.rgb.size(); ++i) {
    apart += std::abs(fast.rgb[i] - still.rgb[i]);
    seen += std::abs(fast.rgb[i] - nothing.rgb[i]);
  }
  EXPECT_LT(apart, 0.4 * seen);
}

TEST(Render, BallIsSeen) {
  Studio studio;
  Picture without = small_picture();
  without.rows[0][0].balls.clear();
  EXPECT_GT(changed(studio.draw(small_picture()), studio.draw(without)), 0.03);
}

TEST(Render, APictureOfNothingIsAnError) {
  Picture picture = small_picture();
  picture.rows[0][0].balls.clear();
  picture.rows[0][0].bodies.clear();
  try {
    write_png(picture, std::filesystem::temp_directory_path() / "crosscheck-nothing.png");
    FAIL() << "a blank picture was written";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("crosscheck-nothing: nothing is to be seen"), std::string::npos);
  }
}

TEST(Render, PenetrationIsSeen) {
  Studio studio;
  // a cloth lying on the ball hides its top; the same cloth 2 cm inside the ball must not
  Picture on_top = small_picture();
  Body& body = body_of(on_top);
  for (int i = 0; i < body.x.cols(); ++i)
    body.x.col(i) = 0.352 * Vec3(2 * body.x(0, i), 1, 2 * body.x(2, i)).normalized();
  Picture inside = on_top;
  body_of(inside).x *= 0.33 / 0.352;
  Picture bare = on_top;
  bare.rows[0][0].bodies.clear();
  // seen: ten times what a hidden cloth may change by the light it lets through
  EXPECT_GT(changed(studio.draw(on_top), studio.draw(bare)), 0.02);
  EXPECT_LT(changed(studio.draw(inside), studio.draw(bare)), 0.002);
}

TEST(Render, ShiftOfTwoPercentIsSeen) {
  Studio studio;
  const Picture picture = small_picture();
  Picture shifted = picture;
  const double view_height = 2 * (picture.view.eye - picture.view.target).norm() *
                             std::tan(picture.view.field_of_view * std::numbers::pi / 360);
  body_of(shifted).x.row(0).array() += 0.02 * view_height;
  EXPECT_GT(changed(studio.draw(picture), studio.draw(shifted)), 0.02);
  EXPECT_EQ(changed(studio.draw(picture), studio.draw(picture)), 0);
}

TEST(Render, SceneOfAnyUnitLooksTheSame) {
  Studio studio;
  // the same scene in millimetres: the frame takes the unit out, round-off aside
  Picture scaled = small_picture();
  body_of(scaled).x *= 1000, scaled.rows[0][0].balls[0].radius *= 1000;
  scaled.view = view_that_holds({body_of(scaled).x}, scaled.rows[0][0].balls, {0.3, 0.4, 1}, panel_aspect(scaled));
  EXPECT_LT(changed(studio.draw(small_picture()), studio.draw(scaled)), 0.002);
}

TEST(Render, BlownUpBodyIsLeftOut) {
  Studio studio;
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300, 1e30}) {
    Picture picture = small_picture();
    Body& body = body_of(picture);
    body.tubes = {{0, 9}, {9, 18}};
    body.bead_radius = by_view;
    body.pinned = {9};
    body.trail = {Vec3(0, 0, 0), Vec3::Constant(bad), Vec3(1, 0, 0)};
    Picture all_bad = picture;
    body.x.col(9).setConstant(bad);
    body_of(all_bad).x.setConstant(bad);
    EXPECT_GT(changed(studio.draw(picture), studio.draw(all_bad)), 0.05) << "the sound part is drawn, " << bad;
  }
}

TEST(Render, WrongIndicesAndNumbersAreRefused) {
  Picture picture = small_picture();
  body_of(picture).tubes = {{0, 64}};
  EXPECT_THROW(draw(picture), std::runtime_error);
  picture = small_picture();
  picture.scale = Scale{"stretch / %", 0, 5};
  body_of(picture).value = {1, 2};
  EXPECT_THROW(draw(picture), std::runtime_error);
  EXPECT_THROW(draw(Picture{}), std::runtime_error);
}

TEST(Render, ScaleColoursLowAndHighApart) {
  Studio studio;
  const auto with_value = [&](double value) {
    Picture picture = small_picture();
    picture.scale = Scale{"stretch / %", 0, 5};
    body_of(picture).value.assign(64, value);
    return studio.draw(picture);
  };
  const Image low = with_value(0), high = with_value(5);
  EXPECT_GT(changed(low, high), 0.02);
  EXPECT_EQ(changed(high, with_value(50)), 0) << "out of range is the end of the scale";
  EXPECT_GT(changed(high, with_value(std::nan(""))), 0.02) << "no value has a colour of its own";
}

TEST(Render, TubesTakePaletteColours) {
  Studio studio;
  const auto with_colour = [&](int index) {
    Picture picture = small_picture();
    Body& body = body_of(picture);
    body.triangles.clear(), std::swap(body.tubes, body.threads);
    body.tube_colour.assign(body.tubes.size(), index);
    return studio.draw(picture);
  };
  EXPECT_GT(changed(with_colour(0), with_colour(1)), 0.02);
}

TEST(Render, PngHasLettersAndTheSameBytes) {
  const Scratch scratch;
  Picture picture = small_picture();
  picture.width = 480, picture.height = 270;
  picture.scale = Scale{"stretch / %", -5, 5, true};
  picture.legend = {"structural", "shear", "bend"};
  picture.rows[0][0].subtitle = "it's `ls` @t {x}_y^2 \\n \"5 %\"";
  picture.rows[0].push_back(picture.rows[0][0]);
  picture.rows[0][1].title = "bullet/deformable-explicit-with-a-long-name";
  Studio studio;
  write_png(picture, scratch.path / "a.png", studio);
  write_png(picture, scratch.path / "b.png", studio);
  EXPECT_EQ(bytes_of(scratch.path / "a.png"), bytes_of(scratch.path / "b.png"));
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path), fs::directory_iterator()), 2) << "temporary files";

  const Image lettered = read_png(scratch.path / "a.png");
  ASSERT_EQ(lettered.width, 480);
  ASSERT_EQ(lettered.height, 270);
  EXPECT_GT(changed(lettered, studio.draw(picture)), 0.01);

  // a long title shrinks all titles and stays in its panel: the column between the panels and the rims are clear
  for (int y = 0; y < 28; ++y) {
    for (const int x : {0, 1, 239, 240, 478, 479}) EXPECT_GT(lettered.rgb[3 * std::size_t(y * 480 + x)], 0xE0) << x;
  }

  picture.rows[0][1].note = "not finite from t = 0.4 s";
  write_png(picture, scratch.path / "b.png", studio);
  EXPECT_GT(changed(lettered, read_png(scratch.path / "b.png")), 0.001);
}

TEST(Render, UnwritablePlaceIsNamed) {
  const Scratch scratch;
  for (const fs::path& file : {scratch.path / "missing" / "picture.png", scratch.path}) {
    try {
      write_png(small_picture(), file);
      FAIL() << "wrote " << file;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
    }
  }
}

TEST(Render, ProgramsAreRunWithoutAShell) {
  const Scratch scratch;
  const ProgramResult echo = run_program({"printf", "%s", "$HOME `ls` 'x'"}, scratch.path);
  EXPECT_EQ(echo.status, 0);
  EXPECT_EQ(echo.out, "$HOME `ls` 'x'");
  const ProgramResult where = run_program({"sh", "-c", "pwd; echo $A >&2; cat; exit 3"}, scratch.path, {"A=b"});
  EXPECT_EQ(where.status, 3);
  EXPECT_EQ(where.out, fs::canonical(scratch.path).string() + "\n");
  EXPECT_EQ(where.err, "b\n");
  EXPECT_THROW(run_program({"no-such-program-anywhere"}, scratch.path), std::runtime_error);
}

}  // namespace
}  // namespace crosscheck::render
