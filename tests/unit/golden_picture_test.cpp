// Pictures as they looked when somebody last looked at them: tests/unit/golden/NAME.png, with letters and colour bar.
//
// Mesa draws the same bytes on the same kind of processor; on others single channels differ by up to 4 (measured: 292
// of 691200 with the oldest instructions). So a picture is the same where no channel differs by more than 8, and at
// most one in 200 by more than 2. What is meant to change a picture changes these files: the test says where it left
// the new one.
#include <gtest/gtest.h>
#include <png.h>

#include <functional>

#include "render_helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck::render {
namespace {

namespace fs = std::filesystem;

const fs::path golden = fs::path(CROSSCHECK_SOURCE) / "tests/unit/golden";

/// No pixels where it cannot be read.
Image image_in(const fs::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, file.c_str())) return {};
  png.format = PNG_FORMAT_RGB;
  Image image{int(png.width), int(png.height), std::vector<unsigned char>(PNG_IMAGE_SIZE(png))};
  png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr);
  return image;
}

bool look_the_same(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.rgb.empty()) return false;
  std::size_t far = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const int apart = std::abs(a.rgb[i] - b.rgb[i]);
    if (apart > 8) return false;
    far += apart > 2;
  }
  return far <= a.rgb.size() / 200;
}

/// A cloth above its ball, coloured by a value, beside the same as springs.
Picture drape(Quality quality) {
  Picture picture = small_picture(quality);
  picture.width = 480, picture.height = 270;
  picture.scale = Scale{"stretch / %", 0, 5};
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
  picture.view = view_that_holds({body.x}, panel.balls, {0.3, 0.4, 1}, panel_aspect(picture));
  return picture;
}

class GoldenPicture : public testing_tools::InFolder {
 protected:
  Image drawn(const Picture& picture) const {
    write_png(picture, folder_ / "drawn.png");
    return image_in(folder_ / "drawn.png");
  }
};

TEST_F(GoldenPicture, LooksAsItDidAndChangesAreNoticed) {
  for (const auto& [name, quality] :
       {std::pair{"drape-fast.png", Quality::fast}, {"drape-still.png", Quality::still}}) {
    SCOPED_TRACE(name);
    const Image known = image_in(golden / name), now = drawn(drape(quality));
    if (!look_the_same(known, now)) {
      const fs::path kept = fs::temp_directory_path() / name;
      fs::copy_file(folder_ / "drawn.png", kept, fs::copy_options::overwrite_existing);
      ADD_FAILURE() << (known.rgb.empty() ? "there is no picture " : "not as in ") << golden / name
                    << "; the new one is " << kept << ": look at both, and copy it where the change is meant";
      continue;
    }
    const std::pair<const char*, std::function<void(Picture&)>> changes[] = {
        {"a ball is missing", [](Picture& p) { p.rows[0][1].balls.clear(); }},
        {"the cloth lies 2 % of the view further right",
         [](Picture& p) {
           const double high = 2 * (p.view.eye - p.view.target).norm() * std::tan(p.view.field_of_view * M_PI / 360);
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
        {"the bar has other colours", [](Picture& p) { p.scale->diverging = true; }},
        {"a title is another", [](Picture& p) { p.rows[0][1].title = "bullet/pdb"; }},
    };
    for (const auto& [what, change] : changes) {
      Picture other = drape(quality);
      change(other);
      EXPECT_FALSE(look_the_same(known, drawn(other))) << what << ", and nobody notices";
    }
  }
}

}  // namespace
}  // namespace crosscheck::render
