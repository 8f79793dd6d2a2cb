// The classic Runge-Kutta rule of order four for submissions that declare it and rely on others to define it. STEPPERS
// is the submission's header; the archive that holds it is linked last, so that an RK4 of the student's own wins.
#include STEPPERS

#include <vector>

namespace {

std::vector<Vector3f> moved(std::vector<Vector3f> state, float h, const std::vector<Vector3f>& slope) {
  for (std::size_t i = 0; i < state.size() && i < slope.size(); ++i) state[i] = state[i] + h * slope[i];
  return state;
}

/// Some evalF are told the time as well.
template <class S>
auto slope(S* system, std::vector<Vector3f> state, int) -> decltype(system->evalF(state)) {
  return system->evalF(state);
}
template <class S>
auto slope(S* system, std::vector<Vector3f> state, long) -> decltype(system->evalF(state, 0.0f)) {
  return system->evalF(state, 0.0f);
}

}  // namespace

void RK4::takeStep(ParticleSystem* particleSystem, float stepSize) {
  const std::vector<Vector3f> x = particleSystem->getState();
  const std::vector<Vector3f> k1 = slope(particleSystem, x, 0);
  const std::vector<Vector3f> k2 = slope(particleSystem, moved(x, stepSize / 2, k1), 0);
  const std::vector<Vector3f> k3 = slope(particleSystem, moved(x, stepSize / 2, k2), 0);
  const std::vector<Vector3f> k4 = slope(particleSystem, moved(x, stepSize, k3), 0);
  std::vector<Vector3f> next = moved(x, stepSize / 6, k1);
  next = moved(next, stepSize / 3, k2);
  next = moved(next, stepSize / 3, k3);
  particleSystem->setState(moved(next, stepSize / 6, k4));
}
