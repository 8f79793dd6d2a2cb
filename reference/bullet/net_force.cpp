// The scene's forces on Bullet's nodes.
#include "reference/bullet/net_force.h"

#include <algorithm>

namespace crosscheck::bullet {

NetForce::NetForce(const Parts& parts, const Scene& scene, const SceneBody& body)
    : parts_(parts), scene_(scene), scene_body_(body) {
  if (parts.air) seen_ = scene.start, of_air_.f = Points::Zero(3, scene.model.particles.size());
}

const btSoftBody::Node& NetForce::node(int particle) const {
  return m_softBodies[0]->m_nodes[scene_body_.node_of(particle)];
}

btVector3 NetForce::velocity(int particle) const {
  const Particles& particles = scene_.model.particles;
  if (particles.pinned[particle] && particles.move) return to_bullet(velocity_at(*particles.move, t_));
  return node(particle).m_v;
}

btVector3 NetForce::line(int a, int b) const {
  // where Bullet's own dashpots look in the explicit world; where the springs look in the implicit one
  return parts_.implicit ? node(a).m_q - node(b).m_q : node(a).m_x - node(b).m_x;
}

void NetForce::addScaledElasticForce(btScalar scale, TVStack& force) {
  if (!parts_.springs) return;
  for (const Spring& s : parts_.springs->list) {
    const auto &a = node(s.a), &b = node(s.b);
    const btVector3 d = a.m_q - b.m_q;
    const btScalar length = d.length();
    if (length == 0) continue;
    const btVector3 f =
        d * static_cast<btScalar>(-scale * parts_.factor * tension_of(s, parts_.springs->law, length).force / length);
    force[a.index] += f;
    force[b.index] -= f;
  }
}

void NetForce::addScaledElasticForceDifferential(btScalar scale, const TVStack& dx, TVStack& df) {
  if (!parts_.springs) return;
  for (const Spring& s : parts_.springs->list) {
    const auto &a = node(s.a), &b = node(s.b);
    btVector3 n = a.m_q - b.m_q;
    const btScalar length = n.length();
    if (length == 0) continue;
    n /= length;
    const Tension tension = tension_of(s, parts_.springs->law, length);
    const double along = std::max(tension.slope, 0.0), across = std::max(tension.force / length, 0.0);
    const btVector3 moved = dx[a.index] - dx[b.index];
    const btVector3 f =
        n * static_cast<btScalar>((along - across) * n.dot(moved)) + moved * static_cast<btScalar>(across);
    df[a.index] -= f * static_cast<btScalar>(scale * parts_.factor);
    df[b.index] += f * static_cast<btScalar>(scale * parts_.factor);
  }
}

void NetForce::add_particle_forces(btScalar scale, TVStack& force) {
  const Particles& particles = scene_.model.particles;
  const auto by = static_cast<btScalar>(scale * parts_.factor);
  const btVector3 wind = parts_.wind ? to_bullet(parts_.wind->acceleration.at(t_)) : btVector3(0, 0, 0);
  for (int i = 0; i < particles.size(); ++i) {
    if (parts_.wind) force[node(i).index] += wind * (by * static_cast<btScalar>(particles.mass[i]));
    if (parts_.drag) force[node(i).index] -= node(i).m_v * (by * static_cast<btScalar>(parts_.drag->c[i]));
  }
  if (!parts_.air) return;
  seen_.t = t_;
  for (int i = 0; i < particles.size(); ++i) {
    seen_.x.col(i) = from_bullet(node(i).m_q);
    seen_.v.col(i) = from_bullet(velocity(i));
  }
  of_air_.clear();
  add_force(*parts_.air, particles, seen_, of_air_);
  for (int i = 0; i < particles.size(); ++i) force[node(i).index] += to_bullet(of_air_.f.col(i)) * by;
}

void NetForce::addScaledExplicitForce(btScalar scale, TVStack& force) {
  addScaledElasticForce(scale, force);
  add_particle_forces(scale, force);
}

void NetForce::addScaledForces(btScalar scale, TVStack& force) {
  addScaledExplicitForce(scale, force);
  addScaledDampingForce(scale, force);
}

void NetForce::addScaledDampingForce(btScalar scale, TVStack& force) {
  if (!parts_.dashpots) return;
  for (const auto& [a, b, c] : parts_.dashpots->list) {
    const btVector3 d = line(a, b);
    if (d.length2() == 0) continue;
    const btVector3 f = d * static_cast<btScalar>(-scale * c * (velocity(a) - velocity(b)).dot(d) / d.length2());
    force[node(a).index] += f;
    force[node(b).index] -= f;
  }
}

void NetForce::addScaledDampingForceDifferential(btScalar scale, const TVStack& dv, TVStack& df) {
  if (parts_.dashpots)
    for (const auto& [a, b, c] : parts_.dashpots->list) {
      const btVector3 d = line(a, b);
      if (d.length2() == 0) continue;
      const btVector3 change = dv[node(a).index] - dv[node(b).index];
      const btVector3 f = d * static_cast<btScalar>(scale * c * change.dot(d) / d.length2());
      df[node(a).index] -= f;
      df[node(b).index] += f;
    }
  if (parts_.drag && parts_.implicit)
    for (int i = 0; i < scene_.model.particles.size(); ++i)
      df[node(i).index] -= dv[node(i).index] * static_cast<btScalar>(scale * parts_.factor * parts_.drag->c[i]);
}

void NetForce::buildDampingForceDifferentialDiagonal(btScalar scale, TVStack& diagonal) {
  if (!parts_.dashpots) return;
  for (const auto& [a, b, c] : parts_.dashpots->list) {
    const btVector3 d = line(a, b);
    if (d.length2() == 0) continue;
    const btVector3 own = d * d * static_cast<btScalar>(scale * c / d.length2());
    if (node(a).m_im > 0) diagonal[node(a).index] -= own;
    if (node(b).m_im > 0) diagonal[node(b).index] -= own;
  }
}

}  // namespace crosscheck::bullet
