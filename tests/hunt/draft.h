// A scene in the form of its file, as a list of particles and springs. It is drawn at random and then reduced step by
// step.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

double to_digits(double value, int digits);

struct SceneDraft {
  struct Particle {
    Vec3 x, v = Vec3::Zero();  // m, m/s
    double mass = 1;           // kg
    bool pinned = false;
  };
  struct Link {  // a spring, with or without a dashpot
    int a, b;
    double k;                    // N/m
    std::optional<double> rest;  // m; empty: the initial length
    double dashpot = 0;          // N s/m
    Family family = Family::single;
  };
  struct Breeze {
    Vec3 mean;  // m/s^2
    struct Gusts {
      double variation;  // 1
      Vec3 side;         // m/s^2
      int seed;
    };
    std::optional<Gusts> gusts;
  };

  std::vector<Particle> particles;
  std::vector<Link> springs;
  std::vector<std::array<int, 2>> constraints;  // distances that keep their initial value
  SpringLaw law = SpringLaw::hooke;
  std::optional<Motion> pin_motion;
  std::optional<double> rotation;  // rad/s; a rotating scene contains only particles
  std::optional<Vec3> gravity;     // m/s^2
  std::optional<double> gamma;     // 1/s, drag over mass
  std::optional<Breeze> wind;
  std::vector<Sphere> spheres;
  double duration = 1, step = 1;  // s
  int samples = 1;

  int size() const { return static_cast<int>(particles.size()); }
  /// Upper bound of the fastest rate, 1/s: the frequency of a vibration (omega^2 <= 2 max sum k / m by Gershgorin;
  /// links stiffen to 5/4 k), or a damping rate. 0 if nothing vibrates and nothing is damped.
  double largest_rate() const;
  /// Names of the ingredients, joined by hyphens: "pins-springs-gravity".
  std::string kind() const;
  /// Text of the scene file, with the shortest numbers that read back to the same bits.
  std::string text() const;
  /// The scene as read from text(), named after its kind. Throws InputError if the reader refuses it.
  Scene scene() const;
};

}  // namespace crosscheck
