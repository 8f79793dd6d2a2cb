// Spheres act one after the other, each in its own frame.
#include "mysim/contacts.h"

namespace crosscheck {

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
  const auto act = rule_ == ContactRule::sticky ? resolve_contact_sticky : resolve_contact;
  for (const Sphere& sphere : spheres_->list) {
    const Vec3 centre = sphere.centre_at(s.t), shift = centre - sphere.centre_at(t_n_);
    const Vec3 velocity = sphere.motion ? velocity_at(*sphere.motion, s.t) : Vec3::Zero();
    for (int i = 0; i < particles_.size(); ++i) {
      if (particles_.pinned[i]) continue;
      Vec3 relative = s.v.col(i) - velocity;
      if (act(sphere, centre, x_n_.col(i) + shift, s.x.col(i), relative) > 0) {
        s.v.col(i) = relative + velocity;
        touched_ = true;
      }
    }
  }
  return touched_;
}

void Contacts::tell(Observer& observer, const State& resolved) const {
  if (touched_) observer.contact(proposed_, resolved);
}

}  // namespace crosscheck
