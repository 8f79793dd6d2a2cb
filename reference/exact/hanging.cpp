// What hangs at rest.
#include <functional>

#include "reference/exact/recognise.h"

namespace crosscheck {

std::optional<Points> hanging_rest(const Scene& scene) {
  const Model& model = scene.model;
  const Particles& particles = model.particles;
  const auto* springs = model.find<Springs>();
  const auto a = steady_acceleration(model);
  const int n = particles.size();
  if (!springs || springs->law != SpringLaw::hooke || !a || !(a->norm() > 0) || particles.pins.size() != 1 ||
      particles.move || static_cast<int>(springs->list.size()) != n - 1 ||
      !only<Springs, Dashpots, Gravity, Wind, Drag>(model))
    return std::nullopt;
  std::vector<std::vector<const Spring*>> at(n);
  for (const Spring& s : springs->list) at[s.a].push_back(&s), at[s.b].push_back(&s);

  // from the pin downwards: what a particle carries, itself included; as many springs as free particles reach each of
  // them once, or there is a loop and someone is not reached
  std::vector<char> reached(n, 0);
  std::vector<double> carried(n, 0);  // kg
  std::vector<std::pair<const Spring*, int>> order;
  std::function<void(int)> descend = [&](int i) {
    reached[i] = 1;
    carried[i] = particles.mass[i];
    for (const Spring* s : at[i]) {
      const int below = s->a == i ? s->b : s->a;
      if (reached[below]) continue;
      order.emplace_back(s, below);
      descend(below);
      carried[i] += carried[below];
    }
  };
  descend(particles.pins[0]);
  if (std::ranges::count(reached, 1) != n) return std::nullopt;

  const Vec3 down = a->normalized();
  Points x = scene.start.x;
  for (const auto& [s, below] : order)
    x.col(below) = x.col(s->a + s->b - below) + (s->rest + carried[below] * a->norm() / s->k) * down;
  return x;
}

}  // namespace crosscheck
