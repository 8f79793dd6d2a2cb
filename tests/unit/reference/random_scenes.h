// Random scenes by seed: scenes with a closed form, small networks without contact, and few particles on balls at rest
// or on planes.
#pragma once

#include <fmt/ranges.h>

#include <numbers>
#include <set>

#include "tests/unit/helpers.h"

namespace crosscheck::testing_tools {

/// Builds the text of a scene file.
class SceneWriter {
 public:
  void particle(const Vec3& x, double mass, const Vec3& v = Vec3::Zero()) {
    text_ += fmt::format("[[particle]]\nposition = {}\nmass = {}\n", list(x), mass);
    if (!v.isZero(0)) text_ += fmt::format("velocity = {}\n", list(v));
  }
  void spring(int a, int b, double k, double rest, double dashpot = 0) {
    text_ += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\nrest = {}\n", a, b, k, rest);
    if (dashpot > 0) text_ += fmt::format("dashpot = {}\n", dashpot);
  }
  void pins(const std::vector<int>& pins) { text_ += fmt::format("[pins]\nparticles = {}\n", pins); }
  /// Call after pins().
  void motion(const Vec3& amplitude, double frequency, double ramp) {
    text_ +=
        fmt::format("[pins.motion]\namplitude = {}\nfrequency = {}\nramp = {}\n", list(amplitude), frequency, ramp);
  }
  void gravity(const Vec3& a) {
    if (!a.isZero(0)) text_ += fmt::format("[gravity]\nacceleration = {}\n", list(a));
  }
  void drag(double gamma) {
    if (gamma > 0) text_ += fmt::format("[drag]\ngamma = {}\n", gamma);
  }
  void sphere(const Vec3& centre, double radius, double friction, double restitution) {
    text_ += fmt::format("[[sphere]]\ncentre = {}\nradius = {}\nfriction = {}\nrestitution = {}\n", list(centre),
                         radius, friction, restitution);
  }
  void plane(const Vec3& point, const Vec3& normal, double friction, double restitution) {
    text_ += fmt::format("[[plane]]\npoint = {}\nnormal = {}\nfriction = {}\nrestitution = {}\n", list(point),
                         list(normal), friction, restitution);
  }
  void wind(const Vec3& a) { text_ += fmt::format("[wind]\nacceleration = {}\n", list(a)); }
  /// Call after wind().
  void gusts(const Vec3& side, int seed) {
    text_ += fmt::format("[wind.gusts]\nvariation = 1\nside = {}\nseed = {}\n", list(side), seed);
  }
  Scene scene(const std::string& name, double duration, double step, int samples) const {
    return parse_scene(scene_text(text_, duration, step, samples), name);
  }

 private:
  static std::string list(const Vec3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); }
  std::string text_;
};

/// Random number between `low` and `high`, uniform in its logarithm.
inline double decades(Random& random, double low, double high) {
  return low * std::pow(high / low, random.between(0, 1));
}
inline bool chance(Random& random, double probability) { return random.between(0, 1) < probability; }
inline int whole(Random& random, int low, int high) { return static_cast<int>(random.between(low, high + 1)); }

/// One mass on one spring in any direction, optionally damped by drag, a dashpot or both, up to overdamped, and driven
/// by its pin.
inline Scene random_spring(unsigned seed, bool damped, bool driven) {
  Random random(seed);
  SceneWriter w;
  const Vec3 n = random.vector().normalized();
  const double mass = decades(random, 0.01, 10), omega = decades(random, 1, 100), rest = decades(random, 0.1, 3);
  // gravity stretches the spring by up to its own length
  const double pull = chance(random, 0.7) ? random.between(0, 1) * rest * omega * omega : 0;
  const double hanging = rest + pull / (omega * omega), amplitude = random.between(0.02, 0.5) * hanging;
  const double phase = random.between(0, 2 * std::numbers::pi);
  const double gamma = damped ? omega * decades(random, 0.01, 5) : 0;
  const double of_drag = chance(random, 0.3) ? 1 : chance(random, 0.5) ? 0 : random.between(0.1, 0.9);
  w.particle(Vec3::Zero(), mass);
  w.particle((hanging + amplitude * std::cos(phase)) * n, mass, -amplitude * omega * std::sin(phase) * n);
  w.spring(0, 1, mass * omega * omega, rest, (1 - of_drag) * gamma * mass);
  w.pins({0});
  if (driven) {
    // an undamped spring is driven away from resonance, so that it does not reach its anchor
    const bool below = chance(random, 0.5);
    const double ratio = gamma > 0.2 * omega ? decades(random, 0.2, 5)
                         : below             ? decades(random, 0.2, 0.8)
                                             : decades(random, 1.25, 5);
    const double shake = random.between(0.01, 0.1) * hanging;
    w.motion(shake * n, ratio * omega / (2 * std::numbers::pi), decades(random, 0.2, 20) / omega);
  }
  w.gravity(pull * n);
  w.drag(of_drag * gamma);
  const double period = 2 * std::numbers::pi / omega;
  return w.scene(fmt::format("random-spring-{}", seed), random.between(2, 6) * period, period / 100, 20);
}

/// One thrown particle, with or without drag and a steady wind.
inline Scene random_projectile(unsigned seed) {
  Random random(seed);
  SceneWriter w;
  const double duration = decades(random, 0.3, 10), speed = decades(random, 0.1, 30);
  w.particle(decades(random, 0.1, 10) * random.vector(), decades(random, 0.01, 10), speed * random.vector());
  w.gravity({0, -9.81, 0});
  if (chance(random, 0.7)) w.drag(decades(random, 0.01, 10) / duration);
  if (chance(random, 0.5)) w.wind(5 * random.vector());
  return w.scene(fmt::format("random-projectile-{}", seed), duration, duration / 200, 20);
}

/// Two to six masses between springs on a line, pinned at one or both ends; undamped, or damped in proportion to mass,
/// stiffness or both.
inline Scene random_chain(unsigned seed) {
  Random random(seed);
  SceneWriter w;
  const Vec3 n = random.vector().normalized();
  const int masses = whole(random, 2, 6);
  const bool both = chance(random, 0.5);
  const double mass = decades(random, 0.01, 1), omega = decades(random, 3, 100), rest = decades(random, 0.1, 1);
  const double stretch = both ? random.between(1, 1.3) : 1, off = random.between(0.005, 0.03) * rest;
  const double gamma = chance(random, 0.5) ? omega * decades(random, 0.01, 1) : 0;
  const double beta = chance(random, 0.4) ? decades(random, 0.003, 0.3) / omega : 0;  // s, dashpot / stiffness
  // the total weight stretches the first spring by less than a fifth
  const double pull = random.between(0, 0.05) * rest * omega * omega / masses;
  double along = 0;
  w.particle(Vec3::Zero(), mass);
  for (int i = 1; i <= masses; ++i) {
    along += rest * stretch;
    const double x = along + random.between(-off, off), v = omega * random.between(-off, off);
    w.particle(x * n, mass * random.between(0.6, 1.7), v * n);
  }
  if (both) w.particle((along + rest * stretch) * n, mass);
  for (int i = 0; i < masses + both; ++i) {
    const double k = mass * omega * omega * random.between(0.6, 1.7);
    w.spring(i, i + 1, k, rest, beta * k);
  }
  w.pins(both ? std::vector<int>{0, masses + 1} : std::vector<int>{0});
  w.gravity(pull * n);
  w.drag(gamma);
  // the period of the slowest mode is about twice the number of masses times that of one spring
  const double duration = random.between(1, 2) * 2 * masses * 2 * std::numbers::pi / omega;
  return w.scene(fmt::format("random-chain-{}", seed), duration, 0.06 / omega, 20);
}

/// A scene with an exact solution (reference/truth/exact): springs with and without drag, dashpot and driven pin,
/// projectiles, and chains on a line. Parameters range over some decades, and the duration over some periods.
inline Scene random_exact_scene(unsigned seed) {
  switch (seed % 6) {
    case 0:
      return random_spring(seed, false, false);
    case 1:
      return random_spring(seed, true, false);
    case 2:
      return random_spring(seed, seed % 4 == 0, true);
    case 3:
      return random_projectile(seed);
    default:
      return random_chain(seed);
  }
}

/// Scenes of the seeds 0 to 199, on which the error bars of the converged truth are calibrated.
inline std::vector<Scene> random_exact_scenes() {
  std::vector<Scene> scenes;
  for (unsigned seed = 0; seed < 200; ++seed) scenes.push_back(random_exact_scene(seed));
  return scenes;
}

/// 3 to 30 particles in a connected random network of springs under gravity, with one or two pins. Drag, wind (steady
/// or gusty), moving pins and initial velocities each occur for about half of the seeds. The scene lasts 0.5 s, with
/// steps of a tenth of the stability limit.
inline Scene random_contact_free_scene(unsigned seed) {
  Random random(seed);
  SceneWriter w;
  const int n = whole(random, 3, 30);
  std::vector<Vec3> x;
  const double side = 0.35 * std::cbrt(n), speed = chance(random, 0.5) ? 0.5 : 0;
  while (static_cast<int>(x.size()) < n) {
    const Vec3 at = side * random.vector();
    if (std::all_of(x.begin(), x.end(), [&](const Vec3& other) { return (at - other).norm() > 0.25; })) x.push_back(at);
  }
  const int pinned = n > 4 && chance(random, 0.5) ? 2 : 1;
  std::vector<double> mass, load(n, 0);
  for (int i = 0; i < n; ++i) {
    mass.push_back(decades(random, 0.05, 1));
    const Vec3 v = speed * random.vector();
    w.particle(x[i], mass[i], i < pinned ? Vec3::Zero() : v);
  }
  std::set<std::pair<int, int>> joined;
  const auto join = [&](int a, int b) {
    if (a == b || !joined.insert(std::minmax(a, b)).second) return;
    const double k = decades(random, 10, 1000);
    w.spring(a, b, k, random.between(0.8, 1.2) * (x[a] - x[b]).norm());
    load[a] += k / mass[a], load[b] += k / mass[b];
  };
  for (int i = 1; i < n; ++i) join(whole(random, 0, i - 1), i);  // a tree, then more springs
  for (int i = 0; i < 2 * n; ++i) {
    const int a = whole(random, 0, n - 1);
    join(a, whole(random, 0, n - 1));
  }
  w.pins(pinned == 2 ? std::vector<int>{0, 1} : std::vector<int>{0});
  if (chance(random, 0.4)) {
    const Vec3 amplitude = 0.1 * random.vector();
    w.motion(amplitude, random.between(0.5, 2), random.between(0.1, 0.5));
  }
  w.gravity({0, -9.81, 0});
  if (chance(random, 0.6)) w.drag(decades(random, 0.2, 5));
  if (chance(random, 0.5)) {
    w.wind(3 * random.vector());
    if (chance(random, 0.6)) w.gusts(2 * random.vector(), whole(random, 1, 1000));
  }
  // omega^2 <= 2 max sum k / m (Gershgorin), and steps are stable up to 2 / omega
  const double omega = std::sqrt(2 * *std::max_element(load.begin(), load.end()));
  return w.scene(fmt::format("random-network-{}", seed), 0.5, 0.2 / omega, 10);
}

/// Particles, a pendulum, a short chain or a small net, falling on one or two balls at rest, with friction of 0 to 0.6
/// and restitution of 0 to 0.9, with or without drag. Lasts 0.5 to 1.2 s, with steps of a tenth of the stability limit.
inline Scene random_contact_scene(unsigned seed) {
  Random random(seed);
  SceneWriter w;
  const double radius = random.between(0.3, 1), friction = chance(random, 0.25) ? 0 : random.between(0.05, 0.6);
  const double restitution = chance(random, 0.5) ? 0 : random.between(0.1, 0.9);
  const double mass = decades(random, 0.01, 0.5), high = radius + decades(random, 0.003, 0.2);
  std::vector<Vec3> x;
  std::vector<std::pair<int, int>> joined;
  std::vector<int> pinned;
  double omega_2 = 1e3;  // 1/s^2, k/m of the springs
  int most = 2;          // maximum number of springs at a particle
  const int kind = seed % 5;
  if (kind == 0) {  // one to four particles, thrown
    for (int i = whole(random, 1, 4); i > 0; --i) x.push_back(Vec3(0, high, 0) + 0.4 * radius * random.vector());
    for (Vec3& at : x) at *= std::max(1., (radius + 0.003) / at.norm());
  } else if (kind == 1) {  // a pendulum of one or two springs, released next to the ball
    const double length = random.between(0.5, 1.2) * radius;
    const Vec3 anchor(-random.between(0, 0.4) * radius, radius + random.between(0.5, 0.9) * length, 0);
    const Vec3 along(-std::cos(random.between(0.1, 0.6)), std::sin(random.between(-0.2, 0.4)),
                     random.between(-0.3, 0.3));
    const int links = whole(random, 1, 2);
    x.push_back(anchor);
    for (int i = 1; i <= links; ++i) {
      x.push_back(anchor + length * i / links * along.normalized());
      joined.emplace_back(i - 1, i);
    }
    pinned = {0};
    omega_2 = decades(random, 500, 5000);
  } else if (kind == 2) {  // a chain across the ball, on or above it
    const int n = whole(random, 3, 12);
    const double span = random.between(0.5, 1.5), from = random.between(-1, 0) * span, turn = random.between(0, 3);
    for (int i = 0; i < n; ++i) {
      const double angle = from + span * i / (n - 1), away = high * std::sin(angle);
      x.push_back({away * std::cos(turn), high * std::cos(angle), away * std::sin(turn)});
      if (i > 0) joined.emplace_back(i - 1, i);
    }
    omega_2 = decades(random, 500, 5000);
  } else {  // a net, level or slightly tilted, off centre
    const int rows = whole(random, 2, 7), columns = whole(random, 2, 7);
    const double side = random.between(0.4, 1.2) * radius, tilt = random.between(-0.1, 0.1);
    const Vec3 u(1, tilt, 0), v(0, random.between(-0.1, 0.1), 1);
    const double spacing = side / (std::max(rows, columns) - 1);
    const Vec3 corner = Vec3(0, high + 0.25 * side, 0) - random.between(0.1, 0.9) * (columns - 1) * spacing * u -
                        random.between(0.1, 0.9) * (rows - 1) * spacing * v;
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const int i = static_cast<int>(x.size());
        x.push_back(corner + spacing * (c * u + r * v));
        if (c > 0) joined.emplace_back(i - 1, i);
        if (r > 0) joined.emplace_back(i - columns, i);
        if (r > 0 && c > 0) joined.emplace_back(i - columns - 1, i), joined.emplace_back(i - columns, i - 1);
      }
    omega_2 = decades(random, 500, 5000), most = 8;
  }
  const double speed = kind == 1 ? 0 : decades(random, 0.05, 1);
  const Vec3 all = speed * Vec3(random.between(-1, 1), random.between(-1, 0), random.between(-1, 1));
  for (int i = 0; i < static_cast<int>(x.size()); ++i)
    w.particle(x[i], mass,
               std::count(pinned.begin(), pinned.end(), i) > 0 ? Vec3(0, 0, 0) : Vec3(all + 0.02 * random.vector()));
  for (const auto& [a, b] : joined) w.spring(a, b, mass * omega_2, (x[a] - x[b]).norm());
  if (!pinned.empty()) w.pins(pinned);
  w.gravity({0, -9.81, 0});
  if (chance(random, 0.6)) w.drag(decades(random, 0.2, 5));
  w.sphere({0, 0, 0}, radius, friction, restitution);
  if (chance(random, 0.3)) {  // a second ball below, to catch what slides off
    const double turn = random.between(0, 6.28), other = random.between(0.3, 0.8) * radius;
    w.sphere({(radius + other) * std::cos(turn), -random.between(0.2, 0.6) * radius, (radius + other) * std::sin(turn)},
             other, friction, restitution);
  }
  const double omega = joined.empty() ? 100 : std::sqrt(2 * most * omega_2);
  return w.scene(fmt::format("random-contact-{}", seed), random.between(0.5, 1.2), 0.2 / omega, 20);
}

/// Like random_contact_scene(), with particles, a chain or a small net that falls on a floor or slope with zero to two
/// walls.
inline Scene random_plane_scene(unsigned seed) {
  Random random(seed);
  SceneWriter w;
  const double friction = chance(random, 0.25) ? 0 : random.between(0.05, 0.6);
  const double restitution = chance(random, 0.5) ? 0 : random.between(0.1, 0.9);
  const double mass = decades(random, 0.01, 0.5), high = decades(random, 0.003, 0.2);
  const double tilt = chance(random, 0.3) ? 0 : random.between(0.05, 0.7), turn = random.between(0, 6.28);
  const Vec3 aside(std::cos(turn), 0, std::sin(turn)), level(-std::sin(turn), 0, std::cos(turn));
  const Vec3 n = std::cos(tilt) * Vec3::UnitY() - std::sin(tilt) * aside,
             up = std::cos(tilt) * aside + std::sin(tilt) * Vec3::UnitY();
  std::vector<Vec3> x;
  std::vector<std::pair<int, int>> joined;
  double omega_2 = 1e3;  // 1/s^2, k/m of the springs
  int most = 2;          // maximum number of springs at a particle
  const int kind = seed % 3;
  if (kind == 0) {  // one to four particles, thrown
    for (int i = whole(random, 1, 4); i > 0; --i)
      x.push_back(random.between(-0.4, 0.4) * up + random.between(-0.4, 0.4) * level + high * random.between(1, 3) * n);
  } else if (kind == 1) {  // a chain, roughly along the plane
    const int count = whole(random, 2, 12);
    const double spacing = random.between(0.03, 0.15), rise = random.between(-0.3, 0.3), side = random.between(-1, 1);
    for (int i = 0; i < count; ++i) {
      const double s = spacing * (i - 0.5 * (count - 1));
      x.push_back(s * (up + side * level) + (high + std::abs(rise) * spacing * count + rise * s) * n);
      if (i > 0) joined.emplace_back(i - 1, i);
    }
    omega_2 = decades(random, 500, 5000);
  } else {  // a net, slightly tilted relative to the plane
    const int rows = whole(random, 2, 7), columns = whole(random, 2, 7);
    const double spacing = random.between(0.05, 0.15), a = random.between(-0.2, 0.2), b = random.between(-0.2, 0.2);
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const int i = static_cast<int>(x.size());
        x.push_back(spacing * (c * up + r * level) + (high + 2 * spacing + spacing * (a * c + b * r)) * n);
        if (c > 0) joined.emplace_back(i - 1, i);
        if (r > 0) joined.emplace_back(i - columns, i);
        if (r > 0 && c > 0) joined.emplace_back(i - columns - 1, i), joined.emplace_back(i - columns, i - 1);
      }
    omega_2 = decades(random, 500, 5000), most = 8;
  }
  const double speed = decades(random, 0.05, 1.5);
  const Vec3 all = speed * (random.between(-1, 1) * up + random.between(-1, 1) * level - random.between(0, 1) * n);
  for (const Vec3& at : x) w.particle(at, mass, all + 0.02 * random.vector());
  for (const auto& [a, b] : joined) w.spring(a, b, mass * omega_2, (x[a] - x[b]).norm());
  w.gravity({0, -9.81, 0});
  if (chance(random, 0.6)) w.drag(decades(random, 0.2, 5));
  w.plane(Vec3::Zero(), n, friction, restitution);
  double lowest = 0, left = 0;
  for (const Vec3& at : x) lowest = std::min(lowest, at.dot(up)), left = std::min(left, at.dot(level));
  const int walls = whole(random, 0, 2);
  if (walls > 0) w.plane((lowest - random.between(0.02, 0.3)) * up, up, friction, restitution);
  if (walls > 1) w.plane((left - random.between(0.02, 0.3)) * level, level, friction, restitution);
  const double omega = joined.empty() ? 100 : std::sqrt(2 * most * omega_2);
  return w.scene(fmt::format("random-planes-{}", seed), random.between(0.5, 1.2), 0.2 / omega, 20);
}

}  // namespace crosscheck::testing_tools
