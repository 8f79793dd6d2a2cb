#include "experiments/speed_accuracy/speed_accuracy.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "experiments/estimate.h"
#include "experiments/metrics.h"
#include "experiments/observers.h"
#include "experiments/scenes/ingredients.h"
#include "experiments/speed_accuracy/step_search.h"
#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/engines.h"
#include "experiments/timing/timing.h"
#include "mysim/model/system.h"

namespace crosscheck {

double stability_limit(const Method& method, const Scene& scene) {
  const Stepper* rule = stepper_of(method);
  if (!rule || !std::isfinite(rule->limit(1, 0.1)) || scene.model.first_order())
    return std::numeric_limits<double>::infinity();
  const double omega = highest_frequency(scene.model, scene.start);
  return omega > 0 ? rule->limit(omega, uniform_drag_rate(scene.model).value_or(0))
                   : std::numeric_limits<double>::infinity();
}

Run Setting::applied_to(Run run) const {
  (tolerance ? run.tolerance : run.step) = value;
  return run;
}

namespace {

/// Largest estimated CPU time of a run, s.
double most_seconds(bool full) { return full ? 1.8 : 0.72; }

}  // namespace

std::vector<Setting> settings_of(const Method& method, const Scene& scene, const Run& run, bool full, int* dropped) {
  std::vector<Setting> settings;
  if (method.adaptive) {
    for (double tolerance = 1e-2; tolerance > (full ? 5e-11 : 5e-9); tolerance /= 100) {
      const Setting setting{true, tolerance};
      // checks the time of adaptive methods: if stability limits their steps, a loose tolerance costs as much as a
      // tight one
      if (!full && estimated_as_it_begins(method, scene, setting.applied_to(run)) > 1.3) {
        if (dropped) ++*dropped;
        continue;
      }
      settings.push_back(setting);
    }
    return settings;
  }
  double last = 0;
  const double limit = stability_limit(method, scene);
  for (int halving = longest_halving; halving >= -4; --halving) {
    const Setting setting{false, time_grid({run.step * std::pow(2, halving), run.duration, run.samples}).h};
    if (setting.value == last || is_beyond(limit, halving, setting.value)) continue;
    last = setting.value;
    const double most = halving >= 0 ? most_seconds(full) : 0.2 * most_seconds(full);
    if (estimated_seconds(method, scene, setting.applied_to(run)) > most) {
      if (dropped) ++*dropped;
      continue;
    }
    settings.push_back(setting);
  }
  return settings;
}

TimedPart part_of(const Method& method, const Scene& scene, const Run& base, const Setting& setting, bool full,
                  bool whole) {
  Run run = setting.applied_to(base);
  if (!method.fingerprint.empty()) return {run};  // external programs take an unknown time to start
  const bool touches = has_contact(scene.model);
  if (method.adaptive && (touches || whole)) return {run};
  const double enough = full ? 0.02 : 0.006;  // s: equals thousands of clock ticks
  // s; longer runs are timed in part only, which saves half a minute on one core
  const double cheap = full ? 0.2 : 0.012;
  const double all_of_it =
      method.adaptive ? estimated_as_it_begins(method, scene, run) : estimated_seconds(method, scene, run);
  const double share = std::min(1., enough / all_of_it);
  whole |= all_of_it < cheap || touches;
  if (method.adaptive) {
    if (whole) return {run};
    run.samples = std::max(1, static_cast<int>(std::ceil(share * run.samples)));
    run.duration = base.duration * run.samples / base.samples;
    return {run, static_cast<double>(run.samples) / base.samples};
  }
  // the clock is read at each sample, which takes 0.3 microseconds; a blow-up is detected early enough with one sample
  // in 100 steps
  const long all = static_cast<long>(time_grid(run).steps_per_sample) * run.samples;
  long steps = whole ? all : std::min(all, std::max(20L, std::lround(share * static_cast<double>(all))));
  int samples = std::clamp(static_cast<int>(share * all_of_it / 1e-4), 1, static_cast<int>(std::min(200L, steps)));
  while (whole && steps % samples != 0) --samples;  // the samples must include the last step
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
  Trajectory trajectory, end;  // `end`: the last frames of a failed run, for playback
  bool ok() const { return outcome.verdict == Verdict::ok; }
};

/// Empty if the method does not support the scene. Notes report settings that the method refused, and settings for
/// which it built another scene.
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
    if (out.verdict == Verdict::unsupported) {  // unsupported at this step, but possibly not at others
      refusal = out.reason, ++refused;
      continue;
    }
    if (!method.stepper && certify(method.name, scene, out).mismatch()) {
      refusal = fmt::format("at {} it built another scene, see its certificate", setting.value), ++refused;
      mismatch = true;
      continue;
    }
    // the last frames come from a separate run, because observing every step changes the steps of adaptive methods
    LastFrames last(omega, setting.tolerance ? 0 : setting.value);
    if (recorded && out.verdict != Verdict::ok)
      run_method(method, scene, setting.applied_to(base), {&last}, std::ref(bounds));
    tries.push_back({setting, std::move(out), std::move(recorder.trajectory), last.path()});
  }
  if (mismatch || (refused > 0 && !tries.empty()))
    notes.push_back(fmt::format("speed-accuracy leaves out {} of {} runs of {} on {}: {}{}", refused, settings.size(),
                                method.name, scene.name, mismatch ? "" : "refused: ", refusal));
  return tries;
}

/// The requested methods; by default, all methods of mysim and Bullet, and the library integrators.
std::vector<Method> methods_for(const Request& request, const Scene& scene) {
  std::vector<Method> methods = methods_of(request, scene);
  if (!request.methods.empty()) return methods;
  // without multistep formulas, which take hundreds of times as long on undamped springs; `bench` shows this on one
  // scene
  for (Method& method : all_methods())
    if (method.family().role == Role::integrator && !method.multistep) methods.push_back(std::move(method));
  return methods;
}

std::string why_not(const Scene& scene, double motion) {
  // if nothing moves, a run of one step is as accurate as any other
  if (!(motion > 1e-6 * scene.size())) return "nothing moves";
  return "";
}

}  // namespace

namespace {

/// A scene as the experiment runs it, with its reference solution and its scales.
struct Judged {
  const Scene& scene;
  Run base;
  std::optional<Truth> truth;
  double motion = 0, until = 0;  // m, s
  bool under_contact_rule() const { return truth && truth->under_contact_rule; }
  /// Largest allowed error of a recommended run, m; nullopt if no error is known.
  std::optional<double> bound() const {
    if (!truth || under_contact_rule()) return std::nullopt;
    const double left = recommended_part * motion - truth->error_bar;
    return left > 0 ? std::optional(left) : std::nullopt;
  }
};

TriedRun tried_run(const Judged& of, const Outcome& out, const Trajectory& path) {
  TriedRun run{.verdict = out.verdict,
               .cost = static_cast<double>(out.evaluations) * static_cast<double>(springs_of(of.scene.model))};
  if (out.verdict == Verdict::ok) run.error = distance_over_time(path, of.truth->trajectory, of.until).largest;
  return run;
}

bool is_affordable(const Method& method, const Judged& of, const Setting& setting, bool full) {
  const Run run = setting.applied_to(of.base);
  return (method.adaptive ? estimated_as_it_begins(method, of.scene, run) : estimated_seconds(method, of.scene, run)) <=
         most_seconds(full);
}

/// The settings that the search for the cheapest run has tried, for each candidate method.
std::map<std::string, std::vector<Setting>> searched_settings(const Request& request, const Judged& of,
                                                              MotionBoundsCache& bounds) {
  std::map<std::string, std::vector<Setting>> settings;
  const auto bound = of.bound();
  if (!bound) return settings;
  std::vector<Method> methods = request.methods.empty() ? candidates(of.scene) : methods_of(request, of.scene);
  std::erase_if(methods, [](const Method& m) { return !is_candidate(m.name); });
  std::vector<TriedRun> runs;
  StepSearch search(
      of.scene, of.base, *bound,
      [&](const Method& method, const Setting& setting) -> std::optional<TriedRun> {
        if (!is_affordable(method, of, setting, request.full)) return std::nullopt;
        Recorder recorder;
        const Outcome out = run_method(method, of.scene, setting.applied_to(of.base), {&recorder}, std::ref(bounds));
        if (!method.stepper && certify(method.name, of.scene, out).mismatch()) return std::nullopt;
        return tried_run(of, out, recorder.trajectory);
      },
      runs);
  search.search(methods);
  for (const TriedRun& run : runs)
    if (run.verdict != Verdict::unsupported) settings[run.method].push_back(run.setting);
  return settings;
}

std::vector<Setting> merged(std::vector<Setting> settings, const std::vector<Setting>& more) {
  for (const Setting& each : more)
    if (std::ranges::none_of(settings, [&](const Setting& s) { return std::abs(s.value / each.value - 1) < 1e-9; }))
      settings.push_back(each);
  std::ranges::stable_sort(settings, std::greater{}, &Setting::value);
  return settings;
}

void refine(const Method& method, const Judged& of, const Request& request, MotionBoundsCache& bounds,
            std::vector<SettingRun>& tries, std::vector<std::string>& notes) {
  const auto bound = of.bound();
  if (!bound || method.family().is_subject() || method.family().role == Role::integrator) return;
  std::vector<TriedRun> runs;
  const auto add = [&](const SettingRun& run) {
    TriedRun tried = tried_run(of, run.outcome, run.trajectory);
    tried.method = method.name, tried.setting = run.setting;
    // the cost is the number of steps: engines need not count evaluations, and all their steps cost the same
    tried.cost = static_cast<double>(run.outcome.steps);
    return tried;
  };
  for (const SettingRun& run : tries) runs.push_back(add(run));
  if (!recommend(runs, *bound)) return;
  StepSearch search(
      of.scene, of.base, *bound,
      [&](const Method& m, const Setting& setting) -> std::optional<TriedRun> {
        if (!is_affordable(m, of, setting, request.full)) return std::nullopt;
        auto more = runs_at(m, of.scene, of.base, {setting}, bool(request.on_runs), bounds, notes);
        if (more.empty()) return std::nullopt;
        tries.push_back(std::move(more[0]));
        return add(tries.back());
      },
      runs);
  search.search({method});
  std::ranges::stable_sort(tries, std::greater{}, [](const SettingRun& run) { return run.setting.value; });
}

SpeedAccuracyRow row_of(const Judged& of, const std::string& method, const SettingRun& run,
                        const std::vector<SettingRun>& tries) {
  const Outcome& out = run.outcome;
  SpeedAccuracyRow row{.scene = of.scene.name,
                       .method = method,
                       .setting = run.setting.kind(),
                       .requested = run.setting.value,
                       .step = out.step,
                       .steps = out.steps,
                       .evaluations = out.evaluations,
                       .verdict = out.verdict,
                       .end = out.end,
                       .motion = of.motion,
                       .until = of.until,
                       .different_law = fmt::format("{}", fmt::join(out.different_law, "; "))};
  if (run.ok() && of.truth) {
    const TrajectoryDistance distance = distance_over_time(run.trajectory, of.truth->trajectory, of.until);
    (of.under_contact_rule() ? row.difference : row.error) = distance.largest;
    (of.under_contact_rule() ? row.difference_over_time : row.error_over_time) = distance.over_time;
  }
  if (run.ok() && tries.back().ok() && &run != &tries.back())
    row.to_own_finest = distance_over_time(run.trajectory, tries.back().trajectory, of.scene.window).largest;
  if (of.truth) {
    row.truth = std::get<std::string>(to_cell(TruthKind{of.truth->tier, of.under_contact_rule()}));
    row.truth_bar = of.truth->error_bar;
  }
  return row;
}

}  // namespace

void speed_accuracy_on(const Request& request, const Scene& scene, TableSet& tables) {
  Run base = run_of(request, scene);
  base.timed = false;  // times are measured by time_speed_accuracy()
  Judged of{scene, base, truth_of(scene, base)};
  Recorder plain;
  if (!of.truth) run_method(find_method(scene.method), scene, base, {&plain});
  of.motion = motion_of(of.truth ? of.truth->trajectory : plain.trajectory);
  if (const std::string why = why_not(scene, of.motion); !why.empty()) {
    tables.notes.push_back(fmt::format("speed-accuracy leaves out {}: {}", scene.name, why));
    return;
  }
  if (!of.truth)
    tables.notes.push_back(fmt::format(
        "speed-accuracy on {}: no reference solution, only distances to each method's own finest run", scene.name));
  of.until = of.truth ? std::min(scene.window, of.truth->until) : scene.window;

  Table table = table_of<SpeedAccuracyRow>();
  std::vector<std::string> shortened;
  MotionBoundsCache bounds;
  auto searched = searched_settings(request, of, bounds);
  std::vector<Method> methods = methods_for(request, scene);
  for (const auto& [name, settings] : searched)
    if (std::ranges::find(methods, name, &Method::name) == methods.end()) methods.push_back(find_method(name));
  for (const Method& method : methods) {
    int dropped = 0;
    const bool has_ladder = request.methods.empty() ? !method.name.ends_with("+events") : true;
    const auto ladder = has_ladder ? settings_of(method, scene, base, request.full, &dropped) : std::vector<Setting>();
    const auto settings = merged(ladder, searched[method.name]);
    std::vector<SettingRun> tries = runs_at(method, scene, base, settings, bool(request.on_runs), bounds, tables.notes);
    refine(method, of, request, bounds, tries, tables.notes);
    if (dropped > 0 && (!tries.empty() || settings.empty()))
      shortened.push_back(fmt::format("{} ({})", method.name, dropped));
    if (request.on_runs && !tries.empty()) {
      RecordedRuns recorded{"speed-accuracy", scene, method.name, {}};
      for (const SettingRun& run : tries) recorded.runs.push_back({run.outcome, run.ok() ? run.trajectory : run.end});
      request.on_runs(recorded);
    }
    for (const SettingRun& run : tries) add(table, row_of(of, method.name, run, tries));
  }
  if (!shortened.empty())
    tables.notes.push_back(fmt::format("speed-accuracy leaves out slow runs on {}{}: {}", scene.name,
                                       request.full ? "" : "; --full includes more of them",
                                       fmt::join(shortened, ", ")));
  tables.add(table);
}

namespace {

struct TimedRow {
  const SpeedAccuracyRow* row;
  const Method* method;
  TimedPart part;
  long evaluations = 0;
  /// Time (s) of the whole run, extrapolated from the timed part.
  Timing scaled(const Timing& t) const {
    const auto measured = static_cast<double>(evaluations), all = static_cast<double>(row->evaluations);
    return t.times(measured > 0 && all > 0 ? all / measured : 1 / part.share);
  }
};

std::vector<size_t> compared_rows(const std::vector<TimedRow>& timed, const std::vector<Timing>& times) {
  std::map<std::string, size_t> cheapest;  // by engine
  std::vector<size_t> compared;
  if (timed.empty()) return compared;
  const SpeedAccuracyRow& any = *timed[0].row;
  const double bound = recommended_part * any.motion - any.truth_bar.value_or(INFINITY);
  std::vector<SpeedAccuracyRow> rows;
  for (const TimedRow& run : timed) rows.push_back(*run.row);
  const auto at = [&](const TriedRun& run) {
    return std::ranges::find_if(timed,
                                [&](const TimedRow& t) {
                                  return t.row->method == run.method && t.row->requested == run.setting.value;
                                }) -
           timed.begin();
  };
  const std::vector<TriedRun> tried = tried_runs(rows, any.scene);
  if (const auto recommended = recommend(tried, bound)) {
    compared.push_back(static_cast<size_t>(at(tried[recommended->run])));
    for (const size_t tie : recommended->tied) compared.push_back(static_cast<size_t>(at(tried[tie])));
  }
  for (size_t i = 0; i < timed.size(); ++i) {
    const SpeedAccuracyRow& row = *timed[i].row;
    if (family_of(row.method).is_subject() || family_of(row.method).role == Role::integrator || !row.error ||
        *row.error > bound)
      continue;
    const auto [best, is_new] = cheapest.try_emplace(engine_of(row.method), i);
    if (!is_new && timed[i].scaled(times[i]).median < timed[best->second].scaled(times[best->second]).median)
      best->second = i;
  }
  for (const auto& [engine, i] : cheapest) compared.push_back(i);
  return compared;
}

}  // namespace

void time_speed_accuracy(const Request& request, const Scene& scene, const TableSet& rows, TableSet& tables) {
  const Table* table_of_runs = rows.table(std::string(SpeedAccuracyRow::table));
  if (!table_of_runs) return;
  const std::vector<SpeedAccuracyRow> runs = rows_of<SpeedAccuracyRow>(*table_of_runs);
  const Run base = run_of(request, scene);
  std::map<std::string, Method> methods;
  for (Method& method : methods_for(request, scene)) methods.emplace(method.name, method);
  std::vector<TimedRow> timed;
  for (const SpeedAccuracyRow& row : runs) {
    const auto known = methods.find(row.method);
    const Method& method = known != methods.end() ? known->second : methods[row.method] = find_method(row.method);
    const Setting setting{row.setting == SettingKind::tolerance, row.requested};
    timed.push_back({&row, &method, part_of(method, scene, base, setting, request.full)});
  }
  MotionBoundsCache bounds;  // cached, because short runs are repeated a thousand times
  const auto run_once = [&](TimedRow& run) {
    // the bounds of motion stop the run, because after a blow-up a step of Bullet's worlds takes many times as long
    const Outcome out = run_method(*run.method, scene, run.part.run, {}, std::ref(bounds));
    run.evaluations = out.evaluations;
    return out.cpu_seconds;
  };
  std::vector<std::function<double()>> turns;
  for (TimedRow& run : timed) turns.push_back([&] { return run_once(run); });
  // expensive runs are most of the work, but two repetitions suffice, because their times vary least. If a first run
  // takes more than 0.2 ms, the second one takes the same time, to 1 % on average (measured for 934 runs)
  const auto samples =
      time_round_robin(turns, request.full ? TimingOptions{.least = 3, .most = 9, .enough = 0.05, .warm = 0.05}
                                           : TimingOptions{.least = 2, .most = 7, .enough = 0.005, .warm = 0.0005});
  const double noise = samples.empty() ? 0 : noise_floor(samples);
  std::vector<Timing> times;
  for (const std::vector<double>& each : samples) times.push_back(timing_of(each));

  std::vector<size_t> in_parts = compared_rows(timed, times);
  std::erase_if(in_parts, [&](size_t i) { return timed[i].part.share == 1; });
  turns.clear();
  for (const size_t i : in_parts) {
    TimedRow& run = timed[i];
    const Setting setting{run.row->setting == SettingKind::tolerance, run.row->requested};
    run.part = part_of(*run.method, scene, base, setting, request.full, true);
    turns.push_back([&] { return run_once(run); });
  }
  const auto whole = time_round_robin(turns, {.least = 3, .most = 7, .enough = 0.1, .warm = 0.0005});
  for (size_t i = 0; i < in_parts.size(); ++i) times[in_parts[i]] = timing_of(whole[i]);

  Table table = table_of<SpeedAccuracyTimingRow>();
  for (size_t i = 0; i < timed.size(); ++i) {
    const Timing& t = times[i];
    if (!(t.median > 0)) {
      if (timed[i].evaluations > 0)
        tables.notes.push_back(fmt::format("{} does not report its CPU time", timed[i].row->method));
      continue;
    }
    add(table, SpeedAccuracyTimingRow{.scene = scene.name,
                                      .method = timed[i].row->method,
                                      .setting = timed[i].row->setting,
                                      .requested = timed[i].row->requested,
                                      .part = timed[i].part.share,
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
  for (size_t i = 0; i < request.scenes.size(); ++i) {
    Request alone = request;
    alone.scenes = {request.scenes[i]};
    points.push_back(timed_after(points[i], "speed-accuracy, timed: " + alone.scenes[0].name,
                                 [alone](const TableSet& rows, TableSet& tables) {
                                   time_speed_accuracy(alone, alone.scenes[0], rows, tables);
                                 }));
  }
  return points;
}

}  // namespace crosscheck
