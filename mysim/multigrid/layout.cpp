#include "mysim/multigrid/layout.h"

#include <algorithm>

namespace crosscheck::multigrid {

Layout Layout::of(const Weave& weave) {
  // down to one block or three; the rest are empty lanes, a third of them at most
  int blocks = (weave.columns + lanes - 1) / lanes, times = 1;
  for (; blocks > 3; blocks = (blocks + 1) / 2) times *= 2;
  return {weave.rows, weave.columns, blocks * times == 3 ? 4 : blocks * times};
}

void Layout::halve(const Lines<double>& fine, Lines<double>& coarse) const {
  const Layout to = halved();
  for (int row = 0; row < to.rows; ++row)
    for (int block = 0; block < to.blocks; ++block)
      std::copy_n(fine.data() + 2 * row * row_length() + static_cast<long>(before + 2 * block) * 3 * lanes, 3 * lanes,
                  coarse.data() + row * to.row_length() + static_cast<long>(before + block) * 3 * lanes);
}

void Layout::put(const Points& points, double factor, Lines<double>& field) const {
  each([&](int i, long, long at) {
    for (int c = 0; c < 3; ++c) field.data()[at + c * lanes] = factor * points(c, i);
  });
}

void Layout::get(const Lines<double>& field, double factor, Points& points) const {
  points.resize(3, static_cast<Eigen::Index>(rows) * columns);
  each([&](int i, long, long at) {
    for (int c = 0; c < 3; ++c) points(c, i) = factor * field.data()[at + c * lanes];
  });
}

}  // namespace crosscheck::multigrid
