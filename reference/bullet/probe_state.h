// A state into which a body is put for a moment, to ask its world for forces.
#pragma once

#include "reference/bullet/scene_body.h"

namespace crosscheck::bullet {

/// Puts the nodes to 1.1 times the start, so that all springs pull, with velocities that are no rigid motion: x + P x
/// (as m/s), P turning the coordinates by one place, under which every distance d grows, d . (d + P d) >= |d|^2 / 2.
/// Puts all back when it goes.
class ProbeState {
 public:
  ProbeState(const Scene& scene, SceneBody& body, double t) : body_(body) {
    const Particles& particles = scene.model.particles;
    const int n = particles.size();
    asked_.t = t;
    asked_.x = 1.1 * scene.start.x;
    asked_.v.resize(3, n);
    asked_.v << asked_.x.row(1), asked_.x.row(2), asked_.x.row(0);
    asked_.v += asked_.x;
    for (int i = 0; i < n; ++i) {
      auto& node = body.body().m_nodes[body.node_of(i)];
      kept_.push_back({node.m_x, node.m_q, node.m_v, node.m_f});
      if (particles.pinned[i]) asked_.v.col(i) = particles.move ? velocity_at(*particles.move, t) : Vec3::Zero();
      node.m_q = node.m_x = to_bullet(asked_.x.col(i));
      node.m_v = particles.pinned[i] ? btVector3(0, 0, 0) : to_bullet(asked_.v.col(i));
      node.m_f = btVector3(0, 0, 0);
    }
  }
  ~ProbeState() {
    for (size_t i = 0; i < kept_.size(); ++i) {
      auto& node = body_.body().m_nodes[body_.node_of(static_cast<int>(i))];
      node.m_x = kept_[i].x, node.m_q = kept_[i].q, node.m_v = kept_[i].v, node.m_f = kept_[i].f;
    }
  }
  ProbeState(const ProbeState&) = delete;
  ProbeState& operator=(const ProbeState&) = delete;

  /// The nodes stay where they are, at rest.
  void stop() {
    for (int i = 0; i < body_.body().m_nodes.size(); ++i) body_.body().m_nodes[i].m_v = btVector3(0, 0, 0);
  }

  /// Forces by node, as the scene numbers the particles.
  template <class Stack>
  ForceProbe probe(const Stack& springs, const Stack& dashpots, const Stack& wind) const {
    ForceProbe p = asked_;
    p.springs = by_particle(springs), p.dashpots = by_particle(dashpots), p.wind = by_particle(wind);
    return p;
  }

 private:
  struct Kept {
    btVector3 x, q, v, f;
  };
  template <class Stack>
  Points by_particle(const Stack& by_node) const {
    Points points(3, by_node.size());
    for (int i = 0; i < by_node.size(); ++i) points.col(i) = from_bullet(by_node[body_.node_of(i)]);
    return points;
  }

  SceneBody& body_;
  ForceProbe asked_;
  std::vector<Kept> kept_;  // by particle
};

}  // namespace crosscheck::bullet
