// Experiment `stiffness`: the stiffness of a position-based link in N/m, compared with the formula for it; the validity
// of the formula in a network; and the stiffness of hanging nets, depending on step and iterations (effective.cpp).

#include <fmt/format.h>

#include <cmath>

#include "experiments/experiment.h"
#include "experiments/stiffness/effective.h"
#include "experiments/stiffness/pulled_sheet.h"
#include "experiments/tables/stiffness.h"
#include "reference/bullet/parameters.h"

namespace crosscheck {
namespace {

/// Scene of masses (kg) that hang from a pin on links of stiffness k (N/m) and length 1 m, with gravity g (m/s^2) and
/// drag.
Scene hanging_chain(int masses, double mass, double k, double g, double gamma, double duration, double h) {
  std::string text = fmt::format(
      "question = \"q\"\nparameters = \"p\"\n[time]\nduration = {}\nsamples = 1\nstep = {}\nwindow = {}\n"
      "tolerance = 1e-6\nmethod = \"leapfrog\"\n",
      duration, h, duration);
  for (int i = 0; i <= masses; ++i) text += fmt::format("[[particle]]\nposition = [0, {}, 0]\nmass = {}\n", -i, mass);
  for (int i = 0; i < masses; ++i)
    text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\nrest = 1\n", i, i + 1, k);
  text += fmt::format("[pins]\nparticles = [0]\n[gravity]\nacceleration = [0, {}, 0]\n", -g);
  if (gamma > 0) text += fmt::format("[drag]\ngamma = {}\n", gamma);
  return parse_scene(text, "hanging-chain");
}

/// Displacement of the chain's end at the end of the run, m. The run must be long enough for the chain to come to rest.
double sag(const Scene& scene, const std::string& method) {
  Recorder recorder;
  const Outcome out = run_method(find_method(method), scene, default_run(scene), {&recorder});
  if (out.verdict != Verdict::ok) return NAN;
  const Points &first = recorder.trajectory.x.front(), &last = recorder.trajectory.x.back();
  return first(1, first.cols() - 1) - last(1, last.cols() - 1);
}

/// A mass on a link: it falls by g h^2 in every step and is pulled back by the link. The stiffness is the force divided
/// by the extension at rest. The mass sinks by 1e-4 of the link's length, for which the link's law differs from Hooke's
/// by 5e-5.
Table single_links(bool full, double h) {
  Table table = table_of<LinkStiffnessRow>();
  std::vector<double> shares = {0.02, 0.1, 0.5, 0.9};
  if (full) shares = {0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9};
  for (const int n : {1, 4, 10})
    for (const double kLST : shares) {
      if (std::pow(1 - kLST, -n) > 2000) continue;  // such a link is rigid to three digits
      const double mass = 1, k = bullet::newton_per_metre(kLST, mass, h, n), K = k * h * h / mass,
                   g = 1e-4 * k / mass / (1 + K);
      // the remainder after m steps is (1 + K)^(-m/2): 60 / ln(1 + K) steps leave 1e-13
      const double steps = std::ceil(60 / std::log1p(K)) + 10;
      const double measured =
          mass * g / sag(hanging_chain(1, mass, k, g, 0, steps * h, h), fmt::format("bullet/pbd+n={}", n));
      add(table, LinkStiffnessRow{kLST, h, n, k, measured, measured / k - 1});
    }
  return table;
}

/// Chains of three masses: their sag relative to the exact sag, for several values of k h^2 / mu of the links between
/// masses (mu = m / 2).
Table networks(bool full, int n) {
  Table table = table_of<NetworkStiffnessRow>();
  const double mass = 0.1, k = 1000, g = 0.0981, expected = mass * g / k * 6;  // strain 3e-5 at most
  std::vector<double> steps = {1. / 60, 1. / 120, 1. / 240, 1. / 480, 1. / 960, 1. / 1920};
  if (full) steps.push_back(1. / 3840);
  for (const double h : steps) {
    // with a drag of 20/s, e^-20 of the sag is left after 2 s
    const double found = sag(hanging_chain(3, mass, k, g, 20, 2, h), fmt::format("bullet/pbd+n={}", n));
    add(table, NetworkStiffnessRow{k * h * h / (mass / 2), h, n, expected, found, found / expected - 1});
  }
  return table;
}

}  // namespace

std::vector<Point> stiffness_points(const Request& request) {
  if (request.scenes_only) return {};
  const bool full = request.full;
  const std::string content = full ? "full" : "quick";
  std::vector<Point> points;
  for (const double h : {1. / 60, 1. / 240, 1. / 1000})
    points.push_back({fmt::format("stiffness: one link at {:.3g} s", h), content,
                      [=](TableSet& tables) { tables.add(single_links(full, h)); }});
  for (const int n : {1, 10})
    points.push_back({fmt::format("stiffness: chain, {} iterations", n), content,
                      [=](TableSet& tables) { tables.add(networks(full, n)); }});
  for (Point& point : effective_stiffness_points(full)) points.push_back(std::move(point));
  for (Point& point : pulled_sheet_points()) points.push_back(std::move(point));
  return points;
}

}  // namespace crosscheck
