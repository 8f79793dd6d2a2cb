// Bodies of pictures: cloth as a surface with threads or as tubes, networks as tubes and beads.
#include "report/bodies.h"

#include <algorithm>

#include "report/strain.h"

namespace crosscheck {
namespace {

bool is_thread(const Spring& s) { return s.family == Family::structural; }

}  // namespace

render::Body body_of(const Scene& scene, const Answer& answer, int frame, Mode mode, const Points* base) {
  render::Body body;
  body.x = answer.trajectory.x[frame];
  body.pinned = scene.model.particles.pins;
  const auto* springs = scene.model.find<Springs>();
  const auto* constraints = scene.model.find<Constraints>();
  const bool surface = !scene.triangles.empty() && mode != Mode::springs;
  if (surface) {
    body.triangles = scene.triangles;
    if (springs)
      for (const Spring& s : springs->list)
        if (is_thread(s)) body.threads.push_back({s.a, s.b});
    if (constraints)
      for (const auto& [a, b, length] : constraints->list) body.threads.push_back({a, b});
  } else {
    if (scene.triangles.empty()) body.bead_radius = render::by_view;
    std::vector<double> strain;
    if (mode == Mode::stretch) stretch_of(scene, body.x, &strain);
    if (springs)
      for (size_t i = 0; i < springs->list.size(); ++i) {
        const Spring& s = springs->list[i];
        body.tubes.push_back({s.a, s.b});
        if (mode == Mode::stretch) body.tube_value.push_back(strain[i]);
      }
    if (constraints)
      for (const auto& [a, b, length] : constraints->list) {
        body.tubes.push_back({a, b});
        if (mode == Mode::stretch) body.tube_value.push_back(extension(body.x, a, b, length));
      }
  }
  if (surface && mode == Mode::stretch) body.value = stretch_of(scene, body.x);
  if (mode == Mode::difference && base) {
    body.value.resize(body.x.cols());
    for (int i = 0; i < body.x.cols(); ++i) body.value[i] = 1000 * (body.x.col(i) - base->col(i)).norm();
  }
  // the last particle of a scene without cloth draws its path
  if (scene.triangles.empty())
    for (int i = 0; i <= frame; ++i) body.trail.push_back(answer.trajectory.x[i].col(body.x.cols() - 1));
  return body;
}

std::vector<Family> families_of(const Scene& scene) {
  std::vector<Family> present;
  if (!scene.model.find<Springs>()) return present;
  for (const Family family : {Family::structural, Family::shear, Family::bend, Family::single})
    for (const Spring& s : scene.model.find<Springs>()->list)
      if (s.family == family) {
        present.push_back(family);
        break;
      }
  return present;
}

std::vector<render::Body> tubes_of(const Scene& scene, const Points& x, const Vec3& towards_eye) {
  const auto& springs = scene.model.find<Springs>()->list;
  double spacing = 1e300;
  for (const Spring& s : springs)
    if (s.rest > 0) spacing = std::min(spacing, s.rest);
  std::vector<render::Body> bodies;
  for (const Family family : families_of(scene)) {
    render::Body body;
    body.x = x;
    if (family == Family::bend) body.x.colwise() += 0.12 * spacing * towards_eye;
    if (bodies.empty()) body.pinned = scene.model.particles.pins;
    body.tube_radius = spacing * (family == Family::bend ? 0.035 : family == Family::shear ? 0.045 : 0.11);
    for (const Spring& s : springs)
      if (s.family == family) body.tubes.push_back({s.a, s.b});
    body.tube_colour.assign(body.tubes.size(), static_cast<int>(bodies.size()));
    bodies.push_back(std::move(body));
  }
  return bodies;
}

std::vector<render::Ball> balls_of(const Scene& scene, double t) {
  std::vector<render::Ball> balls;
  if (const auto* spheres = scene.model.find<Spheres>())
    for (const Sphere& s : spheres->list) balls.push_back({s.centre_at(t), s.radius});
  return balls;
}

}  // namespace crosscheck
