#include "mysim/implicit/multigrid/solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace crosscheck::multigrid {

COMPILED_FOR_EACH_INSTRUCTION_SET(Kernels kernels_of())

Kernels kernels(simd::InstructionSet isa) { return SELECT_COMPILED(isa, kernels_of)(); }

Layout Layout::of(const GridTopology& topology) {
  assert(topology.rows > 0 && topology.columns > 0);
  int tiles = (topology.columns + lanes - 1) / lanes, times = 1;
  for (; tiles > 3; tiles = (tiles + 1) / 2) times *= 2;
  return {topology.rows, topology.columns, tiles * times == 3 ? 4 : tiles * times};
}

void Layout::inject(const AlignedBuffer<double>& fine, AlignedBuffer<double>& coarse) const {
  const Layout to = coarsened();
  assert(fine.size() == static_cast<size_t>(rows * row_length()));
  assert(coarse.size() == static_cast<size_t>(to.rows * to.row_length()));
  for (int row = 0; row < to.rows; ++row)
    for (int tile = 0; tile < to.tiles; ++tile)
      std::copy_n(fine.data() + 2 * row * row_length() + static_cast<long>(left_halo + 2 * tile) * 3 * lanes, 3 * lanes,
                  coarse.data() + row * to.row_length() + static_cast<long>(left_halo + tile) * 3 * lanes);
}

void Layout::put(const Points& points, double factor, AlignedBuffer<double>& field) const {
  assert(points.cols() == static_cast<Eigen::Index>(rows) * columns);
  each([&](int i, long, long at) {
    for (int c = 0; c < 3; ++c) field.data()[at + c * lanes] = factor * points(c, i);
  });
}

void Layout::get(const AlignedBuffer<double>& field, double factor, Points& points) const {
  points.resize(3, static_cast<Eigen::Index>(rows) * columns);
  each([&](int i, long, long at) {
    for (int c = 0; c < 3; ++c) points(c, i) = factor * field.data()[at + c * lanes];
  });
}

Level::Level(const Layout& layout, const GridTopology& topology, double times_longer)
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
  inertia_ = AlignedBuffer<double>(all), free_ = AlignedBuffer<double>(all), blocks_ = AlignedBuffer<double>(6 * all);
  sums_ = AlignedBuffer<double>(6 * row), force_ = AlignedBuffer<double>(3 * row);
  single_inertia_ = AlignedBuffer<float>(all), single_free_ = AlignedBuffer<float>(all),
  single_blocks_ = AlignedBuffer<float>(6 * all);
  single_force_ = AlignedBuffer<float>(3 * row);
  geometry_ = {layout.rows, layout.tiles, x.data(), {}, {}, false, sums_.data()};
  exact_ = {layout.rows,  layout.tiles, {}, inertia_.data(), nullptr /* used in single precision only */,
            free_.data(), force_.data()};
  matrix_ = {layout.rows,         layout.tiles,        {}, single_inertia_.data(), single_blocks_.data(),
             single_free_.data(), single_force_.data()};
  for (int d = 0; d < directions; ++d) {
    if (!topology.families[d]) continue;
    stiffness_ += 2 * topology.families[d]->k;
    k_[d] = AlignedBuffer<double>(static_cast<size_t>(layout.tiles) * lanes);
    springs_[d] = AlignedBuffer<double>(4 * all), single_springs_[d] = AlignedBuffer<float>(4 * all);
    for (int c = 0; c < layout.columns; ++c)
      if (const int to = c + direction[d].right; to >= 0 && to < layout.columns)
        k_[d].data()[c % layout.tiles * lanes + c / layout.tiles] = topology.families[d]->k;
    geometry_.k[d] = k_[d].data(), geometry_.rest[d] = times_longer * topology.families[d]->rest;
    exact_.springs[d] = spring_data_[d] = springs_[d].data();
    matrix_.springs[d] = single_springs_[d].data();
  }
}

void Level::load_inertia() {
  layout_.each([&](int i, long at, long) { inertia_.data()[at] = inertia[i], free_.data()[at] = free[i]; });
  for (size_t i = 0; i < inertia_.size(); ++i) {
    single_inertia_.data()[i] = static_cast<float>(inertia_.data()[i]);
    single_free_.data()[i] = static_cast<float>(free_.data()[i]);
  }
  const double least = inertia.minCoeff();
  inertia_share_ = least / (least + stiffness_);
}

void Level::linearise(const Kernels& f) {
  geometry_.clamped = true;
  f.linearise(geometry_, spring_data_, blocks_.data());
  f.invert(blocks_.data(), inertia_.data(), free_.data(), layout_.all_lanes() / lanes);
  for (int d = 0; d < directions; ++d)
    if (geometry_.k[d]) f.to_float(spring_data_[d], single_springs_[d].data(), 4 * layout_.all_lanes());
  f.to_float(blocks_.data(), single_blocks_.data(), 6 * layout_.all_lanes());
}

void Level::linearise_unclamped(const Kernels& f) {
  geometry_.clamped = false;
  f.linearise(geometry_, spring_data_, blocks_.data());
}

namespace {

/// Chebyshev iteration for eigenvalues of D^-1 A in [lowest, highest]; the upper bound is 2 (multigrid_kernels.h).
struct ChebyshevSmoother {
  int rounds;
  double lowest, highest = 2;
};
// Waves at least as long as four of this grid's springs are left to the next grid; their eigenvalues are below about
// 0.4. In trials on hanging cloths of 24 to 128 columns at 60 and 240 steps per second, one to four rounds were equally
// fast.
constexpr ChebyshevSmoother level_smoother{2, 0.4};
/// If inertia is the share s of the diagonal D, D^-1 A has eigenvalues in [s, 2 - s], and Chebyshev iteration reduces
/// the error by 1 / cosh(rounds acosh(1 / (1 - s))) (Y. Saad, Iterative Methods for Sparse Linear Systems, 2003,
/// 12.3.2). If the share is at least this, five rounds reduce the error tenfold, with less work than a coarser grid.
constexpr double enough_inertia = 0.2;
/// Chooses enough rounds to reduce the error tenfold or, if there is less inertia, for a pull to cross the grid.
ChebyshevSmoother coarsest_smoother(const Level& level) {
  if (const double share = level.inertia_share(); share >= enough_inertia)
    return {static_cast<int>(std::ceil(std::acosh(10.) / std::acosh(1 / (1 - share)))), share, 2 - share};
  const int rounds = std::clamp(std::max(level.layout().rows, level.layout().columns), 16, 64);
  return {rounds, 2 * (1.6 / rounds) * (1.6 / rounds)};
}

void smooth(const Kernels& f, Level& level, const ChebyshevSmoother& r, bool from_zero) {
  assert(r.rounds > 0 && 0 < r.lowest && r.lowest < r.highest);
  const double middle = (r.highest + r.lowest) / 2, half = (r.highest - r.lowest) / 2;
  double ratio = half / middle;
  for (int i = 0; i < r.rounds; ++i) {
    double keep = 0, take = 1 / middle;
    if (i > 0) {
      const double next = 1 / (2 * middle / half - ratio);
      keep = next * ratio, take = 2 * next / half, ratio = next;
    }
    f.smooth(level.matrix(), from_zero && i == 0, static_cast<float>(keep), static_cast<float>(take), level.b.data(),
             level.u.data(), level.change.data());
  }
}

}  // namespace

VCycle::VCycle(const GridTopology& topology, const std::vector<int>& pins)
    : kernels_(multigrid::kernels(simd::active_instruction_set())) {
  levels_.emplace_back(Layout::of(topology), topology, 1);
  for (const int pin : pins) levels_.front().free[pin] = 0;
  for (double longer = 2; levels_.back().layout().can_coarsen(); longer *= 2) {
    const Layout fine = levels_.back().layout(), coarse = fine.coarsened();
    levels_.emplace_back(coarse, topology, longer);
    transfers_.push_back(grid_transfer(fine, coarse));
    const Level& above = levels_[levels_.size() - 2];
    for (int row = 0; row < coarse.rows; ++row)
      for (int column = 0; column < coarse.columns; ++column)
        levels_.back().free[row * coarse.columns + column] = above.free[2 * row * fine.columns + 2 * column];
  }
}

VCycle::GridTransfer VCycle::grid_transfer(const Layout& fine, const Layout& coarse) {
  GridTransfer grid_transfer;
  grid_transfer.right = AlignedBuffer<float>(static_cast<size_t>(coarse.tiles) * lanes);
  grid_transfer.left = AlignedBuffer<float>(static_cast<size_t>(coarse.tiles) * lanes);
  for (int c = 0; c < coarse.columns; ++c) {
    const int at = c % coarse.tiles * lanes + c / coarse.tiles;
    grid_transfer.right.data()[at] = c + 1 < coarse.columns ? 0.5f : 1;
    grid_transfer.left.data()[at] = c > 0 ? 0.5f : 0;
  }
  grid_transfer.transfer = {coarse.rows, coarse.tiles, fine.rows, grid_transfer.right.data(),
                            grid_transfer.left.data()};
  return grid_transfer;
}

void VCycle::set_inertia(const Eigen::ArrayXd& inertia) {
  if (inertia.size() == inertia_.size() && (inertia == inertia_).all()) return;
  inertia_ = inertia;
  levels_.front().inertia = inertia;
  levels_.front().load_inertia();
  for (size_t l = 1; l < levels_.size(); ++l) {
    const Layout &fine = levels_[l - 1].layout(), &coarse = levels_[l].layout();
    // each particle's inertia goes to the coarse particles that interpolate it
    Eigen::ArrayXd& sum = levels_[l].inertia.setZero();
    for (int row = 0; row < fine.rows; ++row)
      for (int column = 0; column < fine.columns; ++column)
        for (const int r : {row / 2, std::min((row + 1) / 2, coarse.rows - 1)})
          for (const int c : {column / 2, std::min((column + 1) / 2, coarse.columns - 1)})
            sum[r * coarse.columns + c] += levels_[l - 1].inertia[row * fine.columns + column] / 4;
    levels_[l].load_inertia();
  }
  coarsest_ = 0;
  while (coarsest_ + 1 < levels_.size() && levels_[coarsest_].inertia_share() < enough_inertia) ++coarsest_;
}

void VCycle::set(const Eigen::ArrayXd& inertia, const Points& x, Curvature curvature) {
  assert(inertia.size() == x.cols() && (inertia > 0).all());
  set_inertia(inertia);
  for (size_t l = 0; l <= coarsest_; ++l) {
    Level& level = levels_[l];
    if (l == 0)
      level.layout().put(x, 1, level.x);
    else
      levels_[l - 1].layout().inject(levels_[l - 1].x, level.x);
    // relaxation and coarse grids must be positive definite, even where the matrix is not
    level.linearise(kernels_);
    if (l == 0 && curvature == Curvature::exact) level.linearise_unclamped(kernels_);
  }
}

double VCycle::products() const {
  double sum = 0;
  for (size_t l = 0; l <= coarsest_; ++l) {
    const Level& level = levels_[l];
    // the first round starts from 0 and needs no product
    const double own = l == coarsest_ ? coarsest_smoother(level).rounds - 1 : 2 * level_smoother.rounds;
    sum += own * static_cast<double>(level.free.size()) / static_cast<double>(levels_.front().free.size());
  }
  return sum;
}

void VCycle::cycle(size_t l) {
  assert(l <= coarsest_ && transfers_.size() + 1 == levels_.size());
  Level& level = levels_[l];
  if (l == coarsest_) return smooth(kernels_, level, coarsest_smoother(level), true);
  Level& coarse = levels_[l + 1];
  smooth(kernels_, level, level_smoother, true);
  kernels_.residual(level.matrix(), level.b.data(), level.u.data(), level.r.data());
  kernels_.restrict_residual(transfers_[l].transfer, level.r.data(), coarse.b.data());
  cycle(l + 1);
  kernels_.prolong_and_add(transfers_[l].transfer, coarse.u.data(), level.matrix().free, level.u.data());
  smooth(kernels_, level, level_smoother, false);
}

namespace {

constexpr int most_iterations = 500;
// on smaller cloths, conjugate gradients without multigrid are at least as fast
constexpr int fewest_rows = 12, fewest_columns = 20;

}  // namespace

MultigridSolver::MultigridSolver(const GridTopology& topology, const std::vector<int>& pins)
    : v_cycle_(topology, pins),
      u_(v_cycle_.layout().field<double>()),
      r_(v_cycle_.layout().field<double>()),
      p_(v_cycle_.layout().field<double>()),
      q_(v_cycle_.layout().field<double>()) {}

CgResult MultigridSolver::solve(const Eigen::ArrayXd& inertia, const Points& x, Curvature curvature, const Points& b,
                                double tolerance, Points& u) {
  assert(b.cols() == x.cols() && tolerance > 0);
  const Kernels& f = v_cycle_.kernels();
  v_cycle_.set(inertia, x, curvature);
  const Matrix<double>& a = v_cycle_.exact();
  const double size = b.norm();
  CgResult result;
  u.setZero(3, b.cols());
  if ((result.converged = size == 0)) return result;

  // b / |b| stays within the range of single precision
  v_cycle_.layout().put(b, 1 / size, r_);
  for (AlignedBuffer<double>* field : {&u_, &p_, &q_}) std::fill_n(field->data(), field->size(), 0);
  f.to_float(r_.data(), v_cycle_.b().data(), static_cast<long>(r_.size()));
  double left = 1, rz = 0, keep = 0;
  while (!(result.converged = std::sqrt(left) <= tolerance) && result.iterations < most_iterations) {
    v_cycle_.cycle();
    double products[2];
    f.dot_products(a, r_.data(), q_.data(), v_cycle_.u().data(), products);
    ++result.iterations;
    // The preconditioner is rounded to single precision and therefore differs slightly between iterations. Even so,
    // beta = z.(r - r_before) / (z.r)_before (Polak and Ribiere) keeps the directions conjugate.
    keep = result.iterations > 1 ? -keep * products[1] / rz : 0;
    rz = products[0];
    f.update_direction(a, v_cycle_.u().data(), keep, p_.data());
    const double curved = f.product(a, p_.data(), q_.data());
    if (!(curved > 0)) {
      result.negative_curvature = true;
      v_cycle_.layout().get(p_, 1, u);
      return result;
    }
    keep = rz / curved;
    left = f.update_solution(a, keep, p_.data(), q_.data(), u_.data(), r_.data(), v_cycle_.b().data());
  }
  v_cycle_.layout().get(u_, size, u);
  return result;
}

std::unique_ptr<MultigridSolver> make_multigrid_solver(const Model& model) {
  const auto* springs = model.find<Springs>();
  if (!springs || model.find<Dashpots>() || model.find<Bending>()) return nullptr;
  const auto topology = simd::find_grid_topology(*springs, model.particles.size());
  if (!topology || topology->rows < fewest_rows || topology->columns < fewest_columns) return nullptr;
  return std::make_unique<MultigridSolver>(*topology, model.particles.pins);
}

}  // namespace crosscheck::multigrid
