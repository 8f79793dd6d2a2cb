// Contact on whole steps: surfaces act one after another.
#include "mysim/run/contacts.h"

#include <cassert>

#include "mysim/run/contact_events.h"
#include "mysim/steppers/steppers.h"

namespace crosscheck {

std::optional<ContactRule> contact_rule_of_option(std::string_view option) {
  if (option == "events") return ContactRule::events;
  if (option == "sticky") return ContactRule::sticky;
  return std::nullopt;
}

bool locates_events(const Stepper& stepper) { return stepper.order > 1 && stepper.evaluations <= 1; }

std::optional<double> resolve_surfaces(std::span<const Surface> surfaces, ContactFunction act, double t_n, double t,
                                       const Vec3& x_n, const Vec3& v_n, Eigen::Ref<Vec3> x, Eigen::Ref<Vec3> v,
                                       bool with_loss) {
  assert(t > t_n);
  bool touched = false;
  const Vec3 change = v - v_n;    // m/s, by all other forces
  Vec3 friction = Vec3::Zero();   // m/s, of lasting contacts
  double impacts = 0, given = 0;  // per unit mass: m^2/s^2; `given`: m^2/s, (work of moving surfaces) x step
  for (const Surface& surface : surfaces) {
    const Vec3 origin = surface.origin_at(t), displacement = origin - surface.origin_at(t_n);
    const Vec3 velocity = surface.velocity_at(t);
    const Vec3 x_before = x, v_before = v;
    Vec3 relative = v - velocity;
    if (!(act(surface, origin, x_n + displacement, x, relative) > 0)) continue;
    touched = true;
    v = relative + velocity;
    if (!with_loss) continue;

    const Vec3 impulse = v - v_before;
    const Vec3 seen = surface.moving() ? Vec3(change - velocity + surface.velocity_at(t_n)) : change;
    if (impulse.norm() > 3 * (1 + surface.restitution) * seen.norm()) {
      impacts += change.dot(x - x_before) / (t - t_n) - impulse.dot(v_before + v) / 2;
      continue;
    }
    const Vec3 normal = surface.normal(x - origin);
    const Vec3 along = impulse.dot(normal) * normal;
    friction += impulse - along;
    given += along.dot(displacement);
  }
  if (!touched) return std::nullopt;
  if (!with_loss) return 0;
  return impacts - (friction.dot(x - x_n) + given) / (t - t_n);
}

Contacts::Contacts(const Model& model, ContactRule rule)
    : particles_(model.particles), surfaces_(surfaces_of(model)), rule_(rule) {
  drag_rate_ = Eigen::ArrayXd::Zero(particles_.size());
  if (const auto* drag = model.find<Drag>()) drag_rate_ = drag->c.array() / particles_.mass.array();
}

void Contacts::begin(const State& s) {
  if (any()) before_ = s;
}

bool Contacts::resolve(State& s) {
  lost_.reset();
  if (!any()) return false;
  assert(before_.x.cols() == s.x.cols());  // begin() came before
  const ContactFunction act = rule_ == ContactRule::sticky ? resolve_contact_sticky : resolve_contact;
  std::vector<SurfaceTrack> tracks;
  if (rule_ == ContactRule::events) tracks = surface_tracks(surfaces_, before_.t, s.t);
  for (int i = 0; i < particles_.size(); ++i) {
    if (particles_.pinned[i]) continue;
    const Vec3 x_n = before_.x.col(i), v_n = before_.v.col(i);
    const auto lost = rule_ == ContactRule::events
                          ? resolve_events(tracks, s.t - before_.t, drag_rate_[i], x_n, v_n, s.x.col(i), s.v.col(i))
                          : resolve_surfaces(surfaces_, act, before_.t, s.t, x_n, v_n, s.x.col(i), s.v.col(i));
    if (lost) lost_ = lost_.value_or(0) + particles_.mass[i] * *lost;
  }
  return lost_.has_value();
}

}  // namespace crosscheck
