// Lets a particle go on a ball and looks where it is pushed.
#include "experiments/disagreements/contact_direction.h"

#include <cmath>
#include <stdexcept>

#include "mysim/observers/trajectory.h"
#include "reference/method.h"

namespace crosscheck {

std::vector<DirectionError> direction_errors(const std::string& method, Scene scene,
                                             const std::vector<double>& angles) {
  Sphere& ball = scene.model.find<Spheres>()->list.at(0);
  ball.friction = 0;
  const Vec3 g = scene.model.find<Gravity>()->acceleration;
  const Method chosen = find_method(method);
  constexpr double duration = 4e-3, step = 2e-4;  // s
  constexpr double inside = 1.2e-4;               // m: a grid of 20 mm puts the surface up to a^2 / 4R = 0.1 mm too low

  std::vector<DirectionError> errors;
  for (const double angle : angles) {
    const Vec3 normal(std::sin(angle), std::cos(angle), 0), down(std::cos(angle), -std::sin(angle), 0);
    scene.start.x.col(0) = ball.centre + (ball.contact_radius() - inside) * normal;
    scene.start.v.setZero();
    auto pushed = [&](double h) {
      Recorder recorder;
      const Outcome out = run_method(chosen, scene, {h, duration, 1}, {&recorder});
      if (out.verdict != Verdict::ok) throw std::runtime_error(method + ": " + out.reason);
      const Vec3 impulse = recorder.trajectory.v.back().col(0) - g * duration;
      return Vec3(std::atan2(impulse.dot(down), impulse.dot(normal)), std::atan2(impulse.z(), impulse.dot(normal)), 0);
    };
    const Vec3 found = 2 * pushed(step / 2) - pushed(step);
    errors.push_back({angle, found[0], found[1]});
  }
  return errors;
}

}  // namespace crosscheck
