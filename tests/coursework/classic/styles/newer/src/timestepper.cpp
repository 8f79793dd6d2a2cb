#include "timestepper.h"

#include <algorithm>
#include <vector>

#include "particlesystem.h"

using State = std::vector<Vector3f>;

static State advanced(const State& x, float h, const State& f) {
  State result(x.size());
  std::transform(x.begin(), x.end(), f.begin(), result.begin(), [h](Vector3f a, Vector3f b) { return a + h * b; });
  return result;
}

void ForwardEuler::takeStep(ParticleSystem* system, float h) {
  const auto x = system->getState();
  system->setState(advanced(x, h, system->evalF(x)));
}

void Trapezoidal::takeStep(ParticleSystem* system, float h) {
  const auto x = system->getState();
  const auto first = system->evalF(x);
  const auto second = system->evalF(advanced(x, h, first));
  system->setState(advanced(advanced(x, 0.5f * h, first), 0.5f * h, second));
}
