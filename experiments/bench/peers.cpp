// Runs of mysim and of its peers, their errors and their times.
#include "experiments/bench/peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/bench/spring_forces.h"
#include "experiments/scenes/cloths.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/bench.h"
#include "experiments/timing/instruction_sets.h"
#include "experiments/timing/timing.h"
#include "mysim/model/system.h"
#include "mysim/run/observers.h"
#include "reference/truth/truth.h"

namespace crosscheck {
namespace {

/// A method of mysim whose step is shortened until it is accurate enough: its longest step (in 2 / omega, below the
/// rule's limit), and the ratio of each step to the one before.
struct MysimMethod {
  const char* method;
  double first, ratio;
};
constexpr double fine = 0.8409, coarse = 0.5;  // 2^(-1/4); where runs are slow and a better rule is at hand
// the most accurate for its work first: where it errs less in as many evaluations there is no use in going on
constexpr MysimMethod own_methods[] = {{"mysim/suzuki4+fast", 1.3, fine},
                                       {"mysim/leapfrog+fast", 0.95, fine},
                                       {"mysim/leapfrog+single", 0.95, fine},
                                       {"mysim/rk4", 1.35, coarse}};
constexpr double shortest = 0.05;        // step of any of them over its first
constexpr double truth_step = 1.36 / 8;  // in 2 / omega: an eighth of suzuki4's largest, and then halved

}  // namespace

PeerRuns::PeerRuns(const Scene& scene, Progress& progress)
    : scene_(scene), progress_(progress), unit_(2 / highest_frequency(scene.model, scene.start)) {
  progress_.begin(fmt::format("{}: the truth", scene_.name));
  const Points coarse = end_of(truth_step);
  truth_ = end_of(truth_step / 2);
  bar_ = rms_distance(coarse, truth_);
}

Points PeerRuns::end_of(double part) const {
  Recorder recorder;
  run_method(find_method("mysim/suzuki4"), scene_, {part * unit_, scene_.duration, 1}, {&recorder});
  return recorder.trajectory.x.back();
}

PeerRun PeerRuns::done(const Method& method, double setting) const {
  Run run{unit_, scene_.duration, 1};
  (method.adaptive ? run.tolerance : run.step) = method.adaptive ? setting : setting * unit_;
  Recorder recorder;
  Outcome out = run_method(method, scene_, run, {&recorder});
  std::optional<double> error;
  if (out.verdict == Verdict::ok) error = rms_distance(recorder.trajectory.x.back(), truth_);
  return {method, run, std::move(out), method.adaptive ? setting : time_grid(run).h, error};
}

std::vector<PeerRun> PeerRuns::of(const std::vector<Peer>& peers) const {
  std::vector<PeerRun> runs;
  for (const Peer& peer : peers) {
    const Method method = find_method(peer.method);
    for (const double setting : peer.settings) {
      progress_.begin(fmt::format("{}: {}", scene_.name, peer.method));
      runs.push_back(done(method, setting));
      runs.back().other_model = peer.other_model;
    }
  }
  return runs;
}

std::vector<PeerRun> PeerRuns::own(double wanted, long most) const {
  std::vector<PeerRun> runs;
  const auto beaten = [&](const PeerRun& run) {
    return std::any_of(runs.begin(), runs.end(), [&](const PeerRun& other) {
      return other.method.name != run.method.name && other.ok() && run.ok() && *other.error <= *run.error &&
             other.outcome.evaluations <= run.outcome.evaluations;
    });
  };
  for (const MysimMethod& own : own_methods) {
    const Method method = find_method(own.method);
    progress_.begin(fmt::format("{}: {}", scene_.name, own.method));
    if (method.name.ends_with("+single") && !fused_step<float>(scene_, simd::InstructionSet::baseline, true)) continue;
    for (double part = own.first; part > shortest * own.first; part *= own.ratio) {
      const PeerRun last = done(method, part);
      runs.push_back(last);
      if ((last.ok() && *last.error <= wanted) || beaten(last) || last.outcome.evaluations > most) break;
    }
  }
  return runs;
}

int PeerRuns::count(const std::vector<Peer>& peers) {
  int count = 1 + static_cast<int>(std::size(own_methods));
  for (const Peer& peer : peers) count += static_cast<int>(peer.settings.size());
  return count;
}

namespace {

/// The time of an evaluation of mysim's methods on one code path, s, round by round.
struct MysimTimes {
  CodePath path;
  std::map<std::string, std::vector<double>> per_evaluation;  // by method; those of which a run ended well
};

/// The times of the peers' runs in their order (none of those that failed), and mysim's.
struct Times {
  std::vector<EvaluationTimes> peers;
  std::vector<MysimTimes> own;
};

Times in_turns(const EqualErrorOptions& options, const std::vector<PeerRun>& peers, const std::vector<PeerRun>& own,
               const LockPatience& patience) {
  Times times;
  times.peers.resize(peers.size());
  std::vector<TimedRun> turns;
  std::vector<std::function<void(const EvaluationTimes&)>> take;  // where the times of each turn go
  for (size_t i = 0; i < peers.size(); ++i) {
    if (!peers[i].ok()) continue;
    turns.push_back({peers[i].method, options.scene, peers[i].run});
    take.push_back([&times, i](const EvaluationTimes& all) { times.peers[i] = all; });
  }
  for (const CodePath& path : code_paths()) times.own.push_back({path, {}});
  for (MysimTimes& mine : times.own)
    for (const PeerRun& run : own) {
      if (!run.ok()) continue;
      const auto [entry, is_new] = mine.per_evaluation.try_emplace(run.method.name);
      if (!is_new) continue;
      turns.push_back({run.method, options.scene, run.run, mine.path.instructions});
      take.push_back([&to = entry->second](const EvaluationTimes& all) { to = all.per_evaluation; });
    }
  const std::vector<EvaluationTimes> all = time_round_robin(turns, options.turns, patience);
  for (size_t i = 0; i < all.size(); ++i) take[i](all[i]);
  return times;
}

Timing time_of(const PeerRun& run, const std::vector<double>& per_evaluation) {
  return timing_of(per_evaluation).times(static_cast<double>(run.outcome.evaluations));
}

std::vector<WorkPrecisionPoint> points_of(const std::vector<PeerRun>& own, const MysimTimes& times) {
  std::vector<WorkPrecisionPoint> points;
  for (const PeerRun& run : own)
    if (run.ok())
      points.push_back({run.method.name, SettingKind::step, run.requested, true, run.error,
                        time_of(run, times.per_evaluation.at(run.method.name)).median});
  return points;
}

/// The row of a peer's run, without mysim's part.
EqualErrorRow row_of(const PeerRun& run, const std::string& scene, double error_bar, const EvaluationTimes& times) {
  EqualErrorRow row{.scene = scene,
                    .peer = run.method.name,
                    .model = run.other_model ? PeerModel::other : PeerModel::same,
                    .setting = run.method.adaptive ? SettingKind::tolerance : SettingKind::step,
                    .requested = run.requested,
                    .verdict = run.outcome.verdict,
                    .error = run.error,
                    .truth_bar = error_bar,
                    .evaluations = run.outcome.evaluations,
                    .cpu_of_whole_run = run.outcome.cpu_seconds,
                    .build = build_of(run.method.name)};
  if (!times.per_evaluation.empty()) {
    const Timing t = time_of(run, times.per_evaluation);
    row.cpu = t.median, row.cpu_low = t.low, row.cpu_high = t.high, row.part_timed = times.share;
  }
  return row;
}

/// Sets mysim's part of the row.
void set_beside(EqualErrorRow& row, const PeerRun& peer, const EvaluationTimes& its, const std::vector<PeerRun>& own,
                const MysimTimes& times, double error_bar) {
  row.path = times.path.name, row.instructions = times.path.instructions;
  if (!peer.ok() || its.per_evaluation.empty()) {
    row.remark = "the peer's run failed";
    return;
  }
  const double left = *peer.error - 2 * error_bar;
  if (left <= 0) {
    row.remark = "below the error bar of the truth";
    return;
  }
  const std::vector<WorkPrecisionPoint> points = points_of(own, times);
  const WorkPrecisionPoint* best = cheapest(points, left);
  if (!best) {
    row.remark = "no run of mysim that was tried errs as little";
    return;
  }
  const auto run = std::find_if(own.begin(), own.end(), [&](const PeerRun& r) {
    return r.method.name == best->method && r.requested == best->requested;
  });
  const double evaluations =
      static_cast<double>(peer.outcome.evaluations) / static_cast<double>(run->outcome.evaluations);
  const Timing ratio =
      timing_of(ratios_of_rounds(its.per_evaluation, times.per_evaluation.at(best->method))).times(evaluations);
  row.mysim = best->method, row.mysim_step = best->requested, row.mysim_error = best->error, row.mysim_cpu = best->cost;
  row.ratio = ratio.median, row.ratio_low = ratio.low, row.ratio_high = ratio.high;
}

void add_own(const std::string& scene, const std::vector<PeerRun>& own, const MysimTimes& times, double error_bar,
             Table& table) {
  for (const PeerRun& run : own) {
    OwnRunRow row{.scene = scene,
                  .method = run.method.name,
                  .step = run.requested,
                  .verdict = run.outcome.verdict,
                  .error = run.error,
                  .truth_bar = error_bar,
                  .evaluations = run.outcome.evaluations,
                  .path = times.path.name,
                  .instructions = times.path.instructions};
    if (run.ok()) {
      const Timing t = time_of(run, times.per_evaluation.at(run.method.name));
      row.cpu = t.median, row.cpu_low = t.low, row.cpu_high = t.high;
    }
    add(table, row);
  }
}

}  // namespace

int work_of(const EqualErrorOptions& options) { return 1 + PeerRuns::count(options.peers); }

void equal_error(const EqualErrorOptions& options, const LockPatience& patience, TableSet& tables, Progress& progress) {
  const std::string& scene = options.scene->name;
  const PeerRuns runs(*options.scene, progress);
  const double error_bar = runs.error_bar();
  std::vector<PeerRun> peers = runs.of(options.peers);
  std::erase_if(peers, [&](const PeerRun& run) {
    const bool refused = run.outcome.verdict == Verdict::unsupported;
    if (const std::string note = fmt::format("bench leaves out {}: {}", run.method.name, run.outcome.reason);
        refused && std::find(tables.notes.begin(), tables.notes.end(), note) == tables.notes.end())
      tables.notes.push_back(note);
    return refused;
  });
  double wanted = INFINITY;  // m: the least error above the error bar
  long most = 0;             // evaluations: as many as take mysim about the time that a peer's slowest run takes
  for (const PeerRun& run : peers) {
    if (run.ok() && *run.error > 2 * error_bar) wanted = std::min(wanted, *run.error - 2 * error_bar);
    most = std::max(most, 5 * run.outcome.evaluations);
  }
  const std::vector<PeerRun> own = runs.own(wanted, most);

  progress.begin(fmt::format("{}: all in turns", scene));
  const Times times = in_turns(options, peers, own, patience);
  Table table = table_of<EqualErrorRow>(), curve = table_of<OwnRunRow>();
  for (size_t i = 0; i < peers.size(); ++i)
    for (const MysimTimes& path : times.own) {
      EqualErrorRow row = row_of(peers[i], scene, error_bar, times.peers[i]);
      set_beside(row, peers[i], times.peers[i], own, path, error_bar);
      add(table, row);
    }
  for (const MysimTimes& path : times.own) add_own(scene, own, path, error_bar, curve);
  tables.add(table);
  tables.add(curve);
}

namespace {

/// The state at the end of a run, m.
Points end_of(const Method& method, const Scene& scene, const Run& run,
              std::optional<simd::InstructionSet> instructions, Outcome* outcome = nullptr) {
  std::optional<ScopedInstructionSet> kept;
  if (instructions) kept.emplace(*instructions);
  Recorder recorder;
  Outcome out = run_method(method, scene, run, {&recorder});
  if (outcome) *outcome = std::move(out);
  return recorder.trajectory.frames() > 1 ? recorder.trajectory.x.back() : Points();
}

void beside(const MethodFamily& peer, const std::shared_ptr<const Scene>& scene, const SameStepOptions& options,
            const LockPatience& patience, Table& table, std::vector<std::string>& notes) {
  const Run run{scene->step, options.duration, 1};
  const Method theirs = find_method(std::string(peer.representative)),
               own = find_method(std::string(subject().representative) + "+fast");
  Outcome out;
  const Points end = end_of(theirs, *scene, run, std::nullopt, &out);
  if (out.verdict != Verdict::ok) {
    notes.push_back(fmt::format("bench: {} on {}: {}", theirs.name, scene->name, out.reason));
    return;
  }
  std::vector<TimedRun> turns{{theirs, scene, run}};
  for (const CodePath& path : code_paths()) turns.push_back({own, scene, run, path.instructions});
  const std::vector<EvaluationTimes> times = time_round_robin(turns, options.turns, patience);
  const Timing its = timing_of(times[0].per_evaluation);
  const std::string force = out.readback ? out.readback->mapped["stiffness"] : "";
  for (size_t i = 0; i < code_paths().size(); ++i) {
    const CodePath path = code_paths()[i];
    const std::vector<double>& mine = times[1 + i].per_evaluation;
    const Timing each = timing_of(mine), ratio = timing_of(ratios_of_rounds(times[0].per_evaluation, mine));
    const double apart = largest_column(end_of(own, *scene, run, path.instructions) - end);
    add(table, SameStepRow{.scene = scene->name,
                           .force = force,
                           .step = out.step,
                           .steps = out.steps,
                           .apart = apart,
                           .bullet_cpu = its.median,
                           .bullet_low = its.low,
                           .bullet_high = its.high,
                           .build = build_of(theirs.name),
                           .path = path.name,
                           .instructions = path.instructions,
                           .mysim = own.name,
                           .cpu = each.median,
                           .low = each.low,
                           .high = each.high,
                           .ratio = ratio.median,
                           .ratio_low = ratio.low,
                           .ratio_high = ratio.high});
  }
}

}  // namespace

void same_step(const SameStepOptions& options, const LockPatience& patience, TableSet& tables, Progress& progress) {
  Table table = table_of<SameStepRow>();
  for (const Scene& scene : {hanging_cloth(options.side), hanging_cloth_of_two_stiffnesses(options.side)}) {
    const MethodFamily& peer = *default_peers().front();  // the table's columns are about it
    progress.begin(fmt::format("{}: the same step in {}", scene.name, peer.title));
    beside(peer, std::make_shared<const Scene>(scene), options, patience, table, tables.notes);
  }
  tables.add(table);
}

}  // namespace crosscheck
