// The certificate's rows of gravity, drag, wind and spheres.
#include <algorithm>

#include "reference/certificate_writer.h"

namespace crosscheck {
namespace {

void certify_spheres(const Spheres* spheres, const Readback& r, CertificateWriter& w) {
  const size_t asked = spheres ? spheres->list.size() : 0;
  if (!r.spheres) {
    if (asked > 0) w.not_told("spheres", fmt::format("{}", asked));
    return;
  }
  if (asked > 0 || !r.spheres->empty())
    w.row("spheres", fmt::format("{}", asked), fmt::format("{}", r.spheres->size()), r.spheres->size() == asked);
  if (r.spheres->size() != asked) return;
  for (size_t i = 0; i < asked; ++i) {
    const Sphere& s = spheres->list[i];
    const Readback::Ball& ball = (*r.spheres)[i];
    const std::string of = asked > 1 ? fmt::format(" of sphere {}", i + 1) : "";
    auto vector = [](const Vec3& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", v.x(), v.y(), v.z()); };
    w.row("centre" + of, vector(s.centre), vector(ball.centre),
          (ball.centre - s.centre).norm() <= w.tolerance() * (s.centre.norm() + s.radius));
    auto number = [&](const std::string& what, double wanted, const std::optional<double>& told, const char* unit,
                      double scale) {
      if (told)
        w.row(what + of, fmt::format("{:.6g}{}", wanted, unit), fmt::format("{:.6g}{}", *told, unit),
              std::abs(*told - wanted) <= w.tolerance() * scale);
      else
        w.not_told(what + of, fmt::format("{:.6g}{}", wanted, unit));
    };
    number("contact radius", s.contact_radius(), ball.radius, " m", s.contact_radius());
    number("friction", s.friction, ball.friction, "", 1);
    number("restitution", s.restitution, ball.restitution, "", 1);
    if (i == 0 && r.margin) number("margin", s.margin, r.margin, " m", s.contact_radius());
  }
}

/// Both winds, by the forces that the engine computed at a known state with the particles at rest.
void certify_wind(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const auto* wind = scene.model.find<Wind>();
  const auto* air = scene.model.find<Aerodynamics>();
  const bool told = r.probe && r.probe->wind.size() > 0;
  if (!wind && !air) {
    if (told && largest_column(r.probe->wind) > 0) w.row("wind", "none", "some", false);
    return;
  }
  const Blowing& blowing = wind ? wind->acceleration : air->velocity;
  const std::string asked = fmt::format("mean ({:.6g}, {:.6g}, {:.6g}) {}{}{}", blowing.mean.x(), blowing.mean.y(),
                                        blowing.mean.z(), wind ? "m/s^2" : "m/s on triangles",
                                        blowing.gusts ? ", gusts" : "", wind && air ? ", and on triangles" : "");
  if (!told) {
    w.not_told("wind", asked);
    return;
  }
  State probed = scene.start;
  probed.t = r.probe->t, probed.x = r.probe->x;
  probed.v.setZero();
  for (const int pin : scene.model.particles.pins) probed.v.col(pin) = r.probe->v.col(pin);
  Forces ours{Points::Zero(3, scene.model.particles.size()), 0};
  if (wind) add_force(*wind, scene.model.particles, probed, ours);
  if (air) add_force(*air, scene.model.particles, probed, ours);
  Points told_forces = r.probe->wind;
  for (const int pin : scene.model.particles.pins) ours.f.col(pin).setZero(), told_forces.col(pin).setZero();
  const double scale = largest_column(ours.f), off = largest_column(ours.f - told_forces);
  // left over when the springs are taken from the sum: their forces' rounding
  const double springs = r.probe->springs.size() > 0 ? largest_column(r.probe->springs) : 0;
  w.row("wind", asked, fmt::format("forces at a known state off by {:.2g}", scale > 0 ? off / scale : off),
        off <= 100 * w.tolerance() * (scale + springs));
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
    w.not_told("gravity", acceleration_text(g));
}

void certify_drag(const Drag& drag, const Particles& particles, const Readback& r, CertificateWriter& w) {
  const Eigen::ArrayXd rates = drag.c.array() / particles.mass.array();
  const double low = rates.minCoeff(), high = rates.maxCoeff();
  const std::string asked =
      high - low < 1e-12 * high ? fmt::format("{:.6g} /s", high) : fmt::format("{:.6g} to {:.6g} /s", low, high);
  if (!r.drag || static_cast<int>(r.drag->size()) != particles.size()) {
    w.not_told("drag", asked);
    return;
  }
  double worst = 0;
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) worst = worse(worst, std::abs((*r.drag)[i] - rates[i]));
  // gamma comes back from 1 - exp(-gamma h): eps / (gamma h) is left
  w.row("drag", asked, fmt::format("largest deviation {:.2g} /s", worst),
        worst <= std::max(w.tolerance(), 1e-9) * high);
}

/// What the scene does not have must not be in the engine either; what the engine does not deny stands in one row.
void certify_absent(const Model& model, const Readback& r, CertificateWriter& w) {
  if (!model.find<Gravity>() && r.gravity && !r.gravity->isZero(0))
    w.row("gravity", "none", acceleration_text(*r.gravity), false);
  if (!model.find<Drag>() && r.drag && std::any_of(r.drag->begin(), r.drag->end(), [](double c) { return c != 0; }))
    w.row("drag", "none", "some", false);
  if (model.first_order()) return;

  const auto* spheres = model.find<Spheres>();
  const std::pair<const char*, bool> not_denied[] = {
      {"gravity", !model.find<Gravity>() && !r.gravity},
      {"drag", !model.find<Drag>() && !r.drag},
      {"dashpots", !model.find<Dashpots>() && !(r.probe && r.probe->dashpots.size() > 0)},
      {"wind", !model.find<Wind>() && !model.find<Aerodynamics>() && !(r.probe && r.probe->wind.size() > 0)},
      {"spheres", !spheres && !r.spheres},
      {"motion of pins", !model.particles.pins.empty() && !model.particles.move && !r.later},
      {"motion of spheres", spheres && !spheres->moving() && !r.later},
  };
  std::string absent;
  for (const auto& [what, silent] : not_denied)
    if (silent) absent += fmt::format("{}no {}", absent.empty() ? "" : ", ", what);
  if (!absent.empty()) w.not_told("nothing else", absent);
}

}  // namespace

void certify_terms(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const Overloaded certify_term{
      [&](const Gravity& t) { certify_gravity(t, r, w); },
      [&](const Drag& t) { certify_drag(t, scene.model.particles, r, w); },
      [&](const Rotation& t) { w.not_told("rotation", fmt::format("{:.6g} rad/s", t.rate)); },
      [](const OneOf<Wind, Aerodynamics, Spheres> auto&) {},     // below: they may be in the engine alone
      [](const OneOf<Springs, Dashpots, Constraints> auto&) {},  // certify_springs.cpp
  };
  for (const Term& term : scene.model.terms) std::visit(certify_term, term);
  certify_wind(scene, r, w);
  certify_spheres(scene.model.find<Spheres>(), r, w);
  certify_absent(scene.model, r, w);
}

}  // namespace crosscheck
