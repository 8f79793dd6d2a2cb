// The steps and tolerances at which methods are tried, their runs, and the timing of these.
#include "experiments/speed_accuracy/speed_accuracy.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/estimate.h"
#include "experiments/metrics.h"
#include "experiments/observers.h"
#include "experiments/timing/timing.h"
#include "mysim/model/system.h"

namespace crosscheck {
namespace {

/// The longest step at which the method's rule holds by theory when the scene begins, s; infinite where none is known.
double limit_of(const Method& method, const Scene& scene) {
  const Stepper* rule = stepper_of(method);
  if (!rule || !std::isfinite(rule->limit(1, 0.1)) || scene.model.first_order())
    return std::numeric_limits<double>::infinity();
  const double omega = highest_frequency(scene.model, scene.start);
  return omega > 0 ? rule->limit(omega, uniform_drag_rate(scene.model).value_or(0))
                   : std::numeric_limits<double>::infinity();
}

}  // namespace

Run Setting::applied_to(Run run) const {
  (tolerance ? run.tolerance : run.step) = value;
  return run;
}

std::vector<Setting> settings_of(const Method& method, const Scene& scene, const Run& run, bool full, int* dropped) {
  std::vector<Setting> settings;
  if (method.adaptive) {
    for (double tolerance = 1e-2; tolerance > (full ? 5e-11 : 5e-9); tolerance /= 100) {
      const Setting setting{true, tolerance};
      // where stability chooses its steps, a loose tolerance costs as much as a tight one
      if (!full && estimated_as_it_begins(method, scene, setting.applied_to(run)) > 1.3) {
        if (dropped) ++*dropped;
        continue;
      }
      settings.push_back(setting);
    }
    return settings;
  }
  double last = 0;
  const double limit = limit_of(method, scene);
  for (int halving = 6; halving >= -4; --halving) {
    const Setting setting{false, time_grid({run.step * std::pow(2, halving), run.duration, run.samples}).h};
    // one or two that fail show where the others end
    if (setting.value == last || (halving > 3 && setting.value > 2 * limit)) continue;
    last = setting.value;
    const double most = (halving >= 0 ? 1.8 : 0.35) * (full ? 1 : 0.4);  // s
    if (estimated_seconds(method, scene, setting.applied_to(run)) > most) {
      if (dropped) ++*dropped;
      continue;
    }
    settings.push_back(setting);
  }
  return settings;
}

TimedPart part_of(const Method& method, const Scene& scene, const Run& base, const Setting& setting, bool full) {
  Run run = setting.applied_to(base);
  if (!method.fingerprint.empty()) return {run};     // a program of its own: what its start costs is not known
  const bool touches = scene.model.find<Spheres>();  // that may cost more than falling
  if (method.adaptive && touches) return {run};
  const double enough = full ? 0.02 : 0.006;  // s: thousands of ticks of the clock
  // s: shorter runs are timed whole. Most of a quick report's runs are; to time the others whole takes half a minute on
  // one core
  const double cheap = full ? 0.2 : 0.012;
  const double all_of_it =
      method.adaptive ? estimated_as_it_begins(method, scene, run) : estimated_seconds(method, scene, run);
  const double share = std::min(1., enough / all_of_it);
  const bool whole = all_of_it < cheap || touches;
  if (method.adaptive) {
    if (whole) return {run};
    run.samples = std::max(1, static_cast<int>(std::ceil(share * run.samples)));
    run.duration = base.duration * run.samples / base.samples;
    return {run, static_cast<double>(run.samples) / base.samples};
  }
  // the clock is read at each sample, which takes 0.3 microseconds: one in 100 is often enough to detect a blow-up
  const long all = static_cast<long>(time_grid(run).steps_per_sample) * run.samples;
  long steps = whole ? all : std::min(all, std::max(20L, std::lround(share * static_cast<double>(all))));
  int samples = std::clamp(static_cast<int>(share * all_of_it / 1e-4), 1, static_cast<int>(std::min(200L, steps)));
  while (whole && steps % samples != 0) --samples;  // the last step is timed too
  steps = steps / samples * samples;
  return {{time_grid(run).h, time_grid(run).h * static_cast<double>(steps), samples},
          static_cast<double>(steps) / static_cast<double>(all)};
}

TrajectoryDistance distance_over_time(const Trajectory& a, const Trajectory& b, double until) {
  TrajectoryDistance distance;
  double squares = 0;
  int samples = 0;
  for (int i = 0; i < std::min(a.frames(), b.frames()) && a.t[i] <= until * (1 + 1e-9); ++i, ++samples) {
    const double d = rms_distance(a.x[i], b.x[i]);
    distance.largest = std::max(distance.largest, d);
    squares += d * d;
  }
  if (samples > 0) distance.over_time = std::sqrt(squares / samples);
  return distance;
}

namespace {

struct SettingRun {
  Setting setting;
  Outcome outcome;
  Trajectory trajectory, end;  // and its last frames, where a callback wants them and it failed
  bool ok() const { return outcome.verdict == Verdict::ok; }
};

/// The runs of one method; empty where it does not take the scene. A note says where it took some settings and refused
/// others, or built another scene at them.
std::vector<SettingRun> runs_at(const Method& method, const Scene& scene, const Run& base,
                                const std::vector<Setting>& settings, bool recorded, MotionBoundsCache& bounds,
                                std::vector<std::string>& notes) {
  const double omega = recorded && !scene.model.first_order() ? highest_frequency(scene.model, scene.start) : 0;
  std::vector<SettingRun> tries;
  std::string refusal;
  size_t refused = 0;
  bool mismatch = false;
  for (const Setting& setting : settings) {
    Recorder recorder;
    Outcome out = run_method(method, scene, setting.applied_to(base), {&recorder}, std::ref(bounds));
    if (out.verdict == Verdict::unsupported) {  // at this step, perhaps not at others
      refusal = out.reason, ++refused;
      continue;
    }
    if (!method.stepper && certify(method.name, scene, out).mismatch()) {
      refusal = fmt::format("at {} it built another scene, see its certificate", setting.value), ++refused;
      mismatch = true;
      continue;
    }
    // its last frames take a run of their own: observing every step makes adaptive methods take other steps
    LastFrames last(omega, setting.tolerance ? 0 : setting.value);
    if (recorded && out.verdict != Verdict::ok)
      run_method(method, scene, setting.applied_to(base), {&last}, std::ref(bounds));
    tries.push_back({setting, std::move(out), std::move(recorder.trajectory), last.path()});
  }
  if (mismatch || (refused > 0 && !tries.empty()))
    notes.push_back(fmt::format("speed-accuracy leaves out {} of {} runs of {} on {}, {}: {}", refused, settings.size(),
                                method.name, scene.name, mismatch ? "for" : "which it refuses", refusal));
  return tries;
}

/// All of mysim and Bullet, and the library integrators of the same equations.
std::vector<Method> methods_for(const Request& request, const Scene& scene) {
  std::vector<Method> methods = methods_of(request, scene);
  if (!request.methods.empty()) return methods;
  // multistep formulas take hundreds of times as long on springs without damping: `bench` says so on one scene
  for (Method& method : all_methods())
    if (method.family().role == Role::integrator && !method.multistep) methods.push_back(std::move(method));
  return methods;
}

/// The reason why no speed is measured, or empty.
std::string why_not(const Scene& scene, double motion) {
  // 1e-6 of its size: where nothing moves a run of one step is as right as any other
  if (!(motion > 1e-6 * scene.size())) return "nothing moves there";
  return "";
}

}  // namespace

void speed_accuracy_on(const Request& request, const Scene& scene, TableSet& tables) {
  Run base = run_of(request, scene);
  base.timed = false;  // time_speed_accuracy() does that
  const auto truth = truth_of(scene, base);
  const bool of_rule = truth && truth->under_contact_rule;
  Recorder plain;
  if (!truth) run_method(find_method(scene.method), scene, base, {&plain});
  const double motion = motion_of(truth ? truth->trajectory : plain.trajectory);
  if (const std::string why = why_not(scene, motion); !why.empty()) {
    tables.notes.push_back(fmt::format("speed-accuracy leaves out {}: {}", scene.name, why));
    return;
  }
  if (!truth)
    tables.notes.push_back(
        fmt::format("speed-accuracy knows no truth of {}: only distances to each method's own finest run", scene.name));
  const double until = truth ? std::min(scene.window, truth->until) : scene.window;
  const std::string tier = truth ? std::string(name_of(truth->tier)) + (of_rule ? ", in-house contact rule" : "") : "";

  Table table = table_of<SpeedAccuracyRow>();
  std::vector<std::string> shortened;
  MotionBoundsCache bounds;
  for (const Method& method : methods_for(request, scene)) {
    int dropped = 0;
    const auto settings = settings_of(method, scene, base, request.full, &dropped);
    const std::vector<SettingRun> tries =
        runs_at(method, scene, base, settings, bool(request.on_runs), bounds, tables.notes);
    if (dropped > 0 && (!tries.empty() || settings.empty()))
      shortened.push_back(fmt::format("{} ({})", method.name, dropped));
    if (request.on_runs && !tries.empty()) {
      RecordedRuns recorded{"speed-accuracy", scene, method.name, {}};
      for (const SettingRun& run : tries) recorded.runs.push_back({run.outcome, run.ok() ? run.trajectory : run.end});
      request.on_runs(recorded);
    }
    for (const SettingRun& run : tries) {
      const Outcome& out = run.outcome;
      std::optional<double> largest, over_time, own;
      if (run.ok() && truth) {
        const TrajectoryDistance distance = distance_over_time(run.trajectory, truth->trajectory, until);
        largest = distance.largest, over_time = distance.over_time;
      }
      if (run.ok() && tries.back().ok() && &run != &tries.back())
        own = distance_over_time(run.trajectory, tries.back().trajectory, scene.window).largest;
      SpeedAccuracyRow row{.scene = scene.name,
                           .method = method.name,
                           .setting = run.setting.kind(),
                           .requested = run.setting.value,
                           .step = out.step,
                           .steps = out.steps,
                           .evaluations = out.evaluations,
                           .verdict = out.verdict,
                           .end = out.end,
                           .to_own_finest = own,
                           .motion = motion,
                           .until = until,
                           .different_law = fmt::format("{}", fmt::join(out.different_law, "; "))};
      (of_rule ? row.difference : row.error) = largest;
      (of_rule ? row.difference_over_time : row.error_over_time) = over_time;
      if (truth) row.truth = tier, row.truth_bar = truth->error_bar;
      add(table, row);
    }
  }
  if (!shortened.empty())
    tables.notes.push_back(fmt::format("speed-accuracy on {} leaves out runs that would cost much{}: {}", scene.name,
                                       request.full ? "" : "; --full has more of them", fmt::join(shortened, ", ")));
  tables.add(table);
}

void time_speed_accuracy(const Request& request, const Scene& scene, TableSet& tables) {
  const Run base = run_of(request, scene);
  struct Timed {
    std::string method;
    Setting setting;
    double share;
    long evaluations = 0;
  };
  std::vector<Timed> timed;
  std::vector<std::function<double()>> runs;
  MotionBoundsCache bounds;  // short runs are repeated a thousand times
  const std::vector<Method> methods = methods_for(request, scene);
  for (const Method& method : methods)
    for (const Setting& setting : settings_of(method, scene, base, request.full)) {
      const TimedPart part = part_of(method, scene, base, setting, request.full);
      // run until it accepts the scene once: it may refuse the longest steps alone
      if (timed.empty() || timed.back().method != method.name)
        if (run_method(method, scene, part.run, {}, std::ref(bounds)).verdict == Verdict::unsupported) continue;
      timed.push_back({method.name, setting, part.share});
      runs.push_back([&method, &scene, &bounds, part, &timed, at = timed.size() - 1] {
        // monitored: after a blow-up a step of Bullet's worlds takes many times as long
        const Outcome out = run_method(method, scene, part.run, {}, std::ref(bounds));
        timed[at].evaluations = out.evaluations;
        return out.cpu_seconds;
      });
    }
  // the dear ones are most of the work, and their times spread least. A first run of more than 0.2 ms takes what the
  // second does, to 1 % on average (measured, 934 runs)
  const auto times =
      time_round_robin(runs, request.full ? TimingOptions{.least = 3, .most = 9, .enough = 0.05, .warm = 0.05}
                                          : TimingOptions{.least = 2, .most = 7, .enough = 0.005, .warm = 0.0005});
  const double noise = times.empty() ? 0 : noise_floor(times);
  Table table = table_of<SpeedAccuracyTimingRow>();
  for (size_t i = 0; i < timed.size(); ++i) {
    const Timing t = timing_of(times[i]);
    if (!(t.median > 0)) {
      if (timed[i].evaluations > 0)
        tables.notes.push_back(fmt::format("{} does not tell what CPU time it took", timed[i].method));
      continue;
    }
    add(table, SpeedAccuracyTimingRow{.scene = scene.name,
                                      .method = timed[i].method,
                                      .setting = timed[i].setting.kind(),
                                      .requested = timed[i].setting.value,
                                      .part = timed[i].share,
                                      .evaluations = timed[i].evaluations,
                                      .cpu = t.median,
                                      .cpu_low = t.low,
                                      .cpu_high = t.high,
                                      .repetitions = t.repetitions,
                                      .noise = noise});
  }
  tables.add(table);
}

std::string build_of(const std::string& method) { return std::string(family_of(method).build_text); }

std::vector<Point> speed_accuracy_points(const Request& request) {
  std::vector<Point> points = one_point_per_scene(request, "speed-accuracy", speed_accuracy_on);
  for (Point& point : one_point_per_scene(request, "speed-accuracy, timed", time_speed_accuracy)) {
    point.timed = true;
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace crosscheck
