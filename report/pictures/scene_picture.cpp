#include "report/pictures/scene_picture.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "reference/method.h"
#include "report/findings/report_data.h"
#include "report/pictures/layout.h"

namespace crosscheck {
namespace {

/// Extension in % of the rest length; compression counts as zero.
double extension(const Points& x, int a, int b, double rest) {
  return rest > 0 ? std::max(0.0, (x.col(a) - x.col(b)).norm() / rest - 1) * 100 : 0;
}

/// Springs, followed by distance constraints as structural springs.
std::vector<Spring> links_of(const Scene& scene) {
  std::vector<Spring> links;
  if (const auto* springs = scene.model.find<Springs>()) links = springs->list;
  if (const auto* constraints = scene.model.find<Constraints>())
    for (const auto& [a, b, length] : constraints->list) links.push_back({a, b, 0, length, Family::structural});
  return links;
}

/// Mean strain at each particle; shear and bend springs do not count.
std::vector<double> mean_at_particles(const std::vector<Spring>& links, const std::vector<double>& strain, size_t n) {
  std::vector<double> sum(n, 0), count(n, 0);
  for (size_t i = 0; i < links.size(); ++i)
    if (links[i].family != Family::shear && links[i].family != Family::bend)
      for (const int end : {links[i].a, links[i].b}) sum[end] += strain[i], count[end] += 1;
  for (size_t i = 0; i < n; ++i) sum[i] /= std::max(1.0, count[i]);
  return sum;
}

/// Rounds a value up to 1, 2 or 5 times a power of ten. Returns 1 if the value is not positive.
double round_up(double value) {
  if (!(value > 0)) return 1;
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (double step : {1.0, 2.0, 5.0, 10.0})
    if (value <= step * power * (1 + 1e-9)) return step * power;
  return value;
}

/// In mode `difference`, the distance from `base` determines the colours.
render::Body body_of(const Scene& scene, const MethodResult& answer, int frame, Mode mode, const Points* base) {
  render::Body body;
  body.x = answer.trajectory.x[frame];
  body.pinned = scene.model.particles.pins;
  const std::vector<Spring> links = links_of(scene);
  std::vector<double> strain;
  if (mode == Mode::stretch)
    for (const Spring& s : links) strain.push_back(extension(body.x, s.a, s.b, s.rest));
  if (!scene.triangles.empty() && mode != Mode::springs) {
    body.triangles = scene.triangles;
    for (const Spring& s : links)
      if (s.family == Family::structural) body.threads.push_back({s.a, s.b});
    if (mode == Mode::stretch) body.value = mean_at_particles(links, strain, body.x.cols());
  } else {
    body.beads = scene.triangles.empty();
    for (const Spring& s : links) body.tubes.push_back({s.a, s.b});
    body.tube_value = strain;
  }
  if (mode == Mode::difference && base) {
    body.value.resize(body.x.cols());
    for (int i = 0; i < body.x.cols(); ++i) body.value[i] = 1000 * (body.x.col(i) - base->col(i)).norm();
  }
  // if there is no cloth, draw the path of the last particle
  if (scene.triangles.empty())
    for (int i = 0; i <= frame; ++i) body.trail.push_back(answer.trajectory.x[i].col(body.x.cols() - 1));
  return body;
}

/// Families of the scene's springs, in the order of the legend.
std::vector<Family> families_of(const Scene& scene) {
  std::vector<Family> present;
  if (!scene.model.find<Springs>()) return present;
  for (const Family family : {Family::structural, Family::shear, Family::bend, Family::single})
    if (std::ranges::count(scene.model.find<Springs>()->list, family, &Spring::family) > 0) present.push_back(family);
  return present;
}

/// One body per family of springs: thick tubes for structural springs, thin ones for shear and bend springs. Bend
/// springs coincide with structural ones, and are shifted towards the eye to be visible.
std::vector<render::Body> tubes_of(const Scene& scene, const Points& x, const Vec3& towards_eye) {
  const auto& springs = scene.model.find<Springs>()->list;
  double spacing = 1e300;
  for (const Spring& s : springs)
    if (s.rest > 0) spacing = std::min(spacing, s.rest);
  std::vector<render::Body> bodies;
  for (const Family family : families_of(scene)) {
    render::Body body;
    body.x = x;
    if (family == Family::bend) body.x.colwise() += 0.12 * spacing * towards_eye;
    if (bodies.empty()) body.pinned = scene.model.particles.pins;
    body.tube_radius = spacing * (family == Family::bend ? 0.035 : family == Family::shear ? 0.045 : 0.11);
    for (const Spring& s : springs)
      if (s.family == family) body.tubes.push_back({s.a, s.b});
    body.tube_colour.assign(body.tubes.size(), static_cast<int>(bodies.size()));
    bodies.push_back(std::move(body));
  }
  return bodies;
}

std::vector<render::Ball> balls_of(const Scene& scene, double t) {
  std::vector<render::Ball> balls;
  if (const auto* spheres = scene.model.find<Spheres>())
    for (const Sphere& s : spheres->list) balls.push_back({s.centre_at(t), s.radius});
  return balls;
}

/// A plane is drawn as a floor or a slope, or not at all.
bool is_floor(const Plane& plane) { return plane.normal.y() > 1 - 1e-9; }
bool is_slope(const Plane& plane) { return plane.normal.y() > 0.1 && !is_floor(plane); }

/// Bounding box of the completed runs; empty if the scene has no planes, because only planes need the box.
Eigen::AlignedBox3d box_over_planes(const Scene& scene, const std::vector<const MethodResult*>& answers) {
  Eigen::AlignedBox3d box;
  if (!scene.model.find<Planes>()) return box;
  for (const MethodResult* a : answers)
    if (a->outcome.verdict == Verdict::ok)
      for (const Points& x : a->trajectory.x)
        box.extend(Vec3(x.rowwise().minCoeff())), box.extend(Vec3(x.rowwise().maxCoeff()));
  return box;
}

/// Square patches of slopes under a box at time t (s).
std::vector<render::Body> slopes_of(const Scene& scene, double t, const Eigen::AlignedBox3d& box) {
  std::vector<render::Body> patches;
  if (box.isEmpty()) return patches;
  const double half = box.diagonal().norm() > 0 ? 0.7 * box.diagonal().norm() : 0.5;
  for (const Plane& plane : scene.model.find<Planes>()->list) {
    if (!is_slope(plane)) continue;
    const Vec3 n = plane.normal, level = n.cross(Vec3::UnitY()).normalized(), d = box.center() - plane.point_at(t);
    const Vec3 at = box.center() - d.dot(n) * n, u = half * level, v = half * level.cross(n);
    render::Body& patch = patches.emplace_back();
    patch.x.resize(3, 4);
    patch.x << at - u - v, at + u - v, at + u + v, at - u + v;
    patch.triangles = {{0, 2, 1}, {0, 3, 2}};
  }
  return patches;
}

constexpr int strip_columns = 5;
constexpr double panel_in_print = 1.2;  // width / height

/// Frame nearest to t; the last one if t is negative.
int frame_at(const Trajectory& path, double t) {
  if (t < 0) return path.frames() - 1;
  const auto nearest = std::min_element(path.t.begin(), path.t.end(),
                                        [t](double a, double b) { return std::abs(a - t) < std::abs(b - t); });
  return static_cast<int>(nearest - path.t.begin());
}

/// The last frame up to `frame` that is finite and within a hundred scene sizes.
int drawable(const Scene& scene, const Trajectory& path, int frame) {
  const double far = 100 * scene.size();
  while (frame > 0 && !(path.x[frame].allFinite() && (path.x[frame] - path.x[0]).cwiseAbs().maxCoeff() < far)) --frame;
  return frame;
}

/// True if everything lies in a plane that faces the viewer; such scenes are drawn without ground.
bool is_flat(const Scene& scene, const std::vector<Points>& shown) {
  double depth = 0;
  for (const Points& x : shown) depth = std::max(depth, x.row(2).maxCoeff() - x.row(2).minCoeff());
  return scene.triangles.empty() && depth < 1e-9;
}

/// Uses only the direction of the scene's camera, because the distance must suit panels of every shape.
Vec3 towards_eye(const Scene& scene, bool flat) {
  if (scene.camera) return scene.camera->eye - scene.camera->target;
  return flat ? Vec3(0, 0, 1) : Vec3(0.55, 0.35, 1);
}

render::View view_of(const Scene& scene, const std::vector<Points>& shown, const std::vector<render::Ball>& balls,
                     double aspect) {
  const bool flat = is_flat(scene, shown);
  render::View view = render::fit_view(shown, balls, towards_eye(scene, flat), aspect, !flat);
  if (const auto* planes = scene.model.find<Planes>(); planes && view.floor)
    for (const Plane& plane : planes->list)
      if (is_floor(plane)) view.floor = plane.point.y();
  return view;
}

/// Name of the method, with the step if another picture shows the same method.
std::string title_of(const MethodResult& answer, const std::vector<const MethodResult*>& all) {
  const auto same = std::ranges::count(all, answer.method, &MethodResult::method);
  return same > 1 ? fmt::format("{}, step {}", answer.method, step_text(answer.outcome.step)) : answer.method;
}

/// Time of the frame; for a failed run, also how and when it failed.
std::string time_text(const MethodResult& answer, int frame) {
  const std::string t = fmt::format("t = {:.3g} s", answer.trajectory.t[frame]);
  const Outcome& outcome = answer.outcome;
  return outcome.verdict == Verdict::ok
             ? t
             : fmt::format("{}, {} at {:.3g} s", t, failure_class(outcome.verdict), outcome.end);
}

std::vector<const MethodResult*> usable_of(const Scene& scene, const std::vector<const MethodResult*>& answers,
                                           const Shot& shot) {
  std::vector<const MethodResult*> usable;
  for (const MethodResult* a : answers)
    if (a->trajectory.frames() > 0) usable.push_back(a);
  if (usable.empty())
    throw InputError(
        fmt::format("{}: no method has a result to draw; expected one that can run the scene", scene.name));
  if (shot.mode == Mode::difference && usable.size() < 2)
    throw InputError(fmt::format("{}: --mode difference: expected two methods that can run the scene", scene.name));
  return usable;
}

std::vector<int> frames_of(const Scene& scene, const Trajectory& path, const Shot& shot) {
  if (shot.mode != Mode::strip) return {drawable(scene, path, frame_at(path, shot.at))};
  std::vector<int> frames;
  for (int c = 0; c < strip_columns; ++c)
    frames.push_back(drawable(scene, path, frame_at(path, scene.duration * c / (strip_columns - 1))));
  return frames;
}

/// Motions that determine view and scale. Excludes blow-ups, which would make other motions too small and too pale.
struct Seen {
  std::vector<Points> healthy, all, trails;
  std::vector<render::Ball> balls;
  double most = 0, most_of_failed = 0;

  void add(const render::Panel& panel, bool ok) {
    const render::Body& body = panel.bodies[0];
    balls.insert(balls.end(), panel.balls.begin(), panel.balls.end());
    double& top = ok ? most : most_of_failed;
    for (const double v : body.value) top = std::max(top, v);
    for (const double v : body.tube_value) top = std::max(top, v);
    all.push_back(body.x);
    if (!ok) return;
    healthy.push_back(body.x);
    if (body.trail.empty()) return;
    trails.emplace_back(3, body.trail.size());
    for (size_t i = 0; i < body.trail.size(); ++i) trails.back().col(static_cast<Eigen::Index>(i)) = body.trail[i];
  }
  std::vector<Points> shown() const {
    std::vector<Points> points = healthy.empty() ? all : healthy;
    points.insert(points.end(), trails.begin(), trails.end());
    return points;
  }
};

/// The picture without its view and without the top of its scale.
render::Picture panels_of(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                          Seen& seen) {
  const std::vector<const MethodResult*> usable = usable_of(scene, answers, shot);
  render::Picture picture;
  picture.width = shot.width;
  picture.height = shot.height;
  picture.quality = shot.quality;
  picture.text = shot.text;
  const bool strip = shot.mode == Mode::strip;
  // stretch cannot be shown if there are no springs
  const bool no_stretch = shot.mode == Mode::stretch && links_of(scene).empty();
  const Mode mode = strip || no_stretch ? Mode::shaded : shot.mode;
  const auto base_frames = frames_of(scene, usable[0]->trajectory, shot);
  if (!strip) picture.rows.emplace_back();
  const Eigen::AlignedBox3d box = box_over_planes(scene, usable);  // gives all panels the same slopes
  for (const MethodResult* a : usable) {
    if (strip) picture.rows.emplace_back();
    const std::vector<int> frames = frames_of(scene, a->trajectory, shot);
    for (size_t c = 0; c < frames.size(); ++c) {
      const Points& base = usable[0]->trajectory.x[base_frames[c]];
      render::Panel panel;
      panel.title = !strip || c == 0 ? title_of(*a, answers) : "";
      panel.subtitle = time_text(*a, frames[c]);
      panel.balls = balls_of(scene, a->trajectory.t[frames[c]]);
      panel.bodies.push_back(body_of(scene, *a, frames[c], mode, &base));
      seen.add(panel, a->outcome.verdict == Verdict::ok);
      for (render::Body& slope : slopes_of(scene, a->trajectory.t[frames[c]], box))
        panel.bodies.push_back(std::move(slope));
      picture.rows.back().push_back(std::move(panel));
    }
  }
  if (mode == Mode::stretch) picture.scale = render::Scale{"stretch / %", 1};
  if (mode == Mode::difference) picture.scale = render::Scale{"distance from " + usable[0]->method + " / mm", 1};
  if (mode == Mode::springs && !scene.triangles.empty())
    for (const Family family : families_of(scene)) picture.legend.emplace_back(name_of(family));
  if (shot.text > 0 && !strip) render::arrange(picture, panel_in_print);
  return picture;
}

}  // namespace

CameraPlacement camera_placement(const Scene& scene, const std::vector<Points>& shown,
                                 const std::vector<double>& times) {
  std::vector<render::Ball> balls;
  for (const double t : times)
    for (const render::Ball& ball : balls_of(scene, t)) balls.push_back(ball);
  return {towards_eye(scene, is_flat(scene, shown)), view_of(scene, shown, balls, 1).floor};
}

int frame_shown(const Scene& scene, const MethodResult& answer, const Shot& shot) {
  return drawable(scene, answer.trajectory, frame_at(answer.trajectory, shot.at));
}

Mode mode_named(const std::string& name) {
  const std::vector<std::string> names{"shaded", "stretch", "springs", "difference", "strip"};  // in the order of Mode
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<Mode>(found - names.begin());
  throw InputError(fmt::format("--mode {}: expected shaded, stretch, springs, difference or strip{}", name,
                               did_you_mean(name, names)));
}

std::vector<std::string> pictured_methods(const Scene& scene) {
  const bool first_order = scene.model.first_order(), hard = scene.model.find<Constraints>() != nullptr;
  std::vector<std::string> names;
  for (const Method& m : all_methods()) {
    const bool representative = m.name == m.family().representative;
    const bool shown = first_order ? m.stepper && m.stepper->first_order && !m.adaptive
                       : hard      ? m.position_based
                                   : representative || (m.position_based && !m.family().is_subject());
    if (shown && m.family().by_default()) names.push_back(m.name);
  }
  if (first_order || hard) return names;
  // if the step is long, show methods that suit long steps and, for comparison, a method that fails
  if (find_method(scene.method).implicit)
    names = {find_method(scene.method).name,
             subject_method([](const Stepper& s) { return s.evaluations == 0 && s.symplectic; }),
             std::string(subject().representative)};
  if (has_contact(scene.model)) names.push_back(sticky_method());
  return names;
}

Shot usual_shot(const Scene& scene, bool full) {
  Shot shot;
  shot.at = scene.camera && scene.camera->at ? *scene.camera->at : -1;
  // soft light takes seconds, which are worth spending on cloth; beads look the same without it
  shot.quality = full || !scene.triangles.empty() ? render::Quality::still : render::Quality::fast;
  shot.mode = scene.triangles.empty() ? Mode::shaded : Mode::stretch;
  shot.width = 1440;
  shot.height = 560;
  return shot;
}

CommonView common_view(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot) {
  Seen seen;
  const render::Picture picture = panels_of(scene, answers, shot, seen);
  const double most = seen.healthy.empty() ? seen.most_of_failed : seen.most;
  return {view_of(scene, seen.shown(), seen.balls, render::panel_aspect(picture)), round_up(most)};
}

render::Picture picture_of(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot,
                           const CommonView& common) {
  Seen unused;
  render::Picture picture = panels_of(scene, answers, shot, unused);
  picture.view = common.view;
  if (picture.scale) picture.scale->high = common.top;
  if (!picture.legend.empty())
    for (auto& row : picture.rows)
      for (render::Panel& panel : row)
        panel.bodies = tubes_of(scene, panel.bodies[0].x, (common.view.eye - common.view.target).normalized());
  return picture;
}

render::Picture picture_of(const Scene& scene, const std::vector<const MethodResult*>& answers, const Shot& shot) {
  return picture_of(scene, answers, shot, common_view(scene, answers, shot));
}

}  // namespace crosscheck
