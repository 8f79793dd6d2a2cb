#include "experiments/check/transformations.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "mysim/base/random.h"

namespace crosscheck {

Eigen::Matrix3d seeded_turn(unsigned seed) {
  std::mt19937_64 engine(seed + 1000);
  // K. Shoemake, Uniform random rotations, Graphics Gems III, 1992
  const double u = uniform(engine), a = 2 * std::numbers::pi * uniform(engine),
               b = 2 * std::numbers::pi * uniform(engine);
  return Eigen::Quaterniond(std::sqrt(u) * std::cos(b), std::sqrt(1 - u) * std::sin(a), std::sqrt(1 - u) * std::cos(a),
                            std::sqrt(u) * std::sin(b))
      .toRotationMatrix();
}

std::vector<int> seeded_order(int n, unsigned seed) {
  std::mt19937_64 engine(seed + 2000);
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  // S. Sattolo, Inf. Process. Lett. 22, 1986: a single cycle, so that no element stays where it was
  for (int i = n - 1; i > 0; --i) std::swap(order[i], order[static_cast<int>(uniform(engine) * i)]);
  return order;
}

Scene placed(Scene scene, const Placement& placement) {
  const Eigen::Matrix3d& turn = placement.turn;
  const auto turn_motion = [&](std::optional<Motion>& motion) {
    if (motion) motion->amplitude = (turn * motion->amplitude).eval();
  };
  const auto turn_wind = [&](WindSignal& wind) {
    wind.mean = (turn * wind.mean).eval();
    if (wind.gusts) wind.gusts->side = (turn * wind.gusts->side).eval();
  };
  scene.start.x = placement.of(scene.start.x);
  scene.start.v = (turn * scene.start.v).eval();
  Particles& p = scene.model.particles;
  p.pin_home = placement.of(p.pin_home);
  turn_motion(p.move);
  for (Term& term : scene.model.terms)
    std::visit(
        Overloaded{[&](Gravity& g) { g.acceleration = (turn * g.acceleration).eval(); },
                   [&](Wind& w) { turn_wind(w.acceleration); }, [&](Aerodynamics& air) { turn_wind(air.velocity); },
                   [&](Spheres& spheres) {
                     for (Sphere& s : spheres.list) {
                       s.centre = (turn * s.centre + placement.shift).eval();
                       turn_motion(s.motion);
                     }
                   },
                   [&](Planes& planes) {
                     for (Plane& plane : planes.list) {
                       plane.point = (turn * plane.point + placement.shift).eval();
                       plane.normal = (turn * plane.normal).eval();
                       if (plane.velocity) plane.velocity = (turn * *plane.velocity).eval();
                     }
                   },
                   [](OneOf<Rotation, Springs, Bending, Dashpots, Constraints, Drag> auto&) {}},
        term);
  scene.hash = hash_of(scene);
  return scene;
}

Scene renumbered(const Scene& scene, const std::vector<int>& order) {
  Scene other = scene;
  const int n = scene.model.particles.size();
  std::vector<int> number(n);
  for (int i = 0; i < n; ++i) number[order[i]] = i;
  const auto reorder = [&](const Points& from, Points& to) {
    for (int i = 0; i < from.cols(); ++i) to.col(i) = from.col(order[i]);
  };
  const Particles& from = scene.model.particles;
  Particles& to = other.model.particles;
  reorder(scene.start.x, other.start.x);
  reorder(scene.start.v, other.start.v);
  for (int i = 0; i < n; ++i) to.mass[i] = from.mass[order[i]], to.pinned[i] = from.pinned[order[i]];
  std::map<int, int> homes;  // index of each pin's home position; a map, to list pins in ascending order
  for (size_t i = 0; i < from.pins.size(); ++i) homes[number[from.pins[i]]] = static_cast<int>(i);
  to.pins.clear();
  for (const auto& [pin, home] : homes) {
    to.pin_home.col(static_cast<int>(to.pins.size())) = from.pin_home.col(home);
    to.pins.push_back(pin);
  }
  const auto rename_ends = [&](auto& list) {
    for (auto& e : list) e.a = number[e.a], e.b = number[e.b];
  };
  const auto rename_corners = [&](std::vector<std::array<int, 3>>& triangles) {
    for (auto& triangle : triangles)
      for (int& corner : triangle) corner = number[corner];
  };
  for (Term& term : other.model.terms)
    std::visit(Overloaded{[&](OneOf<Springs, Dashpots, Constraints> auto& t) { rename_ends(t.list); },
                          [&](Bending& t) {
                            for (auto& s : t.list)
                              for (int k = 0; k < s.size; ++k) s.particle[k] = number[s.particle[k]];
                          },
                          [&](Drag& drag) {
                            const Eigen::VectorXd c = drag.c;
                            for (int i = 0; i < n; ++i) drag.c[i] = c[order[i]];
                          },
                          [&](Aerodynamics& air) { rename_corners(air.triangles); },
                          [](OneOf<Rotation, Gravity, Wind, Spheres, Planes> auto&) {}},
               term);
  rename_corners(other.triangles);
  other.hash = hash_of(other);
  return other;
}

Scene springs_reordered(Scene scene, unsigned seed) {
  std::mt19937_64 engine(seed + 3000);
  const auto turn_round = Overloaded{[](auto& pair) { std::swap(pair.a, pair.b); },
                                     [](Bending::Stencil& s) {
                                       std::reverse(s.particle.begin(), s.particle.begin() + s.size);
                                       std::reverse(s.weight.begin(), s.weight.begin() + s.size);
                                     }};
  const auto reorder = [&](auto& list) {
    const auto old = list;
    const std::vector<int> order = seeded_order(static_cast<int>(list.size()), seed);
    for (size_t i = 0; i < list.size(); ++i) {
      list[i] = old[order[i]];
      if (uniform(engine) < 0.5) turn_round(list[i]);
    }
  };
  for (Term& term : scene.model.terms)
    std::visit(Overloaded{[&](OneOf<Springs, Bending, Dashpots, Constraints> auto& t) { reorder(t.list); },
                          [](OneOf<Rotation, Gravity, Drag, Wind, Aerodynamics, Spheres, Planes> auto&) {}},
               term);
  scene.hash = hash_of(scene);
  return scene;
}

Scene scaled(Scene scene, const Scaling& scaling) {
  const auto [length, mass, time] = scaling;
  const double speed = length / time, acceleration = speed / time;
  const auto scale_motion = [&](std::optional<Motion>& motion) {
    if (motion) motion->amplitude *= length, motion->frequency /= time, motion->ramp *= time;
  };
  const auto scale_wind = [&](WindSignal& wind, double unit) {
    wind.mean *= unit;
    if (!wind.gusts) return;
    wind.gusts->side *= unit;
    for (Gust* gust : {&wind.gusts->along, &wind.gusts->across})
      for (Gust::Wave& wave : gust->waves) wave.omega /= time;
  };
  scene.start.x *= length, scene.start.v *= speed;
  Particles& p = scene.model.particles;
  p.mass *= mass, p.pin_home *= length;
  scale_motion(p.move);
  for (Term& term : scene.model.terms)
    std::visit(
        Overloaded{[&](Rotation& t) { t.rate /= time; }, [&](Gravity& t) { t.acceleration *= acceleration; },
                   [&](Springs& t) {
                     for (Spring& s : t.list) s.k *= mass / (time * time), s.rest *= length;
                   },
                   [&](Bending& t) {
                     for (auto& s : t.list) s.k *= mass / (time * time);
                     t.rigidity *= mass * length * length / (time * time);
                   },
                   [&](Dashpots& t) {
                     for (auto& d : t.list) d.c *= mass / time;
                   },
                   [&](Constraints& t) {
                     for (auto& c : t.list) c.length *= length;
                   },
                   [&](Drag& t) { t.c *= mass / time; }, [&](Wind& t) { scale_wind(t.acceleration, acceleration); },
                   [&](Aerodynamics& t) {
                     t.density *= mass / (length * length * length);
                     scale_wind(t.velocity, speed);
                   },
                   [&](Spheres& t) {
                     for (Sphere& s : t.list) {
                       s.centre *= length, s.radius *= length, s.margin *= length;
                       scale_motion(s.motion);
                     }
                   },
                   [&](Planes& t) {
                     for (Plane& plane : t.list) {
                       plane.point *= length, plane.margin *= length;
                       if (plane.velocity) *plane.velocity *= speed;
                     }
                   }},
        term);
  scene.duration *= time, scene.step *= time, scene.window *= time, scene.tolerance *= length;
  scene.hash = hash_of(scene);
  return scene;
}

namespace {

/// Index of each particle's mirror image, which must have the same mass and the mirrored position and velocity, and
/// must be pinned if the particle is. Returns nullopt if an image is missing.
std::optional<std::vector<int>> images_of(const Scene& scene, const Scene& other, double near) {
  const Particles& p = scene.model.particles;
  std::vector<int> image(p.size(), -1);
  for (int i = 0; i < p.size(); ++i) {
    for (int j = 0; j < p.size() && image[i] < 0; ++j)
      if ((other.start.x.col(i) - scene.start.x.col(j)).norm() <= near &&
          (other.start.v.cols() == 0 || (other.start.v.col(i) - scene.start.v.col(j)).norm() <= near / scene.step) &&
          p.mass[i] == p.mass[j] && p.pinned[i] == p.pinned[j])
        image[i] = j;
    if (image[i] < 0) return std::nullopt;
  }
  return image;
}

/// All springs and other links as lists of their ends and parameters.
std::multiset<std::vector<double>> joined(const Scene& scene, const std::vector<int>& image) {
  std::multiset<std::vector<double>> all;
  const auto add = [&](double kind, int a, int b, double first, double second) {
    const auto [low, high] = std::minmax(image[a], image[b]);
    all.insert({kind, static_cast<double>(low), static_cast<double>(high), first, second});
  };
  for (const Term& term : scene.model.terms)
    std::visit(Overloaded{[&](const Springs& t) {
                            for (const Spring& s : t.list) add(0, s.a, s.b, s.k, static_cast<float>(s.rest));
                          },
                          [&](const Bending& t) {
                            for (const auto& s : t.list) {
                              std::vector<std::pair<int, double>> members;
                              for (int i = 0; i < s.size; ++i) members.emplace_back(image[s.particle[i]], s.weight[i]);
                              std::sort(members.begin(), members.end());
                              const double sign = members[0].second < 0 ? -1 : 1;
                              std::vector<double> key{4, s.k};
                              for (const auto& [particle, weight] : members)
                                key.push_back(particle), key.push_back(sign * weight);
                              all.insert(std::move(key));
                            }
                          },
                          [&](const Dashpots& t) {
                            for (const auto& d : t.list) add(1, d.a, d.b, d.c, 0);
                          },
                          [&](const Constraints& t) {
                            for (const auto& c : t.list) add(2, c.a, c.b, static_cast<float>(c.length), 0);
                          },
                          [&](const Drag& t) {
                            for (int i = 0; i < t.c.size(); ++i) add(3, i, i, t.c[i], 0);
                          },
                          [](const OneOf<Rotation, Gravity, Wind, Aerodynamics, Spheres, Planes> auto&) {}},
               term);
  return all;
}

bool same_outside(const Scene& scene, const Scene& other, double near) {
  const auto same = [](const Vec3& a, const Vec3& b) { return (a - b).norm() <= 1e-12 * a.norm(); };
  const auto same_motion = [&](const std::optional<Motion>& a, const std::optional<Motion>& b) {
    return !a || same(a->amplitude, b->amplitude);
  };
  const auto same_wind = [&](const WindSignal& a, const WindSignal& b) {
    return same(a.mean, b.mean) && (!a.gusts || same(a.gusts->side, b.gusts->side));
  };
  bool all = same_motion(scene.model.particles.move, other.model.particles.move);
  if (const auto* g = scene.model.find<Gravity>())
    all = all && same(g->acceleration, other.model.find<Gravity>()->acceleration);
  if (const auto* w = scene.model.find<Wind>())
    all = all && same_wind(w->acceleration, other.model.find<Wind>()->acceleration);
  // a cloth in air is not symmetric, because its triangles cut the squares along one diagonal
  all = all && !scene.model.find<Aerodynamics>() && !scene.model.first_order();
  if (const auto* spheres = scene.model.find<Spheres>())
    for (size_t i = 0; i < spheres->list.size(); ++i) {
      const Sphere &a = spheres->list[i], &b = other.model.find<Spheres>()->list[i];
      all = all && (a.centre - b.centre).norm() <= near && same_motion(a.motion, b.motion);
    }
  if (const auto* planes = scene.model.find<Planes>())
    for (size_t i = 0; i < planes->list.size(); ++i) {
      const Plane &a = planes->list[i], &b = other.model.find<Planes>()->list[i];
      all = all && same(a.normal, b.normal) && std::abs((a.point - b.point).dot(a.normal)) <= near &&
            (!a.velocity || same(*a.velocity, *b.velocity));
    }
  return all;
}

}  // namespace

std::optional<Mirror> mirror_of(const Scene& scene) {
  const Vec3 low = scene.start.x.rowwise().minCoeff(), high = scene.start.x.rowwise().maxCoeff();
  const double near = 1e-9 * scene.size();
  std::vector<int> itself(scene.model.particles.size());
  std::iota(itself.begin(), itself.end(), 0);
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] - low[axis] <= near) continue;  // a trivial reflection: its plane contains all particles
    Mirror mirror;
    mirror.reflection.turn(axis, axis) = -1;
    mirror.reflection.shift[axis] = low[axis] + high[axis];
    const Scene other = placed(scene, mirror.reflection);
    if (!same_outside(scene, other, near)) continue;
    const auto image = images_of(scene, other, near);
    if (!image || joined(scene, *image) != joined(scene, itself)) continue;
    mirror.image = *image;
    return mirror;
  }
  return std::nullopt;
}

}  // namespace crosscheck
