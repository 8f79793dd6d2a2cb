// Forces, systems and the stepper for a student who writes a part in Python. The macro PART is the index of this part.
#include "../python/remote.h"
#include "pendulum.h"

using coursework::in_python;

template <class Field>
void each_field(Pendulum& p, Field field) {
  field("gravity", p.gravity), field("drag", p.drag), field("mass", p.mass);
  field("stiffness", p.stiffness), field("rest", p.rest);
}

template <class Field>
void each_field(Chain& c, Field field) {
  field("gravity", c.gravity), field("drag", c.drag), field("mass", c.mass);
  field("stiffness", c.stiffness), field("rest", c.rest);
}

#if PART == 0
Vec3 gravity_force(double mass, const Vec3& g) { return in_python<Vec3>("gravity_force", mass, g); }
Vec3 drag_force(double drag, const Vec3& v) { return in_python<Vec3>("drag_force", drag, v); }
#elif PART == 1
Vec3 spring_force(const Vec3& a, const Vec3& b, double stiffness, double rest) {
  return in_python<Vec3>("spring_force", a, b, stiffness, rest);
}
#elif PART == 2
State pendulum_derivative(const Pendulum& pendulum, const State& state) {
  return in_python<State>("pendulum_derivative", pendulum, state);
}
#elif PART == 3
State chain_derivative(const Chain& chain, const State& state) {
  return in_python<State>("chain_derivative", chain, state);
}
#else
State symplectic_step(const Derivative& f, const State& state, double h) {
  return in_python<State>("symplectic_step", f, state, h);
}
#endif

void coursework::offer_official([[maybe_unused]] Python& python) {
#if PART > 0
  python.offer("gravity_force", gravity_force);
  python.offer("drag_force", drag_force);
#endif
#if PART > 1
  python.offer("spring_force", spring_force);
#endif
#if PART > 2
  python.offer("pendulum_derivative", pendulum_derivative);
#endif
#if PART > 3
  python.offer("chain_derivative", chain_derivative);
#endif
}
