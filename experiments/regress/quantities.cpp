#include "experiments/regress/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "experiments/metrics.h"
#include "experiments/stability/limit.h"
#include "mysim/base/random.h"
#include "reference/truth/exact/exact.h"

namespace crosscheck {
namespace {

std::vector<int> frames_at(const Trajectory& path, int parts) {
  std::vector<int> frames;
  for (int i = 1; i <= parts; ++i) {
    const int frame = static_cast<int>(std::lround(static_cast<double>(path.frames() - 1) * i / parts));
    if (frame > 0 && (frames.empty() || frame > frames.back())) frames.push_back(frame);
  }
  return frames;
}

std::string at_time(const std::string& what, double t) { return fmt::format("{} at {:.6g} s", what, t); }

void offsets(const Observation& seen, Quantities& out) {
  for (const int i : frames_at(seen.path(), 8))
    out.push_back({offset_at(seen.path().t[i]), "m", rms_distance(seen.path().x[i], seen.path().x.front())});
}

/// Positions projected on a random direction for each particle. These differ even if means over the particles agree.
void places(const Observation& seen, Quantities& out) {
  const auto n = seen.path().x.front().cols();
  std::mt19937_64 engine(20250101);
  Points along(3, n);
  for (double& part : along.reshaped()) part = 2 * uniform(engine) - 1;
  along /= std::sqrt(static_cast<double>(n));
  for (const int i : frames_at(seen.path(), 8))
    out.push_back({places_at(seen.path().t[i]), "m", dot(along, seen.path().x[i] - seen.path().x.front())});
}

void energies(const Observation& seen, Quantities& out) {
  const auto& rows = seen.case_run.ledger;
  if (rows.empty()) return;
  for (const int i : frames_at(seen.path(), 4)) {
    const auto row = std::min_element(rows.begin(), rows.end(), [&](const LedgerRow& a, const LedgerRow& b) {
      return std::abs(a.t - seen.path().t[i]) < std::abs(b.t - seen.path().t[i]);
    });
    out.push_back({at_time("energy gained", seen.path().t[i]), "J", row->energy.total() - rows.front().energy.total()});
  }
  if (has_contact(seen.scene().model)) out.push_back({contact_quantity, "J", rows.back().contact});
}

void peak_stretch(const Observation& seen, Quantities& out) {
  const auto* springs = seen.scene().model.find<Springs>();
  if (!springs) return;
  double most = -INFINITY;
  for (const Points& x : seen.path().x)
    for (const Spring& s : springs->list)
      if (s.rest > 0) most = std::max(most, (x.col(s.a) - x.col(s.b)).norm() / s.rest - 1);
  if (std::isfinite(most)) out.push_back({"peak stretch", "1", most});
}

/// Amplitudes of the final offset in waves along and across the initial scene. The first amplitude is the mean offset.
void shape(const Observation& seen, Quantities& out) {
  const Points &x0 = seen.scene().start.x, offset = seen.path().x.back() - seen.path().x.front();
  if (x0.cols() < 9) return;
  // axes in descending order of the start's width; if widths are equal, x is before y, and y before z
  const Vec3 low = x0.rowwise().minCoeff(), width = x0.rowwise().maxCoeff() - low;
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return width[a] > (1 + 1e-9) * width[b]; });
  if (!(width[axes[1]] > 0)) return;
  for (const auto& [along, across] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}}) {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < x0.cols(); ++i) {
      const double a = (x0(axes[0], i) - low[axes[0]]) / width[axes[0]],
                   b = (x0(axes[1], i) - low[axes[1]]) / width[axes[1]];
      sum += std::cos(std::numbers::pi * along * a) * std::cos(std::numbers::pi * across * b) * offset.col(i);
    }
    for (int axis = 0; axis < 3; ++axis)
      out.push_back({fmt::format("wave {}, {} of the last shape, {}", along, across, "xyz"[axis]), "m",
                     sum[axis] / static_cast<double>(x0.cols())});
  }
}

void sag(const Observation& seen, Quantities& out) {
  const auto* gravity = seen.scene().model.find<Gravity>();
  if (!gravity || seen.scene().model.particles.pins.empty()) return;
  const Points offset = seen.path().x.back() - seen.path().x.front();
  out.push_back({"sag", "m", (gravity->acceleration.normalized().transpose() * offset).maxCoeff()});
}

/// Period from turning points of the particles' mean position, at the vertices of parabolas through three samples.
void period(const Observation& seen, Quantities& out) {
  const Trajectory& path = seen.path();
  if (has_contact(seen.scene().model) || path.frames() < 8) return;
  Points means(3, path.frames());
  for (int i = 0; i < path.frames(); ++i) means.col(i) = path.x[i].rowwise().mean();
  const Vec3 width = means.rowwise().maxCoeff() - means.rowwise().minCoeff();
  int axis = 0;
  if (!(width.maxCoeff(&axis) > 1e-6 * seen.scene().size())) return;  // rounding noise has no period
  std::vector<double> turns;
  for (int i = 1; i + 1 < path.frames(); ++i) {
    const double before = means(axis, i) - means(axis, i - 1), after = means(axis, i + 1) - means(axis, i);
    if ((before > 0) == (after > 0)) continue;
    turns.push_back(path.t[i] + 0.5 * (path.t[i] - path.t[i - 1]) * (before + after) / (before - after));
  }
  // more than 40 turning points are those of small ripples, which have no period
  if (turns.size() < 3 || turns.size() > 40) return;
  out.push_back({"period", "s", 2 * (turns.back() - turns.front()) / static_cast<double>(turns.size() - 1)});
}

void smallest_clearance(const Observation& seen, Quantities& out) {
  if (!has_contact(seen.scene().model)) return;
  double least = INFINITY;
  for (int i = 0; i < seen.path().frames(); ++i)
    least = std::min(least, *clearance(seen.scene(), seen.path().t[i], seen.path().x[i]));
  out.push_back({"smallest clearance", "m", least});
}

/// The truth if it has a closed form; otherwise nullopt, because a converged truth takes minutes.
std::optional<Truth> exact_truth(const Scene& scene) {
  if (!exact_solution(scene)) return std::nullopt;
  const auto truth = truth_of(scene, default_run(scene));
  return truth && truth->tier == Tier::exact ? truth : std::nullopt;
}

void rebound_height(const Observation& seen, Quantities& out) {
  if (std::ranges::none_of(surfaces_of(seen.scene().model), [](const Surface& s) { return s.restitution > 0; })) return;
  bool touched = false;
  double highest = 0;
  for (int i = 0; i < seen.path().frames(); ++i) {
    const double gap = *clearance(seen.scene(), seen.path().t[i], seen.path().x[i]);
    // a particle touches a surface if the gap is smaller than the particle's movement since the last sample, because
    // the contact lies between two samples
    const double fall = i > 0 ? largest_column(seen.path().x[i] - seen.path().x[i - 1]) : 0;
    touched |= i > 0 && gap < fall;
    if (touched) highest = std::max(highest, gap);
  }
  if (touched) out.push_back({"rebound height", "m", highest});
}

/// Largest RMS distance from the same run at half the step, m, for scenes without a closed form. It estimates the error
/// up to a factor that depends on the order. Needs a run with twice as many steps. Skipped for scenes from which an
/// ingredient was removed.
void change_at_half_the_step(const Observation& seen, Quantities& out) {
  const Scene& scene = seen.scene();
  const Method& method = seen.test_case.method;
  if (method.adaptive || !seen.test_case.without.empty() || exact_solution(scene)) return;
  Run half = run_over_window(scene);
  half.step = seen.case_run.outcome.step / 2;
  Recorder recorder;
  if (run_method(method, scene, half, {&recorder}).verdict != Verdict::ok) return;
  out.push_back({halving_quantity, "m", largest_rms_distance(seen.path(), recorder.trajectory, scene.window)});
}

/// log2 of the ratio of the error (relative to the closed form) to that at half the step, which is close to the rule's
/// order. Takes one more run. Skipped if the error is below 1e-10 of the scene's size, where the ratio has no meaning.
void order_of_error(const Observation& seen, Quantities& out) {
  const Scene& scene = seen.scene();
  const Stepper* rule = seen.test_case.method.stepper;
  if (!rule || rule->adaptive || has_contact(scene.model)) return;
  const auto truth = exact_truth(scene);
  if (!truth) return;
  const Run run = run_over_window(scene);
  Run half = run;
  half.step = seen.case_run.outcome.step / 2;
  Recorder recorder;
  if (run_method(seen.test_case.method, scene, half, {&recorder}).verdict != Verdict::ok) return;
  const double whole = largest_rms_distance(seen.path(), truth->trajectory, scene.window),
               halved = largest_rms_distance(recorder.trajectory, truth->trajectory, scene.window);
  // 1e3 times the rounding error of positions; smaller errors show no order
  if (!(halved > 1e-10 * std::max(1.0, scene.size()))) return;
  out.push_back({"order of the error", "1", std::log2(whole / halved)});
  // both errors are uncertain by the error bar
  out.back().error_bar = truth->error_bar / halved * 2 / std::log(2.);
}

/// Largest stable step (s) from rest, found by bisection to 0.2 %, for scenes with at most 12 free coordinates and
/// rules with a finite limit. Takes about 25 runs of 4000 steps.
void largest_stable_step(const Observation& seen, Quantities& out) {
  constexpr double precision = 2e-3;
  const Method& method = seen.test_case.method;
  const Particles& particles = seen.scene().model.particles;
  const Stepper* rule = stepper_of(method);
  const bool small = 3 * (particles.size() - static_cast<int>(particles.pins.size())) <= 12;
  if (!small || method.adaptive || !rule || !std::isfinite(rule->limit(1, 0.1)) || !seen.scene().model.find<Springs>())
    return;
  const BaseState base = base_state_of(seen.scene());
  if (!base.at_rest) return;
  const MeasuredLimit measured = measured_limit(method, base, 4000, {}, precision);
  if (measured.kind != MeasuredLimit::found) return;
  out.push_back({"largest stable step", "s", measured.limit()});
  out.back().error_bar = measured.limit() * measured.precision();
}

/// Scale of the numbers that are subtracted: positions, energies, or the ratio of a spring's length to its rest length.
/// The scale of energies is at least that of a motion across the whole scene within its window, in case nothing moves.
double size_of_unit(const std::string& unit, const Scene& scene, const CaseRun& case_run) {
  double most = unit == "1" ? 1 : 0;
  if (unit == "m")
    for (const Points& x : case_run.trajectory.x) most = std::max(most, x.cwiseAbs().maxCoeff());
  if (unit == "J" && !case_run.ledger.empty()) {
    const double speed = scene.size() / scene.window;
    most = scene.model.particles.mass.sum() * speed * speed;
    for (const LedgerRow& row : case_run.ledger)
      most = std::max({most, row.energy.kinetic, row.energy.elastic, std::abs(row.energy.gravitational)});
  }
  return most;
}

/// Counts that rounding cannot change: only for rules with fixed steps that solve no equation to a tolerance.
void counts(const Observation& seen, Quantities& out) {
  const Stepper* rule = seen.test_case.method.stepper;
  if (!rule || rule->adaptive || rule->evaluations == 0) return;
  out.push_back({"steps", "1", static_cast<double>(seen.case_run.outcome.steps), {}, true});
  out.push_back({"force evaluations", "1", static_cast<double>(seen.case_run.outcome.evaluations), {}, true});
}

/// Only for scenes with a closed form: a converged truth would add nothing to the comparison of positions.
void error_against_truth(const Observation& seen, Quantities& out) {
  const Scene& scene = seen.scene();
  const auto truth = exact_truth(scene);
  if (!truth) return;
  out.push_back({error_quantity, "m", largest_rms_distance(seen.path(), truth->trajectory, scene.window)});
  out.back().error_bar = truth->error_bar;
}

/// Settings read back from the engine, to six digits, because single precision rounds them.
void settings(const Observation& seen, Quantities& out) {
  if (!seen.case_run.outcome.readback) return;
  const Readback& readback = *seen.case_run.outcome.readback;
  const auto add = [&out](const std::string& name, const std::string& word) {
    if (!word.empty()) out.push_back({setting_prefix + name, "word", 0, word});
  };
  add("precision", readback.precision);
  if (readback.may_sleep) add("sleeping", *readback.may_sleep ? "on" : "off");
  if (readback.margin) add("margin", fmt::format("{:.6g} m", *readback.margin));
  for (const auto& [name, value] : readback.settings) add(name, value);
}

constexpr void (*table[])(const Observation&, Quantities&) = {settings,
                                                              offsets,
                                                              places,
                                                              energies,
                                                              peak_stretch,
                                                              shape,
                                                              sag,
                                                              period,
                                                              settle_time,
                                                              counts,
                                                              leaving_angle,
                                                              smallest_clearance,
                                                              rebound_height,
                                                              error_against_truth,
                                                              order_of_error,
                                                              change_at_half_the_step,
                                                              largest_stable_step};

/// Quantities of a failed run, evaluated up to half of the time at which it failed.
constexpr void (*table_of_failed[])(const Observation&, Quantities&) = {offsets, places};

/// True if the motion itself failed, which happens at a reproducible time.
bool failed_in_time(Verdict verdict) {
  return verdict != Verdict::ok && verdict != Verdict::unsupported && verdict != Verdict::timeout &&
         verdict != Verdict::crash;
}

}  // namespace

std::string offset_at(double t) { return at_time("offset", t); }
std::string places_at(double t) { return at_time("places along drawn directions", t); }

void settle_time(const Observation& seen, Quantities& out) {
  const auto& rows = seen.case_run.ledger;
  double peak = 0;
  for (const LedgerRow& row : rows) peak = std::max(peak, row.energy.kinetic);
  size_t last = 0;
  for (size_t i = 0; i < rows.size(); ++i)
    if (rows[i].energy.kinetic > 0.01 * peak) last = i;
  // skipped near the end of the run, where another rise of the energy may follow
  if (!(peak > 0) || last + 1 >= rows.size() || rows[last].t > 0.8 * rows.back().t) return;
  const double above = std::log(rows[last].energy.kinetic / (0.01 * peak)),
               below = std::log(std::max(rows[last + 1].energy.kinetic, 1e-9 * peak) / (0.01 * peak));
  const double part = above / (above - below);
  out.push_back({"settle time", "s", rows[last].t + part * (rows[last + 1].t - rows[last].t)});
}

void leaving_angle(const Observation& seen, Quantities& out) {
  constexpr double gap = 1e-3;  // m
  const auto* spheres = seen.scene().model.find<Spheres>();
  const auto* gravity = seen.scene().model.find<Gravity>();
  const Points& start = seen.scene().start.x;
  if (!spheres || spheres->list.size() != 1 || !gravity || start.cols() != 1) return;
  if (std::abs(*clearance(seen.scene(), 0, start)) > 1e-9) return;
  for (int i = 1; i < seen.path().frames(); ++i) {
    const double before = *clearance(seen.scene(), seen.path().t[i - 1], seen.path().x[i - 1]),
                 after = *clearance(seen.scene(), seen.path().t[i], seen.path().x[i]);
    if (after < gap) continue;
    const double part = (gap - before) / (after - before), t = std::lerp(seen.path().t[i - 1], seen.path().t[i], part);
    const Vec3 place = (1 - part) * seen.path().x[i - 1].col(0) + part * seen.path().x[i].col(0);
    const Vec3 up = -gravity->acceleration.normalized(),
               out_of_ball = (place - spheres->list[0].centre_at(t)).normalized();
    out.push_back({"leaving angle", "degrees", std::acos(up.dot(out_of_ball)) * 180 / std::numbers::pi});
    return;
  }
}

std::vector<Quantity> quantities_of(const Case& test_case, const CaseRun& case_run) {
  Quantities all{{"verdict", "word", 0, std::string(name_of(case_run.outcome.verdict))}};
  const auto size = [&test_case](Quantities& list, const CaseRun& by) {
    for (Quantity& q : list)
      if (!q.count && !q.is_word()) q.size = size_of_unit(q.unit, test_case.scene, by);
  };
  if (case_run.outcome.verdict == Verdict::ok) {
    for (const auto add : table) add({test_case, case_run}, all);
    size(all, case_run);
  } else if (failed_in_time(case_run.outcome.verdict)) {
    const CaseRun half = comparable_part(case_run);
    settings({test_case, half}, all);
    if (half.trajectory.frames() > 1)
      for (const auto add : table_of_failed) add({test_case, half}, all);
    size(all, half);
    all.push_back({time_of_failure, "s", case_run.outcome.end});
    // failures are detected at samples, so that a run may cross a threshold one sample or one step later
    const Run run = run_over_window(test_case.scene);
    all.back().error_bar = run.duration / run.samples + 2 * case_run.outcome.step;
  }
  return all;
}

}  // namespace crosscheck
