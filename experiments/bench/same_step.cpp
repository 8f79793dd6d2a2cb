#include "experiments/bench/same_step.h"

#include <fmt/format.h>

#include "experiments/bench/paths.h"
#include "experiments/bench/sheet.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/timing.h"
#include "mysim/observers/trajectory.h"

namespace crosscheck {
namespace {

constexpr auto bullets = "bullet/deformable-explicit", ours = "mysim/symplectic-euler+fast";

/// The state at the end of a run, m.
Points end_of(const Method& method, const Scene& scene, const Run& run, std::optional<strip::Isa> instructions,
              Outcome* told = nullptr) {
  std::optional<Instructions> kept;
  if (instructions) kept.emplace(*instructions);
  Recorder recorder;
  Outcome out = run_method(method, scene, run, {&recorder});
  if (told) *told = std::move(out);
  return recorder.trajectory.frames() > 1 ? recorder.trajectory.x.back() : Points();
}

void beside_bullet(const std::shared_ptr<const Scene>& scene, const SameStepAsked& asked, Table& table,
                   std::vector<std::string>& notes) {
  const Run run{scene->step, asked.duration, 1};
  const Method theirs = find_method(bullets), own = find_method(ours);
  Outcome out;
  const Points end = end_of(theirs, *scene, run, std::nullopt, &out);
  if (out.verdict != Verdict::ok) {
    notes.push_back(fmt::format("bench: {} on {}: {}", bullets, scene->name, out.reason));
    return;
  }
  std::vector<Turn> turns{{theirs, scene, run}};
  for (const Path& path : paths()) turns.push_back({own, scene, run, path.instructions});
  const std::vector<TurnTimes> times = timed_in_turns(turns, asked.turns);
  const Timing its = timing_of(times[0].per_evaluation);
  const std::string force = out.readback ? out.readback->mapped["stiffness"] : "";
  for (size_t i = 0; i < paths().size(); ++i) {
    const Path path = paths()[i];
    const std::vector<double>& mine = times[1 + i].per_evaluation;
    const Timing each = timing_of(mine), ratio = timing_of(quotients(times[0].per_evaluation, mine));
    const double apart = largest_column(end_of(own, *scene, run, path.instructions) - end);
    table.add({scene->name, force, out.step, out.steps, apart, its.median, its.low, its.high, build_of(bullets),
               path.name, std::string(name_of(path.instructions)), std::string(ours), each.median, each.low, each.high,
               ratio.median, ratio.low, ratio.high});
  }
}

}  // namespace

void same_step(const SameStepAsked& asked, Rows& rows, Progress& progress) {
  Table table{"bench-same-step-cost",
              {{"scene", "1"},
               {"force of Bullet", "1"},
               {"step", "s"},
               {"steps", "1"},
               {"farthest particle", "m"},
               {"cpu per step of Bullet", "s"},
               {"low of Bullet", "s"},
               {"high of Bullet", "s"},
               {"build", "1"},
               {"path of mysim", "1"},
               {"instructions", "1"},
               {"mysim", "1"},
               {"cpu per step of mysim", "s"},
               {"low of mysim", "s"},
               {"high of mysim", "s"},
               {"ratio", "1"},
               {"ratio low", "1"},
               {"ratio high", "1"}},
              {}};
  for (const Scene& scene : {sheet(asked.side), sheet_of_two_stiffnesses(asked.side)}) {
    progress.begin(fmt::format("{}: the same step in Bullet", scene.name));
    beside_bullet(std::make_shared<const Scene>(scene), asked, table, rows.notes);
  }
  rows.add(table);
}

}  // namespace crosscheck
