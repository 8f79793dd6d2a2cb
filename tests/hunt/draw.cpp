// Twelve kinds of random scenes, each required by some relation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "mysim/base/random.h"
#include "tests/hunt/hunt.h"

namespace crosscheck {
namespace {

/// Random numbers with few digits, so that scenes are readable.
class Draw {
 public:
  Draw(unsigned seed, long index) : engine_(seed * 0x9e3779b97f4a7c15ULL + static_cast<std::uint64_t>(index)) {
    // neighbouring seeds of a Mersenne twister start with similar numbers
    engine_.discard(20);
  }
  double between(double low, double high) { return to_digits(low + (high - low) * uniform(engine_), 4); }
  double decades(double low, double high) { return to_digits(low * std::pow(high / low, uniform(engine_)), 3); }
  bool chance(double probability) { return uniform(engine_) < probability; }
  int whole(int low, int high) { return low + static_cast<int>(uniform(engine_) * (high - low + 1)); }
  Vec3 vector(double size) {
    Vec3 v;
    for (double& part : v) part = between(-size, size);
    return v;
  }

 private:
  std::mt19937_64 engine_;
};

/// Units of a scene: a spring's length, a particle's mass, and the frequency of a particle on one spring. The weight of
/// a particle stretches such a spring by a hundredth to a quarter of its length.
struct Units {
  double length, mass, omega;  // m, kg, rad/s
  double k() const { return mass * omega * omega; }
};
Units draw_units(Draw& random) {
  const double length = random.decades(0.1, 2);
  return {length, random.decades(0.02, 1), random.decades(2, 10) * std::sqrt(9.81 / length)};
}

class DraftMaker {
 public:
  DraftMaker(Draw& random, const Units& units) : random_(random), units_(units) {}

  int particle(const Vec3& x, double speed) {
    SceneDraft::Particle p{x, Vec3::Zero(), to_digits(units_.mass * random_.between(0.6, 1.6), 3), false};
    for (double& part : p.x) part = to_digits(part, 4);
    if (speed > 0) p.v = random_.vector(speed * units_.length * units_.omega);
    draft.particles.push_back(p);
    return draft.size() - 1;
  }
  /// Adds a spring. `strain`: largest relative difference between initial and rest length.
  void spring(int a, int b, double strain, double damping = 0, Family family = Family::single) {
    if (a == b || !joined_.insert(std::minmax(a, b)).second) return;
    SceneDraft::Link s{a, b, to_digits(units_.k() * random_.between(0.5, 2), 3), std::nullopt, 0, family};
    const double length = (draft.particles[a].x - draft.particles[b].x).norm();
    if (strain > 0) s.rest = to_digits(length * random_.between(1 - strain, 1 + strain), 4);
    if (damping > 0) s.dashpot = to_digits(2 * damping * units_.mass * units_.omega, 3);
    draft.springs.push_back(s);
  }
  /// Adds n particles in a connected net, at distances of at least 0.6 unit lengths.
  void net(int n, double strain, double speed, double damping) {
    const double side = 0.9 * units_.length * std::cbrt(n);
    for (int tries = 0; draft.size() < n && tries < 1000; ++tries) {
      const Vec3 x = random_.vector(side);
      if (std::ranges::all_of(draft.particles, [&](const auto& p) { return (p.x - x).norm() > 0.6 * units_.length; }))
        particle(x, speed);
    }
    constexpr Family families[] = {Family::single, Family::structural, Family::shear, Family::bend};
    for (int i = 1; i < draft.size(); ++i)
      spring(random_.whole(0, i - 1), i, strain, damping, families[random_.whole(0, 3)]);
    for (int i = 0; i < 2 * draft.size(); ++i) {
      const int a = random_.whole(0, draft.size() - 1), b = random_.whole(0, draft.size() - 1);
      spring(a, b, strain, damping, families[random_.whole(0, 3)]);
    }
  }
  /// Adds nu x nv particles with a grid's springs, along u and v from `origin`.
  void patch(int nu, int nv, const Vec3& origin, const Vec3& u, const Vec3& v, double strain, double speed,
             double damping) {
    const int first = draft.size();
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) particle(origin + units_.length * (i * u + j * v), speed);
    const auto at = [&](int i, int j) { return first + i + nu * j; };
    const auto join = [&](int i, int j, int di, int dj, Family family) {
      if (i + di >= 0 && i + di < nu && j + dj < nv) spring(at(i, j), at(i + di, j + dj), strain, damping, family);
    };
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) {
        join(i, j, 1, 0, Family::structural), join(i, j, 0, 1, Family::structural);
        join(i, j, 1, 1, Family::shear), join(i, j, -1, 1, Family::shear);
        join(i, j, 2, 0, Family::bend), join(i, j, 0, 2, Family::bend);
      }
  }
  void pin(int i) { draft.particles[i].pinned = true, draft.particles[i].v.setZero(); }
  void gravity() { draft.gravity = Vec3(0, -9.81, 0); }
  void drag() { draft.gamma = to_digits(units_.omega * random_.decades(0.01, 0.5), 3); }
  void wind() {
    draft.wind = SceneDraft::Breeze{random_.vector(5), std::nullopt};
    if (random_.chance(0.5))
      draft.wind->gusts = SceneDraft::Breeze::Gusts{random_.between(0.2, 1), random_.vector(3), random_.whole(1, 999)};
  }
  void sphere(double radius, const Vec3& centre) {
    draft.spheres.push_back({centre, radius, 0, 0, 0, std::nullopt});
    Sphere& ball = draft.spheres.back();
    if (random_.chance(0.5)) ball.margin = 0.02 * radius;
    if (random_.chance(0.7)) ball.friction = random_.between(0.1, 1);
    if (random_.chance(0.3)) ball.restitution = random_.between(0.2, 0.9);
  }
  void law() {
    if (random_.chance(0.25)) draft.law = SpringLaw::bullet_link;
  }

  /// Sets the step to at most `part` / rate for the fastest rate (the stability limit is 2 / omega), with `steps` steps
  /// between samples. The step is a power of two, which every precision represents exactly. In explicit Euler a
  /// vibration grows by a factor 1 + (h omega)^2 / 2 per step: by less than e^2.6 in 512 steps with part = 0.1, and by
  /// less than e^1.7 in 2048 steps with part = 0.04.
  void time(int samples, int steps, double part = 0.1) {
    const double rate = std::max(draft.largest_rate(), draft.rotation ? 0 : units_.omega);
    draft.step = std::exp2(std::floor(std::log2(part / rate)));
    draft.samples = samples;
    draft.duration = draft.step * samples * steps;
  }

  SceneDraft draft;

 private:
  Draw& random_;
  Units units_;
  std::set<std::pair<int, int>> joined_;
};

/// Adds a net or a patch with a random selection of ingredients.
void anything(Draw& random, DraftMaker& make, const Units& units, bool patch) {
  const double strain = random.chance(0.7) ? random.between(0.02, 0.15) : 0;
  const double speed = random.chance(0.6) ? random.between(0.02, 0.2) : 0;
  const double damping = random.chance(0.4) ? random.decades(0.01, 0.3) : 0;
  if (patch)
    make.patch(random.whole(2, 6), random.whole(2, 5), {0, 0, 0}, {1, 0, 0}, Vec3(0, -0.8, 0.6), strain, speed,
               damping);
  else
    make.net(random.whole(2, 30), strain, speed, damping);
  make.law();
  const int pins = random.whole(0, std::min(2, make.draft.size() - 1));
  for (int i = 0; i < pins; ++i) make.pin(i);
  if (pins > 0 && random.chance(0.3))
    make.draft.pin_motion = Motion{random.vector(0.3 * units.length), random.between(0.1, 0.5) * units.omega / 6,
                                   to_digits(3 / units.omega, 2)};
  if (random.chance(0.7)) make.gravity();
  if (random.chance(0.4)) make.drag();
  if (random.chance(0.3)) make.wind();
  make.time(16, 32);
}

/// Adds masses on springs below a pin, with enough damping to come to rest.
void hanging_chain(Draw& random, DraftMaker& make, const Units& units) {
  const bool drag = random.chance(0.5);
  const int masses = random.whole(1, 2);
  // The slowest vibration has the frequency omega / 2n or more. Drag damps it critically. Dashpots of 2 m omega damp
  // the vibration of a single spring critically, and the slowest vibration at the rate (its frequency)^2 / omega. After
  // twelve time constants, 1e-5 of the motion is left.
  const double slowest = units.omega / (2 * masses), decay = drag ? slowest : slowest * slowest / units.omega;
  for (int i = 0; i <= masses; ++i) make.particle({0, -units.length * i, 0}, 0);
  for (int i = 0; i < masses; ++i) make.spring(i, i + 1, 0, drag ? 0 : 1.0);
  make.pin(0), make.gravity();
  if (drag) make.draft.gamma = to_digits(2 * slowest, 3);
  // explicit Euler is stable while h omega^2 is below the drag rate; this holds even for springs four times as stiff
  const double part = drag ? std::min(0.1, *make.draft.gamma / (8 * make.draft.largest_rate())) : 0.1;
  make.time(32, 1, part);
  make.time(32, static_cast<int>(std::ceil(12 / decay / make.draft.duration)), part);
}

void symmetric_strip(Draw& random, DraftMaker& make, const Units& units) {
  const int half = random.whole(1, 4);
  for (int i = -half; i <= half; ++i) {
    const double aside = std::abs(i);
    make.particle({units.length * i, to_digits(0.05 * units.length * aside, 3), 0.01 * aside * aside * units.length},
                  0);
  }
  const int n = make.draft.size();
  for (int i = 0; i + 1 < n; ++i) make.spring(i, i + 1, 0);
  for (int i = 0; i + 2 < n; ++i) make.spring(i, i + 2, 0);
  make.pin(half), make.gravity();
  if (random.chance(0.4)) make.drag();
  for (auto& p : make.draft.particles) p.mass = units.mass;
  for (auto& s : make.draft.springs) s.k = to_digits(units.k(), 3);
  make.time(16, 32);
}

/// Adds one particle, a chain or a patch above a ball, released at rest or thrown.
void on_a_ball(Draw& random, DraftMaker& make, const Units& units) {
  const double radius = random.between(0.8, 3) * units.length;
  const double above = 1.03 * radius + units.length * random.between(0, 0.3);
  const Vec3 top(to_digits(random.between(-0.4, 0.4) * radius, 3), above, 0.02 * units.length);
  const double damping = random.chance(0.5) ? random.decades(0.01, 0.3) : 0;
  const int form = random.whole(0, 2);
  if (form == 0) {
    make.particle(top, random.chance(0.5) ? 0.2 : 0);
  } else if (form == 1) {
    const int n = random.whole(2, 5);
    for (int i = 0; i < n; ++i) make.particle(top + Vec3(units.length * i, 0, 0), 0);
    for (int i = 0; i + 1 < n; ++i) make.spring(i, i + 1, 0, damping);
  } else {
    const int n = random.whole(2, 4);
    make.patch(n, n, top - units.length * (n - 1) / 2 * Vec3(1, 0, 1), {1, 0, 0}, {0, 0, 1}, 0, 0, damping);
  }
  make.sphere(radius, {0, 0, 0});
  make.gravity();
  if (random.chance(0.4)) make.drag();
  make.time(16, 32);
}

void projectile(Draw& random, DraftMaker& make) {
  make.particle(random.vector(1), 0.5);
  make.draft.gravity = Vec3(0, -9.81, 0);
  if (random.chance(0.5)) make.drag();
  if (random.chance(0.5)) make.wind();
  make.time(16, 32);
}

void rotation(Draw& random, DraftMaker& make) {
  const int n = random.whole(1, 3);
  for (int i = 0; i < n; ++i) make.particle(random.vector(1), 0);
  make.draft.rotation = random.between(0.5, 2);
  make.time(16, 32);
}

void hard_chain(Draw& random, DraftMaker& make, const Units& units) {
  const int n = random.whole(2, 5);
  for (int i = 0; i < n; ++i) make.particle({0.8 * units.length * i, -0.6 * units.length * i, 0}, 0);
  for (int i = 0; i + 1 < n; ++i) make.draft.constraints.push_back({i, i + 1});
  make.pin(0), make.gravity();
  if (random.chance(0.4)) make.drag();
  make.time(16, 32);
}

}  // namespace

SceneDraft draw(unsigned seed, long index) {
  Draw random(seed, index);
  const Units units = draw_units(random);
  DraftMaker make(random, units);
  switch (index % drawn_kinds) {
    case 0:
      anything(random, make, units, false);
      break;
    case 1:
      on_a_ball(random, make, units);
      break;
    case 2:
      anything(random, make, units, true);
      break;
    case 3:  // falls without internal motion
      make.net(random.whole(1, 12), 0, 0, random.chance(0.5) ? random.decades(0.01, 0.3) : 0);
      make.law(), make.gravity(), make.time(16, 32);
      break;
    case 4:
      hanging_chain(random, make, units);
      break;
    case 5:  // flies, without external influences
      make.net(random.whole(2, 12), 0.1, 0.2, random.chance(0.3) ? random.decades(0.01, 0.3) : 0);
      make.law(), make.time(16, 32);
      break;
    case 6:  // vibrates for a long time; a single spring exchanges no energy with others
      make.net(2, 0.1, 0.2, 0);
      make.time(128, 16, 0.04);
      break;
    case 7:
      symmetric_strip(random, make, units);
      break;
    case 8:
      projectile(random, make);
      break;
    case 9:  // at rest, without external influences
      make.net(random.whole(2, 12), 0, 0, random.chance(0.5) ? random.decades(0.01, 0.3) : 0);
      make.law(), make.time(16, 32);
      break;
    case 10:
      hard_chain(random, make, units);
      break;
    case 11:
      rotation(random, make);
      break;
  }
  return std::move(make.draft);
}

}  // namespace crosscheck
