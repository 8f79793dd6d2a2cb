// Calls of part 4. The input is a sphere, g (3), h, number of steps, number of particles, state.
#include <algorithm>
#include <cmath>
#include "calls.h"
#include "calls_read.h"

namespace coursework {
namespace {

// computed without the student's gap()
double height_over(const Sphere& sphere, const Vec3& x) {
  return length(x - sphere.centre) - sphere.radius - sphere.margin;
}

struct Run {
  Sphere sphere;
  Vec3 g;
  double h;
  int steps;
  State state;

  void step() {
    advance(state, "contact_step", [&](const State& now) { return contact_step(sphere, now, g, h); });
  }
};

Run read_run(Reader& in) {
  Run run;
  run.sphere = read_sphere(in);
  run.g = in.vector<Vec3>();
  run.h = in.number();
  run.steps = in.integer();
  run.state = read_state<State>(in, in.count());
  return run;
}

/// Angle from the vertical (degrees) and speed (% of sqrt(g R)) after the last step that ended on the surface.
Numbers leaving(Run run) {
  const double radius = run.sphere.radius + run.sphere.margin, weight = length(run.g);
  const Vec3 up = -run.g / weight;
  double angle = 0, speed = 0;
  for (int n = 0; n < run.steps; ++n) {
    run.step();
    const Vec3 d = run.state.x[0] - run.sphere.centre;
    const double height = height_over(run.sphere, run.state.x[0]);
    if (!(height < 0.1 * radius)) break;
    if (height > 1e-9 * radius) continue;
    angle = std::acos(dot(d, up) / length(d)) * 180 / 3.14159265358979323846;
    speed = 100 * length(run.state.v[0]) / std::sqrt(weight * radius);
  }
  return {angle, speed};
}

/// Greatest height over the surface between the first two contacts, in % of the initial height.
Numbers rebound(Run run) {
  const double start = height_over(run.sphere, run.state.x[0]);
  bool touched = false;
  double highest = 0;
  for (int n = 0; n < run.steps; ++n) {
    run.step();
    const double height = height_over(run.sphere, run.state.x[0]);
    const bool touches = height <= 1e-9 * run.sphere.radius;
    if (touches && highest > 1e-3 * start) break;
    touched = touched || touches;
    if (touched) highest = std::max(highest, height);
  }
  return {100 * highest / start};
}

}  // namespace

/// contact_step: position and velocity of each particle after all steps. contact_path: position of the first particle
/// after each step. leaving, rebound: the results of the functions above for the first particle.
bool answer_step(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "contact_step" && call != "contact_path" && call != "leaving" && call != "rebound") return false;
  Reader reader(in);
  Run run = read_run(reader);
  if (call == "leaving") {
    out = leaving(run);
  } else if (call == "rebound") {
    out = rebound(run);
  } else {
    for (int n = 0; n < run.steps; ++n) {
      run.step();
      if (call == "contact_path") put(out, run.state.x.at(0));
    }
    if (call == "contact_step") put_state(out, run.state);
  }
  return true;
}

}  // namespace coursework
