// The certificate's rows for each term.
#include "reference/certificate/rows.h"

#include <algorithm>

namespace crosscheck {
namespace {

/// Rows for number, ends, rest lengths and stiffness of one family of springs.
void certify_family(Family family, const Springs& springs, const Readback& r, CertificateWriter& w) {
  const std::string name = family == Family::single ? "springs" : fmt::format("{} springs", name_of(family));
  int count = 0, same = 0;
  bool reported = true;
  double rest = 0, stiffness = 0, shortest = 1e300, longest = 0, softest = 1e300, stiffest = 0;
  for (size_t i = 0; i < springs.list.size(); ++i) {
    const Spring& s = springs.list[i];
    if (s.family != family) continue;
    ++count;
    shortest = std::min(shortest, s.rest), longest = std::max(longest, s.rest);
    softest = std::min(softest, s.k), stiffest = std::max(stiffest, s.k);
    if (i >= r.links.size() || r.links[i].a != s.a || r.links[i].b != s.b) continue;
    ++same;
    rest = max_or_nan(rest, std::abs(r.links[i].rest - s.rest));
    reported = reported && r.links[i].stiffness;
    if (r.links[i].stiffness) stiffness = max_or_nan(stiffness, std::abs(*r.links[i].stiffness - s.k) / s.k);
  }
  w.row(name, fmt::format("{}", count), fmt::format("{} with the same ends", same), same == count);
  if (same != count) return;
  w.deviation(name + ": rest lengths", range_of(shortest, longest, "m"), rest, std::max(longest, 1e-300));
  const std::string range = range_of(softest, stiffest, "N/m");
  if (reported)
    // the inverse of a mapping with powers amplifies rounding errors, e.g. from eps to eps / 1e-6 for k h^2/mu = 1e-6
    w.row(name + ": stiffness", range, fmt::format("largest deviation {:.2g}", stiffness),
          stiffness <= std::max(1e-8, w.tolerance()));
  else if (!r.probe || r.probe->springs.size() == 0)  // otherwise the forces show the stiffness and the law
    w.add_unattested(name + ": stiffness", range);
}

/// True if `force` (N), which is not one of the scene's forces, exceeds the rounding error of the scene's own forces.
bool beyond_rounding(const Scene& scene, const Points& force, const CertificateWriter& w) {
  const double lengths = scene.size() + largest_column(scene.start.x);
  double scale = 0;
  if (const auto* springs = scene.model.find<Springs>())
    for (const Spring& s : springs->list) scale = std::max(scale, s.k * lengths);
  if (const auto* gravity = scene.model.find<Gravity>())
    scale += scene.model.particles.mass.maxCoeff() * gravity->acceleration.norm();
  return !(largest_column(force) <= w.tolerance() * scale);
}

/// Compares forces that the engine computed at a known state with the scene's own.
void certify_forces(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const Particles& particles = scene.model.particles;
  const auto* springs = scene.model.find<Springs>();
  const auto* dashpots = scene.model.find<Dashpots>();
  State probed = scene.start;
  if (r.probe) probed.x = r.probe->x;
  /// Number of pairs that exert no force in the known state, so that the probe shows nothing about them. Ignores pairs
  /// of two pins.
  auto count_force_free = [&](const auto& list, auto pulls) {
    return std::count_if(list.begin(), list.end(), [&](const auto& pair) {
      return !(particles.pinned[pair.a] && particles.pinned[pair.b]) && !pulls(pair);
    });
  };
  auto compare = [&](const std::string& quantity, const std::string& requested, const auto& term,
                     const Points& reported, long force_free) {
    Forces ours{Points::Zero(3, particles.size()), 0};
    add_force(term, particles, probed, ours);
    Points others = reported;  // forces on pins have no effect; some engines omit them
    for (const int pin : particles.pins) ours.f.col(pin).setZero(), others.col(pin).setZero();
    const double scale = largest_column(ours.f), off = largest_column(ours.f - others);
    const std::string found = fmt::format("forces at a known state off by {:.2g}", scale > 0 ? off / scale : off);
    // a stretch of a tenth loses one digit when the rest length is subtracted, and a sum of a dozen springs another one
    const bool same = off <= 100 * w.tolerance() * scale;
    if (same && force_free > 0)
      w.row(quantity, requested, fmt::format("{}; {} of {} exert none there", found, force_free, term.list.size()),
            Parity::unattested);
    else
      w.row(quantity, requested, found, same);
  };
  if (springs && !springs->list.empty() && r.probe && r.probe->springs.size() > 0) {
    // all laws are linear up to a stretch of a thousandth, so springs in this range show nothing about their law
    const long force_free = count_force_free(springs->list, [&](const Spring& s) {
      return std::abs((probed.x.col(s.a) - probed.x.col(s.b)).norm() - s.rest) > 1e-3 * s.rest;
    });
    const auto [softest, stiffest] = std::ranges::minmax(springs->list, {}, &Spring::k);
    compare("spring law and stiffness",
            fmt::format("{}, {}", name_of(springs->law), range_of(softest.k, stiffest.k, "N/m")), *springs,
            r.probe->springs, force_free);
  } else if (springs && !w.has_different_law("springs")) {
    w.add_unattested("spring law", std::string(name_of(springs->law)));
  }
  if (const auto* bending = scene.model.find<Bending>(); bending && !bending->list.empty()) {
    const auto [softest, stiffest] = std::ranges::minmax(bending->list, {}, &Bending::Stencil::k);
    const std::string requested =
        fmt::format("{} stencils of {}", bending->list.size(), range_of(softest.k, stiffest.k, "N/m"));
    if (!r.probe || r.probe->bending.size() == 0)
      w.add_unattested("bending", requested);
    else
      compare("bending", requested, *bending, r.probe->bending,
              std::ranges::count_if(bending->list, [&](const Bending::Stencil& s) {
                // the stencil is flat up to a millionth of the distance between neighbours
                return bent(s, probed.x).norm() <=
                       1e-6 * (probed.x.col(s.particle[0]) - probed.x.col(s.particle[1])).norm();
              }));
  } else if (r.probe && r.probe->bending.size() > 0 && beyond_rounding(scene, r.probe->bending, w)) {
    w.row("bending", "none", "some", false);
  }
  if (!dashpots) {
    if (r.probe && r.probe->dashpots.size() > 0 && beyond_rounding(scene, r.probe->dashpots, w))
      w.row("dashpots", "none", "some", false);
    return;
  }
  double low = 1e300, high = 0;
  for (const auto& d : dashpots->list) low = std::min(low, d.c), high = std::max(high, d.c);
  const std::string requested = fmt::format("{} of {}", dashpots->list.size(), range_of(low, high, "N s/m"));
  if (!r.probe || r.probe->dashpots.size() == 0) {
    w.add_unattested("dashpots", requested);
    return;
  }
  probed.v = r.probe->v;
  const long force_free = count_force_free(dashpots->list, [&](const Dashpots::Dashpot& d) {
    return (probed.v.col(d.a) - probed.v.col(d.b)).dot(probed.x.col(d.a) - probed.x.col(d.b)) != 0;
  });
  compare("dashpots", requested, *dashpots, r.probe->dashpots, force_free);
}

}  // namespace

void certify_springs(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const auto* springs = scene.model.find<Springs>();
  const auto* constraints = scene.model.find<Constraints>();
  const size_t requested = springs ? springs->list.size() : 0, hard = constraints ? constraints->list.size() : 0;
  if (r.links.size() != requested + hard) {
    w.row("links", fmt::format("{}", requested + hard), fmt::format("{}", r.links.size()), false);
    return;
  }
  if (hard > 0) {
    bool ends = true;
    double off = 0, scale = 0;
    for (size_t i = 0; i < hard; ++i) {
      const auto& [a, b, length] = constraints->list[i];
      const Readback::Link& link = r.links[requested + i];
      ends = ends && link.a == a && link.b == b;
      off = max_or_nan(off, std::abs(link.rest - length));
      scale = std::max(scale, length);
    }
    w.row("hard distances", fmt::format("{}", hard), fmt::format("{}, {}", hard, ends ? "same ends" : "other ends"),
          ends);
    w.deviation("lengths of hard distances", fmt::format("up to {:.6g} m", scale), off, scale);
  }
  if (springs)
    for (const Family family : {Family::single, Family::structural, Family::shear, Family::bend})
      if (std::any_of(springs->list.begin(), springs->list.end(), [&](const Spring& s) { return s.family == family; }))
        certify_family(family, *springs, r, w);
  certify_forces(scene, r, w);
}

namespace {

/// Row for a property of a sphere or plane; marked as unattested if the engine does not report it.
void certify_number(const std::string& what, double wanted, const std::optional<double>& reported, const char* unit,
                    double scale, CertificateWriter& w) {
  if (reported)
    w.row(what, fmt::format("{:.6g}{}", wanted, unit), fmt::format("{:.6g}{}", *reported, unit),
          std::abs(*reported - wanted) <= w.tolerance() * scale);
  else
    w.add_unattested(what, fmt::format("{:.6g}{}", wanted, unit));
}

/// Row for the number of spheres or planes; returns false if they cannot be compared one by one.
template <class Reported>
bool certify_count(const char* what, size_t requested, const std::optional<Reported>& reported, CertificateWriter& w) {
  if (!reported) {
    if (requested > 0) w.add_unattested(what, fmt::format("{}", requested));
    return false;
  }
  if (requested > 0 || !reported->empty())
    w.row(what, fmt::format("{}", requested), fmt::format("{}", reported->size()), reported->size() == requested);
  return reported->size() == requested;
}

std::string place_text(const Vec3& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", v.x(), v.y(), v.z()); }

void certify_spheres(const Spheres* spheres, const Readback& r, CertificateWriter& w) {
  const size_t requested = spheres ? spheres->list.size() : 0;
  if (!certify_count("spheres", requested, r.spheres, w)) return;
  for (size_t i = 0; i < requested; ++i) {
    const Sphere& s = spheres->list[i];
    const Readback::Ball& ball = (*r.spheres)[i];
    const std::string of = requested > 1 ? fmt::format(" of sphere {}", i + 1) : "";
    w.row("centre" + of, place_text(s.centre), place_text(ball.centre),
          (ball.centre - s.centre).norm() <= w.tolerance() * (s.centre.norm() + s.radius));
    certify_number("contact radius" + of, s.contact_radius(), ball.radius, " m", s.contact_radius(), w);
    certify_number("friction" + of, s.friction, ball.friction, "", 1, w);
    certify_number("restitution" + of, s.restitution, ball.restitution, "", 1, w);
    if (i == 0 && r.margin) certify_number("margin" + of, s.margin, r.margin, " m", s.contact_radius(), w);
  }
}

void certify_planes(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const auto* planes = scene.model.find<Planes>();
  const size_t requested = planes ? planes->list.size() : 0;
  if (!certify_count("planes", requested, r.planes, w)) return;
  for (size_t i = 0; i < requested; ++i) {
    const Plane& p = planes->list[i];
    const Readback::Face& face = (*r.planes)[i];
    const std::string of = requested > 1 ? fmt::format(" of plane {}", i + 1) : "";
    const auto direction = [](const Vec3& n) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", n.x(), n.y(), n.z()); };
    w.row("normal" + of, direction(p.normal), direction(face.normal), (face.normal - p.normal).norm() <= w.tolerance());
    // the engine may report any point of the face, so its distance from the scene's plane is compared
    const double scale = scene.size() + face.point.norm() + p.point.norm();
    certify_number("contact offset" + of, p.margin, (face.point - p.point).dot(p.normal), " m", scale, w);
    certify_number("friction" + of, p.friction, face.friction, "", 1, w);
    certify_number("restitution" + of, p.restitution, face.restitution, "", 1, w);
  }
}

/// Compares wind and aerodynamic force with the engine's forces at a known state with particles at rest.
void certify_wind(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const auto* wind = scene.model.find<Wind>();
  const auto* air = scene.model.find<Aerodynamics>();
  const bool reported = r.probe && r.probe->wind.size() > 0;
  if (!wind && !air) {
    if (reported && beyond_rounding(scene, r.probe->wind, w)) w.row("wind", "none", "some", false);
    return;
  }
  const WindSignal& wind_signal = wind ? wind->acceleration : air->velocity;
  const std::string requested = fmt::format(
      "mean ({:.6g}, {:.6g}, {:.6g}) {}{}{}", wind_signal.mean.x(), wind_signal.mean.y(), wind_signal.mean.z(),
      wind ? "m/s^2" : "m/s on triangles", wind_signal.gusts ? ", gusts" : "", wind && air ? ", and on triangles" : "");
  if (!reported) {
    w.add_unattested("wind", requested);
    return;
  }
  State probed = scene.start;
  probed.t = r.probe->t, probed.x = r.probe->x;
  probed.v.setZero();
  for (const int pin : scene.model.particles.pins) probed.v.col(pin) = r.probe->v.col(pin);
  Forces ours{Points::Zero(3, scene.model.particles.size()), 0};
  if (wind) add_force(*wind, scene.model.particles, probed, ours);
  if (air) add_force(*air, scene.model.particles, probed, ours);
  Points reported_forces = r.probe->wind;
  for (const int pin : scene.model.particles.pins) ours.f.col(pin).setZero(), reported_forces.col(pin).setZero();
  const double scale = largest_column(ours.f), off = largest_column(ours.f - reported_forces);
  // rounding error left by springs and bending, which are subtracted from the sum
  double elastic = 0;
  for (const Points* taken : {&r.probe->springs, &r.probe->bending})
    if (taken->size() > 0) elastic = std::max(elastic, largest_column(*taken));
  w.row("wind", requested, fmt::format("forces at a known state off by {:.2g}", scale > 0 ? off / scale : off),
        off <= 100 * w.tolerance() * (scale + elastic));
}

std::string acceleration_text(const Vec3& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m/s^2", v.x(), v.y(), v.z());
}

void certify_gravity(const Gravity& gravity, const Readback& r, CertificateWriter& w) {
  const Vec3& g = gravity.acceleration;
  if (r.gravity)
    w.row("gravity", acceleration_text(g), acceleration_text(*r.gravity),
          (*r.gravity - g).norm() <= w.tolerance() * g.norm());
  else
    w.add_unattested("gravity", acceleration_text(g));
}

void certify_drag(const Drag& drag, const Particles& particles, const Readback& r, CertificateWriter& w) {
  const Eigen::ArrayXd rates = drag.c.array() / particles.mass.array();
  const double low = rates.minCoeff(), high = rates.maxCoeff();
  const std::string requested =
      high - low < 1e-12 * high ? fmt::format("{:.6g} /s", high) : fmt::format("{:.6g} to {:.6g} /s", low, high);
  if (!r.drag || static_cast<int>(r.drag->size()) != particles.size()) {
    w.add_unattested("drag", requested);
    return;
  }
  double worst = 0;
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) worst = max_or_nan(worst, std::abs((*r.drag)[i] - rates[i]));
  // gamma is recovered from 1 - exp(-gamma h), with an error of eps / (gamma h)
  w.row("drag", requested, fmt::format("largest deviation {:.2g} /s", worst),
        worst <= std::max(w.tolerance(), 1e-9) * high);
}

/// Adds rows for ingredients that only the engine has, and one row for all those whose absence it does not report.
void certify_absent(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const Model& model = scene.model;
  // tolerates the rounding of a position in each step, and the rounding of 1 - exp(-gamma h)
  if (!model.find<Gravity>() && r.gravity && !(r.gravity->norm() * w.step() * w.step() <= w.tolerance() * scene.size()))
    w.row("gravity", "none", acceleration_text(*r.gravity), false);
  if (!model.find<Drag>() && r.drag &&
      std::ranges::any_of(*r.drag, [&](double c) { return !(std::abs(c) * w.step() <= w.tolerance()); }))
    w.row("drag", "none", "some", false);
  if (model.first_order()) return;

  const auto* spheres = model.find<Spheres>();
  const std::pair<const char*, bool> not_denied[] = {
      {"gravity", !model.find<Gravity>() && !r.gravity},
      {"drag", !model.find<Drag>() && !r.drag},
      {"dashpots", !model.find<Dashpots>() && !(r.probe && r.probe->dashpots.size() > 0)},
      {"wind", !model.find<Wind>() && !model.find<Aerodynamics>() && !(r.probe && r.probe->wind.size() > 0)},
      {"spheres", !spheres && !r.spheres},  // planes are not listed: older engines cannot report their absence
      {"motion of pins", !model.particles.pins.empty() && !model.particles.move && !r.later},
      {"motion of spheres", spheres && !spheres->moving() && !r.later},
  };
  std::string absent;
  for (const auto& [what, silent] : not_denied)
    if (silent) absent += fmt::format("{}no {}", absent.empty() ? "" : ", ", what);
  if (!absent.empty()) w.add_unattested("nothing else", absent);
}

}  // namespace

void certify_terms(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const Overloaded certify_term{
      [&](const Gravity& t) { certify_gravity(t, r, w); },
      [&](const Drag& t) { certify_drag(t, scene.model.particles, r, w); },
      [&](const Rotation& t) { w.add_unattested("rotation", fmt::format("{:.6g} rad/s", t.rate)); },
      [](const OneOf<Wind, Aerodynamics, Spheres, Planes> auto&) {},  // handled below: an engine may have them anyway
      [](const OneOf<Springs, Bending, Dashpots, Constraints> auto&) {},  // above
  };
  for (const Term& term : scene.model.terms) std::visit(certify_term, term);
  certify_wind(scene, r, w);
  certify_spheres(scene.model.find<Spheres>(), r, w);
  certify_planes(scene, r, w);
  certify_absent(scene, r, w);
}

}  // namespace crosscheck
