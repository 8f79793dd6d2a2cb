// Seeded, smooth gusts.
#include "mysim/terms/wind.h"

#include <numbers>

#include "mysim/base/random.h"
#include "mysim/portable_trigonometry.h"

namespace crosscheck {

Gust::Gust(int seed, int channel) {
  std::mt19937_64 engine(1000003ull * static_cast<unsigned>(seed) + static_cast<unsigned>(channel));
  double total = 0;
  for (Wave& wave : waves) {
    // frequencies of 0.2 to 1.2 Hz: slow enough for every step in use, fast enough for gusts
    wave = {0.5 + uniform(engine), 2 * std::numbers::pi * (0.2 + uniform(engine)),
            2 * std::numbers::pi * uniform(engine)};
    total += wave.weight;
  }
  for (Wave& wave : waves) wave.weight /= total;
}

double Gust::at(double t) const {
  double sum = 0;
  for (const Wave& wave : waves) sum += wave.weight * portable_sin(wave.omega * t + wave.phase);
  return sum;
}

Vec3 WindSignal::at(double t) const {
  if (!gusts) return mean;
  return mean * (1 + gusts->variation * gusts->along.at(t)) + gusts->side * gusts->across.at(t);
}

void add_force(const Wind& wind, const Particles& particles, const State& state, Forces& forces) {
  const Vec3 a = wind.acceleration.at(state.t);
  for (int i = 0; i < particles.size(); ++i) forces.f.col(i) += particles.mass[i] * a;
}

}  // namespace crosscheck
