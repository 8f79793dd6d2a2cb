// The engine as a WebAssembly module for page/lab/engine.ts. An instance is one scene and one run. Texts are UTF-8 in
// the module's buffer; returned arrays are valid until the next call. An exception ends the instance (browser.cpp).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "report/lab/live_run.h"

#define EXPORT(name) __attribute__((export_name(#name)))

namespace crosscheck {
namespace {

struct Instance {
  std::string text;  // last text received or returned
  std::optional<LiveRun> run;
  std::vector<int> integers;
  std::vector<double> numbers;
};

Instance& instance() {
  static Instance only;
  return only;
}

LiveRun& run() { return *instance().run; }

const char* hand_out(std::string text) {
  instance().text = std::move(text);
  return instance().text.c_str();
}

const int* hand_out(std::vector<int> values) {
  instance().integers = std::move(values);
  return instance().integers.data();
}

const double* hand_out(std::vector<double> values) {
  instance().numbers = std::move(values);
  return instance().numbers.data();
}

const double* hand_out(const Points& points) {
  return hand_out(std::vector<double>(points.data(), points.data() + points.size()));
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char sign : text) {
    if (sign == '"' || sign == '\\') out += '\\';
    if (static_cast<unsigned char>(sign) < ' ')
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(sign));
    else
      out += sign;
  }
  return out + '"';
}

std::string list_of(const Vec3& v) { return fmt::format("[{},{},{}]", v[0], v[1], v[2]); }

/// The list of a term; empty if the model lacks the term.
template <class T>
auto list_in_term() -> const decltype(T::list)& {
  static const decltype(T::list) none;
  const auto* found = run().scene().model.find<T>();
  return found ? found->list : none;
}
const auto& springs() { return list_in_term<Springs>(); }
const auto& constraints() { return list_in_term<Constraints>(); }

template <class Pair>
std::vector<int> ends_of(const std::vector<Pair>& pairs) {
  std::vector<int> ends;
  for (const Pair& pair : pairs) ends.push_back(pair.a), ends.push_back(pair.b);
  return ends;
}

template <class Number, class List, class Member>
std::vector<Number> of_each(const List& list, const Member& member) {
  std::vector<Number> numbers;
  for (const auto& item : list) numbers.push_back(static_cast<Number>(std::invoke(member, item)));
  return numbers;
}

}  // namespace

/// Buffer of this size (bytes) for the text of the next call.
EXPORT(text_buffer) char* text_buffer(int bytes) {
  instance().text.assign(static_cast<size_t>(bytes), ' ');
  return instance().text.data();
}

EXPORT(steppers) const char* steppers_json() {
  std::string out;
  for (const Stepper& s : steppers())
    out += fmt::format(R"({}{{"name":{},"evaluations":{},"firstOrder":{},"adaptive":{},"hard":{}}})",
                       out.empty() ? "" : ",", quoted(s.name), s.evaluations, s.first_order, s.adaptive,
                       s.hard_constraints);
  return hand_out("[" + out + "]");
}

EXPORT(open) void open() { instance().run.emplace(parse_scene(std::string(instance().text), "lab.toml", "lab")); }

EXPORT(scene) const char* scene_json() {
  const Scene& s = run().scene();
  std::string spheres, planes, camera = "null";
  for (const Sphere& sphere : list_in_term<Spheres>())
    spheres += fmt::format(R"({}{{"radius":{}}})", spheres.empty() ? "" : ",", sphere.radius);
  for (const Plane& plane : list_in_term<Planes>())
    planes += fmt::format(R"({}{{"point":{},"normal":{}}})", planes.empty() ? "" : ",", list_of(plane.point),
                          list_of(plane.normal));
  if (s.camera) camera = fmt::format(R"({{"eye":{},"target":{}}})", list_of(s.camera->eye), list_of(s.camera->target));
  return hand_out(fmt::format(
      R"({{"duration":{},"samples":{},"step":{},"method":{},"particles":{},"springCount":{},"constraintCount":{},"triangleCount":{},"pinCount":{},"firstOrder":{},"spheres":[{}],"planes":[{}],"camera":{}}})",
      s.duration, s.samples, s.step, quoted(s.method), s.model.particles.size(), springs().size(), constraints().size(),
      s.triangles.size(), s.model.particles.pins.size(), s.model.first_order(), spheres, planes, camera));
}

EXPORT(pins) const int* pins() { return hand_out(run().scene().model.particles.pins); }

/// Both ends of each spring or constraint.
EXPORT(spring_ends) const int* spring_ends() { return hand_out(ends_of(springs())); }
EXPORT(constraint_ends) const int* constraint_ends() { return hand_out(ends_of(constraints())); }

EXPORT(spring_families) const int* spring_families() { return hand_out(of_each<int>(springs(), &Spring::family)); }

/// Rest lengths, m.
EXPORT(spring_rests) const double* spring_rests() { return hand_out(of_each<double>(springs(), &Spring::rest)); }
/// Lengths of distance constraints, m.
EXPORT(constraint_lengths) const double* constraint_lengths() {
  return hand_out(of_each<double>(constraints(), [](const auto& c) { return c.length; }));
}

EXPORT(triangles) const int* triangles() {
  std::vector<int> corners;
  for (const auto& triangle : run().scene().triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return hand_out(std::move(corners));
}

/// Fastest vibration, rad/s.
EXPORT(omega) double omega() { return run().omega(); }

/// Critical step (s) of the stepper in this row of the table; nan if unknown.
EXPORT(critical_step) double critical_step(int row) {
  return run().critical_step(steppers()[static_cast<size_t>(row)]).value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Starts a run. The text buffer contains its rule.
EXPORT(start) void start(double step, double tolerance, double duration, int keep_ledger) {
  run().start({std::string(instance().text), step, tolerance, duration, keep_ledger != 0});
}

EXPORT(advance) int advance(double t, int most) { return run().advance(t, most); }
EXPORT(time) double time() { return run().time(); }

EXPORT(outcome) const char* outcome_json() {
  const Outcome out = run().outcome();
  return hand_out(fmt::format(R"({{"verdict":{},"reason":{},"step":{},"steps":{}}})", quoted(name_of(out.verdict)),
                              quoted(out.reason), std::isfinite(out.step) ? out.step : 0, out.steps));
}

/// Positions, m.
EXPORT(positions) const double* positions() { return run().state().x.data(); }
/// Velocities, m/s.
EXPORT(velocities) const double* velocities() { return run().state().v.data(); }

/// Centres of the spheres at a time (s), m.
EXPORT(centres) const double* centres(double t) {
  std::vector<double> places;
  for (const Sphere& sphere : list_in_term<Spheres>())
    for (const double part : sphere.centre_at(t)) places.push_back(part);
  return hand_out(std::move(places));
}

/// Kinetic, elastic, gravitational; losses to drag, dashpots, contact; work of wind, pins; balance (J). Null for
/// first-order scenes.
EXPORT(energies) const double* energies() {
  const auto row = run().energies();
  if (!row) return nullptr;
  const Energy& e = row->energy;
  return hand_out(std::vector<double>{e.kinetic, e.elastic, e.gravitational, row->drag, row->dashpots, row->contact,
                                      row->wind, row->pins, row->balance()});
}

EXPORT(hold) void hold(int particle, double x, double y, double z) { run().hold(particle, {x, y, z}); }
EXPORT(release) void release() { run().release(); }
EXPORT(set_pinned) void set_pinned(int particle, int pinned) { run().set_pinned(particle, pinned != 0); }
EXPORT(fingerprint) const char* fingerprint() { return hand_out(run().fingerprint()); }

}  // namespace crosscheck
