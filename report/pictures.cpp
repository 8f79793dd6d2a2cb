// Bodies, views and scales of pictures.
#include "report/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mysim/errors.h"
#include "report/facts.h"
#include "report/strain.h"

namespace crosscheck {
namespace {

constexpr int strip_columns = 5;

/// Index of the sample nearest to t, or the last one for negative t.
int frame_at(const Trajectory& path, double t) {
  if (t < 0) return path.frames() - 1;
  const auto nearest = std::min_element(path.t.begin(), path.t.end(),
                                        [t](double a, double b) { return std::abs(a - t) < std::abs(b - t); });
  return static_cast<int>(nearest - path.t.begin());
}

/// The last frame up to `frame` that can be drawn: finite, and within a hundred scene sizes.
int drawable(const Scene& scene, const Trajectory& path, int frame) {
  const double far = 100 * scene.size();
  while (frame > 0 && !(path.x[frame].allFinite() && (path.x[frame] - path.x[0]).cwiseAbs().maxCoeff() < far)) --frame;
  return frame;
}

bool is_thread(const Spring& s) { return s.family == Family::structural; }

render::Body body_of(const Scene& scene, const Answer& answer, int frame, Mode mode, const Points* base) {
  render::Body body;
  body.x = answer.trajectory.x[frame];
  body.pinned = scene.model.particles.pins;
  const auto* springs = scene.model.find<Springs>();
  const auto* constraints = scene.model.find<Constraints>();
  const bool surface = !scene.triangles.empty() && mode != Mode::springs;
  if (surface) {
    body.triangles = scene.triangles;
    if (springs)
      for (const Spring& s : springs->list)
        if (is_thread(s)) body.threads.push_back({s.a, s.b});
    if (constraints)
      for (const auto& [a, b, length] : constraints->list) body.threads.push_back({a, b});
  } else {
    if (scene.triangles.empty()) body.bead_radius = render::by_view;
    std::vector<double> strain;
    if (mode == Mode::stretch) stretch_of(scene, body.x, &strain);
    if (springs)
      for (size_t i = 0; i < springs->list.size(); ++i) {
        const Spring& s = springs->list[i];
        body.tubes.push_back({s.a, s.b});
        if (mode == Mode::stretch) body.tube_value.push_back(strain[i]);
      }
    if (constraints)
      for (const auto& [a, b, length] : constraints->list) {
        body.tubes.push_back({a, b});
        if (mode == Mode::stretch) body.tube_value.push_back(extension(body.x, a, b, length));
      }
  }
  if (surface && mode == Mode::stretch) body.value = stretch_of(scene, body.x);
  if (mode == Mode::difference && base) {
    body.value.resize(body.x.cols());
    for (int i = 0; i < body.x.cols(); ++i) body.value[i] = 1000 * (body.x.col(i) - base->col(i)).norm();
  }
  // the last particle of a scene without cloth draws its path
  if (scene.triangles.empty())
    for (int i = 0; i <= frame; ++i) body.trail.push_back(answer.trajectory.x[i].col(body.x.cols() - 1));
  return body;
}

/// The families that the scene's springs belong to, in the order of the legend.
std::vector<Family> families_of(const Scene& scene) {
  std::vector<Family> present;
  if (!scene.model.find<Springs>()) return present;
  for (const Family family : {Family::structural, Family::shear, Family::bend, Family::single})
    for (const Spring& s : scene.model.find<Springs>()->list)
      if (s.family == family) {
        present.push_back(family);
        break;
      }
  return present;
}

/// The springs of a cloth as tubes, one body per family: structural ones thick, shear and bend ones thin. Bend springs
/// lie on the structural ones; they are lifted towards the eye so that both are seen.
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

/// Whether all that is shown lies in one plane that faces the viewer, so that no ground belongs below it.
bool is_flat(const Scene& scene, const std::vector<Points>& shown) {
  double depth = 0;
  for (const Points& x : shown) depth = std::max(depth, x.row(2).maxCoeff() - x.row(2).minCoeff());
  return scene.triangles.empty() && depth < 1e-9;
}

/// The scene's camera says from where; how far away is chosen so that panels of every shape hold everything.
Vec3 towards_eye(const Scene& scene, bool flat) {
  if (scene.camera) return scene.camera->eye - scene.camera->target;
  return flat ? Vec3(0, 0, 1) : Vec3(0.55, 0.35, 1);
}

/// The scene's camera, or one that holds everything that the panels show.
render::View view_of(const Scene& scene, const std::vector<Points>& shown, const std::vector<render::Ball>& balls,
                     double aspect) {
  const bool flat = is_flat(scene, shown);
  render::View view = render::view_that_holds(shown, balls, towards_eye(scene, flat), aspect);
  if (flat) view.floor.reset();
  return view;
}

std::string time_text(const Answer& answer, int frame) {
  const std::string t = fmt::format("t = {:.3g} s", answer.trajectory.t[frame]);
  return answer.outcome.verdict == Verdict::ok
             ? t
             : fmt::format("{}, {} at {:.3g} s", t, failure_word(std::string(name_of(answer.outcome.verdict))),
                           answer.outcome.end);
}

std::vector<int> frames_of(const Scene& scene, const Trajectory& path, const Shot& shot) {
  if (shot.mode != Mode::strip) return {drawable(scene, path, frame_at(path, shot.at))};
  std::vector<int> frames;
  for (int c = 0; c < strip_columns; ++c)
    frames.push_back(drawable(scene, path, frame_at(path, scene.duration * c / (strip_columns - 1))));
  return frames;
}

}  // namespace

Vantage vantage_of(const Scene& scene, const std::vector<Points>& shown, const std::vector<double>& times) {
  std::vector<render::Ball> balls;
  for (const double t : times)
    for (const render::Ball& ball : balls_of(scene, t)) balls.push_back(ball);
  return {towards_eye(scene, is_flat(scene, shown)), view_of(scene, shown, balls, 1).floor};
}

Mode mode_named(const std::string& name) {
  constexpr std::pair<const char*, Mode> table[] = {{"shaded", Mode::shaded},
                                                    {"stretch", Mode::stretch},
                                                    {"springs", Mode::springs},
                                                    {"difference", Mode::difference},
                                                    {"strip", Mode::strip}};
  for (const auto& [known, mode] : table)
    if (name == known) return mode;
  throw InputError(fmt::format("--mode {}: expected shaded, stretch, springs, difference or strip", name));
}

std::vector<std::string> pictured_methods(const Scene& scene) {
  if (scene.model.first_order()) return {"mysim/explicit-euler", "mysim/trapezoidal", "mysim/rk4"};
  if (scene.model.find<Constraints>()) return {"mysim/xpbd", "bullet/pbd"};
  std::vector<std::string> names{"mysim/symplectic-euler", "bullet/deformable-explicit", "bullet/pbd"};
  // what is meant for long steps first, and what fails there beside it
  if (scene.method.find("implicit") != std::string::npos)
    names = {"mysim/" + scene.method, "mysim/implicit-midpoint", "mysim/symplectic-euler"};
  if (scene.model.find<Spheres>()) names.push_back("mysim/symplectic-euler+sticky");
  return names;
}

render::Picture picture_of(const Scene& scene, const std::vector<const Answer*>& answers, const Shot& shot) {
  std::vector<const Answer*> usable;
  for (const Answer* a : answers)
    if (a->trajectory.frames() > 0) usable.push_back(a);
  if (usable.empty())
    throw InputError(
        fmt::format("{}: none of the methods gives a picture; expected one that can run the scene", scene.name));

  render::Picture picture;
  picture.width = shot.width;
  picture.height = shot.height;
  picture.quality = shot.quality;
  if (shot.mode == Mode::difference && usable.size() < 2)
    throw InputError(fmt::format("{}: --mode difference: expected two methods that can run the scene", scene.name));
  const bool strip = shot.mode == Mode::strip;
  // without springs there is no stretch to colour by
  const bool no_stretch =
      shot.mode == Mode::stretch && !scene.model.find<Springs>() && !scene.model.find<Constraints>();
  const Mode mode = strip || no_stretch ? Mode::shaded : shot.mode;
  Shot when = shot;
  for (const Answer* a : usable)
    if (shot.at_first_failure && a->outcome.verdict != Verdict::ok)
      when.at = when.at < 0 ? a->outcome.end : std::min(when.at, a->outcome.end);
  const auto base_frames = frames_of(scene, usable[0]->trajectory, when);
  std::vector<Points> healthy, all;
  std::vector<render::Ball> balls;
  double most = 0, most_of_failed = 0;
  if (!strip) picture.rows.emplace_back();
  for (const Answer* a : usable) {
    if (strip) picture.rows.emplace_back();
    const std::vector<int> frames = frames_of(scene, a->trajectory, when);
    for (size_t c = 0; c < frames.size(); ++c) {
      const Points& base = usable[0]->trajectory.x[base_frames[c]];
      render::Panel panel;
      panel.title = !strip || c == 0 ? a->method : "";
      panel.subtitle = time_text(*a, frames[c]);
      panel.balls = balls_of(scene, a->trajectory.t[frames[c]]);
      balls.insert(balls.end(), panel.balls.begin(), panel.balls.end());
      panel.bodies.push_back(body_of(scene, *a, frames[c], mode, &base));
      // a run that blew up would leave no colour for the others
      double& top = a->outcome.verdict == Verdict::ok ? most : most_of_failed;
      for (double v : panel.bodies[0].value) top = std::max(top, v);
      for (double v : panel.bodies[0].tube_value) top = std::max(top, v);
      all.push_back(panel.bodies[0].x);
      if (a->outcome.verdict == Verdict::ok) healthy.push_back(panel.bodies[0].x);
      for (const Vec3& p : panel.bodies[0].trail)
        if (a->outcome.verdict == Verdict::ok) healthy.push_back(Points(p));
      picture.rows.back().push_back(std::move(panel));
    }
  }
  if (healthy.empty() || shot.at_first_failure) most = std::max(most, most_of_failed);
  if (mode == Mode::stretch) picture.scale = render::Scale{"stretch / %", 0, round_up(most)};
  if (mode == Mode::difference)
    picture.scale = render::Scale{"distance from " + usable[0]->method + " / mm", 0, round_up(most)};
  if (mode == Mode::springs && !scene.triangles.empty())
    for (const Family family : families_of(scene)) picture.legend.emplace_back(name_of(family));
  picture.view = view_of(scene, healthy.empty() ? all : healthy, balls, render::panel_aspect(picture));
  if (!picture.legend.empty())
    for (render::Panel& panel : picture.rows[0])
      panel.bodies = tubes_of(scene, panel.bodies[0].x, (picture.view.eye - picture.view.target).normalized());
  return picture;
}

}  // namespace crosscheck
