// A chain and a cloth hang from their upper ends. Their sag, and the period of their vertical oscillation, show the
// effective stiffness that a method produces. Loads are so small that strains remain below some thousandths; the sag is
// then proportional to 1 / k, and the period to 1 / sqrt(k).
#include "experiments/stiffness/effective.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "experiments/measures.h"
#include "experiments/metrics.h"
#include "experiments/period.h"
#include "experiments/tables/stiffness.h"
#include "reference/bullet/parameters.h"

namespace crosscheck {
namespace {

struct Net {
  std::string name;
  std::string text;  // text of the scene file, without drag
  double omega;      // rad/s, approximate frequency of the slowest vibration along gravity
};

constexpr double load = 0.05;  // m/s^2

std::string heading(double h) {
  return fmt::format(
      "question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 1\nstep = {}\nwindow = 1\ntolerance = "
      "1e-6\n"
      "method = \"leapfrog\"\n[gravity]\nacceleration = [0, {}, 0]\n",
      h, -load);
}

/// Chain of masses of 50 g on springs of 200 N/m and 0.1 m. The slowest vibration of n masses with one fixed end has
/// the frequency 2 sqrt(k/m) sin(pi / (4 n + 2)).
Net hanging_chain_of(int masses) {
  const double mass = 0.05, k = 200;
  std::string text = heading(1e-3);
  for (int i = 0; i <= masses; ++i)
    text += fmt::format("[[particle]]\nposition = [0, {}, 0]\nmass = {}\n", -0.1 * i, mass);
  for (int i = 0; i < masses; ++i) text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\n", i, i + 1, k);
  text += "[pins]\nparticles = [0]\n";
  return {fmt::format("chain of {}", masses), std::move(text),
          2 * std::sqrt(k / mass) * std::sin(std::numbers::pi / (4 * masses + 2))};
}

/// Cloth of particles of 10 g on structural, shear and bend springs of 50 N/m, pinned along the upper edge. A column of
/// n rows below the edge behaves approximately like a chain of structural springs, which suffices to choose a duration.
Net hanging_cloth_of(int side) {
  std::string text =
      heading(1e-3) + fmt::format(
                          "[grid]\nsize = [{0}, {0}]\norigin = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, -1, 0]\nmass = "
                          "{1}\n[grid.stiffness]\nstructural = 50\nshear = 50\nbend = 50\n[pins]\nparticles = [0",
                          side, 0.01 * side * side);
  for (int i = 1; i < side; ++i) text += fmt::format(", {}", i);
  return {fmt::format("cloth of {0} x {0}", side), text + "]\n",
          2 * std::sqrt(50 / 0.01) * std::sin(std::numbers::pi / (4 * (side - 1) + 2))};
}

/// Depth (m) of the lowest particle below its start at the end of a run with drag of rate omega. Returns nullopt if the
/// run fails, or if the depth changes by more than a thousandth in the last quarter of the run.
std::optional<double> sag(const Net& net, const Method& method, double step) {
  const Scene scene = parse_scene(net.text + fmt::format("[drag]\ngamma = {}\n", net.omega), "hanging-net");
  Recorder recorder;
  // drag of rate omega reduces a vibration of frequency omega or above to exp(-omega t / 2), and a vibration of a fifth
  // of that frequency (of a net that is 25 times softer) to exp(-omega t / 24): after 80 / omega at most a thirtieth is
  // left
  const Outcome out = run_method(method, scene, {step, 80 / net.omega, 4, 1e-6, false}, {&recorder});
  if (out.verdict != Verdict::ok) return std::nullopt;
  const auto depth = [&](int frame) {
    return (recorder.trajectory.x[0].row(1) - recorder.trajectory.x[frame].row(1)).maxCoeff();
  };
  const double last = depth(4);
  return last > 0 && std::abs(last - depth(3)) < 1e-3 * last ? std::optional(last) : std::nullopt;
}

/// Period (s) of the centre of mass after the net is released, without drag. Returns nullopt if the run fails, if the
/// method's own damping leaves fewer than three turning points, or if the step is too long to resolve them.
std::optional<double> period(const Net& net, const Method& method, double step) {
  const Scene scene = parse_scene(net.text, "hanging-net");
  // four periods of a net that may be ten times as soft
  const double duration = 4 * 3 * 2 * std::numbers::pi / net.omega;
  Recorder recorder;
  const int steps = static_cast<int>(std::ceil(duration / step));
  const Outcome out = run_method(method, scene, {step, steps * step, steps, 1e-6, false}, {&recorder});
  if (out.verdict != Verdict::ok) return std::nullopt;
  std::vector<Vec3> path;
  for (const Points& x : recorder.trajectory.x) path.push_back(centre_of_mass(scene, x));
  const auto found = period_of_path(recorder.trajectory.t, path);
  // a parabola through three samples locates a turning point if turning points are at least six steps apart
  return found && *found >= 12 * step ? found : std::nullopt;
}

/// A method to be tried at several steps and numbers of iterations. `sub_steps`: the method makes one pass per step, so
/// its step is divided instead.
struct Choice {
  std::string_view method;
  enum class Iterations { none, option, sub_steps } iterations;
};
constexpr Choice choices[] = {{"bullet/pbd", Choice::Iterations::option},
                              {"mysim/xpbd", Choice::Iterations::sub_steps},
                              {"bullet/deformable-implicit", Choice::Iterations::none}};

void measure(const Net& net, bool full, TableSet& tables) {
  Table table = table_of<EffectiveStiffnessRow>();
  const Scene scene = parse_scene(net.text, "hanging-net");
  const Spring& spring = scene.model.find<Springs>()->list.back();
  const double mu = bullet::pair_mass(scene.model.particles, spring);
  const double expected_sag = sag_of(scene).value(),
               expected_period = period(net, find_method("mysim/rk4"), 0.1 / std::sqrt(spring.k / mu)).value();
  std::vector<double> steps = {1. / 30, 1. / 60, 1. / 120, 1. / 240, 1. / 480};
  if (full) steps.insert(steps.end(), {1. / 960, 1. / 1920});
  std::vector<int> iterations = {1, 4, 16};
  if (full) iterations.push_back(64);
  for (const Choice& choice : choices)
    for (const int n : iterations)
      for (const double h : steps) {
        if (choice.iterations == Choice::Iterations::none && n > 1) continue;
        const bool option = choice.iterations == Choice::Iterations::option;
        const Method method =
            find_method(option ? fmt::format("{}+n={}", choice.method, n) : std::string(choice.method));
        const double step = choice.iterations == Choice::Iterations::sub_steps ? h / n : h;
        EffectiveStiffnessRow row{.net = net.name,
                                  .method = std::string(choice.method),
                                  .step = h,
                                  .iterations = n,
                                  .stiffness = spring.k * h * h / mu,
                                  .expected_sag = expected_sag,
                                  .sag = sag(net, method, step),
                                  .expected_period = expected_period,
                                  .period = period(net, method, step)};
        if (row.sag) row.by_sag = expected_sag / *row.sag;
        if (row.period) row.by_period = std::pow(expected_period / *row.period, 2);
        add(table, row);
      }
  tables.add(table);
}

}  // namespace

std::vector<Point> effective_stiffness_points(bool full) {
  std::vector<Point> points;
  for (const Net& net : {hanging_chain_of(8), hanging_cloth_of(6)})
    points.push_back({fmt::format("stiffness: effective, {}", net.name), full ? "full" : "quick",
                      [net, full](TableSet& tables) { measure(net, full, tables); }});
  return points;
}

}  // namespace crosscheck
