// The scene's forces on Bullet's nodes.
#include "reference/bullet/net_force.h"

namespace crosscheck::bullet {

void NetForce::addScaledElasticForce(btScalar scale, TVStack& force) {
  if (!parts_.springs) return;
  const auto& nodes = m_softBodies[0]->m_nodes;
  for (const Spring& s : parts_.springs->list) {
    const auto& a = nodes[scene_body_.node_of(s.a)];
    const auto& b = nodes[scene_body_.node_of(s.b)];
    const btVector3 d = a.m_q - b.m_q;
    const btScalar length = d.length();
    if (length == 0) continue;
    const btVector3 f = d * (-scale * parts_.factor * tension_of(s, parts_.springs->law, length).force / length);
    force[a.index] += f;
    force[b.index] -= f;
  }
}

void NetForce::addScaledExplicitForce(btScalar scale, TVStack& force) {
  addScaledElasticForce(scale, force);
  const auto& nodes = m_softBodies[0]->m_nodes;
  const btVector3 wind = parts_.wind ? to_bullet(parts_.wind->acceleration.at(t_)) : btVector3(0, 0, 0);
  for (int i = 0; i < particles_.size(); ++i) {
    const auto& node = nodes[scene_body_.node_of(i)];
    if (parts_.wind) force[node.index] += wind * (scale * parts_.factor * particles_.mass[i]);
    if (parts_.drag) force[node.index] -= node.m_v * (scale * parts_.factor * parts_.drag->c[i]);
  }
}

}  // namespace crosscheck::bullet
