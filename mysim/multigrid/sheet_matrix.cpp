#include "mysim/multigrid/sheet_matrix.h"

#include <algorithm>

namespace crosscheck::multigrid {
namespace {

/// Chebyshev's rounds against eigenvalues of D^-1 A in [lowest, highest], where it is 2 at most (kernel.h).
struct Relaxation {
  int rounds;
  double lowest, highest = 2;
};
// the next sheet holds waves of four of this one's springs and longer, whose eigenvalues are below about a fifth of 2;
// by trial on hanging sheets of 24 to 128 columns at 60 and 240 steps a second one to four rounds take the same time
constexpr Relaxation between{2, 0.4};
/// On the coarsest sheet there is no next one: as many rounds as a pull needs to walk through it, which reduce by ten
/// what is above the lowest.
Relaxation coarsest(const Layout& layout) {
  const int rounds = std::clamp(std::max(layout.rows, layout.columns), 16, 64);
  return {rounds, 2 * (1.6 / rounds) * (1.6 / rounds)};
}

void relax(const Functions& f, Level& level, const Relaxation& r, bool from_zero) {
  const double middle = (r.highest + r.lowest) / 2, half = (r.highest - r.lowest) / 2;
  double ratio = half / middle;
  for (int i = 0; i < r.rounds; ++i) {
    double keep = 0, take = 1 / middle;
    if (i > 0) {
      const double next = 1 / (2 * middle / half - ratio);
      keep = next * ratio, take = 2 * next / half, ratio = next;
    }
    f.relax(level.matrix(), from_zero && i == 0, static_cast<float>(keep), static_cast<float>(take), level.b.data(),
            level.u.data(), level.change.data());
  }
}

}  // namespace

SheetMatrix::SheetMatrix(const Weave& weave, const std::vector<int>& pins)
    : functions_(multigrid::functions(strip::chosen())) {
  levels_.emplace_back(Layout::of(weave), weave, 1);
  for (const int pin : pins) levels_.front().free[pin] = 0;
  for (double longer = 2; levels_.back().layout().can_be_halved(); longer *= 2) {
    const Layout fine = levels_.back().layout(), coarse = fine.halved();
    levels_.emplace_back(coarse, weave, longer);
    steps_.push_back(step(fine, coarse));
    const Level& above = levels_[levels_.size() - 2];
    for (int row = 0; row < coarse.rows; ++row)
      for (int column = 0; column < coarse.columns; ++column)
        levels_.back().free[row * coarse.columns + column] = above.free[2 * row * fine.columns + 2 * column];
  }
}

SheetMatrix::Step SheetMatrix::step(const Layout& fine, const Layout& coarse) {
  Step step;
  step.right = Lines<float>(static_cast<size_t>(coarse.blocks) * lanes);
  step.left = Lines<float>(static_cast<size_t>(coarse.blocks) * lanes);
  for (int c = 0; c < coarse.columns; ++c) {
    const int at = c % coarse.blocks * lanes + c / coarse.blocks;
    step.right.data()[at] = c + 1 < coarse.columns ? 0.5f : 1;
    step.left.data()[at] = c > 0 ? 0.5f : 0;
  }
  step.transfer = {coarse.rows, coarse.blocks, fine.rows, step.right.data(), step.left.data()};
  return step;
}

void SheetMatrix::set_inertia(const Eigen::ArrayXd& inertia) {
  if (inertia.size() == inertia_.size() && (inertia == inertia_).all()) return;
  inertia_ = inertia;
  levels_.front().inertia = inertia;
  levels_.front().take_inertia();
  for (size_t l = 1; l < levels_.size(); ++l) {
    const Layout &fine = levels_[l - 1].layout(), &coarse = levels_[l].layout();
    // each particle's, given to the coarse ones that it hangs on
    Eigen::ArrayXd& sum = levels_[l].inertia.setZero();
    for (int row = 0; row < fine.rows; ++row)
      for (int column = 0; column < fine.columns; ++column)
        for (const int r : {row / 2, std::min((row + 1) / 2, coarse.rows - 1)})
          for (const int c : {column / 2, std::min((column + 1) / 2, coarse.columns - 1)})
            sum[r * coarse.columns + c] += levels_[l - 1].inertia[row * fine.columns + column] / 4;
    levels_[l].take_inertia();
  }
}

void SheetMatrix::set(const Eigen::ArrayXd& inertia, const Points& x, Curvature curvature) {
  set_inertia(inertia);
  for (size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    if (l == 0)
      level.layout().put(x, 1, level.x);
    else
      levels_[l - 1].layout().halve(levels_[l - 1].x, level.x);
    // what relaxation and coarse sheets do must be positive definite, even where the matrix is not
    level.linearise(functions_);
    if (l == 0 && curvature == Curvature::exact) level.linearise_exactly(functions_);
  }
}

double SheetMatrix::products() const {
  double sum = 0;
  for (const Level& level : levels_) {
    const bool last = &level == &levels_.back();
    // the first round, from 0, takes none
    const double own = last ? coarsest(level.layout()).rounds - 1 : 2 * between.rounds;
    sum += own * static_cast<double>(level.free.size()) / static_cast<double>(levels_.front().free.size());
  }
  return sum;
}

void SheetMatrix::cycle(size_t l) {
  Level& level = levels_[l];
  if (l + 1 == levels_.size()) return relax(functions_, level, coarsest(level.layout()), true);
  Level& coarse = levels_[l + 1];
  relax(functions_, level, between, true);
  functions_.residual(level.matrix(), level.b.data(), level.u.data(), level.r.data());
  functions_.to_coarse(steps_[l].transfer, level.r.data(), coarse.b.data());
  cycle(l + 1);
  functions_.to_fine(steps_[l].transfer, coarse.u.data(), level.matrix().free, level.u.data());
  relax(functions_, level, between, false);
}

}  // namespace crosscheck::multigrid
