// Springs and masses on one line: a sum of normal modes, each of them a damped and perhaps driven oscillator.
#include <fmt/format.h>

#include "reference/exact/driven.h"
#include "reference/exact/linear.h"
#include "reference/exact/recognise.h"

namespace crosscheck {
namespace {

/// A mode about where it would come to rest.
struct Vibration {
  Oscillator free;
  std::optional<DrivenMotion> driven;

  double position(double t) const { return free.position(t) + (driven ? driven->position(t) : 0); }
  double velocity(double t) const { return free.velocity(t) + (driven ? driven->velocity(t) : 0); }
  double largest() const { return free.largest() + (driven ? driven->largest() : 0); }
};

}  // namespace

std::optional<ExactSolution> normal_modes(const Scene& scene) {
  const Particles& particles = scene.model.particles;
  const auto linear = linear_scene(scene);
  if (!linear || !scene.model.find<Springs>()) return std::nullopt;

  std::vector<Vibration> vibrations;
  std::vector<double> centre, amplitude;
  for (const Mode& m : linear->modes) {
    centre.push_back(m.push / m.w2);
    Vibration v{{m.w2, m.drag + m.dashpot, m.u0 - centre.back(), m.v0}, {}};
    if (particles.move) v.driven.emplace(m.w2, m.drag, m.dashpot, m.sway * linear->shake, *particles.move);
    amplitude.push_back(v.largest());
    vibrations.push_back(std::move(v));
  }
  if (!(linear->room(scene.model, centre, amplitude) > 0)) return std::nullopt;
  return ExactSolution{
      fmt::format("{}{}",
                  linear->modes.size() == 1 ? "damped harmonic oscillator about the hanging length"
                                            : "sum of the normal modes of springs and masses on a line",
                  particles.move ? ", driven by the pins" : ""),
      [start = scene.start, particles, modes = linear->modes, vibrations](double t) {
        State s = start;
        s.t = t;
        s.v.setZero();
        for (size_t i = 0; i < modes.size(); ++i) {
          s.x += (vibrations[i].position(t) - vibrations[i].free.u0) * modes[i].shape;
          s.v += vibrations[i].velocity(t) * modes[i].shape;
        }
        particles.place_pins(s);
        return s;
      }};
}

}  // namespace crosscheck
