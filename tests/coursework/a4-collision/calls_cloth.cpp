// Calls of part 5. A cloth is encoded as the number of particles, masses, number of pins, pins, number of springs, `a`,
// `b`, `k`, `rest` of each spring, gravity and drag; its state follows.
#include "calls.h"
#include "calls_read.h"

namespace coursework {
namespace {

Cloth read_cloth(Reader& in) {
  Cloth cloth;
  cloth.mass = in.numbers(in.integer());
  for (int left = in.integer(); left > 0; --left) cloth.pins.push_back(in.integer());
  cloth.springs.resize(in.integer());
  for (Spring& s : cloth.springs) {
    s.a = in.integer();
    s.b = in.integer();
    s.k = in.number();
    s.rest = in.number();
  }
  cloth.gravity = in.vector<Vec3>();
  cloth.drag = in.number();
  return cloth;
}

}  // namespace

/// accelerations (cloth, state): acceleration of each particle.
/// cloth_step (cloth, state, number of spheres, spheres, h, steps): position and velocity of each particle at the end.
/// cloth_path (the same arguments, then a particle): position of this particle after each step.
bool answer_cloth(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "accelerations" && call != "cloth_step" && call != "cloth_path") return false;
  Reader reader(in);
  const Cloth cloth = read_cloth(reader);
  const std::size_t count = cloth.mass.size();
  State state = read_state<State>(reader, count);
  if (call == "accelerations") {
    put(out, accelerations(cloth, state));
    return true;
  }
  std::vector<Sphere> spheres;
  for (int left = reader.integer(); left > 0; --left) spheres.push_back(read_sphere(reader));
  const double h = reader.number();
  const int steps = reader.integer();
  const int watched = call == "cloth_path" ? reader.integer() : -1;
  for (int n = 0; n < steps; ++n) {
    advance(state, "cloth_step", [&](const State& now) { return cloth_step(cloth, spheres, now, h); });
    if (watched >= 0) put(out, state.x.at(watched));
  }
  if (watched < 0) put_state(out, state);
  return true;
}

}  // namespace coursework
