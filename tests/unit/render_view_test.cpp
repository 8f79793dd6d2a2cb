// The view that holds everything, and the ball's mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "render_helpers.h"
#include "report/render/frame.h"
#include "report/render/mesh.h"

namespace crosscheck::render {
namespace {

TEST(Render, SphereMeshIsRoundAndClosed) {
  // the picture's balls: no flat piece may dip more than 0.1 % of the radius below the surface
  const Mesh mesh = sphere_mesh(112);
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
      const View view = view_that_holds({points}, balls, direction, aspect);
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
        EXPECT_GT(view.up.dot(all.col(i)), *view.floor);
      }
      EXPECT_LT(reach, 0.89) << "margin, aspect " << aspect;
      EXPECT_GT(reach, 0.45) << "size, aspect " << aspect;
    }
  }
}

TEST(Render, ViewOfHardCasesIsUsable) {
  Points line = Points::Zero(3, 2), bad = line;
  line << 0, 0, 0, -1, 0, 0;
  bad << 0, std::nan(""), 0, 1, 0, 1;
  for (const View& view : {view_that_holds({line}, {}, {0, 0, 1}, 1), view_that_holds({bad}, {}, {0, 0, 1}, 1),
                           view_that_holds({}, {}, {0, 0, 1}, 1), view_that_holds({line}, {}, {0, 0, 0}, 0)}) {
    EXPECT_NO_THROW(frame_of(view, 1));
  }
}

}  // namespace
}  // namespace crosscheck::render
