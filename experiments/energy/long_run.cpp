#include "experiments/energy/long_run.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "experiments/tables/energy.h"
#include "mysim/model/energy.h"
#include "mysim/run/observers.h"

namespace crosscheck {

Verdict ThinnedLedger::observe(const State& state, bool sample) {
  bool look = sample || seen_ % stride_ == 0;
  if (seen_ == next_) {
    look = true;
    next_ = std::max(next_ + 1, std::lround(static_cast<double>(next_) * 1.12));  // twenty per decade
  }
  ++seen_;
  return ledger_.observe(state, look);
}

ResidualStatistics residual_statistics(const std::vector<LedgerRow>& rows) {
  ResidualStatistics run;
  if (rows.size() < 2) return run;
  const LedgerRow &start = rows.front(), &end = rows.back();
  const auto residual = [&](const LedgerRow& row) { return row.balance() - start.balance(); };
  double early = 0, twice_kinetic = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    const LedgerRow& row = rows[i];
    run.energy_scale =
        std::max({run.energy_scale, row.energy.kinetic, std::abs(row.energy.gravitational - start.energy.gravitational),
                  std::abs(row.energy.elastic - start.energy.elastic)});
    run.worst = std::max(run.worst, std::abs(residual(row)));
    if (row.t <= 0.1 * end.t) early = run.worst;
    if (i > 0) twice_kinetic += (row.t - rows[i - 1].t) * (row.energy.kinetic + rows[i - 1].energy.kinetic);
  }
  run.final = residual(end);
  run.growth = early > 0 ? std::log10(run.worst / early) : 0;
  run.equivalent_drag = twice_kinetic > 0 ? -run.final / twice_kinetic : 0;

  // rows are dense at the start, so each row is weighted with the time since the previous row
  double weight = 0, mean_t = 0, mean_r = 0, tt = 0, tr = 0, rr = 0;
  const auto each = [&](auto&& use) {
    for (size_t i = 1; i < rows.size(); ++i) use(rows[i].t - rows[i - 1].t, rows[i].t, residual(rows[i]));
  };
  each([&](double w, double t, double r) { weight += w, mean_t += w * t, mean_r += w * r; });
  mean_t /= weight, mean_r /= weight;
  each([&](double w, double t, double r) {
    tt += w * (t - mean_t) * (t - mean_t), tr += w * (t - mean_t) * (r - mean_r);
    rr += w * (r - mean_r) * (r - mean_r);
  });
  run.drift = tt > 0 ? tr / tt : 0;
  run.oscillation = std::sqrt(std::max(0.0, (rr - run.drift * tr) / weight));
  return run;
}

namespace {

/// |R(i y)|, with the stability function R, for rules that treat x and v alike in a step; nullopt for other rules.
std::optional<double> gain(const std::string& rule, double y) {
  const std::complex<double> z(0, y);
  if (rule == "explicit-euler") return std::abs(1. + z);
  if (rule == "trapezoidal") return std::abs(1. + z + z * z / 2.);
  if (rule == "rk4") return std::abs(1. + z * (1. + z / 2. * (1. + z / 3. * (1. + z / 4.))));
  if (rule == "implicit-euler") return 1 / std::abs(1. - z);
  for (const auto symplectic : {"symplectic-euler", "leapfrog", "suzuki4", "implicit-midpoint"})
    if (rule == symplectic) return 1;
  return std::nullopt;
}

}  // namespace

Scene undamped_oscillator() {
  return parse_scene(
      "question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 1\nstep = 1e-3\nwindow = 1\n"
      "tolerance = 1e-6\nmethod = \"leapfrog\"\n[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\n"
      "position = [0, -1.001, 0]\nmass = 1\n[[spring]]\nends = [0, 1]\nstiffness = 100\nrest = 1\n"
      "[pins]\nparticles = [0]\n",
      "undamped-oscillator");
}

std::optional<double> damping_by_theory(const Method& method, double h, double frequency) {
  const Stepper* rule = stepper_of(method);
  const auto factor = gain(!method.on_one_spring.empty() ? method.on_one_spring
                           : rule                        ? std::string(rule->name)
                                                         : "",
                           h * frequency);
  if (!factor) return std::nullopt;
  return *factor == 1 ? 0 : -2 * std::log(*factor) / h;
}

double decay_rate(std::span<const std::pair<double, double>> points) {
  double n = 0, t1 = 0, y1 = 0, tt = 0, ty = 0;
  for (const auto& [t, y] : points) n += 1, t1 += t, y1 += y, tt += t * t, ty += t * y;
  return -(n * ty - t1 * y1) / (n * tt - t1 * t1);
}

MeasuredDamping measured_damping(const Method& method, double h, int steps) {
  const Scene scene = undamped_oscillator();
  Recorder recorder;
  MeasuredDamping found{run_method(method, scene, {h, h * steps, steps}, {&recorder}), std::nullopt};
  const Trajectory& path = recorder.trajectory;
  std::vector<std::pair<double, double>> logs;
  double first = 0;
  for (int i = 0; i < path.frames(); ++i) {
    if (path.v[i].cols() != path.x[i].cols() || !path.x[i].allFinite()) continue;
    const double energy = energy_of(scene.model, {path.t[i], path.x[i], path.v[i]}).total();
    if (i == 0) first = energy;
    // positions near 1 m are rounded by 1e-16 m, which is 1e-13 of the initial extension of 1 mm; the energy becomes
    // noise only far below this bound
    if (!(energy > 1e-10 * first) || !(energy < 1e10 * first)) break;
    logs.emplace_back(path.t[i], std::log(energy / first));
  }
  if (logs.size() >= 2) found.rate = decay_rate(logs);
  return found;
}

void add_damping(const Method& method, bool full, TableSet& tables) {
  Table table = table_of<DampingRow>();
  std::vector<double> sizes = {0.02, 0.05, 0.1, 0.2, 0.5, 1, 1.5, 3};
  if (full) sizes = {0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5};
  for (const double size : sizes) {
    const double h = size / oscillator_omega;
    const MeasuredDamping found = measured_damping(method, h, full ? 4000 : 1000);
    if (found.outcome.verdict == Verdict::unsupported) continue;
    add(table, DampingRow{.method = method.name,
                          .verdict = found.outcome.verdict,
                          .end = found.outcome.end,
                          .step = h,
                          .h_omega = size,
                          .equivalent_drag = found.rate,
                          .by_theory = damping_by_theory(method, h, oscillator_omega)});
  }
  tables.add(table);
}

}  // namespace crosscheck
