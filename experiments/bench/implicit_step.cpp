#include "experiments/bench/implicit_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "experiments/bench/measurements.h"
#include "experiments/scenes/cloths.h"
#include "experiments/timing/instruction_sets.h"
#include "mysim/base/errors.h"
#include "mysim/implicit/newton.h"
#include "mysim/model/system.h"
#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {
namespace {

double rate_of(const Model& model) {
  const auto rate = uniform_drag_rate(model);
  if (!rate) throw std::invalid_argument("a factorised step takes drag as one rate of all particles");
  return *rate;
}

}  // namespace

FactorisedStep::FactorisedStep(const Scene& scene, double h)
    : springs_(scene.model.find<Springs>()->list),
      mass_(scene.model.particles.mass.array()),
      gravity_(scene.model.find<Gravity>()->acceleration),
      h_(h),
      gamma_(rate_of(scene.model)) {
  int rows = 0;
  for (const char pinned : scene.model.particles.pinned) first_.push_back(pinned ? -1 : std::exchange(rows, rows + 3));
  std::vector<Eigen::Triplet<double>> pattern;
  const auto kept = [&](int row, int column) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (row + i >= column + j) pattern.emplace_back(row + i, column + j, 1.0);
  };
  for (const int row : first_)
    if (row >= 0) kept(row, row);
  const auto ends = [&](const Spring& s) { return std::minmax(first_[s.a], first_[s.b]); };
  for (const Spring& s : springs_)
    if (const auto [early, late] = ends(s); early >= 0) kept(late, early);
  matrix_.resize(rows, rows);
  matrix_.setFromTriplets(pattern.begin(), pattern.end());
  matrix_.makeCompressed();
  const auto places = [&](int row, int column) {
    Places p;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        p.number[i][j] = row < 0 || column < 0 || row + i < column + j
                             ? -1
                             : static_cast<int>(&matrix_.coeffRef(row + i, column + j) - matrix_.valuePtr());
    return p;
  };
  for (const int row : first_) diagonal_.push_back(places(row, row));
  for (const Spring& s : springs_) {
    const auto [early, late] = ends(s);
    off_.push_back(places(early < 0 ? -1 : late, early));
  }
  solver_.analyzePattern(matrix_);
  right_.resize(rows);
}

void FactorisedStep::add(const Places& places, const Eigen::Matrix3d& block) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (places.number[i][j] >= 0) matrix_.valuePtr()[places.number[i][j]] += block(i, j);
}

const Points& FactorisedStep::step(const Points& x, const Points& v) {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0);
  end_ = x + h_ * v;
  for (int i = 0; i < x.cols(); ++i) {
    if (first_[i] < 0) {
      end_.col(i) = x.col(i);
      continue;
    }
    add(diagonal_[i], mass_[i] * (1 / h_ + gamma_) / h_ * Eigen::Matrix3d::Identity());
    right_.segment<3>(first_[i]) = mass_[i] * (gravity_ - gamma_ * v.col(i));
  }
  for (size_t i = 0; i < springs_.size(); ++i) {
    const Spring& s = springs_[i];
    const Vec3 d = end_.col(s.a) - end_.col(s.b);
    const double length = d.norm(), across = std::max(0.0, s.k * (1 - s.rest / length));
    const Vec3 n = d / length, pull = s.k * (length - s.rest) * n;
    const Eigen::Matrix3d block = across * Eigen::Matrix3d::Identity() + (s.k - across) * n * n.transpose();
    if (first_[s.a] >= 0) add(diagonal_[s.a], block), right_.segment<3>(first_[s.a]) -= pull;
    if (first_[s.b] >= 0) add(diagonal_[s.b], block), right_.segment<3>(first_[s.b]) += pull;
    add(off_[i], -block);
  }
  solver_.factorize(matrix_);
  if (solver_.info() != Eigen::Success) throw SolverFailure("the matrix of the step could not be factorised");
  const Eigen::VectorXd u = solver_.solve(right_);
  for (int i = 0; i < x.cols(); ++i)
    if (first_[i] >= 0) end_.col(i) += u.segment<3>(first_[i]);
  return end_;
}

namespace {

constexpr double falls_for = 0.5;  // s

struct FallingCloth {
  Scene scene;
  State state;
  explicit FallingCloth(int side) : scene(hanging_cloth(side)) {
    Recorder recorder;
    run_method(find_method("mysim/leapfrog+fast"), scene, {scene.step, falls_for, 1}, {&recorder});
    state = {0, recorder.trajectory.x.back(), recorder.trajectory.v.back()};
  }
};

/// The solver's instruction set is chosen when the solver is created.
struct MysimStep {
  System system;
  ImplicitStep step;
  explicit MysimStep(const Scene& scene) : system(scene.model), step(system) {}
  static std::shared_ptr<MysimStep> with(const Scene& scene, simd::InstructionSet isa) {
    const ScopedInstructionSet kept(isa);
    return std::make_shared<MysimStep>(scene);
  }
};

void beside_factorisation(const FallingCloth& falling, double rate, const MicrobenchmarkOptions& options,
                          BenchRecord& record) {
  const double h = 1 / rate;
  const auto factorised = std::make_shared<FactorisedStep>(falling.scene, h);
  const State& from = falling.state;
  std::vector<Microbenchmark> benchmarks{{"factorised", [factorised, &from] { factorised->step(from.x, from.v); }}};
  std::map<simd::InstructionSet, std::shared_ptr<MysimStep>> own;
  for (const simd::InstructionSet isa : compared_instruction_sets()) {
    own[isa] = MysimStep::with(falling.scene, isa);
    benchmarks.push_back(
        {std::string(name_of(isa)), [solver = own[isa], &from, h] { solver->step.solve_linear(from, h); }});
  }
  const auto times = run_microbenchmarks(benchmarks, options, record.patience);
  const Points& end = factorised->step(from.x, from.v);
  for (const auto& [isa, solver] : own) {
    BenchRow row{.work = bench_work::implicit_step,
                 .scene = falling.scene.name,
                 .peer = "Eigen's SimplicialLDLT",
                 .variant = fmt::format("{:g} steps a second", rate),
                 .step = h,
                 .apart = largest_column(solver->step.solve_linear(from, h).x - end),
                 .mysim = "implicit-euler+linear",
                 .instructions = isa,
                 .step_of_mysim = h,
                 .unit = "step"};
    set_times(row, times.at("factorised"), times.at(std::string(name_of(isa))));
    record.rows.push_back(std::move(row));
  }
}

}  // namespace

void measure_implicit_steps(const ImplicitStepOptions& options, BenchRecord& record) {
  for (const int side : options.sides) {
    const FallingCloth falling(side);
    for (const double rate : options.rates) {
      record.progress.begin(fmt::format("{}: implicit steps of 1/{:g} s", falling.scene.name, rate));
      beside_factorisation(falling, rate, options.microbenchmarks, record);
    }
  }
}

}  // namespace crosscheck
