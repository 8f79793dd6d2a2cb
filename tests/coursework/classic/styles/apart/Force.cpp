#include "Force.h"

void Weight::addTo(const std::vector<Body>&, std::vector<Vector3f>& sums) const {
  for (Vector3f& sum : sums) sum += g_;
}

void Viscosity::addTo(const std::vector<Body>& bodies, std::vector<Vector3f>& sums) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) sums[i] -= c_ * bodies[i].velocity;
}

void Hooke::addTo(const std::vector<Body>& bodies, std::vector<Vector3f>& sums) const {
  const Vector3f d = bodies[a_].position - bodies[b_].position;
  const Vector3f f = k_ * (d.abs() - rest_) / d.abs() * d;
  sums[a_] -= f;
  sums[b_] += f;
}

std::vector<Vector3f> Mechanics::derivative(const std::vector<Vector3f>& state) const {
  const std::size_t n = state.size() / 2;
  std::vector<Body> bodies(n);
  for (std::size_t i = 0; i < n; ++i) bodies[i] = {state[i], state[n + i]};
  std::vector<Vector3f> sums(n, Vector3f(0));
  for (const auto& force : forces_) force->addTo(bodies, sums);
  std::vector<Vector3f> result(state.begin() + n, state.end());
  result.insert(result.end(), sums.begin(), sums.end());
  for (int i : held_) result[n + i] = Vector3f(0);
  return result;
}
