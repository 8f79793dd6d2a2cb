// Experiment `contact`: collision response to balls and planes, measured with probes whose result is known, and with
// draped cloths.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/contact/probes.h"
#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/tables/contact.h"
#include "mysim/run/contacts.h"

namespace crosscheck {
namespace {

void rebounds(const Request& request, const Method& method, TableSet& tables) {
  Table table = table_of<ReboundRow>();
  std::vector<double> parts = {0, 0.5, 0.9};
  if (request.full) parts = {0, 0.25, 0.5, 0.75, 0.9, 1};
  for (const double e : parts)
    for (const double h : {1. / 60, 1. / 240, 1e-3, 1e-4}) {
      Outcome out;
      const auto height = rebound(method, drop_on_ball(e), h, out);
      add(table, ReboundRow{.method = method.name,
                            .verdict = out.verdict,
                            .reason = out.reason,
                            .step = h,
                            .restitution = e,
                            .rebound = height,
                            .by_theory = 0.3 * e * e});
    }
  tables.add(table);
}

void leavings(const Request& request, const Method& method, TableSet& tables) {
  Table table = table_of<LeavingRow>();
  const Leaving exact = leaving_by_theory();
  std::vector<double> steps = {1. / 240, 1e-3, 1e-4};
  if (request.full) steps = {1. / 60, 1. / 240, 1e-3, 2.5e-4, 1e-4, 1e-5};
  for (const double h : steps) {
    Outcome out;
    const auto found = leaving(method, h, out);
    LeavingRow row{.method = method.name,
                   .verdict = out.verdict,
                   .reason = out.reason,
                   .step = h,
                   .angle_by_theory = exact.angle,
                   .speed_by_theory = exact.speed};
    if (found) row.angle = found->angle, row.speed = found->speed;
    add(table, row);
  }
  tables.add(table);
}

void cones_on(Ground ground, const Request& request, const Method& method, TableSet& tables) {
  const bool flat = ground == Ground::plane;
  Table table = flat ? table_of<PlaneConeRow>() : table_of<ConeRow>();
  std::vector<double> steps = {1e-3};
  // omits longer steps on planes: their error would hide the short slide at a friction a thousandth below the limit
  if (request.full && !flat) steps = {1. / 60, 1. / 240, 1e-3};
  for (const double h : steps)
    for (const double degrees : {10., 20., 30., 40., 50.}) {
      const double limit = std::tan(degrees * 0.017453292519943295);
      std::vector<double> frictions = {0.95 * limit, 1.05 * limit};
      if (flat) frictions = {limit / 1.001, limit / 0.999};
      for (int i = 0; i <= 12; ++i)
        // the two values above represent all frictions that differ from the limit by at most a twentieth
        if (std::abs(0.1 * i / limit - 1) > 0.05) frictions.push_back(0.1 * i);
      std::sort(frictions.begin(), frictions.end());
      for (const double mu : frictions) {
        Outcome out;
        const auto found = cone(method, degrees, mu, ground, h, out);
        const double sliding_distance =
            std::max(0.0, 9.81 * (std::sin(std::atan(limit)) - mu * std::cos(std::atan(limit))) / 8);
        ConeRow row{.method = method.name,
                    .verdict = out.verdict,
                    .reason = out.reason,
                    .step = h,
                    .angle = degrees,
                    .friction = mu,
                    .distance_by_theory = sliding_distance,
                    .state_by_theory = mu < limit ? ContactState::slides : ContactState::sticks};
        if (found) row.distance = found->distance, row.state = found->state;
        add(table, row);
      }
    }
  tables.add(table);
}

void cones(const Request& request, const Method& method, TableSet& tables) {
  for (const Ground ground : {Ground::ball, Ground::plane}) cones_on(ground, request, method, tables);
}

void plane_probes(const Request&, const Method& method, TableSet& tables) {
  Table table = table_of<PlaneProbeRow>();
  for (const PlaneProbe probe : {PlaneProbe::apex, PlaneProbe::period, PlaneProbe::loss, PlaneProbe::held})
    for (const double h : {1. / 240, 1e-3, 1e-4}) {
      Outcome out;
      const auto value = measured(probe, method, h, out);
      add(table, PlaneProbeRow{.probe = probe,
                               .method = method.name,
                               .verdict = out.verdict,
                               .reason = out.reason,
                               .step = h,
                               .measured = value,
                               .by_theory = by_theory(probe)});
    }
  tables.add(table);
}

void orders_of_contact(const Request& request, const Method& method, TableSet& tables) {
  Table table = table_of<ContactOrderRow>();
  std::vector<Method> methods = {method};
  if (locates_events(*method.stepper) && method.name.find('+') == std::string::npos)
    methods.push_back(find_method(method.name + "+events"));
  for (const Scene& scene : contact_order_probes()) {
    const auto truth = truth_of(scene, default_run(scene));
    if (!truth || truth->under_contact_rule) {
      tables.notes.push_back(fmt::format("contact leaves out {}: no reference solution is known for it", scene.name));
      continue;
    }
    for (const Method& each : methods) {
      std::optional<double> before;
      for (int i = 0; i < (request.full ? 6 : 4); ++i) {
        Run run = default_run(scene);
        run.step = run.duration / run.samples / (4 << i);
        run.timed = false;
        Recorder recorder;
        const Outcome out = run_method(each, scene, run, {&recorder});
        ContactOrderRow row{.probe = scene.name,
                            .method = each.name,
                            .verdict = out.verdict,
                            .step = out.step,
                            .truth = truth->how,
                            .truth_tier = truth->tier,
                            .truth_bar = truth->error_bar};
        if (out.verdict == Verdict::ok) {
          row.error = largest_rms_distance(recorder.trajectory, truth->trajectory);
          // if the error is below thirty error bars of the truth, it is too uncertain for an order
          const bool known = *row.error > 30 * truth->error_bar;
          if (before && known) row.order = std::log2(*before / *row.error);
          before = known ? row.error : std::nullopt;
        }
        add(table, row);
      }
    }
  }
  tables.add(table);
}

/// Adds penetration depth, settling time and final state of a run with balls or planes.
void drape(const Scene& scene, const Method& method, double step, TableSet& tables) {
  Table summary = table_of<DrapeRow>();
  Table deep = table_of<PenetrationRow>();
  Table table = table_of<DrapeTimeRow>(scene.name + "-drape");
  Run run = default_run(scene);
  run.step = step;
  run.timed = false;
  Recorder recorder;
  Ledger ledger(scene.model, method.contact);
  const Outcome out = run_method(method, scene, run, {&recorder, &ledger});
  const bool none = out.verdict == Verdict::unsupported || recorder.trajectory.frames() == 0;
  const Trajectory path = none ? Trajectory{} : std::move(recorder.trajectory);
  const auto mirror = MirrorSymmetry::of(scene);
  const Vec3 start = centre_of_mass(scene, scene.start.x);
  double radius = INFINITY;
  for (const Surface& s : surfaces_of(scene.model)) radius = std::min(radius, s.radius());

  std::optional<double> nodes, triangles, last_gap, last_depth, last_creep, skew;
  double settled = 0;
  Vec3 centre = start;
  for (int i = 0; i < path.frames(); ++i) {
    const double t = path.t[i];
    const Points& x = path.x[i];
    if (!x.allFinite()) break;
    centre = centre_of_mass(scene, x);
    const Vec3 aside(centre.x() - start.x(), 0, centre.z() - start.z());
    last_gap = clearance(scene, t, x);
    last_depth = depth_of_triangles(scene, t, x);
    last_creep = creep(scene, t, x, path.v[i]);
    if (mirror) skew = mirror->asymmetry(x);
    if (last_gap) nodes = std::max(nodes.value_or(-INFINITY), -*last_gap);
    if (last_depth) triangles = std::max(triangles.value_or(-INFINITY), *last_depth);
    // the cloth is at rest if the RMS speed stays at or below 1 cm/s for at least the last twentieth of the run
    const auto count = static_cast<double>(x.cols());
    if (path.v[i].cols() != x.cols() || std::sqrt(path.v[i].squaredNorm() / count) > 0.01)
      settled = i + 1 < path.frames() ? path.t[i + 1] : INFINITY;
    add(table, DrapeTimeRow{.method = method.name,
                            .step = out.step,
                            .t = t,
                            .centre_height = centre.y(),
                            .moved_aside = aside.norm(),
                            .clearance = last_gap,
                            .triangles_inside = last_depth,
                            .creep = last_creep,
                            .asymmetry = skew});
  }
  const bool ok = out.verdict == Verdict::ok && !none;
  DrapeRow row{.scene = scene.name,
               .method = method.name,
               .verdict = out.verdict,
               .reason = out.reason,
               .end = out.end,
               .step = out.step,
               .contact_inferred = ledger.contact_inferred()};
  PenetrationRow depth{
      .scene = scene.name, .method = method.name, .verdict = out.verdict, .step = out.step, .radius = radius};
  if (ok) {
    if (settled < 0.95 * out.end) row.settled_after = settled;
    row.centre_height = centre.y();
    row.moved_aside = std::hypot(centre.x() - start.x(), centre.z() - start.z());
    row.clearance = last_gap, row.creep = last_creep, row.asymmetry = skew;
    if (!ledger.rows().empty()) row.contact = ledger.rows().back().contact;
    const auto share = [&](double inside) { return 100 * std::max(0.0, inside) / radius; };
    if (nodes) depth.particles = share(*nodes);
    if (triangles) depth.triangles = share(*triangles);
    if (last_gap) depth.particles_at_end = share(-*last_gap);
    if (last_depth) depth.triangles_at_end = share(*last_depth);
  }
  add(summary, row);
  tables.add(summary);
  if (std::isfinite(radius)) add(deep, depth), tables.add(deep);
  tables.add(table);
}

}  // namespace

std::vector<Point> contact_points(const Request& request) {
  std::vector<Point> points;
  const auto add = [&](const std::string& what, const Method& method, const Scene& scene, auto compute) {
    Request alone = request;
    alone.scenes.clear();
    alone.methods = {method};
    points.push_back({fmt::format("contact: {} by {}", what, method.name), content_of(alone, scene),
                      [=](TableSet& tables) { compute(alone, method, tables); }});
  };
  const Scene centred = drop_centred(), aside = drop_aside();
  for (const Scene& scene : {aside, centred})
    for (const Method& method : methods_of(request, scene))
      if (!request.scenes_only)
        add(scene.name, method, scene, [scene](const Request& alone, const Method& m, TableSet& tables) {
          std::vector<double> steps = {2e-3, 1e-3};
          if (alone.full) steps = {4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4};
          for (const double h : steps) drape(scene, m, h, tables);
        });
  for (const Scene& scene : request.scenes) {
    if (!has_contact(scene.model)) {
      points.push_back({"contact: " + scene.name, content_of(request, scene), [name = scene.name](TableSet& tables) {
                          tables.notes.push_back(fmt::format("contact leaves out {}: it has no ball or plane", name));
                        }});
      continue;
    }
    for (const Method& method : methods_of(request, scene))
      add(scene.name, method, scene, [scene](const Request& alone, const Method& m, TableSet& tables) {
        drape(scene, m, run_of(alone, scene).step, tables);
      });
  }
  if (request.all_engines && request.scenes_only)
    for (const Method& method : request.methods) add("Coulomb cone", method, on_slope(0, 0, Ground::ball), cones);
  if (request.scenes_only) return points;
  for (const Method& method : methods_of(request, centred)) {
    add("rebound", method, drop_on_ball(0), rebounds);
    add("leaving", method, frictionless_slide(), leavings);
    add("Coulomb cone", method, on_slope(0, 0, Ground::ball), cones);
    add("planes", method, drop_on_floor(), plane_probes);
    if (method.stepper && !method.adaptive && !method.sticky_contact)
      add("order of contact", method, contact_order_probes().back(), orders_of_contact);
  }
  return points;
}

}  // namespace crosscheck
