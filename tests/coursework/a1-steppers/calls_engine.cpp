// Particles on springs as a first-order system, advanced by the student's steppers, for charts that compare them with
// other engines.
#include <cmath>
#include <ctime>

#include "calls.h"
#include "numbers.h"
#include "steppers.h"

namespace coursework {
namespace {

struct Spring {
  std::size_t a, b;
  double stiffness, rest;
};

/// State x holds all positions, then all velocities: x' = v, v' = (springs + drag) / m + g. Fixed particles do not
/// move.
struct Particles {
  explicit Particles(Reader& in) {
    count = in.count();
    for (std::size_t i = 0; i < count; ++i) {
      mass.push_back(in.number());
      drag.push_back(in.number());
      held.push_back(in.number() != 0);
    }
    gravity = in.numbers(3);
    for (std::size_t left = in.count(); left > 0; --left) {
      const std::size_t a = in.count(), b = in.count();
      const double stiffness = in.number(), rest = in.number();
      springs.push_back({a, b, stiffness, rest});
    }
    start = in.numbers(6 * count);
  }

  State rates(const State& x) const {
    const std::size_t all = 3 * count;
    State out(2 * all, 0.0);
    const auto pull = [&](std::size_t particle, std::size_t axis, double force) {
      out[all + 3 * particle + axis] += force / mass[particle];
    };
    for (const Spring& s : springs) {
      double d[3];
      for (std::size_t k = 0; k < 3; ++k) d[k] = x[3 * s.a + k] - x[3 * s.b + k];
      const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      if (length == 0) continue;  // coincident ends: no force
      for (std::size_t k = 0; k < 3; ++k) {
        const double force = s.stiffness * (length - s.rest) * d[k] / length;
        pull(s.a, k, -force);
        pull(s.b, k, force);
      }
    }
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = 3 * i + k;
        if (held[i]) {
          out[all + at] = 0;
          continue;
        }
        out[at] = x[all + at];
        out[all + at] += gravity[k] - drag[i] / mass[i] * x[all + at];
      }
    return out;
  }

  std::size_t count;
  std::vector<double> mass, drag;  // kg, N s/m
  std::vector<bool> held;
  Numbers gravity;  // m/s^2
  std::vector<Spring> springs;
  State start;
};

}  // namespace

/// engine.RULE. Input: step (s), steps between samples, number of samples, then the input of Particles. Output: state
/// at the start and at each sample, number of evaluations of the right-hand side, and CPU time of the steps (s).
bool answer_engine(const std::string& call, const Numbers& in, Numbers& out) {
  const auto step = call == "engine.euler"         ? euler_step
                    : call == "engine.trapezoidal" ? trapezoidal_step
                    : call == "engine.rk4"         ? rk4_step
                                                   : nullptr;
  if (!step) return false;
  Reader reader(in);
  const double h = reader.number();
  const int between = reader.integer(), samples = reader.integer();
  const Particles particles(reader);
  double evaluations = 0;
  const Derivative f = [&](double, const State& x) {
    ++evaluations;
    return particles.rates(x);
  };
  State x = particles.start;
  out = x;
  const std::clock_t begin = std::clock();
  for (int sample = 0; sample < samples; ++sample) {
    for (int i = 0; i < between; ++i) x = step(f, h * (static_cast<double>(sample) * between + i), x, h);
    if (x.size() != particles.start.size()) throw Unusable("state_size");
    out.insert(out.end(), x.begin(), x.end());
  }
  out.push_back(evaluations);
  out.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  return true;
}

}  // namespace coursework
