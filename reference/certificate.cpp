// Compares the scene with what an engine says it built.
#include "reference/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crosscheck {
namespace {

/// The larger one; nan where one is nan, so that a deviation that is no number never passes.
double worse(double a, double b) { return std::isnan(b) || b > a ? b : a; }

class Writer {
 public:
  Writer(Certificate& certificate, const Readback& readback) : certificate_(certificate), readback_(readback) {}

  void row(const std::string& quantity, std::string asked, std::string read_back, Parity parity) {
    const auto how = readback_.mapped.find(quantity);
    certificate_.rows.push_back({quantity, std::move(asked), how == readback_.mapped.end() ? "as it is" : how->second,
                                 std::move(read_back), parity});
  }
  void row(const std::string& quantity, std::string asked, std::string read_back, bool same) {
    row(quantity, std::move(asked), std::move(read_back), same ? Parity::match : Parity::mismatch);
  }
  /// A quantity compared by its largest deviation, relative to its scale.
  void deviation(const std::string& quantity, std::string asked, double largest, double scale) {
    row(quantity, std::move(asked), fmt::format("largest deviation {:.2g}", scale > 0 ? largest / scale : largest),
        largest <= tolerance() * scale);
  }
  /// Rounding of an engine that computes in this precision, after a mapping and its inverse: some tens of ulps.
  double tolerance() const { return readback_.precision == "single" ? 1e-5 : 1e-12; }

 private:
  Certificate& certificate_;
  const Readback& readback_;
};

void certify_particles(const Scene& scene, const Readback& r, Writer& w) {
  const Particles& p = scene.model.particles;
  const bool count = static_cast<int>(r.mass.size()) == p.size();
  w.row("particles", fmt::format("{}", p.size()), fmt::format("{}", r.mass.size()), count);
  if (!count) return;
  double worst = 0, total = 0;
  for (int i = 0; i < p.size(); ++i)
    if (!p.pinned[i]) {
      worst = worse(worst, std::abs(r.mass[i] - p.mass[i]) / p.mass[i]);
      total += p.mass[i];
    }
  w.deviation("masses", fmt::format("{:.6g} kg in all, free particles", total), worst, 1);
  w.row("pins", fmt::format("{}", p.pins.size()), fmt::format("{}", std::count(r.pinned.begin(), r.pinned.end(), 1)),
        std::equal(r.pinned.begin(), r.pinned.end(), p.pinned.begin(), p.pinned.end()));
}

void certify_springs(const Scene& scene, const Readback& r, Writer& w) {
  const auto* springs = scene.model.find<Springs>();
  const auto* constraints = scene.model.find<Constraints>();
  const size_t asked = springs ? springs->list.size() : 0, hard = constraints ? constraints->list.size() : 0;
  bool same = r.links.size() == asked + hard;
  double rest = 0, longest = 0, stiffness = 0;
  bool told = same;
  for (size_t i = 0; same && i < asked; ++i) {
    const Spring& s = springs->list[i];
    const Readback::Link& link = r.links[i];
    same = link.a == s.a && link.b == s.b;
    rest = worse(rest, std::abs(link.rest - s.rest));
    longest = std::max(longest, s.rest);
    told = told && link.stiffness;
    if (link.stiffness) stiffness = worse(stiffness, std::abs(*link.stiffness - s.k) / s.k);
  }
  w.row("springs", fmt::format("{}", asked),
        fmt::format("{}, {}", r.links.size() - std::min(hard, r.links.size()), same ? "same ends" : "other ends"),
        same);
  if (!same) return;
  if (hard > 0) {
    bool ends = true;
    double off = 0, scale = 0;
    for (size_t i = 0; i < hard; ++i) {
      const auto& [a, b, length] = constraints->list[i];
      const Readback::Link& link = r.links[asked + i];
      ends = ends && link.a == a && link.b == b;
      off = worse(off, std::abs(link.rest - length));
      scale = std::max(scale, length);
    }
    w.row("hard distances", fmt::format("{}", hard), fmt::format("{}, {}", hard, ends ? "same ends" : "other ends"),
          ends);
    w.deviation("their lengths", fmt::format("up to {:.6g} m", scale), off, scale);
  }
  if (asked == 0) return;
  w.deviation("rest lengths", fmt::format("up to {:.6g} m", longest), rest, std::max(longest, 1e-300));
  const auto [softest, stiffest] = std::minmax_element(springs->list.begin(), springs->list.end(),
                                                       [](const Spring& a, const Spring& b) { return a.k < b.k; });
  const std::string range = softest->k == stiffest->k ? fmt::format("{:.6g} N/m", softest->k)
                                                      : fmt::format("{:.6g} to {:.6g} N/m", softest->k, stiffest->k);
  if (told) {
    // the inverse of a mapping by powers loses what 1 - kLST loses: k h^2/mu may be 1e-6, and eps / 1e-6 is left
    w.row("stiffness", range, fmt::format("largest deviation {:.2g}", stiffness),
          stiffness <= std::max(1e-8, w.tolerance()));
  } else if (r.probe) {
    Forces ours{Points::Zero(3, scene.model.particles.size()), 0};
    State stretched = scene.start;
    stretched.x = r.probe->x;
    add_force(*springs, scene.model.particles, stretched, ours);
    const double scale = largest_column(ours.f);
    const double off = largest_column(ours.f - r.probe->force);
    // forces are differences of lengths near the rest length: 1 % of stretch costs two digits
    w.row("stiffness", range, fmt::format("forces at 1 % stretch off by {:.2g}", off / scale),
          off <= 100 * w.tolerance() * scale);
  } else {
    w.row("stiffness", range, "not told", Parity::unattested);
  }
}

void certify_spheres(const Spheres* spheres, const Readback& r, Writer& w) {
  const size_t asked = spheres ? spheres->list.size() : 0;
  if (!r.spheres) {
    if (asked > 0) w.row("spheres", fmt::format("{}", asked), "not told", Parity::unattested);
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
        w.row(what + of, fmt::format("{:.6g}{}", wanted, unit), "not told", Parity::unattested);
    };
    number("contact radius", s.contact_radius(), ball.radius, " m", s.contact_radius());
    number("friction", s.friction, ball.friction, "", 1);
    if (s.restitution > 0 || ball.restitution.value_or(0) != 0)
      number("restitution", s.restitution, ball.restitution, "", 1);
    if (i == 0 && r.margin) number("margin", s.margin, r.margin, " m", s.contact_radius());
  }
}

void certify_terms(const Scene& scene, const Readback& r, Writer& w) {
  const Model& model = scene.model;
  auto vector = [](const Vec3& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m/s^2", v.x(), v.y(), v.z()); };
  if (const auto* gravity = model.find<Gravity>()) {
    if (r.gravity)
      w.row("gravity", vector(gravity->acceleration), vector(*r.gravity),
            (*r.gravity - gravity->acceleration).norm() <= w.tolerance() * gravity->acceleration.norm());
    else
      w.row("gravity", vector(gravity->acceleration), "not told", Parity::unattested);
  }
  if (const auto* drag = model.find<Drag>()) {
    const double low = (drag->c.array() / model.particles.mass.array()).minCoeff();
    const double high = (drag->c.array() / model.particles.mass.array()).maxCoeff();
    const std::string asked =
        high - low < 1e-12 * high ? fmt::format("{:.6g} /s", high) : fmt::format("{:.6g} to {:.6g} /s", low, high);
    if (r.drag && static_cast<int>(r.drag->size()) == model.particles.size()) {
      double worst = 0;
      for (int i = 0; i < model.particles.size(); ++i)
        if (!model.particles.pinned[i])
          worst = worse(worst, std::abs((*r.drag)[i] - drag->c[i] / model.particles.mass[i]));
      // gamma comes back from 1 - exp(-gamma h): eps / (gamma h) is left
      w.row("drag", asked, fmt::format("largest deviation {:.2g} /s", worst),
            worst <= std::max(w.tolerance(), 1e-9) * high);
    } else {
      w.row("drag", asked, "not told", Parity::unattested);
    }
  }
  // what the scene does not have must not be in the engine either
  if (!model.find<Gravity>() && r.gravity && !r.gravity->isZero(0)) w.row("gravity", "none", vector(*r.gravity), false);
  if (!model.find<Drag>() && r.drag && std::any_of(r.drag->begin(), r.drag->end(), [](double c) { return c != 0; }))
    w.row("drag", "none", "some", false);
  if (const auto* wind = model.find<Wind>())
    w.row("wind", "mean " + vector(wind->acceleration.mean) + (wind->acceleration.gusts ? " with gusts" : ""),
          "given to the engine at each step", Parity::match);
  certify_spheres(model.find<Spheres>(), r, w);
}

}  // namespace

std::string_view name_of(Parity parity) {
  switch (parity) {
    case Parity::match:
      return "match";
    case Parity::different_law:
      return "different law";
    case Parity::mismatch:
      return "mismatch";
    case Parity::unattested:
      return "not attested";
  }
  return "unknown";
}

bool Certificate::mismatch() const {
  return std::any_of(rows.begin(), rows.end(), [](const CertificateRow& r) { return r.parity == Parity::mismatch; });
}

Certificate certify(const std::string& method, const Scene& scene, const Outcome& outcome) {
  Certificate certificate{method, scene.name, {}};
  if (!outcome.readback) {
    certificate.rows.push_back({"whole scene", "hash " + scene.hash, "-", "not told", Parity::unattested});
    return certificate;
  }
  const Readback& r = *outcome.readback;
  Writer w(certificate, r);
  certify_particles(scene, r, w);
  certify_springs(scene, r, w);
  certify_terms(scene, r, w);
  w.row("step", fmt::format("{:.6g} s", outcome.step), fmt::format("{:.6g} s", r.step), r.step == outcome.step);
  w.row("precision", "double", r.precision, r.precision == "double" ? Parity::match : Parity::different_law);
  w.row("sleeping", "off", r.may_sleep ? "on" : "off", !r.may_sleep);
  for (const std::string& law : outcome.different_law) {
    const size_t colon = law.find(": ");
    certificate.rows.push_back(
        {"law of " + law.substr(0, colon), "as in the scene", "-", law.substr(colon + 2), Parity::different_law});
  }
  return certificate;
}

}  // namespace crosscheck
