// Extended position-based dynamics with small steps (M. Macklin, M. Mueller and N. Chentanez, Motion in Games, 2016; M.
// Macklin et al., Symposium on Computer Animation, 2019): a free step, then one pass over dashpots, springs, bending
// and hard distances, each of which corrects the positions of its particles immediately.

#include <algorithm>

#include "mysim/steppers/steppers.h"

namespace crosscheck {
namespace {

class ProjectionPass {
 public:
  ProjectionPass(const Particles& particles, const Eigen::ArrayXd& drag_rate, const Points& x_n, double h, State& s)
      : particles_(particles), drag_rate_(drag_rate), x_n_(x_n), h_(h), s_(s) {}

  /// Drag is implicit: it divides the effect of every force in a step by 1 + h gamma.
  double inverse_mass(int i) const {
    return particles_.pinned[i] ? 0 : 1 / (particles_.mass[i] * (1 + h_ * drag_rate_[i]));
  }
  double inverse_mass(int a, int b) const { return inverse_mass(a) + inverse_mass(b); }
  Vec3 between(int a, int b) const { return s_.x.col(a) - s_.x.col(b); }
  Vec3 moved_apart(int a, int b) const { return between(a, b) - (x_n_.col(a) - x_n_.col(b)); }
  /// impulse in kg m.
  void push(int i, const Vec3& impulse) {
    const Vec3 by = inverse_mass(i) * impulse;
    s_.x.col(i) += by;
    s_.v.col(i) += by / h_;
  }
  void push(int a, int b, const Vec3& impulse) {
    push(a, impulse);
    push(b, -impulse);
  }

 private:
  const Particles& particles_;
  const Eigen::ArrayXd& drag_rate_;
  const Points& x_n_;
  double h_;
  State& s_;
};

}  // namespace

void xpbd(System& f, State& s, double h, Workspace& w) {
  const Model& model = f.model();
  Points &x_n = w[0].x, &a = w[1].v;
  x_n = s.x;

  // free step: forces that are not constraints, implicit drag, pins at their new positions
  f.external_acceleration(s, a);
  for (int i = 0; i < s.x.cols(); ++i) s.v.col(i) = (s.v.col(i) + h * a.col(i)) / (1 + h * f.drag_rate()[i]);
  s.x += h * s.v;
  s.t += h;
  model.particles.place_pins(s);

  ProjectionPass pass(model.particles, f.drag_rate(), x_n, h, s);
  f.count(1);
  if (const auto* dashpots = model.find<Dashpots>())
    for (const auto& [i, j, c] : dashpots->list) {
      const Vec3 d = pass.between(i, j);
      const double length2 = d.squaredNorm(), inverse = pass.inverse_mass(i, j);
      if (length2 == 0) continue;
      // dashpots are implicit: the remaining separation d' along the line satisfies d' + (c h inverse mass) d' = moved
      // apart
      pass.push(i, j, (-c * h * pass.moved_apart(i, j).dot(d) / (length2 * (1 + c * h * inverse))) * d);
    }
  if (const auto* springs = model.find<Springs>())
    for (const Spring& p : springs->list) {
      const Vec3 d = pass.between(p.a, p.b);
      const double length = d.norm();
      if (length == 0) {
        f.count_degenerate_springs(p.rest > 0);
        continue;
      }
      // springs are implicit along the line, and linearised; with Hooke's law they correct by -(L - r) / (inverse mass
      // + compliance / h^2)
      const auto [force, slope] = tension_of(p, springs->law, length);
      const double stiffening = h * h * std::max(0.0, slope) * pass.inverse_mass(p.a, p.b);
      pass.push(p.a, p.b, (-h * h * force / (length * (1 + stiffening))) * d);
    }
  if (const auto* bending = model.find<Bending>())
    for (const Bending::Stencil& p : bending->list) {
      double inverse = 0;  // 1/kg, for c
      for (int i = 0; i < p.size; ++i) inverse += p.weight[i] * p.weight[i] * pass.inverse_mass(p.particle[i]);
      // bending is implicit and linear: the remaining c' satisfies c' + (h^2 k inverse mass) c' = c
      const Vec3 impulse = -h * h * p.k / (1 + h * h * p.k * inverse) * bent(p, s.x);
      for (int i = 0; i < p.size; ++i) pass.push(p.particle[i], p.weight[i] * impulse);
    }
  if (const auto* constraints = model.find<Constraints>())
    for (const auto& [i, j, rest] : constraints->list) {
      const Vec3 d = pass.between(i, j);
      const double length = d.norm(), inverse = pass.inverse_mass(i, j);
      if (length == 0)
        f.count_degenerate_springs(1);
      else if (inverse > 0)
        pass.push(i, j, (-(length - rest) / (length * inverse)) * d);
    }
}

}  // namespace crosscheck
