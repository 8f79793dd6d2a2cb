// Tests pictures: determinism, visibility, robustness, the view, and golden pictures.

#include <gtest/gtest.h>
#include <unistd.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>

#include "mysim/base/process.h"
#include "render_helpers.h"
#include "report/pictures/camera.h"
#include "report/pictures/draw_list.h"
#include "report/pictures/picture.h"
#include "tests/unit/temporary.h"

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

TEST(Render, SamePictureSameBytes) {
  for (const Quality quality : {Quality::fast, Quality::still}) {
    const Picture picture = small_picture(quality);
    const Image first = draw(picture);
    EXPECT_EQ(first.rgb, draw(picture).rgb);
  }
}

TEST(Render, IsNotBlankAndEndsInBackground) {
  const Image image = draw(small_picture());
  const auto [least, most] = std::minmax_element(image.rgb.begin(), image.rgb.end());
  EXPECT_GT(*most - *least, 80);
  // no seam is visible, because the rim equals the background bit for bit
  for (int x = 0; x < image.width; ++x) {
    for (const int y : {0, image.height - 1}) {
      const unsigned char* pixel = &image.rgb[3 * std::size_t(y * image.width + x)];
      ASSERT_TRUE(pixel[0] == 0xF7 && pixel[1] == 0xF7 && pixel[2] == 0xF5) << x << ", " << y;
    }
  }
}

TEST(Render, BothQualitiesShowTheSameScene) {
  // bodies are at the same positions; light and shadow change the image much less than the bodies do
  Picture empty = small_picture();
  empty.rows[0][0].bodies.clear(), empty.rows[0][0].balls.clear();
  const Image fast = draw(small_picture(Quality::fast)), still = draw(small_picture(Quality::still));
  double apart = 0, seen = 0;
  const Image nothing = draw(empty);
  for (std::size_t i = 0; i < fast.rgb.size(); ++i) {
    apart += std::abs(fast.rgb[i] - still.rgb[i]);
    seen += std::abs(fast.rgb[i] - nothing.rgb[i]);
  }
  EXPECT_LT(apart, 0.4 * seen);
}

TEST(Render, BallIsSeen) {
  Picture without = small_picture();
  without.rows[0][0].balls.clear();
  EXPECT_GT(changed(draw(small_picture()), draw(without)), 0.03);
}

TEST(Render, APictureOfNothingIsAnError) {
  Picture picture = small_picture();
  picture.rows[0][0].balls.clear();
  picture.rows[0][0].bodies.clear();
  try {
    write_png(picture, std::filesystem::temp_directory_path() / "crosscheck-nothing.png");
    FAIL() << "expected an error for a blank picture";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("crosscheck-nothing: the picture is empty"), std::string::npos);
  }
}

TEST(Render, PenetrationIsSeen) {
  // a cloth on the ball must hide the top of the ball; the same cloth 2 cm inside must not
  Picture on_top = small_picture();
  Body& body = body_of(on_top);
  for (int i = 0; i < body.x.cols(); ++i)
    body.x.col(i) = 0.352 * Vec3(2 * body.x(0, i), 1, 2 * body.x(2, i)).normalized();
  Picture inside = on_top;
  body_of(inside).x *= 0.33 / 0.352;
  Picture bare = on_top;
  bare.rows[0][0].bodies.clear();
  // the hidden cloth may transmit a little light; the one on the ball must change the image ten times as much
  EXPECT_GT(changed(draw(on_top), draw(bare)), 0.02);
  EXPECT_LT(changed(draw(inside), draw(bare)), 0.002);
}

TEST(Render, ShiftOfTwoPercentIsSeen) {
  const Picture picture = small_picture();
  Picture shifted = picture;
  const double view_height =
      2 * (picture.view.eye - picture.view.target).norm() * std::tan(field_of_view * std::numbers::pi / 360);
  body_of(shifted).x.row(0).array() += 0.02 * view_height;
  EXPECT_GT(changed(draw(picture), draw(shifted)), 0.02);
  EXPECT_EQ(changed(draw(picture), draw(picture)), 0);
}

TEST(Render, SceneOfAnyUnitLooksTheSame) {
  // lengths in millimetres give the same picture up to round-off, because the camera's frame has no unit
  Picture scaled = small_picture();
  body_of(scaled).x *= 1000, scaled.rows[0][0].balls[0].radius *= 1000;
  scaled.view = fit_view({body_of(scaled).x}, scaled.rows[0][0].balls, {0.3, 0.4, 1}, panel_aspect(scaled));
  EXPECT_LT(changed(draw(small_picture()), draw(scaled)), 0.002);
}

TEST(Render, LeavesOutABodyThatBlewUp) {
  Picture empty = small_picture();
  empty.rows[0][0].bodies.clear();
  const Image without = draw(empty);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300, 1e30}) {
    Picture picture = small_picture();
    body_of(picture).trail = {Vec3(0, 0, 0), Vec3::Constant(bad)};
    body_of(picture).x.col(9).setConstant(bad);
    EXPECT_EQ(changed(draw(picture), without), 0) << bad;
  }
}

TEST(Render, RefusesAPictureWithoutPanels) { EXPECT_THROW(draw(Picture{}), std::runtime_error); }

TEST(Render, ScaleColoursLowAndHighApart) {
  const auto with_value = [&](double value) {
    Picture picture = small_picture();
    picture.scale = Scale{"stretch / %", 5};
    body_of(picture).value.assign(64, value);
    return draw(picture);
  };
  const Image low = with_value(0), high = with_value(5);
  EXPECT_GT(changed(low, high), 0.02);
  EXPECT_EQ(changed(high, with_value(50)), 0) << "values out of range have the colour at the end of the scale";
}

TEST(Render, TubesTakePaletteColours) {
  const auto with_colour = [&](int index) {
    Picture picture = small_picture();
    Body& body = body_of(picture);
    body.triangles.clear(), std::swap(body.tubes, body.threads);
    body.tube_colour.assign(body.tubes.size(), index);
    return draw(picture);
  };
  EXPECT_GT(changed(with_colour(0), with_colour(1)), 0.02);
}

TEST(Render, PngHasLettersAndTheSameBytes) {
  const Scratch scratch;
  Picture picture = small_picture();
  picture.width = 480, picture.height = 270;
  picture.scale = Scale{"stretch / %", 5};
  picture.legend = {"structural", "shear", "bend"};
  picture.rows[0][0].subtitle = "it's `ls` @t {x}_y^2 \\n \"5 %\"";
  picture.rows[0].push_back(picture.rows[0][0]);
  picture.rows[0][1].title = "bullet/deformable-explicit-with-a-long-name";
  write_png(picture, scratch.path / "a.png");
  write_png(picture, scratch.path / "b.png");
  EXPECT_EQ(bytes_of(scratch.path / "a.png"), bytes_of(scratch.path / "b.png"));
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path), fs::directory_iterator()), 2)
      << "no temporary files may remain";

  const Image lettered = read_png(scratch.path / "a.png");
  ASSERT_EQ(lettered.width, 480);
  ASSERT_EQ(lettered.height, 270);
  EXPECT_GT(changed(lettered, draw(picture)), 0.01);

  // long titles shrink, so that no letter is at the rims or between the panels
  for (int y = 0; y < 28; ++y) {
    for (const int x : {0, 1, 239, 240, 478, 479}) EXPECT_GT(lettered.rgb[3 * std::size_t(y * 480 + x)], 0xE0) << x;
  }
}

TEST(Render, UnwritablePlaceIsNamed) {
  const Scratch scratch;
  std::ofstream(scratch.path / "file") << "no folder";
  for (const fs::path& file : {scratch.path / "file" / "picture.png", scratch.path}) {
    try {
      write_png(small_picture(), file);
      FAIL() << "expected an error for " << file;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "expected one line";
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

TEST(Render, RodWithoutLengthIsARoundBall) {
  // no facet of a ball may be more than 0.1 % of the radius below the surface
  const RodMesh mesh = rod_mesh(112, 28);
  ASSERT_EQ(mesh.index.size() % 3, 0u);
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (std::size_t k = i; k < i + 3; ++k) middle += mesh.corner[mesh.index[k]].head<3>() / 3;
    ASSERT_GT(middle.norm(), 0.999f);
  }
}

TEST(Render, ViewHoldsEverythingTightly) {
  const Points points = Points::Random(3, 50);
  const std::vector<Ball> balls = {{{0.5, -0.2, 0.1}, 0.9}};
  for (const double aspect : {0.4, 1.0, 2.5}) {
    for (const Vec3& direction : {Vec3(0.3, 0.4, 1), Vec3(0, 0, 1), Vec3(-1, 0.2, 0), Vec3(0, 1, 0)}) {
      const View view = fit_view({points}, balls, direction, aspect);
      const Frame frame = frame_of(view, aspect);
      Points all(3, 50 + 400);
      all.leftCols(50) = points;
      for (int i = 0; i < 400; ++i) {
        all.col(50 + i) = balls[0].centre + balls[0].radius * Vec3::Random().normalized();
      }
      double reach = 0;
      for (int i = 0; i < all.cols(); ++i) {
        const Eigen::Vector4f clip = frame.to_clip * frame.place(all.col(i)).homogeneous();
        reach = std::max({reach, double(std::abs(clip.x() / clip.w())), double(std::abs(clip.y() / clip.w()))});
        EXPECT_GT(all(1, i), *view.floor);
      }
      EXPECT_LT(reach, 0.89) << "margin, aspect " << aspect;
      EXPECT_GT(reach, 0.45) << "size, aspect " << aspect;
    }
  }
}

TEST(Render, ViewHasEverythingInItsMiddle) {
  // the shadow falls far to the side, and may be cut off; the cloth must stay centred and large
  Points hanging(3, 4);
  hanging << -1, 1, -1, 1, 0, 0, 3, 3, 0, 0, 0, 0;
  for (const double aspect : {0.5, 1.0, 2.0}) {
    const View view = fit_view({hanging}, {}, {0.5, 0.3, 1}, aspect);
    const Frame frame = frame_of(view, aspect);
    Eigen::AlignedBox2f box;
    for (int i = 0; i < hanging.cols(); ++i)
      box.extend((frame.to_clip * frame.place(hanging.col(i)).homogeneous()).hnormalized().head<2>());
    EXPECT_LT(box.center().cwiseAbs().maxCoeff(), 0.05) << aspect;
    EXPECT_GT(box.sizes().maxCoeff(), 2 * 0.66) << aspect;
  }
}

TEST(Render, ViewOfHardCasesIsUsable) {
  Points line = Points::Zero(3, 2), bad = line;
  line << 0, 0, 0, -1, 0, 0;
  bad << 0, std::nan(""), 0, 1, 0, 1;
  for (const View& view : {fit_view({line}, {}, {0, 0, 1}, 1), fit_view({bad}, {}, {0, 0, 1}, 1),
                           fit_view({}, {}, {0, 0, 1}, 1), fit_view({line}, {}, {0, 0, 0}, 0)}) {
    EXPECT_NO_THROW(frame_of(view, 1));
  }
}

}  // namespace

// Golden pictures, approved by a person: tests/unit/report/golden/NAME.png, with letters and colour bar.
//
// Mesa's output is identical on processors of the same kind. On other kinds, single channels differ by up to 4
// (measured: 292 of 691200 with the oldest instructions). Pictures count as equal if no channel differs by more than 8,
// and at most one channel in 200 by more than 2. The test reports the path of the new picture, from which the golden
// one can be updated.

namespace {

namespace fs = std::filesystem;

const fs::path golden = fs::path(CROSSCHECK_SOURCE) / "tests/unit/report/golden";

/// If `letters`, letters are compared, too. Other versions of Cairo may shift them by a fraction of a pixel, which
/// affects a tenth of the channels in their rows.
bool look_the_same(const Image& a, const Image& b, bool letters = true) {
  if (a.width != b.width || a.height != b.height || a.rgb.empty()) return false;
  std::size_t far = 0, in_letters = 0;
  const std::size_t row = 3UL * static_cast<std::size_t>(a.width), last = static_cast<std::size_t>(a.height) - 20;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const int apart = std::abs(a.rgb[i] - b.rgb[i]);
    if (!letters && apart > 2 && (i / row < 30 || i / row >= last)) {
      ++in_letters;
      continue;
    }
    if (apart > 8) return false;
    far += apart > 2;
  }
  return far <= a.rgb.size() / 200 && in_letters <= 50 * row / 10;
}

/// A cloth above a ball, coloured by a value, next to the same cloth drawn as springs.
Picture drape(Quality quality) {
  Picture picture = small_picture(quality);
  picture.width = 480, picture.height = 270;
  picture.scale = Scale{"stretch / %", 5};
  Panel& panel = picture.rows[0][0];
  panel.title = "mysim/symplectic-euler", panel.subtitle = "t = 1.5 s";
  Body& body = panel.bodies[0];
  for (Eigen::Index i = 0; i < body.x.cols(); ++i) body.value.push_back(5 * body.x.col(i).norm());
  picture.rows[0].push_back(panel);
  Panel& other = picture.rows[0][1];
  other.title = "bullet/pbd";
  Body& springs = other.bodies[0];
  springs.triangles.clear(), std::swap(springs.tubes, springs.threads);
  for (const auto& [a, b] : springs.tubes) springs.tube_value.push_back((springs.value[a] + springs.value[b]) / 2);
  picture.view = fit_view({body.x}, panel.balls, {0.3, 0.4, 1}, panel_aspect(picture));
  return picture;
}

/// True if letters can equal those of the golden pictures, which Cairo 1.16 drew.
bool has_golden_letters() {
  return run_program({"pkg-config", "--modversion", "cairo"}, fs::temp_directory_path()).out.starts_with("1.16");
}

class GoldenPicture : public testing_tools::InFolder {
 protected:
  Image drawn(const Picture& picture) const {
    write_png(picture, folder_ / "drawn.png");
    return read_png(folder_ / "drawn.png");
  }
};

TEST_F(GoldenPicture, LooksAsItDidAndChangesAreNoticed) {
  for (const auto& [name, quality] :
       {std::pair{"drape-fast.png", Quality::fast}, {"drape-still.png", Quality::still}}) {
    SCOPED_TRACE(name);
    const Image known = read_png(golden / name), now = drawn(drape(quality));
    if (!look_the_same(known, now, has_golden_letters())) {
      const fs::path kept = fs::temp_directory_path() / name;
      fs::copy_file(folder_ / "drawn.png", kept, fs::copy_options::overwrite_existing);
      ADD_FAILURE() << (known.rgb.empty() ? "there is no picture " : "not as in ") << golden / name
                    << "; the new one is " << kept << ": compare both, and copy it if the change is intended";
      continue;
    }
    const std::pair<const char*, std::function<void(Picture&)>> changes[] = {
        {"a ball is missing", [](Picture& p) { p.rows[0][1].balls.clear(); }},
        {"the cloth lies 2 % of the view further right",
         [](Picture& p) {
           const double high = 2 * (p.view.eye - p.view.target).norm() * std::tan(field_of_view * M_PI / 360);
           p.rows[0][0].bodies[0].x.row(0).array() += 0.02 * high;
         }},
        {"the bar says 6 where it is 5",
         [](Picture& p) {
           p.scale->high = 6;
           for (Panel& panel : p.rows[0]) {
             for (double& v : panel.bodies[0].value) v *= 1.2;
             for (double& v : panel.bodies[0].tube_value) v *= 1.2;
           }
         }},
        {"a title is another", [](Picture& p) { p.rows[0][1].title = "bullet/pdb"; }},
    };
    for (const auto& [what, change] : changes) {
      Picture other = drape(quality);
      change(other);
      EXPECT_FALSE(look_the_same(now, drawn(other))) << what << ", and the comparison does not notice";
    }
  }
}

}  // namespace
}  // namespace crosscheck::render
