// A scene as its file holds it, particle by particle and spring by spring: what is drawn at random, and made smaller
// part by part.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// The nearest number of so many decimal digits.
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
    std::optional<double> rest;  // m; none: as long as it starts
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
  std::vector<std::array<int, 2>> constraints;  // distances that stay as they start
  SpringLaw law = SpringLaw::hooke;
  std::optional<Motion> pin_motion;
  std::optional<double> rotation;  // rad/s; with it the particles alone are the scene
  std::optional<Vec3> gravity;     // m/s^2
  std::optional<double> gamma;     // 1/s, drag over mass
  std::optional<Breeze> wind;
  std::vector<Sphere> spheres;
  double duration = 1, step = 1;  // s
  int samples = 1;

  int size() const { return static_cast<int>(particles.size()); }
  /// 1/s, a bound of what changes fastest: the frequency of a vibration (omega^2 <= 2 max sum k / m by Gershgorin;
  /// links stiffen to 5/4 k), or a rate of damping. 0 where nothing vibrates and nothing is damped.
  double largest_rate() const;
  /// Its ingredients, one word each: "pins-springs-gravity"; the same words for every scene of that kind.
  std::string kind() const;
  /// The scene file. Numbers are as short as they read back to the same bits.
  std::string text() const;
  /// The file as it is read: called after its kind. Throws InputError where the reader refuses it.
  Scene scene() const;
};

}  // namespace crosscheck
