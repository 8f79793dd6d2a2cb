// Experiment `energy`: energies, losses and the residual of the energy balance in runs of up to a hundred thousand
// steps.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/energy/long_run.h"
#include "experiments/estimate.h"
#include "experiments/experiment.h"
#include "experiments/tables/energy.h"

namespace crosscheck {
namespace {

constexpr long all_steps = 100000;
constexpr int samples = 200;
/// Factor by which steps of implicit rules, which are meant for long steps, exceed the scene's.
constexpr int longer = 10;

/// All sources and sinks of energy: a cloth with two moving pins, gusts, a ball, drag and dashpots.
Scene everything() {
  return parse_scene(
      "question = \"Where does the energy go when everything acts at once?\"\n"
      "parameters = \"5 x 5 particles, as soft as a step of 1 ms allows with room to spare\"\n"
      "[time]\nduration = 5\nsamples = 100\nstep = 1e-3\nwindow = 5\ntolerance = 1e-3\nmethod = \"leapfrog\"\n"
      "[grid]\nsize = [5, 5]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\nv = [0, -1, 0]\nmass = 0.25\n"
      "dashpot = 0.01\n[grid.stiffness]\nstructural = 30\nshear = 30\nbend = 30\n"
      "[pins]\nparticles = [0, 4]\n[pins.motion]\namplitude = [0, 0, 0.15]\nfrequency = 0.5\nramp = 0.5\n"
      "[gravity]\nacceleration = [0, -9.81, 0]\n[drag]\ngamma = 0.5\n"
      "[wind]\nacceleration = [0, 0, 2]\n[wind.gusts]\nvariation = 1\nside = [1, 0, 0]\nseed = 5\n"
      "[sphere]\ncentre = [0, -0.8, 0.45]\nradius = 0.4\nmargin = 0.02\nfriction = 0.3\n",
      "all-at-once");
}

/// Length of all runs, in steps of the scene: as many as the representative of the slowest engine takes within a CPU
/// budget. In a full run the budget suffices for all steps of a cloth of 10 x 10.
long steps_for(const Request& request, const Scene& scene) {
  const double budget = request.full ? 2.5 : 0.9;  // s
  double of_all = 0;
  for (const Method& method : builtin_methods())
    if (method.family().by_default() && method.name == method.family().representative)
      of_all = std::max(of_all, estimated_seconds(method, scene, all_steps));
  return std::clamp(static_cast<long>(all_steps * budget / of_all) / samples * samples, 1000l, all_steps);
}

EnergyRow summary_of(const Scene& scene, const Method& method, const Outcome& out, const ThinnedLedger& ledger) {
  const Model& model = scene.model;
  const Stepper* rule = stepper_of(method);
  const std::vector<LedgerRow>& rows = ledger.rows();
  const bool claimed = !ledger.contact_inferred(), empty = out.verdict == Verdict::unsupported || rows.empty();
  EnergyRow row{.scene = scene.name,
                .method = method.name,
                .verdict = out.verdict,
                .reason = out.reason,
                .end = out.end,
                .step = out.step,
                .steps = out.steps,
                .undamped = !model.find<Drag>() && !model.find<Dashpots>() && !has_contact(model),
                .symplectic = rule && rule->symplectic,
                .closure_claimed = claimed && !empty,
                .contact_inferred = has_contact(model) && !claimed};
  if (empty) return row;
  const LedgerRow &start = rows.front(), &end = rows.back();
  const ResidualStatistics all = residual_statistics(rows);
  if (claimed) {
    row.largest_residual = all.worst, row.residual = all.final, row.drift = all.drift;
    row.oscillation = all.oscillation, row.growth = all.growth, row.equivalent_drag = all.equivalent_drag;
  }
  row.turned_over = all.energy_scale;
  row.kinetic_at_start = start.energy.kinetic, row.elastic_at_start = start.energy.elastic;
  row.kinetic = end.energy.kinetic, row.elastic = end.energy.elastic;
  row.gravity = start.energy.gravitational - end.energy.gravitational;
  row.drag = end.drag, row.dashpots = end.dashpots, row.contact = end.contact;
  row.wind = end.wind, row.pins = end.pins;
  return row;
}

/// Adds 200 rows at equal intervals and, to resolve the beginning, the first 40 rows and rows at indices that grow by a
/// factor of 1.12.
void add_thinned(Table& table, const Method& method, const ThinnedLedger& ledger, double duration) {
  const std::vector<LedgerRow>& rows = ledger.rows();
  double worst = 0, next = 0;
  size_t kept = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    const LedgerRow& now = rows[i];
    const double residual = now.balance() - rows.front().balance();
    worst = std::max(worst, std::abs(residual));
    const bool even = now.t >= next - 1e-9 * duration;
    const bool first = i < 40 || static_cast<double>(i) >= 1.12 * static_cast<double>(kept);
    if (!even && !first && i + 1 < rows.size()) continue;
    if (even) next += duration / samples;
    kept = i;
    SceneLedgerRow row{.method = method.name,
                       .t = now.t,
                       .kinetic = now.energy.kinetic,
                       .elastic = now.energy.elastic,
                       .gravitational = now.energy.gravitational,
                       .drag = now.drag,
                       .dashpots = now.dashpots,
                       .contact = now.contact,
                       .wind = now.wind,
                       .pins = now.pins};
    if (!ledger.contact_inferred()) row.residual = residual, row.largest_residual = worst;
    add(table, row);
  }
}

void long_run(const Request& request, const Scene& scene, const Method& method, TableSet& tables) {
  const long steps = steps_for(request, scene);
  const double step = request.step > 0 ? request.step : scene.step;
  Run run = default_run(scene);
  run.duration = step * static_cast<double>(steps);
  run.samples = samples;
  run.timed = false;
  run.step = request.step == 0 && method.implicit ? longer * step : step;
  if (steps < all_steps)
    tables.notes.push_back(fmt::format("energy takes {} steps instead of {} on {}, which has {} particles{}", steps,
                                       all_steps, scene.name, scene.model.particles.size(),
                                       request.full ? "" : "; --full takes more"));

  // estimates the run first, because an adaptive rule may take millions of steps for stiff springs
  if (const double seconds = method.adaptive ? estimated_as_it_begins(method, scene, run) : 0; seconds > 30) {
    tables.notes.push_back(
        fmt::format("energy leaves out {} on {}: a run of {:.3g} s would take about {:.0f} s of CPU time", method.name,
                    scene.name, run.duration, seconds));
    return;
  }

  // twenty thousand observations suffice to find the largest residual, and take less time than the steps themselves
  ThinnedLedger ledger(scene.model, method.contact, std::max(1l, steps / 20000));
  const Outcome out = run_method(method, scene, run, {&ledger});
  if (out.verdict == Verdict::ok && ledger.rows().empty())
    tables.notes.push_back(fmt::format("energy leaves out {} on {}: no velocities", method.name, scene.name));
  Table summary = table_of<EnergyRow>();
  add(summary, summary_of(scene, method, out, ledger));
  Table table = table_of<SceneLedgerRow>(scene.name + "-ledger");
  if (out.verdict != Verdict::unsupported) add_thinned(table, method, ledger, run.duration);
  tables.add(summary);
  tables.add(table);
}

}  // namespace

std::vector<Point> energy_points(const Request& request) {
  std::vector<Scene> scenes = request.scenes;
  if (!request.scenes_only) scenes.push_back(everything());
  std::vector<Point> points;
  for (const Scene& scene : scenes) {
    if (scene.model.first_order()) {
      points.push_back({"energy: " + scene.name, content_of(request, scene), [name = scene.name](TableSet& tables) {
                          tables.notes.push_back(
                              fmt::format("energy leaves out {}: a first-order system has no energy", name));
                        }});
      continue;
    }
    for (const Method& method : methods_of(request, scene)) {
      Request alone = request;
      alone.methods = {method};
      points.push_back({fmt::format("energy: {} by {}", scene.name, method.name), content_of(alone, scene),
                        [=](TableSet& tables) { long_run(alone, scene, method, tables); }});
    }
  }
  if (request.scenes_only) return points;
  const Scene oscillator = undamped_oscillator();
  for (const Method& method : methods_of(request, oscillator)) {
    if (method.adaptive) continue;
    Request alone = request;
    alone.methods = {method};
    points.push_back({fmt::format("energy: numerical damping of {}", method.name), content_of(alone, oscillator),
                      [=, full = request.full](TableSet& tables) { add_damping(method, full, tables); }});
  }
  return points;
}

}  // namespace crosscheck
