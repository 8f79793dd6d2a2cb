// Spheres act one after the other on each particle.
#include "mysim/contacts.h"

namespace crosscheck {

bool touch(const Spheres& spheres, ContactFunction act, double t_n, double t, const Vec3& x_n, Eigen::Ref<Vec3> x,
           Eigen::Ref<Vec3> v) {
  bool touched = false;
  for (const Sphere& sphere : spheres.list) {
    const Vec3 centre = sphere.centre_at(t), shift = centre - sphere.centre_at(t_n);
    const Vec3 velocity = sphere.motion ? velocity_at(*sphere.motion, t) : Vec3::Zero();
    Vec3 relative = v - velocity;
    if (act(sphere, centre, x_n + shift, x, relative) > 0) {
      v = relative + velocity;
      touched = true;
    }
  }
  return touched;
}

Contacts::Contacts(const Model& model, ContactRule rule)
    : particles_(model.particles), spheres_(model.find<Spheres>()), rule_(rule) {}

void Contacts::begin(const State& s) {
  if (!spheres_) return;
  t_n_ = s.t;
  x_n_ = s.x;
}

bool Contacts::resolve(State& s) {
  if (!spheres_) return false;
  proposed_ = s;
  touched_ = false;
  const ContactFunction act = rule_ == ContactRule::sticky ? resolve_contact_sticky : resolve_contact;
  for (int i = 0; i < particles_.size(); ++i)
    if (!particles_.pinned[i]) touched_ |= touch(*spheres_, act, t_n_, s.t, x_n_.col(i), s.x.col(i), s.v.col(i));
  return touched_;
}

void Contacts::tell(Observer& observer, const State& resolved) const {
  if (touched_) observer.contact(proposed_, resolved);
}

}  // namespace crosscheck
