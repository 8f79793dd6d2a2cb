// One particle through one step: flight, impact, sliding, sticking, wedging between surfaces.
#include "mysim/run/contact_events.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace crosscheck {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr int most_events = 16;   // per step; after these, the rule for whole steps (terms/surface.h) applies
constexpr int most_contacts = 4;  // simultaneous, of a particle

/// Smallest argument, accurate to the last few bits, at which the condition holds. It must be false at `low` and true
/// at `high`.
template <class Condition>
double first_time(Condition holds, double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    if (!(middle > low && middle < high)) break;
    (holds(middle) ? high : low) = middle;
  }
  return high;
}

double cubed(double s) { return s * s * s; }

Vec3 without_normal_part(const Vec3& v, const Vec3& n) { return v - v.dot(n) * n; }

Vec3 direction_of(const Vec3& v, const Vec3& otherwise) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : otherwise;
}

class ParticleStep {
 public:
  ParticleStep(std::span<const SurfaceTrack> surfaces, double h, double gamma, const Vec3& x_n, const Vec3& v_n,
               const Vec3& x, const Vec3& v)
      : surfaces_(surfaces), h_(h), gamma_(gamma), reach_(x_n.norm() + h * (v_n.norm() + v.norm())), x_(x_n), v_(v_n) {
    b_ = (v - v_n) / h + gamma / 2 * (v_n + v);
    bend_ = x - (x_n + h / 2 * (v_n + v));
    ends_inside_ =
        std::any_of(surfaces.begin(), surfaces.end(), [&](const SurfaceTrack& track) { return inside(track, x, h); });
  }

  /// Returns false if the particle touched no surface.
  bool run() {
    for (int event = 0; event < most_events && done_ < h_; ++event) {
      find_contacts();
      if (count_ == 0)
        fly();
      else if (count_ == 1)
        slide_or_stick(*contacts_[0].track);
      else
        wedge();
    }
    if (!touched_ && !ends_inside_) return false;
    if (done_ < h_) finish_by_whole_step();
    // Moving a particle out of one surface may move it into another. Repetition converges to a point where both meet.
    for (int round = 0; round < 100; ++round) {
      bool inside = false;
      for (const SurfaceTrack& track : surfaces_) inside |= put_outside(track);
      if (!inside || surfaces_.size() == 1) break;
    }
    return true;
  }
  const Vec3& x() const { return x_; }
  const Vec3& v() const { return v_; }
  double lost() const { return lost_; }

 private:
  struct Point {
    Vec3 x, v;
  };
  struct Contact {
    const SurfaceTrack* track;
    Vec3 normal;
  };
  /// The end of a slide, relative to the surface.
  struct Slid {
    Vec3 r, w;
    double pressure;  // m/s^2, normal force N at the end
    Vec3 force;       // m/s^2, mean contact force
    double friction;  // m/s^2, tangential part of the force
    Vec3 along;       // direction of the motion that friction opposes
  };

  static double gap(const SurfaceTrack& track, const Vec3& x, double s) {
    return track.surface().gap(x - track.origin(s));
  }
  /// True if x is inside by more than rounding. A particle that takes off from the surface thus counts as outside.
  bool inside(const SurfaceTrack& track, const Vec3& x, double s) const {
    return gap(track, x, s) < -16 * eps * track.surface().rounding_scale(track.origin(s), reach_);
  }
  Vec3 normal_at(const SurfaceTrack& track) const { return track.surface().normal(x_ - track.origin(done_)); }
  void put_on(const SurfaceTrack& track) { x_ = track.surface().put_on(track.origin(done_), x_, normal_at(track)); }
  /// Returns false if the particle is already outside.
  bool put_outside(const SurfaceTrack& track) {
    if (!(gap(track, x_, done_) < 0)) return false;
    put_on(track);
    return true;
  }
  void change_velocity(const Vec3& v) {
    lost_ += (v_.squaredNorm() - v.squaredNorm()) / 2;
    v_ = v;
  }

  /// Normal force N (m/s^2) that keeps the particle on the surface at its current velocity.
  double pressure(const SurfaceTrack& track, const Vec3& n) const {
    const Vec3 w = without_normal_part(v_ - track.velocity(done_), n);
    return -(b_ - gamma_ * v_ - track.acceleration()).dot(n) - w.squaredNorm() / track.surface().radius();
  }

  /// Applies the impulses of surfaces that the particle runs into, and lists the surfaces that it stays on.
  void find_contacts() {
    std::array<Contact, most_contacts> near;
    int touching = 0;
    for (const SurfaceTrack& track : surfaces_) {
      // rounding error of a position on the surface: of the centre, of the radius, and of a step away and back
      const double rounding = 1e-12 * track.surface().rounding_scale(track.origin(done_), reach_);
      if (touching == most_contacts || !(gap(track, x_, done_) <= rounding)) continue;
      put_outside(track);
      near[touching++] = {&track, normal_at(track)};
    }
    bool hit = false;
    for (int round = 0; round < 20; ++round) {
      bool again = false;
      for (int i = 0; i < touching; ++i) again |= collide(near[i]);
      hit |= again;
      if (!again || touching == 1) break;
    }
    count_ = 0;
    for (int i = 0; i < touching; ++i) {
      const auto& [track, n] = near[i];
      const double away = (v_ - track->velocity(done_)).dot(n), press = pressure(*track, n);
      // after an impact, a particle that would return within a step stays; without an impact, it separates at any speed
      // above rounding
      const double slow = (hit ? 1 : 1e-6) * h_ * press / 2 + 8 * eps * v_.norm();
      if (press > 0 && away <= slow) contacts_[count_++] = near[i];
    }
    for (int i = 0; i < count_; ++i) {
      const auto& [track, n] = contacts_[i];
      touched_ = true;
      if (const double away = (v_ - track->velocity(done_)).dot(n); away > 0) change_velocity(v_ - away * n);
    }
  }

  /// Applies the impulse of an impact. Returns false if the particle does not move inward.
  bool collide(const Contact& contact) {
    const auto& [track, n] = contact;
    const Surface& surface = track->surface();
    const Vec3 w = v_ - track->velocity(done_);
    const double inward = -w.dot(n);
    if (!(inward > 4 * eps * v_.norm())) return false;
    touched_ = true;
    const bool is_back_within_step = 2 * surface.restitution * inward < h_ * pressure(*track, n);
    const double change = (1 + (is_back_within_step ? 0 : surface.restitution)) * inward;
    const Vec3 along = without_normal_part(w, n);
    const double speed = along.norm(), kept = std::max(0.0, speed - surface.friction * change);
    Vec3 after = (change - inward) * n;
    if (speed > 0) after += kept / speed * along;
    change_velocity(track->velocity(done_) + after);
    return true;
  }

  /// The stepper's path (a Hermite cubic through its states) minus the parabola, if the path starts with the step.
  Vec3 bent(double s) const {
    const double part = s / h_;
    return done_ == 0 ? Vec3(part * part * (3 - 2 * part) * bend_) : Vec3::Zero();
  }
  Point flight(double s) const {
    Vec3 v = v_ + s / (1 + s * gamma_ / 2) * (b_ - gamma_ * v_);
    Vec3 x = x_ + s / 2 * (v_ + v);
    x += bent(s);
    if (const double part = s / h_; done_ == 0) v += 6 * part * (1 - part) / h_ * bend_;
    return {x, v};
  }

  /// Free flight until a surface is reached or the step ends.
  void fly() {
    double until = h_ - done_;
    for (const SurfaceTrack& track : surfaces_) {
      const auto is_inside = [&](double s) { return inside(track, flight(s).x, done_ + s); };
      const auto recedes = [&](double s) {
        const Point p = flight(s);
        return track.surface().approach(p.x - track.origin(done_ + s), p.v - track.velocity(done_ + s)) > 0;
      };
      if (is_inside(until)) {
        until = first_time(is_inside, 0, until);
      } else if (!recedes(0) && recedes(until)) {
        const double nearest = first_time(recedes, 0, until);
        if (is_inside(nearest)) until = first_time(is_inside, 0, nearest);
      }
    }
    const Point p = flight(until);
    x_ = p.x, v_ = p.v;
    advance(until);
  }

  void advance(double s) {
    // a time that is less than the end of the step by a rounding error counts as the end
    done_ = done_ + s >= h_ * (1 - 4 * eps) ? h_ : done_ + s;
  }

  Slid slide(const SurfaceTrack& track, const Vec3& b, const Vec3& r, const Vec3& w, const Vec3& forward,
             double s) const {
    const Surface& surface = track.surface();
    const double mu = surface.friction, radius = surface.radius();
    const auto press = [&](const Vec3& n, const Vec3& speed) { return -b.dot(n) - speed.squaredNorm() / radius; };
    const Vec3 n0 = surface.normal_on(r);
    const double press0 = std::max(0.0, press(n0, w));
    // First half of the slide. Friction opposes the mean velocity of the slide, whose direction is the same as without
    // friction. If friction opposed an initial velocity much smaller than s mu N, transverse motion would grow without
    // bound.
    const Vec3 n = surface.normal(r + s / 2 * w);
    const Vec3 unheld = without_normal_part(w + s / 2 * (b - gamma_ * w + press0 * n0), n);
    Slid end;
    end.along = unheld.dot(forward) > 0 ? direction_of(unheld, forward) : forward;
    const double pressure = std::max(0.0, press(n, unheld - s / 2 * mu * press0 * end.along));
    end.friction = mu * pressure;
    end.force = pressure * n - end.friction * end.along;
    // the whole slide
    end.w = w + s / (1 + s * gamma_ / 2) * (b + end.force - gamma_ * w);
    const Vec3 to = r + s / 2 * (w + end.w) + without_normal_part(bent(s), n), n1 = surface.normal(to);
    end.r = surface.nearest(to, n1);
    end.w = without_normal_part(end.w, n1);
    end.pressure = press(n1, end.w);
    return end;
  }

  void slide_or_stick(const SurfaceTrack& track) {
    const Surface& surface = track.surface();
    const double rest = h_ - done_, mu = surface.friction;
    const Vec3 n = normal_at(track), r = surface.nearest(x_ - track.origin(done_), n);
    Vec3 w = without_normal_part(v_ - track.velocity(done_), n);
    const Vec3 surface_velocity = (track.velocity(done_) + track.velocity(h_)) / 2;
    const Vec3 b = b_ - track.acceleration() - gamma_ * surface_velocity;  // in the frame of the surface
    const Vec3 b_along = without_normal_part(b, n);
    const double press = -b.dot(n) - w.squaredNorm() / surface.radius();
    const bool holds = b_along.norm() <= mu * press;
    // a speed that friction removes within a billionth of the step is zero
    if (w.norm() <= 1e-9 * h_ * b.norm() && (holds || mu > 0)) {
      w.setZero();
      if (holds) {
        lost_ += rest * b.dot(surface_velocity);
        done_ = h_;
        x_ = track.origin(h_) + r, v_ = track.velocity(h_);
        return;
      }
    }
    const Vec3 forward = direction_of(w, direction_of(b_along, Vec3::Zero()));
    const auto stops = [&](const Slid& end) { return mu > 0 && !w.isZero(0) && end.w.dot(forward) <= 0; };
    const auto ends = [&](double s) {
      const Slid end = slide(track, b, r, w, forward, s);
      if (end.pressure < 0 || stops(end)) return true;
      const Vec3 x = track.origin(done_ + s) + end.r;
      return std::any_of(surfaces_.begin(), surfaces_.end(),
                         [&](const SurfaceTrack& other) { return &other != &track && inside(other, x, done_ + s); });
    };
    const double until = ends(rest) ? first_time(ends, 0, rest) : rest;
    Slid end = slide(track, b, r, w, forward, until);
    lost_ += until * (end.friction * end.along.dot(w + end.w) / 2 - end.force.dot(surface_velocity));
    advance(until);
    if (stops(end)) {
      end.w -= end.w.dot(forward) * forward;
      if (without_normal_part(b, surface.normal_on(end.r)).norm() <= mu * end.pressure) end.w.setZero();
    }
    x_ = track.origin(done_) + end.r, v_ = track.velocity(done_) + end.w;
  }

  /// Velocity after sliding between several surfaces, and the impulse of each.
  struct Wedged {
    Vec3 v;
    std::array<double, most_contacts> pushed;  // m/s
  };
  Wedged wedged(double s) const {
    const double end = s >= h_ - done_ ? h_ : done_ + s;
    const Point free = flight(s);
    std::array<Vec3, most_contacts> normal, along;
    Wedged to{free.v, {}};
    auto& [v, pushed] = to;
    for (int i = 0; i < count_; ++i) {
      const SurfaceTrack& track = *contacts_[i].track;
      normal[i] = track.surface().normal(x_ + s / 2 * v_ - track.origin(done_ + s / 2));
      along[i].setZero();
    }
    // each sweep multiplies the remaining error by at most the squared cosine of the angle between normals
    for (int sweep = 0; sweep < 500; ++sweep) {
      double change = 0;
      for (int i = 0; i < count_; ++i) {
        const Vec3 before = v;
        Vec3 w = v - contacts_[i].track->velocity(end);
        const double push = std::max(0.0, pushed[i] - w.dot(normal[i]));
        v += (push - pushed[i]) * normal[i];
        pushed[i] = push;
        w = without_normal_part(v - contacts_[i].track->velocity(end), normal[i]);
        Vec3 held = along[i] - w;
        if (const double size = held.norm(), most = contacts_[i].track->surface().friction * push; size > most)
          held *= most / size;
        v += held - along[i];
        along[i] = held;
        change = std::max(change, (v - before).norm());
      }
      if (!(change > eps * (free.v.norm() + v_.norm()))) break;
    }
    return to;
  }

  /// Moves in contact with several surfaces, until another surface is reached or the step ends.
  void wedge() {
    const double rest = h_ - done_;
    const auto is_in_another = [&](double s) {
      const Vec3 x = x_ + s / 2 * (v_ + wedged(s).v);
      return std::any_of(surfaces_.begin(), surfaces_.end(), [&](const SurfaceTrack& track) {
        const auto end = contacts_.begin() + count_;
        return std::none_of(contacts_.begin(), end, [&](const Contact& c) { return c.track == &track; }) &&
               inside(track, x, done_ + s);
      });
    };
    const double s =
        static_cast<int>(surfaces_.size()) > count_ && is_in_another(rest) ? first_time(is_in_another, 0, rest) : rest;
    const auto [v, pushed] = wedged(s);
    lost_ -= (v - flight(s).v).dot(v + v_) / 2;
    x_ += s / 2 * (v_ + v), v_ = v;
    advance(s);
    for (int round = 0; round < 100; ++round) {
      double off = 0;
      for (int i = 0; i < count_; ++i) {
        const SurfaceTrack& track = *contacts_[i].track;
        const double g = gap(track, x_, done_);
        if (g < 0 || pushed[i] > 0) put_on(track), off = std::max(off, std::abs(g));
      }
      if (!(off > 4 * eps * x_.norm())) break;
    }
  }

  void finish_by_whole_step() {
    const Vec3 x_n = x_, v_n = v_;
    const Point p = flight(h_ - done_);
    const double begun = done_;
    x_ = p.x, v_ = p.v, done_ = h_;
    for (const SurfaceTrack& track : surfaces_) {
      const Vec3 origin = track.origin(h_);
      Vec3 w = v_ - track.velocity(h_);
      resolve_contact(track.surface(), origin, x_n + origin - track.origin(begun), x_, w);
      v_ = track.velocity(h_) + w;
    }
    lost_ -= (v_ - p.v).dot(v_ + v_n) / 2;
  }

  const std::span<const SurfaceTrack> surfaces_;
  const double h_, gamma_, reach_;
  Vec3 b_, bend_;    // m/s^2; m
  Vec3 x_, v_;       // m, m/s, at time done_ of the step
  double done_ = 0;  // s
  double lost_ = 0;  // m^2/s^2
  bool touched_ = false, ends_inside_;
  std::array<Contact, most_contacts> contacts_;  // persistent
  int count_ = 0;
};

/// True if the particle may come near the surface during the step: a path of constant acceleration deviates from its
/// chord by at most h |v - v_n| / 8.
bool comes_near(const SurfaceTrack& track, double h, const Vec3& x_n, const Vec3& v_n, const Vec3& x, const Vec3& v) {
  const Vec3 from = x_n - track.origin(0), to = x - track.origin(h);
  const Surface& surface = track.surface();
  const double way = (to - from).norm() + h / 8 * (v - v_n - h * track.acceleration()).norm();
  if (surface.flat()) return !(surface.gap(from) > way * (1 + 1e-9) + 1e-12 * (from.norm() + track.origin(0).norm()));
  const double reach = surface.radius() * (1 + 1e-9) + way;
  return !(from.squaredNorm() > reach * reach);
}

}  // namespace

SurfaceTrack::SurfaceTrack(const Surface& surface, double t_n, double t)
    : surface_(&surface),
      h_(t - t_n),
      origin_(surface.origin_at(t_n)),
      velocity_(Vec3::Zero()),
      end_origin_(origin_),
      end_velocity_(Vec3::Zero()),
      acceleration_(Vec3::Zero()),
      rest_(Vec3::Zero()) {
  if (!surface.moving()) return;
  velocity_ = surface.velocity_at(t_n);
  end_origin_ = surface.origin_at(t);
  end_velocity_ = surface.velocity_at(t);
  acceleration_ = (end_velocity_ - velocity_) / h_;
  rest_ = end_origin_ - (origin_ + h_ / 2 * (velocity_ + end_velocity_));
}

Vec3 SurfaceTrack::origin(double s) const {
  if (!surface_->moving() || s == 0) return origin_;
  if (s >= h_) return end_origin_;
  return origin_ + s * velocity_ + s * s / 2 * acceleration_ + cubed(s / h_) * rest_;
}

Vec3 SurfaceTrack::velocity(double s) const { return s >= h_ ? end_velocity_ : Vec3(velocity_ + s * acceleration_); }

std::vector<SurfaceTrack> surface_tracks(std::span<const Surface> surfaces, double t_n, double t) {
  std::vector<SurfaceTrack> tracks;
  tracks.reserve(surfaces.size());
  for (const Surface& surface : surfaces) tracks.emplace_back(surface, t_n, t);
  return tracks;
}

std::optional<double> resolve_events(std::span<const SurfaceTrack> surfaces, double h, double gamma, const Vec3& x_n,
                                     const Vec3& v_n, Eigen::Ref<Vec3> x, Eigen::Ref<Vec3> v) {
  if (std::none_of(surfaces.begin(), surfaces.end(),
                   [&](const SurfaceTrack& track) { return comes_near(track, h, x_n, v_n, x, v); }))
    return std::nullopt;
  ParticleStep step(surfaces, h, gamma, x_n, v_n, x, v);
  if (!step.run()) return std::nullopt;
  x = step.x(), v = step.v();
  return step.lost();
}

}  // namespace crosscheck
