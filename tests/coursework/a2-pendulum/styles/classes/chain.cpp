// Particles and springs as objects of their own.
#include "pendulum.h"

namespace {

class Particle {
 public:
  Particle(double mass, const Vec3& position, const Vec3& velocity) : mass_(mass), x_(position), v_(velocity) {}
  void push(const Vec3& force) { force_ += force; }
  const Vec3& position() const { return x_; }
  const Vec3& velocity() const { return v_; }
  Vec3 acceleration() const { return force_ / mass_; }
  double mass() const { return mass_; }

 private:
  double mass_;
  Vec3 x_, v_, force_;
};

class Spring {
 public:
  Spring(Particle& one, Particle& other, double stiffness, double rest)
      : one_(one), other_(other), stiffness_(stiffness), rest_(rest) {}
  void pull() const {
    one_.push(spring_force(one_.position(), other_.position(), stiffness_, rest_));
    other_.push(spring_force(other_.position(), one_.position(), stiffness_, rest_));
  }

 private:
  Particle &one_, &other_;
  double stiffness_, rest_;
};

}  // namespace

State chain_derivative(const Chain& chain, const State& state) {
  std::vector<Particle> particles;
  for (std::size_t i = 0; i < chain.mass.size(); ++i)
    particles.emplace_back(chain.mass[i], state[2 * i], state[2 * i + 1]);
  for (std::size_t i = 0; i < chain.rest.size(); ++i)
    Spring(particles[i], particles[i + 1], chain.stiffness[i], chain.rest[i]).pull();
  State rate{Vec3{}, Vec3{}};
  for (std::size_t i = 1; i < particles.size(); ++i) {
    particles[i].push(gravity_force(particles[i].mass(), chain.gravity));
    particles[i].push(drag_force(chain.drag, particles[i].velocity()));
    rate.push_back(particles[i].velocity());
    rate.push_back(particles[i].acceleration());
  }
  return rate;
}
