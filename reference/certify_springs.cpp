// The certificate's rows of springs, hard distances and dashpots.
#include <algorithm>

#include "reference/certificate_writer.h"

namespace crosscheck {
namespace {

/// Springs of one family: how many and between whom, rest lengths, stiffness.
void certify_family(Family family, const Springs& springs, const Readback& r, CertificateWriter& w) {
  const std::string name = family == Family::single ? "springs" : fmt::format("{} springs", name_of(family));
  int count = 0, same = 0;
  bool told = true;
  double rest = 0, stiffness = 0, shortest = 1e300, longest = 0, softest = 1e300, stiffest = 0;
  for (size_t i = 0; i < springs.list.size(); ++i) {
    const Spring& s = springs.list[i];
    if (s.family != family) continue;
    ++count;
    shortest = std::min(shortest, s.rest), longest = std::max(longest, s.rest);
    softest = std::min(softest, s.k), stiffest = std::max(stiffest, s.k);
    if (i >= r.links.size() || r.links[i].a != s.a || r.links[i].b != s.b) continue;
    ++same;
    rest = worse(rest, std::abs(r.links[i].rest - s.rest));
    told = told && r.links[i].stiffness;
    if (r.links[i].stiffness) stiffness = worse(stiffness, std::abs(*r.links[i].stiffness - s.k) / s.k);
  }
  w.row(name, fmt::format("{}", count), fmt::format("{} with the same ends", same), same == count);
  if (same != count) return;
  w.deviation(name + ": rest lengths", range_of(shortest, longest, "m"), rest, std::max(longest, 1e-300));
  const std::string range = range_of(softest, stiffest, "N/m");
  if (told)
    // the inverse of a mapping by powers loses what 1 - kLST loses: k h^2/mu may be 1e-6, and eps / 1e-6 is left
    w.row(name + ": stiffness", range, fmt::format("largest deviation {:.2g}", stiffness),
          stiffness <= std::max(1e-8, w.tolerance()));
  else if (!r.probe || r.probe->springs.size() == 0)  // otherwise the forces tell it, with the law
    w.not_told(name + ": stiffness", range);
}

/// Forces that the engine computed at a known stretch and speed, against the scene's own.
void certify_forces(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const Particles& particles = scene.model.particles;
  const auto* springs = scene.model.find<Springs>();
  const auto* dashpots = scene.model.find<Dashpots>();
  State probed = scene.start;
  if (r.probe) probed.x = r.probe->x;
  /// Of how many pairs the known state says nothing, since there is no force there. Between two pins there need be
  /// none.
  auto count_idle = [&](const auto& list, auto pulls) {
    return std::count_if(list.begin(), list.end(), [&](const auto& pair) {
      return !(particles.pinned[pair.a] && particles.pinned[pair.b]) && !pulls(pair);
    });
  };
  auto compare = [&](const std::string& quantity, const std::string& asked, const auto& term, const Points& told,
                     long idle) {
    Forces ours{Points::Zero(3, particles.size()), 0};
    add_force(term, particles, probed, ours);
    Points others = told;  // a force on a pin moves nothing, and some engines leave it out
    for (const int pin : particles.pins) ours.f.col(pin).setZero(), others.col(pin).setZero();
    const double scale = largest_column(ours.f), off = largest_column(ours.f - others);
    const std::string found = fmt::format("forces at a known state off by {:.2g}", scale > 0 ? off / scale : off);
    // forces are differences of lengths at a tenth of stretch: that costs a digit, sums of a dozen springs another
    const bool same = off <= 100 * w.tolerance() * scale;
    if (same && idle > 0)
      w.row(quantity, asked, fmt::format("{}; {} of {} have none there", found, idle, term.list.size()),
            Parity::unattested);
    else
      w.row(quantity, asked, found, same);
  };
  if (springs && !springs->list.empty() && r.probe && r.probe->springs.size() > 0) {
    // a stretch by less than a thousandth tells no law: all laws are straight lines there
    const long idle = count_idle(springs->list, [&](const Spring& s) {
      return std::abs((probed.x.col(s.a) - probed.x.col(s.b)).norm() - s.rest) > 1e-3 * s.rest;
    });
    const auto [softest, stiffest] = std::ranges::minmax(springs->list, {}, &Spring::k);
    compare("spring law and stiffness",
            fmt::format("{}, {}", name_of(springs->law), range_of(softest.k, stiffest.k, "N/m")), *springs,
            r.probe->springs, idle);
  } else if (springs && !w.other_law("springs")) {
    w.not_told("spring law", std::string(name_of(springs->law)));
  }
  if (!dashpots) {
    if (r.probe && r.probe->dashpots.size() > 0 && largest_column(r.probe->dashpots) > 0)
      w.row("dashpots", "none", "some", false);
    return;
  }
  double low = 1e300, high = 0;
  for (const auto& d : dashpots->list) low = std::min(low, d.c), high = std::max(high, d.c);
  const std::string asked = fmt::format("{} of {}", dashpots->list.size(), range_of(low, high, "N s/m"));
  if (!r.probe || r.probe->dashpots.size() == 0) {
    w.not_told("dashpots", asked);
    return;
  }
  probed.v = r.probe->v;
  const long idle = count_idle(dashpots->list, [&](const Dashpots::Dashpot& d) {
    return (probed.v.col(d.a) - probed.v.col(d.b)).dot(probed.x.col(d.a) - probed.x.col(d.b)) != 0;
  });
  compare("dashpots", asked, *dashpots, r.probe->dashpots, idle);
}

}  // namespace

void certify_springs(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const auto* springs = scene.model.find<Springs>();
  const auto* constraints = scene.model.find<Constraints>();
  const size_t asked = springs ? springs->list.size() : 0, hard = constraints ? constraints->list.size() : 0;
  if (r.links.size() != asked + hard) {
    w.row("links", fmt::format("{}", asked + hard), fmt::format("{}", r.links.size()), false);
    return;
  }
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
  if (springs)
    for (const Family family : {Family::single, Family::structural, Family::shear, Family::bend})
      if (std::any_of(springs->list.begin(), springs->list.end(), [&](const Spring& s) { return s.family == family; }))
        certify_family(family, *springs, r, w);
  certify_forces(scene, r, w);
}

}  // namespace crosscheck
