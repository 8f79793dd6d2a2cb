#include "experiments/bench/implicit_step.h"

#include <fmt/format.h>

#include <memory>

#include "experiments/bench/factorised_step.h"
#include "experiments/bench/instructions.h"
#include "experiments/bench/paths.h"
#include "experiments/bench/sheet.h"
#include "experiments/timing.h"
#include "mysim/implicit/newton.h"
#include "mysim/observers/trajectory.h"
#include "reference/method.h"

namespace crosscheck {
namespace {

constexpr double falls_for = 0.5;  // s

/// A sheet on its way down, and what a step of it asks for.
struct Falling {
  Scene scene;
  State state;
  explicit Falling(int side) : scene(sheet(side)) {
    Recorder recorder;
    run_method(find_method("mysim/leapfrog+fast"), scene, {scene.step, falls_for, 1}, {&recorder});
    state = {0, recorder.trajectory.x.back(), recorder.trajectory.v.back()};
  }
};

/// mysim's solver, which keeps to the instructions that were chosen when it was made.
struct Own {
  System system;
  ImplicitStep step;
  explicit Own(const Scene& scene) : system(scene.model), step(system) {}
  static std::shared_ptr<Own> with(const Scene& scene, strip::Isa isa) {
    const Instructions kept(isa);
    return std::make_shared<Own>(scene);
  }
};

void beside_factorisation(const Falling& falling, double rate, const MicroPlan& plan, Table& table) {
  const double h = 1 / rate;
  const auto factorised = std::make_shared<FactorisedStep>(falling.scene, h);
  const State& from = falling.state;
  std::vector<Micro> micros{{"factorised", [factorised, &from] { factorised->step(from.x, from.v); }}};
  std::vector<std::shared_ptr<Own>> own;
  for (const Path& path : paths()) {
    own.push_back(Own::with(falling.scene, path.instructions));
    micros.push_back({path.name, [solver = own.back(), &from, h] { solver->step.solve_linear(from, h); }});
  }
  const auto times = measured(micros, plan);
  const Timing its = timing_of(times.at("factorised"));
  const Points& end = factorised->step(from.x, from.v);
  for (size_t i = 0; i < own.size(); ++i) {
    const Path path = paths()[i];
    const Points mine = own[i]->step.solve_linear(from, h).x;
    const std::vector<double>& each = times.at(path.name);
    const Timing time = timing_of(each), ratio = timing_of(quotients(times.at("factorised"), each));
    table.add({falling.scene.name, static_cast<long>(from.x.cols()), rate, largest_column(mine - end),
               largest_column(mine - from.x), its.median, its.low, its.high, path.name,
               std::string(name_of(path.instructions)), static_cast<long>(own[i]->step.iterations()), time.median,
               time.low, time.high, ratio.median, ratio.low, ratio.high});
  }
}

}  // namespace

void implicit_step(const ImplicitStepAsked& asked, Rows& rows, Progress& progress) {
  Table table{"bench-implicit-step-cost",
              {{"scene", "1"},
               {"particles", "1"},
               {"rate", "1/s"},
               {"farthest particle", "m"},
               {"largest move", "m"},
               {"cpu per step of Eigen", "s"},
               {"low of Eigen", "s"},
               {"high of Eigen", "s"},
               {"path of mysim", "1"},
               {"instructions", "1"},
               {"iterations", "1"},
               {"cpu per step of mysim", "s"},
               {"low of mysim", "s"},
               {"high of mysim", "s"},
               {"ratio", "1"},
               {"ratio low", "1"},
               {"ratio high", "1"}},
              {}};
  for (const int side : asked.sides) {
    const Falling falling(side);
    for (const double rate : asked.rates) {
      progress.begin(fmt::format("{}: implicit steps of 1/{:g} s", falling.scene.name, rate));
      beside_factorisation(falling, rate, asked.plan, table);
    }
  }
  rows.add(table);
}

}  // namespace crosscheck
