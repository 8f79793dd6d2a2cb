// Random trials of verdicts: a small scene is run with a method and a step on either side of its stability limit. The
// verdict is compared with the same run without a stop.
#pragma once

#include <array>

#include "experiments/tables/table.h"
#include "mysim/model/system.h"
#include "mysim/run/observers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/random_scenes.h"

namespace crosscheck::testing_tools {

/// Families of methods whose verdicts are counted separately.
struct TrialFamily {
  std::string_view name;
  std::vector<std::string> methods;
};
inline const std::vector<TrialFamily>& trial_families() {
  static const std::vector<TrialFamily> table = {
      {"symplectic", {"symplectic-euler", "leapfrog", "suzuki4"}},
      {"runge-kutta", {"rk4", "odeint/rk4"}},
      {"growing", {"explicit-euler", "trapezoidal"}},
      {"implicit", {"implicit-euler", "implicit-euler+linear", "implicit-midpoint"}},
      {"position-based", {"xpbd"}},
      {"adaptive", {"dopri5"}},
      {"bullet-explicit", {"bullet/deformable-explicit"}},
      {"bullet-implicit", {"bullet/deformable-implicit"}},
      {"bullet-pbd", {"bullet/pbd", "bullet/pbd+n=10"}},
  };
  return table;
}

/// A random scene and its characteristic rates.
struct TrialScene {
  Scene scene;
  std::string kind;  // kind of body, and a letter per ingredient
  double omega = 0;  // rad/s, fastest vibration at the start
  double gamma = 0;  // 1/s, drag rate
  double beta = 0;   // s, dashpot coefficient divided by stiffness
};

/// One mass, a chain or a net of springs, free or pinned, slack or prestressed. Some have gravity, drag, dashpots,
/// moving pins, wind, or a sphere below, which may move. Lasts 60 to 300 radians of the fastest vibration.
inline TrialScene trial_scene(Random& random) {
  SceneWriter w;
  TrialScene trial;
  const double d = decades(random, 0.05, 0.5), mass = decades(random, 0.01, 1), k = decades(random, 3, 3000);
  const double omega = std::sqrt(k / mass);  // frequency of a single spring and mass
  const int body = whole(random, 0, 2);
  const int nx = body == 0 ? 2 : whole(random, 3, body == 1 ? 7 : 5), ny = body == 2 ? whole(random, 3, 5) : 1;
  const double prestress = chance(random, 0.35) ? random.between(0.5, 0.95) : chance(random, 0.15) ? 1.1 : 1;
  const bool air = body == 2 && chance(random, 0.15), gravity = chance(random, 0.6);
  const bool ball = gravity && chance(random, 0.35), held = !ball || chance(random, 0.3);
  if (chance(random, 0.3)) trial.beta = decades(random, 1e-3, 0.2) / omega;
  // the cloth's position ranges from vertical to flat
  const Vec3 u = body == 1 && chance(random, 0.5) ? Vec3(0, -1, 0) : Vec3(1, 0, 0),
             v = chance(random, 0.5) ? Vec3(0, 0, 1) : Vec3(0, -1, 0);
  const double speed = chance(random, 0.4) ? decades(random, 0.01, 1) * omega * d : 0, off = decades(random, 1e-3, 0.3);
  std::vector<int> pins;
  if (held) {
    if (ny == 1) {
      pins = {0};
      if (nx > 2 && chance(random, 0.5)) pins.push_back(nx - 1);
    } else {
      const int which = whole(random, 0, 2);  // pins: two corners, an edge, or the whole rim
      for (int i = 0; i < nx * ny; ++i) {
        const int x = i % nx, y = i / nx;
        if (which == 0 ? i == 0 || i == nx - 1 : which == 1 ? y == 0 : x == 0 || y == 0 || x == nx - 1 || y == ny - 1)
          pins.push_back(i);
      }
    }
  }
  const auto is_pin = [&](int i) { return std::find(pins.begin(), pins.end(), i) != pins.end(); };
  for (int i = 0; i < nx * ny; ++i) {
    const Vec3 home = d * (i % nx * u + i / nx * v), push = off * d * random.vector(), gait = speed * random.vector();
    const bool pinned = is_pin(i);
    w.particle(pinned ? home : Vec3(home + push), mass * (chance(random, 0.2) ? random.between(0.5, 2) : 1),
               pinned ? Vec3::Zero() : gait);
  }
  const auto join = [&](int a, int b, double length) {
    const double stiffness = k * random.between(0.7, 1.4);
    w.spring(a, b, stiffness, prestress * length, trial.beta * stiffness);
  };
  const bool shear = chance(random, 0.7);
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) {
      const int i = y * nx + x;
      if (x + 1 < nx) join(i, i + 1, d);
      if (y + 1 < ny) join(i, i + nx, d);
      if (shear && x + 1 < nx && y + 1 < ny)
        join(i, i + nx + 1, std::sqrt(2.) * d), join(i + 1, i + nx, std::sqrt(2.) * d);
    }
  trial.kind = body == 0 ? "spring" : body == 1 ? "chain" : "net";
  trial.kind += "-";
  if (!pins.empty()) {
    w.pins(pins);
    if (chance(random, 0.25)) {
      w.motion(random.between(0.1, 1) * d * random.vector(), omega * decades(random, 0.02, 0.5) / 6.28,
               decades(random, 1, 20) / omega);
      trial.kind += "m";
    }
  }
  const double pull = decades(random, 1e-3, 0.3) * omega * omega * d;
  if (gravity) w.gravity({0, -pull, 0}), trial.kind += "g";
  if (chance(random, 0.4)) w.drag(trial.gamma = omega * decades(random, 1e-3, 2)), trial.kind += "d";
  if (trial.beta > 0) trial.kind += "D";
  if (!air && chance(random, 0.2)) {
    w.wind(decades(random, 1e-3, 0.2) * omega * omega * d * random.vector());
    if (chance(random, 0.5)) w.gusts(0.02 * omega * omega * d * random.vector(), whole(random, 1, 1000));
    trial.kind += "w";
  }
  if (prestress < 1) trial.kind += "p";
  const double duration = random.between(60, 300) / omega;
  trial.scene = w.scene("trial", duration, 0.1 / omega, 10);
  Model& model = trial.scene.model;
  if (ball) {
    // the sphere is below the centre of the body, and so close that a falling or swinging body hits it
    const Points& x = trial.scene.start.x;
    const double size = std::max(d, trial.scene.size()), radius = random.between(0.3, 1) * size;
    Vec3 centre = x.rowwise().mean();
    centre += 0.2 * size * random.vector();
    centre.y() = x.row(1).minCoeff() - 1.05 * radius - random.between(0, 0.3) * size;
    Sphere sphere{centre,
                  radius,
                  0.02 * radius,
                  chance(random, 0.7) ? random.between(0, 1) : 0,
                  chance(random, 0.3) ? random.between(0, 1) : 0,
                  {}};
    if (chance(random, 0.2)) sphere.motion = Motion{0.2 * size * random.vector(), omega * 0.02, 10 / omega};
    model.terms.emplace_back(Spheres{{sphere}});
    trial.kind += sphere.motion ? "S" : "s";
  }
  if (air) {
    for (int y = 0; y + 1 < ny; ++y)
      for (int x = 0; x + 1 < nx; ++x) {
        const int i = y * nx + x;
        trial.scene.triangles.push_back({i, i + 1, i + nx});
        trial.scene.triangles.push_back({i + 1, i + nx + 1, i + nx});
      }
    // the pressure is at most a third of the force of a spring stretched by its length
    const double flow = omega * d, density = decades(random, 1e-3, 0.3) * mass / (d * d * d);
    model.terms.emplace_back(Aerodynamics{density, 1, WindSignal{flow * random.vector(), {}}, trial.scene.triangles});
    trial.kind += "a";
  }
  trial.scene.hash = hash_of(trial.scene);
  trial.omega = highest_frequency(model, trial.scene.start);
  return trial;
}

/// Observes the extent and speed of a run at every step, computed from positions alone, and the verdicts of monitors
/// that do not stop the run.
class UnstoppedRun : public Observer {
 public:
  /// Uses two monitors: one observes all steps, the other only the states that verdicts are normally based on.
  /// `most_stretch` and `most_speed`: bounds of a good run.
  UnstoppedRun(const TrialScene& trial, const Run& run, double most_stretch, double most_speed)
      : trial_(trial),
        most_stretch_(most_stretch),
        most_speed_(most_speed),
        all_(trial.scene, run),
        pairs_(trial.scene, run) {}

  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool sample) override {
    if (state.t > 0 || seen_ > 0) ++step_;
    const bool finite = state.x.allFinite() && state.x.cwiseAbs().maxCoeff() < 1e100;
    if (finite)
      measure(state);
    else
      stretch = speed = INFINITY;
    if (left == 0 && step_ > 0 && (stretch > most_stretch_ || speed > most_speed_)) left = step_;
    const Verdict now = all_.observe(state, sample);
    if (by_all == Verdict::ok && (by_all = now) != Verdict::ok) when_all = step_;
    if (by_pairs == Verdict::ok && (sample || pairs_.due(state.t)))
      if ((by_pairs = pairs_.observe(state, sample)) != Verdict::ok) when_pairs = step_;
    return finite ? Verdict::ok : Verdict::nan;
  }
  double largest_ratio() const { return all_.largest_ratio(); }

  double stretch = 0, speed = 0;  // largest ratio of spring length to rest length; largest speed of a particle, m/s
  long left = 0;                  // first step beyond one of the bounds; 0 if there is none
  Verdict by_all = Verdict::ok, by_pairs = Verdict::ok;
  long when_all = 0, when_pairs = 0;  // steps of these verdicts

 private:
  void measure(const State& state) {
    for (const Spring& s : trial_.scene.model.find<Springs>()->list)
      stretch = std::max(stretch, (state.x.col(s.a) - state.x.col(s.b)).norm() / s.rest);
    if (seen_ >= 2) {
      const Points way = state.x - before_.x;
      for (int i = 0; i < way.cols(); ++i)
        if (!trial_.scene.model.particles.pinned[i]) speed = std::max(speed, way.col(i).norm() / (state.t - before_.t));
    }
    std::swap(before_, last_);
    last_.t = state.t, last_.x = state.x;
    ++seen_;
  }

  const TrialScene& trial_;
  double most_stretch_, most_speed_;
  DivergenceMonitor all_, pairs_;
  State before_, last_;
  int seen_ = 0;
  long step_ = 0;
};

/// Largest extent and speed of the reference solution.
struct TrueMotion : Observer {
  explicit TrueMotion(const Model& of) : model(of) {}
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool) override {
    for (const Spring& s : model.find<Springs>()->list)
      stretch = std::max(stretch, (state.x.col(s.a) - state.x.col(s.b)).norm() / s.rest);
    for (int i = 0; i < state.v.cols(); ++i)
      if (!model.particles.pinned[i]) speed = std::max(speed, state.v.col(i).norm());
    return Verdict::ok;
  }
  const Model& model;
  double stretch = 0, speed = 0;  // 1; m/s
};

struct Trial {
  unsigned seed = 0;
  std::string family, method, kind;
  double step = 0, share = 0;  // s; ratio of the step to the limit, or 0 if there is no limit
  long steps = 0;
  double stretch = 0, speed = 0;          // relative to the maxima of the reference solution
  bool within = false;                    // stretch and speed stay within a factor of ten of these maxima to the end
  bool later = false;                     // as `within`, but no longer true in a run ten times as long
  long left = 0;                          // first step beyond the bounds
  Verdict verdict = Verdict::ok;          // based on the states that a run normally observes
  Verdict every = Verdict::ok;            // based on every step
  long when_verdict = 0, when_every = 0;  // steps of these verdicts
  double most = 0;                        // K^ / B of mysim/run/observers.h
  double margin = 0;                      // dimensionless: (limit with all springs stretched far) / step - 1
  bool wrong(Verdict said) const { return within ? said != Verdict::ok : said == Verdict::ok; }
};

/// Stability limit (s) of a rule at the fastest vibration of the scene.
inline double nominal_limit(const Stepper& rule, const TrialScene& trial, double omega) {
  return std::min(rule.limit(omega, trial.gamma + trial.beta * omega * omega), rule.limit(omega, trial.gamma));
}

/// Runs the trial of a seed. Returns nullopt if the method does not support the scene, the step is within 0.5 % of the
/// limit, or the reference solution hardly moves.
inline std::optional<Trial> tried(unsigned seed, bool longer = true) {
  Random random(seed);
  const TrialFamily& family = trial_families()[seed % trial_families().size()];
  Trial trial{.seed = seed, .family = std::string(family.name)};
  trial.method = family.methods[whole(random, 0, static_cast<int>(family.methods.size()) - 1)];
  const Method method = find_method(trial.method);
  const TrialScene drawn = trial_scene(random);
  trial.kind = drawn.kind;
  const Scene& scene = drawn.scene;

  const Stepper* rule = stepper_of(method);
  double limit = rule ? nominal_limit(*rule, drawn, drawn.omega) : 0;
  if (method.adaptive || std::isinf(limit)) limit = 0;
  const double wanted = limit == 0            ? decades(random, 0.02, 5) / drawn.omega
                        : chance(random, 0.5) ? limit * random.between(0.85, 1.15)
                                              : limit * decades(random, 0.2, 3);
  const int samples = std::array{10, 30, 100}[whole(random, 0, 2)];
  const long per_sample = std::max(1L, std::lround(scene.duration / samples / wanted));
  Run run{wanted, wanted * static_cast<double>(per_sample * samples), samples};
  run.tolerance = decades(random, 1e-8, 1e-2);
  run.timed = false;
  trial.step = time_grid(run).h, trial.steps = per_sample * samples, trial.share = limit > 0 ? trial.step / limit : 0;
  if (limit > 0 && std::abs(trial.share - 1) < 0.005) return std::nullopt;
  if (rule && limit > 0)
    trial.margin = nominal_limit(*rule, drawn, highest_frequency_bound(scene.model, scene.start)) / trial.step - 1;

  // reference solution: rk4 at a tenth of its own limit
  const Stepper& exact = stepper("rk4");
  const double fine =
      std::min(trial.step, 0.1 * nominal_limit(exact, drawn, highest_frequency_bound(scene.model, scene.start)));
  const Run fine_run{fine, run.duration, run.samples, 1e-6, false};
  TrueMotion truth(scene.model);
  simulate(exact, ContactRule::coulomb, scene, fine_run, truth);
  if (!(truth.speed > 1e-4 * drawn.omega * scene.size()) || !std::isfinite(truth.speed)) return std::nullopt;

  const auto run_freely = [&](const Run& as) {
    UnstoppedRun freely(drawn, as, 10 * truth.stretch, 10 * truth.speed);
    method.engine(scene, as, freely);
    return freely;
  };
  try {
    const UnstoppedRun freely = run_freely(run);
    trial.stretch = freely.stretch / truth.stretch, trial.speed = freely.speed / truth.speed;
    trial.left = freely.left, trial.within = freely.left == 0;
    trial.verdict = freely.by_pairs, trial.every = freely.by_all;
    trial.when_verdict = freely.when_pairs, trial.when_every = freely.when_all;
    trial.most = freely.largest_ratio();
    // unpinned bodies would only fall farther in a longer run
    const bool held = !scene.model.particles.pins.empty();
    if (longer && held && trial.within && trial.share > 0.8 && trial.verdict == Verdict::ok) {
      Run tenfold = run;
      tenfold.duration *= 10, tenfold.samples *= 10;
      trial.later = run_freely(tenfold).left > 0;
    }
  } catch (const Unsupported&) {
    return std::nullopt;
  }
  return trial;
}

}  // namespace crosscheck::testing_tools
