#include "mysim/multigrid/level.h"

namespace crosscheck::multigrid {

Level::Level(const Layout& layout, const Weave& weave, double times_longer)
    : inertia(Eigen::ArrayXd::Zero(layout.rows * layout.columns)),
      free(Eigen::ArrayXd::Ones(layout.rows * layout.columns)),
      x(layout.field<double>()),
      b(layout.field<float>()),
      u(layout.field<float>()),
      change(layout.field<float>()),
      r(layout.field<float>()),
      layout_(layout) {
  const auto all = static_cast<size_t>(layout.all_lanes());
  const auto row = static_cast<size_t>(layout.row_length());
  inertia_ = Lines<double>(all), free_ = Lines<double>(all), blocks_ = Lines<double>(6 * all);
  sums_ = Lines<double>(6 * row), force_ = Lines<double>(3 * row);
  single_inertia_ = Lines<float>(all), single_free_ = Lines<float>(all), single_blocks_ = Lines<float>(6 * all);
  single_force_ = Lines<float>(3 * row);
  shape_ = {layout.rows, layout.blocks, x.data(), {}, {}, false, sums_.data()};
  exact_ = {layout.rows,  layout.blocks, {}, inertia_.data(), nullptr /* only asked for in single precision */,
            free_.data(), force_.data()};
  matrix_ = {layout.rows,         layout.blocks,       {}, single_inertia_.data(), single_blocks_.data(),
             single_free_.data(), single_force_.data()};
  for (int d = 0; d < directions; ++d) {
    if (!weave.families[d]) continue;
    k_[d] = Lines<double>(static_cast<size_t>(layout.blocks) * lanes);
    springs_[d] = Lines<double>(4 * all), single_springs_[d] = Lines<float>(4 * all);
    for (int c = 0; c < layout.columns; ++c)
      if (const int to = c + direction[d].right; to >= 0 && to < layout.columns)
        k_[d].data()[c % layout.blocks * lanes + c / layout.blocks] = weave.families[d]->k;
    shape_.k[d] = k_[d].data(), shape_.rest[d] = times_longer * weave.families[d]->rest;
    exact_.springs[d] = spring_lines_[d] = springs_[d].data();
    matrix_.springs[d] = single_springs_[d].data();
  }
}

void Level::take_inertia() {
  layout_.each([&](int i, long at, long) { inertia_.data()[at] = inertia[i], free_.data()[at] = free[i]; });
  for (size_t i = 0; i < inertia_.size(); ++i) {
    single_inertia_.data()[i] = static_cast<float>(inertia_.data()[i]);
    single_free_.data()[i] = static_cast<float>(free_.data()[i]);
  }
}

void Level::linearise(const Functions& f) {
  shape_.clamped = true;
  f.linearise(shape_, spring_lines_, blocks_.data());
  f.invert(blocks_.data(), inertia_.data(), free_.data(), layout_.all_lanes() / lanes);
  for (int d = 0; d < directions; ++d)
    if (shape_.k[d]) f.narrow(spring_lines_[d], single_springs_[d].data(), 4 * layout_.all_lanes());
  f.narrow(blocks_.data(), single_blocks_.data(), 6 * layout_.all_lanes());
}

void Level::linearise_exactly(const Functions& f) {
  shape_.clamped = false;
  f.linearise(shape_, spring_lines_, blocks_.data());
}

}  // namespace crosscheck::multigrid
