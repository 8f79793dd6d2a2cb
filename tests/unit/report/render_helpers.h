#pragma once

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "report/pictures/picture.h"

namespace crosscheck::render {

/// A cloth of n x n particles and side 1 m, which sags slightly in the middle.
inline Body cloth(int n, double height) {
  Body body;
  body.x.resize(3, n * n);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double u = double(i) / (n - 1), v = double(j) / (n - 1);
      body.x.col(j * n + i) = Vec3(u - 0.5, height - 0.3 * u * (1 - u) * v * (1 - v), v - 0.5);
      const int here = j * n + i;
      if (i + 1 < n) body.threads.push_back({here, here + 1});
      if (j + 1 < n) body.threads.push_back({here, here + n});
      if (i + 1 == n || j + 1 == n) continue;
      body.triangles.push_back({here, here + 1, here + n + 1});
      body.triangles.push_back({here, here + n + 1, here + n});
    }
  }
  return body;
}

inline Picture small_picture(Quality quality = Quality::fast) {
  Picture picture;
  picture.quality = quality;
  picture.width = 160, picture.height = 120;
  const Body body = cloth(8, 0.6);
  const Ball ball{{0, 0, 0}, 0.35};
  picture.rows = {{Panel{"mysim", "", {body}, {ball}}}};
  picture.view = fit_view({body.x}, {ball}, {0.3, 0.4, 1}, panel_aspect(picture));
  return picture;
}

inline Body& body_of(Picture& picture) { return picture.rows[0][0].bodies[0]; }

/// Fraction of pixels that differ by more than 8 in a channel.
inline double changed(const Image& a, const Image& b) {
  EXPECT_EQ(a.rgb.size(), b.rgb.size());
  int count = 0;
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
    int most = 0;
    for (std::size_t k = i; k < i + 3; ++k) most = std::max(most, std::abs(a.rgb[k] - b.rgb[k]));
    count += most > 8;
  }
  return double(count) / (a.width * a.height);
}

}  // namespace crosscheck::render
