#include "experiments/contact/probes.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/metrics.h"
#include "reference/truth/exact/exact.h"

namespace crosscheck {
namespace {

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  return length2 > 0 ? Vec3(a + std::clamp((p - a).dot(d) / length2, 0.0, 1.0) * d) : a;
}

}  // namespace

Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const double area2 = n.squaredNorm();
  if (area2 > 0) {
    // barycentric weights of the foot of the perpendicular, which is inside the triangle if no weight is negative
    const double wa = (c - b).cross(p - b).dot(n), wb = (a - c).cross(p - c).dot(n), wc = (b - a).cross(p - a).dot(n);
    if (wa >= 0 && wb >= 0 && wc >= 0) return (wa * a + wb * b + wc * c) / (wa + wb + wc);
  }
  Vec3 best = nearest_on_segment(p, a, b);
  for (const Vec3& other : {nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)})
    if ((other - p).squaredNorm() < (best - p).squaredNorm()) best = other;
  return best;
}

std::optional<double> depth_of_triangles(const Scene& scene, double t, const Points& x) {
  const auto* spheres = scene.model.find<Spheres>();
  if (!spheres || scene.triangles.empty()) return std::nullopt;
  double deepest = -INFINITY;
  for (const Sphere& sphere : spheres->list) {
    const Vec3 centre = sphere.centre_at(t);
    for (const auto& [a, b, c] : scene.triangles)
      deepest = std::max(deepest, sphere.contact_radius() -
                                      (nearest_on_triangle(centre, x.col(a), x.col(b), x.col(c)) - centre).norm());
  }
  return deepest;
}

namespace {

constexpr int axes[] = {0, 2};

Vec3 reflected(Vec3 p, const Vec3& centre, int axis) {
  p[axis] = 2 * centre[axis] - p[axis];
  return p;
}

}  // namespace

std::optional<MirrorSymmetry> MirrorSymmetry::of(const Scene& scene) {
  const Model& model = scene.model;
  const auto* spheres = model.find<Spheres>();
  const auto* gravity = model.find<Gravity>();
  const int n = model.particles.size();
  // compares all pairs, which takes a second for ten thousand particles
  if (!spheres || spheres->list.size() != 1 || spheres->moving() || model.find<Wind>() || model.find<Aerodynamics>() ||
      model.particles.move || n < 2 || n > 10000 || !scene.start.v.isZero(0))
    return std::nullopt;
  if (gravity && (gravity->acceleration.x() != 0 || gravity->acceleration.z() != 0)) return std::nullopt;
  MirrorSymmetry mirror;
  mirror.centre_ = spheres->list[0].centre;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < n; ++i) {
      const Vec3 image = reflected(scene.start.x.col(i), mirror.centre_, axes[side]);
      int found = -1;
      for (int j = 0; j < n && found < 0; ++j)
        if ((scene.start.x.col(j) - image).norm() < 1e-12 * scene.size() &&
            model.particles.pinned[i] == model.particles.pinned[j] &&
            model.particles.mass[i] == model.particles.mass[j])
          found = j;
      if (found < 0) return std::nullopt;
      mirror.partner_[side].push_back(found);
    }
  return mirror;
}

double MirrorSymmetry::asymmetry(const Points& x) const {
  double most = 0;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < x.cols(); ++i)
      most = std::max(most, (x.col(partner_[side][i]) - reflected(x.col(i), centre_, axes[side])).norm());
  return most;
}

namespace {

constexpr double gravity = 9.81, drop = 0.3, ball = 1.02, gap = 1e-3;

Scene probe(const std::string& name, double duration, const std::string& more) {
  return parse_scene(fmt::format("question = \"q\"\nparameters = \"p\"\n[time]\nduration = {}\nsamples = 1\n"
                                 "step = 1e-3\nwindow = {}\ntolerance = 1e-3\nmethod = \"leapfrog\"\n{}",
                                 duration, duration, more),
                     name);
}

constexpr auto downwards = "[gravity]\nacceleration = [0, -9.81, 0]\n";

Trajectory each_step(const Method& method, const Scene& scene, double step, Outcome& out, Ledger* ledger = nullptr) {
  Recorder recorder;
  std::vector<Observer*> observers{&recorder};
  if (ledger) observers.push_back(ledger);
  out = run_method(method, scene, {step, scene.duration, static_cast<int>(std::lround(scene.duration / step))},
                   observers);
  return std::move(recorder.trajectory);
}

Leaving passing(const Vec3& x0, const Vec3& v0, const Vec3& x1, const Vec3& v1) {
  const double before = x0.norm() - ball - gap, after = x1.norm() - ball - gap, part = before / (before - after);
  const Vec3 x = x0 + part * (x1 - x0);
  return {std::atan2(x.x(), x.y()) * 180 / std::numbers::pi, (v0 + part * (v1 - v0)).norm()};
}

}  // namespace

Scene drop_on_ball(double restitution) {
  return probe("drop-on-ball", 0.9,
               fmt::format("[[particle]]\nposition = [0, {}, 0]\nmass = 1\n{}[sphere]\ncentre = [0, -0.5, 0]\n"
                           "radius = 0.48\nmargin = 0.02\nrestitution = {}\n",
                           drop, downwards, restitution));
}

std::optional<double> rebound(const Method& method, const Scene& scene, double step, Outcome& out) {
  const Trajectory path = each_step(method, scene, step, out);
  if (out.verdict != Verdict::ok) return std::nullopt;
  const double fall = std::sqrt(2 * drop / gravity);  // s
  // searches the highest point after the landing only, because earlier heights belong to the fall. The landing is the
  // lowest sample within two steps of the impact
  int landed = 0;
  double lowest = INFINITY;
  for (int i = 0; i < path.frames(); ++i)
    if (const double y = path.x[i](1, 0); std::abs(path.t[i] - fall) <= 2 * step && y < lowest) lowest = y, landed = i;
  double highest = 0;
  for (int i = landed; i < path.frames(); ++i) highest = std::max(highest, path.x[i](1, 0));
  return highest;
}

Scene frictionless_slide() {
  const double angle = std::numbers::pi / 180, speed = std::sqrt(2 * gravity * ball * (1 - std::cos(angle)));
  return probe(
      "frictionless-slide", 2.2,
      fmt::format("[[particle]]\nposition = [{:.17g}, {:.17g}, 0]\nmass = 1\nvelocity = [{:.17g}, {:.17g}, 0]\n"
                  "{}[sphere]\ncentre = [0, 0, 0]\nradius = 1\nmargin = 0.02\n",
                  ball * std::sin(angle), ball * std::cos(angle), speed * std::cos(angle), -speed * std::sin(angle),
                  downwards));
}

std::optional<Leaving> leaving(const Method& method, double step, Outcome& out) {
  const Trajectory path = each_step(method, frictionless_slide(), step, out);
  for (int i = 1; i < path.frames() && path.v[i].cols() > 0; ++i)
    if (path.x[i].col(0).norm() > ball + gap)
      return passing(path.x[i - 1].col(0), path.v[i - 1].col(0), path.x[i].col(0), path.v[i].col(0));
  return std::nullopt;
}

Leaving leaving_by_theory() {
  const auto exact = exact_solution(frictionless_slide());
  double low = 0, high = 2.2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (exact->at(middle).x.col(0).norm() > ball + gap ? high : low) = middle;
  }
  const State at = exact->at(high);
  return {std::atan2(at.x(0, 0), at.x(1, 0)) * 180 / std::numbers::pi, at.v.col(0).norm()};
}

Scene on_slope(double degrees, double friction, Ground ground) {
  const double angle = degrees * std::numbers::pi / 180;
  if (ground == Ground::plane) {
    const Vec3 n(-std::sin(angle), std::cos(angle), 0);
    return probe("on-plane", 0.5,
                 fmt::format("[[particle]]\nposition = [0, 0, 0]\nmass = 1\n{}[plane]\npoint = [{:.17g}, {:.17g}, 0]\n"
                             "normal = [{:.17g}, {:.17g}, 0]\nmargin = 0.02\nfriction = {:.17g}\n",
                             downwards, -0.02 * n.x(), -0.02 * n.y(), n.x(), n.y(), friction));
  }
  return probe("on-slope", 0.5,
               fmt::format("[[particle]]\nposition = [0, 1000.02, 0]\nmass = 1\n[gravity]\nacceleration = [{:.17g}, "
                           "{:.17g}, 0]\n[sphere]\ncentre = [0, 0, 0]\nradius = 1000\nmargin = 0.02\nfriction = "
                           "{:.17g}\n",
                           gravity * std::sin(angle), -gravity * std::cos(angle), friction));
}

std::optional<ConeResult> cone(const Method& method, double degrees, double friction, Ground ground, double step,
                               Outcome& out) {
  const Scene scene = on_slope(degrees, friction, ground);
  Recorder recorder;
  out = run_method(method, scene, {step, scene.duration, 10}, {&recorder});
  if (out.verdict != Verdict::ok) return std::nullopt;
  const Trajectory& path = recorder.trajectory;
  const double angle = degrees * std::numbers::pi / 180, t = scene.duration;
  ConeResult result{(path.x.back() - path.x.front()).norm(),
                    std::max(0.0, gravity * (std::sin(angle) - friction * std::cos(angle))) * t * t / 2,
                    ContactState::neither};
  // m. On a plane of 10 degrees, a particle slides 0.21 mm if its friction is a thousandth below the limit, and the
  // error of a first-order rule is 0.02 mm.
  const double negligible = ground == Ground::plane ? 5e-5 : 1e-3;
  if (result.distance < negligible)
    result.state = ContactState::sticks;
  else if (std::abs(result.distance - result.coulomb) < 0.1 * result.coulomb + negligible)
    result.state = ContactState::slides;
  return result;
}

namespace {

constexpr double returned = 0.8, width = 0.7, speed = 3;  // restitution; m between the contact planes; m/s
constexpr int periods = 10;

/// Highest position after the third landing, m; 0 if there are fewer landings.
double third_apex(const Trajectory& path) {
  int landings = 0;
  bool falling = false;
  double highest = 0;
  for (int i = 1; i < path.frames() && landings < 4; ++i) {
    const double rise = path.x[i](1, 0) - path.x[i - 1](1, 0);
    if (falling && rise > 0) ++landings;
    if (rise != 0) falling = rise < 0;
    if (landings == 3) highest = std::max(highest, path.x[i](1, 0));
  }
  return highest;
}

/// Mean time between passages through the initial position in the initial direction, s.
std::optional<double> mean_period(const Trajectory& path) {
  int passages = 0;
  for (int i = 2; i < path.frames(); ++i) {
    const double before = path.x[i - 1](0, 0) - path.x[0](0, 0), after = path.x[i](0, 0) - path.x[0](0, 0);
    if (before < 0 && after >= 0 && ++passages == periods)
      return (path.t[i - 1] + (path.t[i] - path.t[i - 1]) * before / (before - after)) / periods;
  }
  return std::nullopt;
}

}  // namespace

Scene drop_on_floor() {
  return probe("drop-on-floor", 1.2,
               fmt::format("[[particle]]\nposition = [0, {}, 0]\nmass = 1\n{}[plane]\npoint = [0, -0.02, 0]\n"
                           "normal = [0, 1, 0]\nmargin = 0.02\nrestitution = {}\n",
                           drop, downwards, returned));
}

Scene between_walls() {
  return probe("between-walls", 4.8,
               fmt::format("[[particle]]\nposition = [0.3, 0, 0]\nmass = 1\nvelocity = [{}, 0, 0]\n"
                           "[[plane]]\npoint = [0, 0, 0]\nnormal = [1, 0, 0]\nrestitution = 1\n"
                           "[[plane]]\npoint = [{}, 0, 0]\nnormal = [-1, 0, 0]\nrestitution = 1\n",
                           speed, width));
}

double by_theory(PlaneProbe probe) {
  return probe == PlaneProbe::apex ? std::pow(returned, 6) : probe == PlaneProbe::loss ? 0 : 1;
}

std::optional<double> measured(PlaneProbe probe, const Method& method, double step, Outcome& out) {
  const Scene scene = probe == PlaneProbe::apex     ? drop_on_floor()
                      : probe == PlaneProbe::period ? between_walls()
                                                    : on_slope(probe == PlaneProbe::loss ? 25 : 0, 0.6, Ground::plane);
  Ledger ledger(scene.model, method.contact);
  const Trajectory path = each_step(method, scene, step, out, &ledger);
  if (out.verdict != Verdict::ok) return std::nullopt;
  if (probe == PlaneProbe::apex) return third_apex(path) / drop;
  if (probe == PlaneProbe::period) {
    const auto period = mean_period(path);
    return period ? std::optional(*period * speed / (2 * width)) : std::nullopt;
  }
  if (probe == PlaneProbe::loss) {
    const double gained = std::pow(gravity * std::sin(25 * std::numbers::pi / 180) * scene.duration, 2) / 2;  // J
    return ledger.rows().empty() ? std::nullopt : std::optional(ledger.rows().back().contact / gained);
  }
  // a particle counts as at rest if it is slower than a thousandth of the speed after one step of free fall
  int held = 0;
  for (int i = 1; i < path.frames(); ++i) held += path.v[i].norm() < 1e-3 * gravity * step;
  return double(held) / (path.frames() - 1);
}

std::vector<Scene> contact_order_probes() {
  const auto particle = [](double angle, double speed) {
    return fmt::format("[[particle]]\nposition = [{:.17g}, {:.17g}, 0]\nmass = 0.1\nvelocity = [{:.17g}, {:.17g}, 0]\n",
                       std::sin(angle), std::cos(angle), speed * std::cos(angle), -speed * std::sin(angle));
  };
  const auto sphere = [](double x, const std::string& surface) {
    return fmt::format("[[sphere]]\ncentre = [{}, 0, 0]\nradius = 1\n{}\n", x, surface);
  };
  std::string chain;
  for (int i = 0; i < 9; ++i) chain += particle(-0.3 + 0.9 * i / 8, 0);
  for (int i = 0; i < 8; ++i) chain += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = 200\n", i, i + 1);
  std::vector<Scene> scenes = {
      probe("leaves", 1, particle(0.2, 0.6) + sphere(0, "") + downwards),
      probe("leaves with friction", 1, particle(0, 1) + sphere(0, "friction = 0.2") + downwards),
      probe("stops", 0.6, particle(0, 1) + sphere(0, "friction = 0.5") + downwards),
      probe("bounces", 1,
            "[[particle]]\nposition = [0, 1.3, 0]\nmass = 0.1\n" + sphere(0, "restitution = 0.7") + downwards),
      probe("valley", 1, particle(0.2, 0) + sphere(0, "") + sphere(0.8, "") + downwards),
      probe("chain", 0.5, chain + sphere(0, "friction = 0.3") + downwards)};
  for (Scene& scene : scenes) scene.samples = 20;
  return scenes;
}

namespace {

Scene falling_cloth(const std::string& name, double aside, double friction, double gamma, double duration) {
  Scene scene =
      probe(name, duration,
            fmt::format("[camera]\neye = [2.4, 1.3, 2.9]\ntarget = [0, -0.2, 0]\n"
                        "[grid]\nsize = [13, 13]\norigin = [{}, 0.65, -0.5]\nu = [1, 0, 0]\nv = [0, 0, 1]\n"
                        "mass = 1\n[grid.stiffness]\nstructural = 150\nshear = 150\nbend = 30\n{}[drag]\n"
                        "gamma = {}\n[sphere]\ncentre = [0, 0, 0]\nradius = 0.48\nmargin = 0.02\nfriction = {}\n",
                        aside - 0.5, downwards, gamma, friction));
  scene.samples = static_cast<int>(std::lround(50 * duration));
  return scene;
}

}  // namespace

Scene drop_centred() { return falling_cloth("drop-centred", 0, 0.5, 4, 3); }
Scene drop_aside() { return falling_cloth("drop-aside", 0.12, 0.25, 2, 1.6); }

}  // namespace crosscheck
