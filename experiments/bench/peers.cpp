#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/bench/measurements.h"
#include "experiments/bench/spring_forces.h"
#include "experiments/scenes/cloths.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/timing/instruction_sets.h"
#include "mysim/model/system.h"
#include "mysim/run/observers.h"
#include "reference/truth/truth.h"

namespace crosscheck {
namespace {

/// A method of mysim whose step is shortened until it is accurate enough. `first`: longest step in units of 2 / omega,
/// below the rule's limit; `ratio`: each step divided by the previous one.
struct MysimMethod {
  const char* method;
  double first, ratio;
};
constexpr double fine = 0.8409, coarse = 0.5;  // 2^(-1/4), and 1/2 for a slow rule that is never the best one
// the most efficient first: a later method stops when an earlier one has been more accurate at the same cost
constexpr MysimMethod own_methods[] = {{"mysim/suzuki4+fast", 1.3, fine},
                                       {"mysim/leapfrog+fast", 0.95, fine},
                                       {"mysim/leapfrog+single", 0.95, fine},
                                       {"mysim/rk4", 1.35, coarse}};
constexpr double longest = 60;           // s; external programs that would take longer are left out
constexpr double shortest = 0.05;        // a method's shortest step divided by its first one
constexpr double truth_step = 1.36 / 8;  // in units of 2 / omega: an eighth of suzuki4's largest step; later halved

struct PeerRun {
  Method method;
  Run run;
  Outcome outcome;
  double setting;               // s, or a tolerance
  std::optional<double> error;  // m, RMS over the particles at the end; empty if the run failed
  bool other_model = false;
  double projected = 0;  // predicted CPU time (s) of a run that was left out as too long; otherwise 0
  bool ok() const { return error.has_value(); }
};

class PeerRuns {
 public:
  PeerRuns(const Scene& scene, Progress& progress)
      : scene_(scene), progress_(progress), unit_(2 / highest_frequency(scene.model, scene.start)) {
    progress_.begin(fmt::format("{}: reference solution", scene_.name));
    const Points before = end_of(truth_step);
    truth_ = end_of(truth_step / 2);
    bar_ = rms_distance(before, truth_);
  }
  /// Change of the truth by the last halving of its step, m.
  double error_bar() const { return bar_; }

  std::vector<PeerRun> of(const std::vector<Peer>& peers) const;
  /// Runs of each method from long steps to short ones, also in single precision if the cloth is wide enough. A method
  /// stops at the error `wanted` (m), after `most` evaluations, or when another method has been at least as accurate
  /// with no more evaluations.
  std::vector<PeerRun> own(double wanted, long most) const;

 private:
  /// `projects`: first runs a fiftieth of the duration to predict whether the whole run would take too long.
  PeerRun done(const Method& method, double setting, bool projects = false) const;
  Points end_of(double part) const {
    Recorder recorder;
    run_method(find_method("mysim/suzuki4"), scene_, {part * unit_, scene_.duration, 1}, {&recorder});
    return recorder.trajectory.x.back();
  }

  const Scene& scene_;
  Progress& progress_;
  double unit_;  // s: 2 / omega
  Points truth_;
  double bar_;
};

PeerRun PeerRuns::done(const Method& method, double setting, bool projects) const {
  Run run{unit_, scene_.duration, 1};
  (method.adaptive ? run.tolerance : run.step) = method.adaptive ? setting : setting * unit_;
  if (projects) {
    Run part = run;
    part.duration /= 50;
    NullObserver nothing;
    Outcome out = run_method(method, scene_, part, {&nothing});
    if (const double projected = 50 * out.cpu_seconds; projected > longest)
      return {method, run, std::move(out), setting, {}, false, projected};
  }
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
      runs.push_back(done(method, setting, method.family().role == Role::outside));
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

/// Enters the time and ratio of mysim's cheapest run with an error of at most `bound` (m). Returns false if no run has.
bool set_cheapest(BenchRow& row, const PeerRun& peer, const std::vector<double>& peer_times,
                  const std::vector<PeerRun>& own, double bound,
                  const std::map<std::string, std::vector<double>>& own_times) {
  const PeerRun* best = nullptr;
  double cost = 0;  // s
  for (const PeerRun& run : own) {
    if (!run.ok() || *run.error > bound) continue;
    const double seconds =
        timing_of(own_times.at(run.method.name)).median * static_cast<double>(run.outcome.evaluations);
    if (!best || seconds < cost) best = &run, cost = seconds;
  }
  if (!best) return false;
  row.mysim = best->method.name, row.step_of_mysim = best->setting, row.error_of_mysim = best->error;
  set_times(row, peer_times, own_times.at(best->method.name), static_cast<double>(peer.outcome.evaluations),
            static_cast<double>(best->outcome.evaluations));
  return true;
}

}  // namespace

int work_of(const EqualErrorOptions& options) {
  size_t work = 2 + std::size(own_methods);  // 2: the truth, and the final timing of all runs in turns
  for (const Peer& peer : options.peers) work += peer.settings.size();
  return static_cast<int>(work);
}

void measure_equal_error(const EqualErrorOptions& options, BenchRecord& record) {
  const std::string& scene = options.scene->name;
  const PeerRuns runs(*options.scene, record.progress);
  const double bar = runs.error_bar();
  std::vector<PeerRun> peers = runs.of(options.peers);
  std::erase_if(peers, [&](const PeerRun& run) {
    const bool refused = run.outcome.verdict == Verdict::unsupported;
    const std::string note = fmt::format("bench leaves out {}: {}", run.method.name, run.outcome.reason);
    if (refused && std::ranges::count(record.notes, note) == 0) record.notes.push_back(note);
    return refused;
  });
  double wanted = INFINITY;  // m, smallest error that mysim must reach to compare with a peer
  long most = 0;             // number of mysim's evaluations that take about as long as the slowest run of a peer
  for (const PeerRun& run : peers) {
    if (run.ok() && *run.error > 2 * bar) wanted = std::min(wanted, *run.error - 2 * bar);
    most = std::max(most, 5 * run.outcome.evaluations);
  }
  const std::vector<PeerRun> own = runs.own(wanted, most);

  record.progress.begin(fmt::format("{}: all methods, interleaved", scene));
  std::vector<TimedRun> turns;
  std::vector<std::vector<double>> peer_times(peers.size());                             // s per evaluation, by round
  std::map<simd::InstructionSet, std::map<std::string, std::vector<double>>> own_times;  // by method
  std::vector<std::vector<double>*> times;                                               // one per turn
  for (size_t i = 0; i < peers.size(); ++i)
    if (peers[i].ok()) turns.push_back({peers[i].method, options.scene, peers[i].run}), times.push_back(&peer_times[i]);
  for (const simd::InstructionSet isa : compared_instruction_sets())
    for (const PeerRun& run : own) {
      if (!run.ok()) continue;
      const auto [entry, is_new] = own_times[isa].try_emplace(run.method.name);
      if (is_new) turns.push_back({run.method, options.scene, run.run, isa}), times.push_back(&entry->second);
    }
  const std::vector<EvaluationTimes> all = time_round_robin(turns, options.turns, record.patience);
  for (size_t i = 0; i < all.size(); ++i) *times[i] = all[i].per_evaluation;

  for (size_t i = 0; i < peers.size(); ++i)
    for (const simd::InstructionSet isa : compared_instruction_sets()) {
      const PeerRun& peer = peers[i];
      BenchRow row{.work = bench_work::same_error,
                   .scene = scene,
                   .peer = peer.method.name,
                   .variant = peer.other_model ? "other model" : "",
                   .build = build_of(peer.method.name),
                   .verdict = peer.outcome.verdict,
                   .error = peer.error,
                   .truth_bar = bar,
                   .evaluations = peer.outcome.evaluations,
                   .instructions = isa,
                   .unit = "run"};
      (peer.method.adaptive ? row.tolerance : row.step) = peer.setting;
      if (peer.projected > 0)
        row.remark = fmt::format("left out: it would take about {:.0f} s of CPU time", peer.projected);
      else if (!peer.ok() || peer_times[i].empty())
        row.remark = "the peer's run failed";
      else if (*peer.error <= 2 * bar)
        row.remark = "below the error bar of the reference solution";
      else if (!set_cheapest(row, peer, peer_times[i], own, *peer.error - 2 * bar, own_times[isa]))
        row.remark = "no run of mysim that was tried is as accurate";
      record.rows.push_back(std::move(row));
    }
}

namespace {

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
            BenchRecord& record) {
  const Run run{scene->step, options.duration, 1};
  const Method theirs = find_method(std::string(peer.representative)),
               own = find_method(std::string(subject().representative) + "+fast");
  Outcome out;
  const Points end = end_of(theirs, *scene, run, std::nullopt, &out);
  if (out.verdict != Verdict::ok) {
    record.notes.push_back(fmt::format("bench: {} on {}: {}", theirs.name, scene->name, out.reason));
    return;
  }
  const bool own_force = out.readback && out.readback->mapped["stiffness"].starts_with("force class");
  const std::vector<simd::InstructionSet> sets = compared_instruction_sets();
  std::vector<TimedRun> turns{{theirs, scene, run}};
  for (const simd::InstructionSet isa : sets) turns.push_back({own, scene, run, isa});
  const std::vector<EvaluationTimes> times = time_round_robin(turns, options.turns, record.patience);
  for (size_t i = 0; i < sets.size(); ++i) {
    BenchRow row{.work = bench_work::same_step,
                 .scene = scene->name,
                 .peer = theirs.name,
                 .variant = own_force ? "own force class" : "Bullet's force",
                 .build = build_of(theirs.name),
                 .step = out.step,
                 .apart = largest_column(end_of(own, *scene, run, sets[i]) - end),
                 .evaluations = out.steps,
                 .mysim = own.name,
                 .instructions = sets[i],
                 .step_of_mysim = out.step,
                 .unit = "step"};
    set_times(row, times[0].per_evaluation, times[1 + i].per_evaluation);
    record.rows.push_back(std::move(row));
  }
}

}  // namespace

void measure_same_step(const SameStepOptions& options, BenchRecord& record) {
  for (const Scene& scene : {hanging_cloth(options.side), hanging_cloth_of_two_stiffnesses(options.side)}) {
    const MethodFamily& peer = *default_peers().front();
    record.progress.begin(fmt::format("{}: the same step in {}", scene.name, peer.title));
    beside(peer, std::make_shared<const Scene>(scene), options, record);
  }
}

}  // namespace crosscheck
