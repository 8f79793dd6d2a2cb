#include "reference/certificate/certificate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reference/certificate/rows.h"

namespace crosscheck {
namespace {

void certify_particles(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const Particles& p = scene.model.particles;
  const bool count = static_cast<int>(r.mass.size()) == p.size();
  w.row("particles", fmt::format("{}", p.size()), fmt::format("{}", r.mass.size()), count);
  if (!count) return;
  double worst = 0, total = 0;
  for (int i = 0; i < p.size(); ++i)
    if (!p.pinned[i]) {
      worst = max_or_nan(worst, std::abs(r.mass[i] - p.mass[i]) / p.mass[i]);
      total += p.mass[i];
    }
  w.deviation("masses", fmt::format("{:.6g} kg in total, free particles", total), worst, 1);
  w.row("pins", fmt::format("{}", p.pins.size()), fmt::format("{}", std::count(r.pinned.begin(), r.pinned.end(), 1)),
        std::equal(r.pinned.begin(), r.pinned.end(), p.pinned.begin(), p.pinned.end()));
}

/// Adds rows for the motions of pins, spheres and planes. A fixed object has a row only if the engine moves it.
void certify_motion(const Scene& scene, const Readback& r, CertificateWriter& w) {
  const Particles& p = scene.model.particles;
  const auto* spheres = scene.model.find<Spheres>();
  const auto* planes = scene.model.find<Planes>();
  auto row = [&](const std::string& quantity, const std::string& motion, const Points& ours, const Points& reported) {
    const double off = reported.cols() == ours.cols() ? largest_column(ours - reported) : NAN;
    const bool same = off <= w.tolerance() * (scene.size() + largest_column(ours));
    if (motion.empty() && same) return;
    w.row(quantity, motion.empty() ? "none" : motion, fmt::format("at {:.3g} s off by {:.2g} m", r.later->t, off),
          same);
  };
  const auto vector = [](const Vec3& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x(), v.y(), v.z()); };
  const auto text = [&](const std::optional<Motion>& m) {
    return m ? fmt::format("{} m at {:.6g} Hz", vector(m->amplitude), m->frequency) : "";
  };
  const auto numbered = [](const char* what, size_t i, size_t count) {
    return count > 1 ? fmt::format("motion of {} {}", what, i + 1) : fmt::format("motion of the {}", what);
  };
  if (!r.later) {
    if (p.move) w.add_unattested("motion of pins", "as in the scene");
    if (spheres && spheres->moving()) w.add_unattested("motion of spheres", "as in the scene");
    if (planes && planes->moving()) w.add_unattested("motion of planes", "as in the scene");
    return;
  }
  const double t = r.later->t;
  row("motion of pins", text(p.move), p.pin_home.colwise() + (p.move ? displacement_at(*p.move, t) : Vec3::Zero()),
      r.later->pins);
  for (size_t i = 0; spheres && i < std::min(spheres->list.size(), r.later->centres.size()); ++i)
    row(numbered("sphere", i, spheres->list.size()), text(spheres->list[i].motion), spheres->list[i].centre_at(t),
        r.later->centres[i]);
  const size_t count = planes && r.planes ? std::min(planes->list.size(), r.planes->size()) : 0;
  if (planes && planes->moving() && r.later->points.size() != count)
    w.add_unattested("motion of planes", "as in the scene");
  for (size_t i = 0; i < std::min(count, r.later->points.size()); ++i) {
    // the engine may report any point of the face, so displacements are compared
    const auto& velocity = planes->list[i].velocity;
    row(numbered("plane", i, count), velocity ? vector(*velocity) + " m/s" : "",
        Vec3(t * velocity.value_or(Vec3::Zero())), Vec3(r.later->points[i] - (*r.planes)[i].point));
  }
}

void certify_start(const Scene& scene, const Readback& r, CertificateWriter& w) {
  if (!r.start || r.start->x.cols() != scene.start.x.cols()) {
    w.row("start", "as in the scene", r.start ? "other particles" : "not reported",
          r.start ? Parity::mismatch : Parity::unattested);
    return;
  }
  double x = 0, v = 0;
  for (int i = 0; i < scene.start.x.cols(); ++i) {
    x = max_or_nan(x, (r.start->x.col(i) - scene.start.x.col(i)).norm());
    if (!scene.model.particles.pinned[i]) v = max_or_nan(v, (r.start->v.col(i) - scene.start.v.col(i)).norm());
  }
  const double size = scene.start.x.cwiseAbs().maxCoeff() + scene.size();
  w.deviation("start positions", fmt::format("within {:.3g} m", size), x, size);
  const double speed = largest_column(scene.start.v);
  w.deviation("start velocities", speed > 0 ? fmt::format("up to {:.6g} m/s", speed) : "at rest", v,
              speed > 0 ? speed : 1e-300);
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

bool Certificate::fully_attested() const {
  return std::none_of(rows.begin(), rows.end(), [](const CertificateRow& r) { return r.parity == Parity::unattested; });
}

std::string summary_of(const Certificate& certificate) {
  size_t match = 0, other = 0;
  std::vector<std::string> wrong, not_attested;
  for (const CertificateRow& row : certificate.rows) switch (row.parity) {
      case Parity::match:
        ++match;
        break;
      case Parity::different_law:
        ++other;
        break;
      case Parity::mismatch:
        wrong.push_back(row.quantity);
        break;
      case Parity::unattested:
        not_attested.push_back(row.quantity);
    }
  const size_t reported = match + wrong.size();
  std::string out =
      reported == 0 ? "nothing was read back"
                    : fmt::format("{} {} read back, {}", reported, reported == 1 ? "quantity" : "quantities",
                                  wrong.empty() ? "no mismatch" : fmt::format("MISMATCH: {}", fmt::join(wrong, ", ")));
  if (other > 0) out += fmt::format("; {} under another law", other);
  if (!not_attested.empty()) out += fmt::format("; not attested: {}", fmt::join(not_attested, ", "));
  return out;
}

Certificate certify(const std::string& method, const Scene& scene, const Outcome& outcome) {
  Certificate certificate{method, scene.name, {}};
  if (!outcome.readback) {
    certificate.rows.push_back({"whole scene", "hash " + scene.hash, "-", "not reported", Parity::unattested});
    return certificate;
  }
  const Readback& r = *outcome.readback;
  CertificateWriter w(certificate, outcome);
  certify_particles(scene, r, w);
  certify_start(scene, r, w);
  certify_motion(scene, r, w);
  certify_springs(scene, r, w);
  certify_terms(scene, r, w);
  const std::string step = fmt::format("{:.6g} s", outcome.step);
  if (outcome.adaptive)
    w.row("step", step, "chosen by the engine", Parity::unattested);
  else if (r.step)
    // single precision represents 0.001 with an error of up to half an ulp
    w.row("step", step, fmt::format("{:.6g} s", *r.step),
          std::abs(*r.step - outcome.step) <= (r.precision == "single" ? 0x1p-24 : w.tolerance()) * outcome.step);
  else
    w.add_unattested("step", step);
  w.row("precision", "double", r.precision, r.precision == "double" ? Parity::match : Parity::different_law);
  if (r.may_sleep)
    w.row("sleeping", "off", *r.may_sleep ? "on" : "off", !*r.may_sleep);
  else
    w.add_unattested("sleeping", "off");
  for (const std::string& law : outcome.different_law) {
    const size_t colon = law.find(": ");
    certificate.rows.push_back(
        {"law of " + law.substr(0, colon), "as in the scene", "-", law.substr(colon + 2), Parity::different_law});
  }
  return certificate;
}

}  // namespace crosscheck
