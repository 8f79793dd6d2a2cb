// A closed form, two independent routes refined until they agree, or the converged contact rule.
#include "reference/truth/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "mysim/base/errors.h"
#include "mysim/model/system.h"
#include "mysim/run/observers.h"
#include "reference/method.h"
#include "reference/truth/cache.h"
#include "reference/truth/exact/exact.h"
#include "reference/truth/independent/integrators.h"
#include "reference/truth/multipliers.h"

namespace crosscheck {
namespace {

Truth from_closed_form(const ExactSolution& exact, const Scene& scene, const Run& run) {
  const TimeGrid steps = time_grid(run);
  Truth truth{Tier::exact, "closed form: " + exact.formula, {}, 0};
  double path = 0;
  for (int sample = 0; sample <= steps.samples; ++sample) {
    const State s = exact.at(steps.time(sample, 0));
    if (sample > 0) path += (s.x - truth.trajectory.x.back()).norm();
    truth.trajectory.t.push_back(s.t);
    truth.trajectory.x.push_back(s.x);
    truth.trajectory.v.push_back(s.v);
  }
  // an angle is rounded by eps times the angle, so the error grows with the path
  truth.error_bar = 1e-15 * (scene.size() + path);
  return truth;
}

}  // namespace

std::string_view name_of(Tier tier) {
  switch (tier) {
    case Tier::exact:
      return "exact";
    case Tier::exact_discrete:
      return "exact for the discrete rule";
    case Tier::converged:
      return "converged";
    case Tier::another_engine:
      return "another engine";
  }
  return "unknown";
}

std::optional<Truth> truth_of(const Scene& scene, const Run& run) {
  if (const auto exact = exact_solution(scene)) return from_closed_form(*exact, scene, run);
  const auto find = [&] {
    if (!has_contact(scene.model)) return converged_truth(scene, run);
    auto truth = event_truth(scene, run);
    if (!truth) truth = time_stepping_truth(scene, run);
    return truth ? truth : contact_truth(scene, run);
  };
  const auto cache = TruthCache::from_environment();
  return cache ? cache->find_or_compute(scene, run, find) : find();
}

namespace {

/// Samples of one run of a route.
struct RoutePath : Trajectory {
  std::vector<double> contact = {};  // J, energy taken by contact since the start; empty if not observed
};
double apart_in_place(const RoutePath& a, const RoutePath& b, size_t i) { return rms_distance(a.x[i], b.x[i]); }
double apart_in_contact(const RoutePath& a, const RoutePath& b, size_t i) {
  return std::abs(a.contact[i] - b.contact[i]);
}

/// Three runs of one kind, each refined by the same factor.
struct RefinementStudy {
  std::string how;
  double step;   // s, of the fine run; the mean under error control
  double ratio;  // largest factor by which one refinement may lower the error; a larger one is coincidence
  RoutePath coarse, middle, fine;
};

/// Error of a refinement study up to each sample, estimated from the differences of its runs.
class RichardsonEstimate {
 public:
  using Distance = double (*)(const RoutePath&, const RoutePath&, size_t);
  explicit RichardsonEstimate(const RefinementStudy& study, Distance apart = apart_in_place)
      : study_(study), apart_(apart) {}
  /// Error up to sample i, m (or J), estimated as truth.h describes; call it with increasing i. Each refinement divides
  /// the error by r = 2^p. The estimate contains a factor of 3 because r is measured.
  double error_up_to(size_t i) {
    before_ = std::max(before_, apart_(study_.coarse, study_.middle, i));
    last_ = std::max(last_, apart_(study_.middle, study_.fine, i));
    if (!std::isfinite(last_) || !std::isfinite(before_)) return INFINITY;
    const double r = std::min(before_ / last_, study_.ratio);
    return r >= 2 ? 3 * last_ / (r - 1) : last_;
  }
  /// Last difference up to the same sample, m (or J).
  double last_change() const { return last_; }

 private:
  const RefinementStudy& study_;
  Distance apart_;
  double before_ = 0, last_ = 0;
};

/// Error of a route, from its own refinement and from another route.
class ErrorOfTwoRoutes {
 public:
  ErrorOfTwoRoutes(const RefinementStudy& one, const RefinementStudy& other,
                   RichardsonEstimate::Distance apart = apart_in_place)
      : one_(one), other_(other), apart_(apart), own_(one, apart), theirs_(other, apart) {}
  /// Error of the first route at sample i, m (or J), as truth.h describes; call it with increasing i. The second
  /// route's estimate is added to the distance because both routes may err in the same way. An error of order 1 is of
  /// another kind and dominates, so it is not added.
  double error_up_to(size_t i) {
    const double theirs = theirs_.error_up_to(i), own = own_.error_up_to(i),
                 between = apart_(one_.fine, other_.fine, i);
    const double apart = other_.ratio > 2        ? between + theirs
                         : std::isfinite(theirs) ? std::max(between, theirs_.last_change())
                                                 : INFINITY;
    return std::max(apart, own);
  }

 private:
  const RefinementStudy &one_, &other_;
  RichardsonEstimate::Distance apart_;
  RichardsonEstimate own_, theirs_;
};

constexpr int most_followed = 49;  // number of particles that the event-driven route accepts

bool few_particles(const Scene& scene) { return scene.model.particles.size() < 50; }

/// First step (s), from the scene alone: truth must not depend on the run that is compared with it.
double first_step(const Scene& scene, bool constrained) {
  // rk4 is accurate well below h omega = 0.7 and stable up to 2.83, so the first run is at 1.4 or less
  const double omega = scene.model.first_order() ? 0 : highest_frequency(scene.model, scene.start);
  // few particles are cheap, so their steps are short and show an order; hard distances are expensive
  const double part = constrained ? 1 : few_particles(scene) ? 16 : 4;
  return std::min(2 * scene.step / part, omega > 0 ? 1.4 / omega : scene.step);
}

/// mysim's run at one step, under a DivergenceMonitor; nullopt if the run failed. Throws Unsupported if the hard
/// distances depend on each other.
std::optional<RoutePath> run_rk4(const Scene& scene, const Run& run, bool constrained) {
  Recorder recorder;
  Outcome out;
  if (constrained) {
    DivergenceMonitor monitor(scene, run);
    MonitoredObservers look(monitor, {&recorder});
    MultiplierWorld world(scene, time_grid(run).h);
    out = run_loop(world, run, look);
  } else {
    out = run_method(find_method("mysim/rk4"), scene, run, {&recorder});
  }
  if (out.verdict != Verdict::ok) return std::nullopt;
  return RoutePath{std::move(recorder.trajectory)};
}

/// Halves the step from h on, until the result changes little: at least twice, so that an order is visible, and at most
/// `most_halvings` times. `at` runs at a given step (s), and returns nullopt if the run fails; `how` describes a step
/// in ms.
template <class RunAt, class How>
std::optional<RefinementStudy> refine_step(const Scene& scene, double h, int order, int most_halvings, RunAt at,
                                           How how) {
  const double enough = 1e-8 * scene.size();  // far below any scene's needs; few particles reach 1e-11 at once
  std::optional<RoutePath> coarse, middle = at(h);
  double change = INFINITY;
  for (int i = 1; i <= most_halvings && middle; ++i) {
    h /= 2;
    auto fine = at(h);
    if (!fine) return std::nullopt;
    const double before = std::exchange(change, largest_rms_distance(*middle, *fine));
    // if halving no longer helps, only round-off or chaos is left; with contact events, halving helps irregularly
    const bool helps = change <= before / 2 || order < 4;
    if (coarse && (change < enough || !helps || (order < 4 && i == most_halvings)))
      return RefinementStudy{how(1e3 * h),    h, std::exp2(order), std::move(*coarse), std::move(*middle),
                             std::move(*fine)};
    coarse = std::move(middle);
    middle = std::move(fine);
  }
  return std::nullopt;
}

std::optional<RefinementStudy> refine_rk4(const Scene& scene, const Run& run) {
  const bool constrained = scene.model.find<Constraints>() != nullptr;
  return refine_step(
      scene, first_step(scene, constrained), 4, 7,
      [&](double h) {
        return run_rk4(scene, {h, run.duration, run.samples}, constrained);
      },
      [&](double ms) {
        return fmt::format("mysim/rk4 at {:.3g} ms{}", ms,
                           constrained ? ", with Lagrange multipliers for the hard distances" : "");
      });
}

/// Runs at three tolerances, each a tenth of the previous one.
std::optional<RefinementStudy> refine_tolerance(const Scene& scene, const Run& run, double loosest, std::string how,
                                                Outcome (*engine)(const Scene&, const Run&, Observer&)) {
  RefinementStudy study{std::move(how), 0, 10, {}, {}, {}};
  double tolerance = loosest;
  for (RoutePath* path : {&study.coarse, &study.middle, &study.fine}) {
    Recorder recorder;
    const Outcome out = engine(scene, {scene.step, run.duration, run.samples, tolerance}, recorder);
    if (out.verdict != Verdict::ok) return std::nullopt;
    study.step = out.step;
    *path = RoutePath{std::move(recorder.trajectory)};
    tolerance /= 10;
  }
  return study;
}

std::optional<RefinementStudy> refine_bulirsch_stoer(const Scene& scene, const Run& run) {
  // error of a step, relative to the scene's size; round-off is at 1e-16
  return refine_tolerance(
      scene, run, few_particles(scene) ? 1e-11 : 1e-8,
      fmt::format("odeint (Boost {}), Bulirsch-Stoer extrapolation, with an independently written right-hand side",
                  odeint_version()),
      run_odeint_bulirsch_stoer);
}

/// The first samples of a truth; nullopt without samples.
std::optional<Truth> ended_after(size_t samples, Truth truth) {
  if (samples == 0) return std::nullopt;
  Trajectory& path = truth.trajectory;
  if (samples < path.t.size()) truth.until = path.t[samples - 1];
  path.t.resize(samples), path.x.resize(samples), path.v.resize(samples);
  truth.error_bars.resize(samples);
  truth.error_bar = truth.error_bars.back();
  if (!truth.contact.empty()) truth.contact.resize(samples), truth.contact_bars.resize(samples);
  return truth;
}

/// Truth from two routes: the path of `one`, with its error estimated from `other` and both refinements, until the
/// error exceeds `most` (m) or a hundredth of the motion.
std::optional<Truth> truth_of_routes(const Scene& scene, const Run& run, RefinementStudy one,
                                     const RefinementStudy& other, double most = INFINITY) {
  Truth truth{Tier::converged, fmt::format("{}, compared with {}", one.how, other.how), one.fine, 0};
  const auto& x = truth.trajectory.x;
  ErrorOfTwoRoutes of_place(one, other), of_contact(one, other, apart_in_contact);
  const bool contact_known = !one.fine.contact.empty() && !other.fine.contact.empty();
  double contact_bar = 0;
  // one rounding of positions per step, accumulated like a random walk
  const double random_walk = 0.5 * std::numeric_limits<double>::epsilon() * std::sqrt(run.duration / one.step);
  double motion = 0;
  size_t known = 0;
  for (size_t i = 0; i < std::min(x.size(), other.fine.x.size()); ++i) {
    motion = std::max(motion, rms_distance(x[i], x[0]));
    // plus some ulps, by which each route errs regardless of its refinement
    const double place = x[i].norm() / std::sqrt(x[i].cols());
    const double rounding = std::max(random_walk * place, 1e-15 * std::max(scene.size(), place));
    const double error_bar = of_place.error_up_to(i) + rounding;
    truth.error_bar = std::isfinite(error_bar) ? std::max(truth.error_bar, error_bar) : INFINITY;
    truth.error_bars.push_back(truth.error_bar);
    if (contact_known) {
      contact_bar = std::max(contact_bar, of_contact.error_up_to(i));
      truth.contact.push_back(one.fine.contact[i]), truth.contact_bars.push_back(contact_bar);
    }
    if (truth.error_bar < 0.01 * motion && truth.error_bar <= most) known = i + 1;
  }
  return ended_after(known, std::move(truth));
}

}  // namespace

std::optional<Truth> converged_truth(const Scene& scene, const Run& run) try {
  auto rk4_study = refine_rk4(scene, run);
  if (!rk4_study) return std::nullopt;
  const auto odeint_study = refine_bulirsch_stoer(scene, run);
  if (!odeint_study) return std::nullopt;
  auto truth = truth_of_routes(scene, run, std::move(*rk4_study), *odeint_study);
  return truth && std::isinf(truth->until) ? truth : std::nullopt;
} catch (const Unsupported&) {
  return std::nullopt;
} catch (const SolverFailure&) {
  return std::nullopt;
}

namespace {

std::optional<Trajectory> run_leapfrog(const Scene& scene, const Run& run) {
  Recorder recorder;
  if (run_method(find_method("mysim/leapfrog"), scene, run, {&recorder}).verdict != Verdict::ok) return std::nullopt;
  return std::move(recorder.trajectory);
}

/// Energy taken by contact, inferred for both routes from the energy balance; ignores impulses reported by a route.
class MissingEnergy : public Ledger {
 public:
  explicit MissingEnergy(const Model& model) : Ledger(model, ContactLoss::inferred) {}
  void contact(double) override {}
  std::vector<double> at_samples() const {
    std::vector<double> taken;
    for (const LedgerRow& row : rows()) taken.push_back(row.contact);
    return taken;
  }
};

/// True if a particle is closer to a contact surface than 1e-9 of the scene's size, which exceeds position rounding.
bool in_contact(const Scene& scene, double t, const Points& x) {
  const double near = 1e-9 * scene.size();
  const std::vector<Surface> surfaces = surfaces_of(scene.model);
  for (int i = 0; i < x.cols(); ++i)
    if (!scene.model.particles.pinned[i] && clearance_from(surfaces, t, x.col(i)) < near) return true;
  return false;
}

/// First sample with contact, and last sample at which single positions are predictable.
struct SampleRange {
  int touch, end;
};
std::optional<SampleRange> predictable_samples(const Scene& scene, const Trajectory& path) {
  const Particles& particles = scene.model.particles;
  int touch = 0;
  while (touch < path.frames() && !in_contact(scene, path.t[touch], path.x[touch])) ++touch;
  if (touch == path.frames()) return std::nullopt;
  const bool several = particles.size() - static_cast<int>(particles.pins.size()) > 1;
  // A body topples from a sphere of radius R within a few times sqrt(R / g). Cloths of 1 m on a sphere of 1 m were
  // predictable for 0.3 s after their first touch.
  double followed = INFINITY;
  if (const auto* gravity = scene.model.find<Gravity>())
    for (const Surface& surface : surfaces_of(scene.model))
      followed = std::min(followed, std::sqrt(0.9 * surface.radius() / gravity->acceleration.norm()));
  const double until = several ? std::min(scene.window, path.t[touch] + followed) : scene.window;
  int end = 0;
  while (end + 1 < path.frames() && path.t[end + 1] <= until * (1 + 1e-9)) ++end;
  return SampleRange{touch, end};
}

}  // namespace

namespace {

/// The event-driven route at three tolerances, up to the end of the shortest run; nullopt if a run ends before the
/// first sample after the start.
std::optional<RefinementStudy> refine_events(const Scene& scene, const Run& run) {
  RefinementStudy study{
      fmt::format("odeint (Boost {}), Dormand-Prince 5(4) restarted at events, with independently written equations",
                  odeint_version()),
      scene.step,
      10,
      {},
      {},
      {}};
  double tolerance = 1e-10;
  Run shorter = run;
  for (RoutePath* path : {&study.coarse, &study.middle, &study.fine}) {
    Recorder recorder;
    try {
      const Outcome out = run_event_driven(scene, {scene.step, shorter.duration, shorter.samples, tolerance}, recorder);
      if (out.verdict == Verdict::ok) study.step = out.step;
    } catch (const Unsupported&) {
      if (recorder.trajectory.frames() == 0) throw;  // no frames: the scene itself is refused, not only a later state
    }
    *path = RoutePath{std::move(recorder.trajectory)};
    const int end = path->frames() - 1;
    if (end < 1) return std::nullopt;
    shorter.duration = run.duration / run.samples * end, shorter.samples = end;
    tolerance /= 10;
  }
  return study;
}

/// Truth of the first part of a run, with its end; nullopt if the truth ends before or at the first touch, because it
/// then shows nothing about contact.
std::optional<Truth> truth_of_part(const Scene& scene, const Run& run, const Run& part, std::optional<Truth> truth) {
  if (!truth) return std::nullopt;
  if (part.samples < run.samples) truth->until = std::min(truth->until, part.duration);
  if (std::isinf(truth->until)) return truth;
  const Trajectory& known = truth->trajectory;
  int touch = 0;
  while (touch < known.frames() && !in_contact(scene, known.t[touch], known.x[touch])) ++touch;
  return touch + 1 < known.frames() ? std::move(truth) : std::nullopt;
}

std::optional<RefinementStudy> refine_leapfrog_events(const Scene& scene, const Run& run, double first, int halvings) {
  return refine_step(
      scene, first, 2, halvings,
      [&](double h) -> std::optional<RoutePath> {
        Recorder recorder;
        MissingEnergy missing(scene.model);
        const Run at{h, run.duration, run.samples};
        if (run_method(find_method("mysim/leapfrog+events"), scene, at, {&recorder, &missing}).verdict != Verdict::ok)
          return std::nullopt;
        return RoutePath{std::move(recorder.trajectory), missing.at_samples()};
      },
      [](double ms) { return fmt::format("mysim/leapfrog+events at {:.3g} ms", ms); });
}

/// The two finer paths, extrapolated to a step of 0 for an error of order 2. If the error is of this order, the
/// extrapolated paths differ by far less than the error of the fine path; otherwise by as much as before, or more.
RefinementStudy extrapolated(RefinementStudy study) {
  const auto extrapolate = [](RoutePath& fine, const RoutePath& coarse) {
    for (size_t i = 0; i < std::min(fine.x.size(), coarse.x.size()); ++i) fine.x[i] += (fine.x[i] - coarse.x[i]) / 3;
  };
  extrapolate(study.fine, study.middle);
  extrapolate(study.middle, study.coarse);
  study.how += ", extrapolated";
  return study;
}

/// First part of a run, at least one sample, until the route's own estimate exceeds `most` (m).
Run known_part(const RefinementStudy& study, const Run& run, double most) {
  RichardsonEstimate estimate(study);
  int last = 0;
  while (last + 1 < study.fine.frames() && estimate.error_up_to(static_cast<size_t>(last) + 1) <= most) ++last;
  last = std::max(last, 1);
  return {run.step, run.duration / run.samples * last, last};
}

}  // namespace

std::optional<Truth> event_truth(const Scene& scene, const Run& run) try {
  const int n = scene.model.particles.size();
  if (n > most_followed) return std::nullopt;
  auto events = refine_events(scene, run);
  if (!events) return std::nullopt;
  const Trajectory& path = events->fine;
  const Run shared{run.step, path.t.back(), path.frames() - 1};
  // 1e7 steps of a particle take a second or two
  const double first = first_step(scene, false), steps = shared.duration / first * n;
  const int halvings = std::clamp(static_cast<int>(std::log2(1e7 / steps)), 2, 7);
  auto leapfrog = refine_leapfrog_events(scene, shared, first, halvings);
  if (!leapfrog) return std::nullopt;
  auto truth = truth_of_routes(scene, shared, std::move(*events), extrapolated(std::move(*leapfrog)));
  return truth_of_part(scene, run, shared, std::move(truth));
} catch (const Unsupported&) {
  return std::nullopt;
} catch (const SolverFailure&) {
  return std::nullopt;
}

std::optional<Truth> time_stepping_truth(const Scene& scene, const Run& run) try {
  if (scene.model.find<Constraints>() || scene.model.first_order()) return std::nullopt;
  const double omega = highest_frequency(scene.model, scene.start);
  const double first = omega > 0 ? std::min(scene.step, 1.4 / omega) : scene.step;
  // only samples within the scene's comparison window are evaluated
  const double interval = run.duration / run.samples;
  const int most = std::clamp(static_cast<int>(scene.window / interval * (1 + 1e-9)), 1, run.samples);
  const Run seen{run.step, interval * most, most};
  auto events = refine_leapfrog_events(scene, seen, first, 2);
  if (!events) return std::nullopt;
  // a third of the tolerance, which leaves at least two bars for a run's own error
  const double largest_bar = scene.tolerance / 3;
  const Run part = known_part(*events, seen, largest_bar);
  RefinementStudy stepping{"", first / 32, 2, {}, {}, {}};
  stepping.how = fmt::format("Moreau's time stepping at {:.3g} ms, independently written", 1e3 * stepping.step);
  double h = 4 * stepping.step;
  for (RoutePath* path : {&stepping.coarse, &stepping.middle, &stepping.fine}) {
    Recorder recorder;
    MissingEnergy missing(scene.model);
    Observers look({&recorder, &missing});
    if (run_time_stepping(scene, {h, part.duration, part.samples}, look).verdict != Verdict::ok) return std::nullopt;
    *path = RoutePath{std::move(recorder.trajectory), missing.at_samples()};
    h /= 2;
  }
  return truth_of_part(scene, run, part, truth_of_routes(scene, part, std::move(*events), stepping, largest_bar));
} catch (const Unsupported&) {
  return std::nullopt;
} catch (const SolverFailure&) {
  return std::nullopt;
}

std::optional<Truth> contact_truth(const Scene& scene, const Run& run) {
  if (scene.model.find<Constraints>() || scene.model.first_order()) return std::nullopt;
  const auto coarse_run = run_leapfrog(scene, {scene.step, run.duration, run.samples});
  const auto span = coarse_run ? predictable_samples(scene, *coarse_run) : std::nullopt;
  if (!span || span->end <= span->touch) return std::nullopt;
  const int end = span->end;
  std::optional<Trajectory> paths[3];
  double h = scene.step / 4;
  for (auto& path : paths) {
    h /= 2;
    if (!(path = run_leapfrog(scene, {h, run.duration * end / run.samples, end}))) return std::nullopt;
  }
  const auto& [coarse, middle, fine] = paths;

  Truth truth{Tier::converged, "", {}, 1e-15 * scene.size()};
  truth.under_contact_rule = true;
  // one rounding of positions per step in the worst case: smaller differences show no order
  const double noise = std::numeric_limits<double>::epsilon() * scene.size() * run.duration / h;
  double before = 0, last = 0, motion = 0, least = 4;
  for (int i = 0; i <= end; ++i) {
    before = std::max(before, rms_distance(coarse->x[i], middle->x[i]));
    last = std::max(last, rms_distance(middle->x[i], fine->x[i]));
    const double ratio = last > noise ? before / last : 2;
    if (!(ratio >= 1.5)) break;
    least = std::min(least, ratio);
    motion = std::max(motion, rms_distance(fine->x[i], fine->x[0]));
    truth.error_bar = std::max(truth.error_bar, last / (std::min(ratio, 2.0) - 1));
    truth.error_bars.push_back(truth.error_bar);
    truth.until = fine->t[i];
  }
  if (static_cast<int>(truth.error_bars.size()) <= span->touch + 1 || !(truth.error_bar < 0.01 * motion))
    return std::nullopt;
  truth.trajectory = std::move(*paths[2]);
  truth.trajectory.t.resize(truth.error_bars.size());
  truth.trajectory.x.resize(truth.error_bars.size());
  truth.trajectory.v.resize(truth.error_bars.size());
  truth.how = fmt::format(
      "mysim/leapfrog at {:.3g} ms, converged in the step (to order {:.2g} at least) under mysim's contact rule; "
      "other contact rules differ",
      1e3 * h, std::log2(least));
  return truth;
}

}  // namespace crosscheck
