#include "mysim/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "mysim/base/errors.h"
#include "mysim/base/hash.h"
#include "mysim/base/text.h"
#include "mysim/scene/grid.h"
#include "mysim/scene/keys.h"

namespace crosscheck {
namespace {

class Hash {
 public:
  void add(std::uint64_t word) {
    for (int i = 0; i < 8; ++i) bytes_.add(static_cast<unsigned char>(word >> (8 * i)));
  }
  void add(int value) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(value))); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::string_view text) {
    for (char c : text) add(static_cast<int>(c));
    add(-1);
  }
  template <class Derived>
  void add(const Eigen::DenseBase<Derived>& values) {
    add(static_cast<int>(values.size()));
    for (int j = 0; j < values.cols(); ++j)
      for (int i = 0; i < values.rows(); ++i) add(static_cast<double>(values(i, j)));
  }

  void term(const Rotation& t) { add(t.rate); }
  void term(const Gravity& t) { add(t.acceleration); }
  void term(const Springs& t) {
    for (const Spring& s : t.list) add(s.a), add(s.b), add(s.k), add(s.rest);
    if (t.law != SpringLaw::hooke) add(name_of(t.law));
  }
  void term(const Bending& t) {
    for (const Bending::Stencil& s : t.list) {
      add(s.size), add(s.k);
      for (int i = 0; i < s.size; ++i) add(s.particle[i]), add(s.weight[i]);
    }
  }
  void term(const Dashpots& t) {
    for (const auto& [a, b, c] : t.list) add(a), add(b), add(c);
  }
  void term(const Constraints& t) {
    for (const auto& [a, b, length] : t.list) add(a), add(b), add(length);
  }
  void term(const Drag& t) { add(t.c); }
  void term(const Wind& t) { wind_signal(t.acceleration); }
  void term(const Aerodynamics& t) {
    add(t.density), add(t.coefficient), wind_signal(t.velocity);
    for (const auto& triangle : t.triangles)
      for (int corner : triangle) add(corner);
  }
  void term(const Spheres& t) {
    for (const Sphere& s : t.list) {
      add(s.centre), add(s.radius), add(s.margin), add(s.friction), add(s.restitution);
      if (s.motion) motion(*s.motion);
    }
  }
  void term(const Planes& t) {
    for (const Plane& p : t.list) {
      add(p.point), add(p.normal), add(p.margin), add(p.friction), add(p.restitution);
      if (p.velocity) add(*p.velocity);
    }
  }
  void motion(const Motion& m) { add(m.amplitude), add(m.frequency), add(m.ramp); }

  std::uint64_t value() const { return bytes_.value(); }

 private:
  void wind_signal(const WindSignal& b) {
    add(b.mean);
    if (b.gusts) add(b.gusts->variation), add(b.gusts->side), add(b.gusts->seed);
  }

  Fnv1a bytes_;
};

}  // namespace

std::string hash_of(const Scene& scene) {
  Hash h;
  const Particles& p = scene.model.particles;
  h.add(p.mass);
  for (int pin : p.pins) h.add(pin);
  h.add(-1);
  if (p.move) h.motion(*p.move);
  for (const Term& term : scene.model.terms) {
    h.add(name_of(term));
    std::visit([&](const auto& t) { h.term(t); }, term);
  }
  h.add(scene.start.x);
  h.add(scene.start.v);
  return fmt::format("{:016x}", h.value());
}

namespace {

constexpr auto without_mass = "which makes the scene first-order: without mass and without forces";

Drag read_drag(const TomlTable& s, const Particles& particles) {
  if (s.has("coefficient") && s.has("gamma")) s.fail("gamma", "either coefficient (N s/m) or gamma (1/s), not both");
  if (s.has("gamma")) return {s.positive("gamma") * particles.mass};
  return {Eigen::VectorXd::Constant(particles.size(), s.positive("coefficient"))};
}

/// Reads the mean wind from `key`, and [gusts] from the same table.
WindSignal read_wind_signal(const TomlTable& s, std::string_view key) {
  WindSignal wind_signal{s.vec3(key), std::nullopt};
  if (s.has("gusts")) {
    const TomlTable g = s.section("gusts");
    const int seed = g.count("seed");
    wind_signal.gusts = {g.not_negative("variation"), g.vec3("side"), seed, Gust(seed, 1), Gust(seed, 2)};
  }
  return wind_signal;
}

Aerodynamics read_aerodynamics(const TomlTable& s, const std::vector<std::array<int, 3>>& triangles) {
  if (triangles.empty()) s.fail("velocity", "a scene with a [grid]: air presses on its triangles");
  return {s.positive("density"), s.positive("coefficient"), read_wind_signal(s, "velocity"), triangles};
}

Motion read_motion(const TomlTable& s) { return {s.vec3("amplitude"), s.positive("frequency"), s.positive("ramp")}; }

template <class Solid>
void read_contact(const TomlTable& s, Solid& solid) {
  if (s.has("margin")) solid.margin = s.not_negative("margin");
  if (s.has("friction")) solid.friction = s.not_negative("friction");
  if (s.has("restitution")) {
    solid.restitution = s.not_negative("restitution");
    if (solid.restitution > 1) s.fail("restitution", "a number from 0 to 1");
  }
}

Sphere read_sphere(const TomlTable& s) {
  Sphere sphere{s.vec3("centre"), s.positive("radius"), 0, 0, 0, std::nullopt};
  read_contact(s, sphere);
  if (s.has("motion")) sphere.motion = read_motion(s.section("motion"));
  return sphere;
}

Plane read_plane(const TomlTable& s) {
  Plane plane{s.vec3("point"), s.vec3("normal").stableNormalized(), 0, 0, 0, std::nullopt};
  if (plane.normal.isZero(0)) s.fail("normal", "a direction out of the solid, got the zero vector");
  read_contact(s, plane);
  if (s.has("velocity")) plane.velocity = s.vec3("velocity");
  return plane;
}

// The terms with a section of their own; springs, bending, dashpots and constraints come from [grid], [[spring]] and
// [[constraint]].
struct TermReader {
  std::string_view key;
  Term (*read)(const TomlTable&, const Scene&);
};
constexpr TermReader term_readers[] = {
    {Rotation::name, [](const TomlTable& s, const Scene&) -> Term { return Rotation{s.number("rate")}; }},
    {Gravity::name, [](const TomlTable& s, const Scene&) -> Term { return Gravity{s.vec3("acceleration")}; }},
    {Drag::name, [](const TomlTable& s, const Scene& scene) -> Term { return read_drag(s, scene.model.particles); }},
    {Wind::name, [](const TomlTable& s, const Scene&) -> Term { return Wind{read_wind_signal(s, "acceleration")}; }},
    {Aerodynamics::name,
     [](const TomlTable& s, const Scene& scene) -> Term { return read_aerodynamics(s, scene.triangles); }},
};

void read_particles(const TomlTable& file, const std::optional<Grid>& grid, bool first_order, Scene& scene) {
  const std::vector<TomlTable> single = file.sections("particle");
  const int on_grid = grid ? grid->size() : 0;
  const int n = on_grid + static_cast<int>(single.size());
  if (n == 0) file.fail("particle", "at least one [[particle]] or a [grid]");
  if (grid && first_order) file.fail("grid", fmt::format("only single particles with [rotation], {}", without_mass));
  scene.start.x.resize(3, n);
  scene.start.v = Points::Zero(3, first_order ? 0 : n);
  scene.model.particles.mass = Eigen::VectorXd::Ones(n);
  scene.model.particles.pinned.assign(n, 0);
  if (grid) {
    scene.start.x.leftCols(on_grid) = grid_points(*grid);
    scene.model.particles.mass.head(on_grid).setConstant(grid->mass / on_grid);
    scene.triangles = grid_triangles(*grid);
  }
  for (int i = on_grid; i < n; ++i) {
    const TomlTable& p = single[i - on_grid];
    scene.start.x.col(i) = p.vec3("position");
    if (first_order) continue;  // masses and velocities are rejected later
    scene.model.particles.mass[i] = p.positive("mass");
    if (p.has("velocity")) scene.start.v.col(i) = p.vec3("velocity");
  }
}

/// The ends of a [[spring]] or [[constraint]].
struct Ends {
  int a, b;
  double distance;  // m, at the start
};
Ends read_ends(const TomlTable& s, const Scene& scene) {
  const std::vector<int> ends = s.integers("ends");
  const int n = scene.model.particles.size();
  if (ends.size() != 2) s.fail("ends", fmt::format("two different particles, got {} numbers", ends.size()));
  if (ends[0] == ends[1]) s.fail("ends", fmt::format("two different particles, got {} twice", ends[0]));
  for (int i = 0; i < 2; ++i)
    if (ends[i] >= n)
      s.fail(fmt::format("ends[{}]", i),
             fmt::format("a particle from 0 to {} (there are {}), got {}", n - 1, n, ends[i]));
  return {ends[0], ends[1], (scene.start.x.col(ends[0]) - scene.start.x.col(ends[1])).norm()};
}

Family read_family(const TomlTable& s) {
  if (!s.has("family")) return Family::single;
  const std::string word = s.text("family");
  std::vector<std::string> words;
  for (const Family family : {Family::structural, Family::shear, Family::bend}) {
    if (word == name_of(family)) return family;
    words.emplace_back(name_of(family));
  }
  s.fail("family", fmt::format("\"{}\", \"{}\" or \"{}\", got \"{}\"{}", words[0], words[1], words[2], word,
                               did_you_mean(word, words)));
}

/// Reads springs, bending, dashpots and hard distances, first those of the grid, then single ones.
void read_pairs(const TomlTable& file, const std::optional<Grid>& grid, Scene& scene) {
  Springs springs;
  Dashpots dashpots;
  Constraints constraints;
  if (grid) {
    springs.list = grid_springs(*grid);
    const auto hard = [](const Spring& s) { return std::isinf(s.k); };
    for (const Spring& s : springs.list) {
      if (hard(s))
        constraints.list.push_back({s.a, s.b, s.rest});
      else if (grid->dashpot > 0)
        dashpots.list.push_back({s.a, s.b, grid->dashpot});
    }
    std::erase_if(springs.list, hard);
  }
  for (const TomlTable& s : file.sections("spring")) {
    const auto [a, b, distance] = read_ends(s, scene);
    const double rest = s.has("rest") ? s.not_negative("rest") : distance;
    if (distance == 0 && rest > 0)
      s.fail("ends",
             fmt::format("ends that do not coincide at the start, because the rest length is above zero, got particles "
                         "{} and {} at the same place",
                         a, b));
    springs.list.push_back({a, b, s.positive("stiffness"), rest, read_family(s)});
    if (s.has("dashpot")) dashpots.list.push_back({a, b, s.positive("dashpot")});
  }
  for (const TomlTable& s : file.sections("constraint")) {
    const auto [a, b, distance] = read_ends(s, scene);
    const double length = s.has("length") ? s.positive("length") : distance;
    // 1e-9 allows for the rounding of decimal numbers
    if (!(std::abs(distance - length) <= 1e-9 * length) || distance == 0)
      s.fail("ends", fmt::format("ends that are {:.6g} m apart at the start (their fixed distance), got {:.6g} m",
                                 length, distance));
    constraints.list.push_back({a, b, length});
  }
  if (file.has("springs")) {
    const TomlTable s = file.section("springs");
    const std::string law = s.text("law");
    if (law == name_of(SpringLaw::bullet_link))
      springs.law = SpringLaw::bullet_link;
    else if (law != name_of(SpringLaw::hooke)) {
      const std::vector<std::string> laws{std::string(name_of(SpringLaw::hooke)),
                                          std::string(name_of(SpringLaw::bullet_link))};
      s.fail("law", fmt::format("\"{}\" or \"{}\", got \"{}\"{}", laws[0], laws[1], law, did_you_mean(law, laws)));
    }
    if (springs.list.empty()) s.fail("law", "at least one spring that follows it, got none");
  }
  if (!springs.list.empty()) scene.model.terms.emplace_back(std::move(springs));
  if (grid && grid->bending > 0) scene.model.terms.emplace_back(grid_bending(*grid));
  if (!dashpots.list.empty()) scene.model.terms.emplace_back(std::move(dashpots));
  if (!constraints.list.empty()) scene.model.terms.emplace_back(std::move(constraints));
}

/// Reads an initial state that differs from the one that defines the springs' default lengths.
void read_start(const TomlTable& file, bool first_order, Scene& scene) {
  if (!file.has("start")) return;
  const TomlTable s = file.section("start");
  const int n = scene.model.particles.size();
  scene.start.x = s.points("positions", n);
  if (first_order && s.has("velocities")) s.fail("velocities", fmt::format("none with [rotation], {}", without_mass));
  if (s.has("velocities")) scene.start.v = s.points("velocities", n);
}

void read_spheres(const TomlTable& file, Scene& scene) {
  if (!file.has(Spheres::name)) return;
  Spheres spheres;
  const Particles& particles = scene.model.particles;
  for (const TomlTable& s : file.one_or_more(Spheres::name)) {
    const Sphere sphere = read_sphere(s);
    for (int i = 0; i < particles.size(); ++i) {
      const double distance = (scene.start.x.col(i) - sphere.centre).norm();
      // 1e-9 allows a particle to be inside by the rounding of a decimal number
      if (!particles.pinned[i] && distance < (1 - 1e-9) * sphere.contact_radius())
        s.fail("radius",
               fmt::format("no particle inside radius + margin at the start, got particle {} at {:.6g} m from the "
                           "centre, below {:.6g} m",
                           i, distance, sphere.contact_radius()));
    }
    spheres.list.push_back(sphere);
  }
  if (spheres.list.empty()) file.fail(Spheres::name, "a table [sphere] or tables [[sphere]]");
  scene.model.terms.emplace_back(std::move(spheres));
}

/// Distance between two opposite planes minus their margins (m). Returns nothing if the sine of their angle exceeds the
/// rounding of a decimal number.
std::optional<double> width_between(const Plane& a, const Plane& b) {
  if (!(a.normal.dot(b.normal) < 0 && a.normal.cross(b.normal).norm() < 1e-9)) return std::nullopt;
  return (b.point - a.point).dot(a.normal) - a.margin - b.margin;
}

void read_planes(const TomlTable& file, Scene& scene) {
  if (!file.has(Planes::name)) return;
  Planes planes;
  const Particles& particles = scene.model.particles;
  // a particle may be behind a plane by the rounding of a decimal number
  const double rounding = 1e-9 * (scene.size() + largest_column(scene.start.x));
  for (const TomlTable& s : file.one_or_more(Planes::name)) {
    const Plane plane = read_plane(s);
    for (int i = 0; i < particles.size(); ++i) {
      const double height = (scene.start.x.col(i) - plane.point).dot(plane.normal);
      if (height < plane.margin - rounding)
        s.fail("point", fmt::format("no {} below the margin of {:.6g} m at the start, got particle {} at {:.6g} m",
                                    particles.pinned[i] ? "pin" : "particle", plane.margin, i, height));
    }
    for (const Plane& other : planes.list) {
      const double margins = plane.margin + other.margin;
      if (const auto width = width_between(plane, other); width && !(*width > 0))
        s.fail("point", fmt::format("more than both margins, {:.6g} m, to the opposite plane, got {:.6g} m", margins,
                                    *width + margins));
    }
    planes.list.push_back(plane);
  }
  if (planes.list.empty()) file.fail(Planes::name, "a table [plane] or tables [[plane]]");
  scene.model.terms.emplace_back(std::move(planes));
}

void read_pins(const TomlTable& file, Scene& scene) {
  if (!file.has("pins")) return;
  const TomlTable s = file.section("pins");
  Particles& particles = scene.model.particles;
  particles.pins = s.integers("particles");
  if (particles.pins.empty()) s.fail("particles", "at least one particle");
  for (size_t i = 0; i < particles.pins.size(); ++i) {
    const std::string entry = fmt::format("particles[{}]", i);
    const int pin = particles.pins[i], n = particles.size();
    if (pin >= n) s.fail(entry, fmt::format("a particle from 0 to {} (there are {}), got {}", n - 1, n, pin));
    if (particles.pinned[pin]) s.fail(entry, fmt::format("each particle once, got {} twice", pin));
    particles.pinned[pin] = 1;
    if (!scene.start.v.col(pin).isZero(0))
      s.fail(entry, fmt::format("pins that start at rest; particle {} has a velocity", pin));
  }
  std::sort(particles.pins.begin(), particles.pins.end());
  particles.pin_home.resize(3, static_cast<int>(particles.pins.size()));
  for (size_t i = 0; i < particles.pins.size(); ++i)
    particles.pin_home.col(static_cast<int>(i)) = scene.start.x.col(particles.pins[i]);
  // erases constraints between pins, which keep their distances anyway
  if (auto* constraints = scene.model.find<Constraints>())
    std::erase_if(constraints->list, [&](const auto& c) { return particles.pinned[c.a] && particles.pinned[c.b]; });
  if (static_cast<int>(particles.pins.size()) == particles.size())
    s.fail("particles", fmt::format("at least one particle left free, got all {}", particles.size()));
  if (s.has("motion")) {
    if (scene.model.find<Constraints>())
      s.fail("motion", "fixed pins: the work of moved pins on hard distances is not modelled");
    particles.move = read_motion(s.section("motion"));
  }
}

void read_time(const TomlTable& file, Scene& scene) {
  const TomlTable s = file.section("time");
  scene.duration = s.positive("duration");
  scene.samples = s.count("samples", most_samples);
  scene.step = s.positive("step");
  if (scene.step > scene.duration)
    s.fail("step", fmt::format("a step not longer than the duration of {} s, got {} s", scene.duration, scene.step));
  if (const double between = scene.duration / scene.samples / scene.step; between > 1e9)
    s.fail("step", fmt::format("at most 1e9 steps between two samples, got {:.3g}", between));
  scene.window = s.positive("window");
  if (scene.window > scene.duration)
    s.fail("window",
           fmt::format("a window not longer than the duration of {} s, got {} s", scene.duration, scene.window));
  scene.tolerance = s.positive("tolerance");
  scene.method = s.text("method");
  // only the command line may name a program (load_scene())
  if (scene.method.find(':') != std::string::npos) scene.method.clear();
}

/// Checks the targets of `crosscheck advise`; engines do not read them.
void check_wish(const TomlTable& file) {
  if (!file.has("wish")) return;
  const TomlTable s = file.section("wish");
  int count = 0;
  for (const char* key : {"sag", "period", "settle_time", "max_stretch", "c11", "anisotropy"})
    if (s.has(key)) s.positive(key), ++count;
  if (count == 0) file.fail("wish", "at least one of sag, period, settle_time, max_stretch, c11 and anisotropy");
}

Scene expand(const TomlTable& file, const std::string& name) {
  Scene scene{};
  scene.name = name;
  scene.question = file.text("question");
  scene.parameters = file.text("parameters");
  scene.source = file.source();
  read_time(file, scene);
  check_wish(file);

  const bool first_order = file.has(Rotation::name);
  std::optional<Grid> grid;
  if (file.has("grid")) grid = read_grid(file.section("grid"));
  read_particles(file, grid, first_order, scene);
  if (!first_order) read_pairs(file, grid, scene);
  read_start(file, first_order, scene);
  if (!first_order) read_pins(file, scene);
  for (const TermReader& reader : term_readers)
    if ((!first_order || reader.key == Rotation::name) && file.has(reader.key))
      scene.model.terms.push_back(reader.read(file.section(reader.key), scene));
  if (!first_order) read_spheres(file, scene), read_planes(file, scene);
  if (scene.model.find<Wind>() && scene.model.find<Aerodynamics>())
    file.fail(Wind::name, "one kind of wind, [wind] or [aerodynamics]");

  if (file.has("camera")) {
    const TomlTable s = file.section("camera");
    scene.camera = Camera{s.vec3("eye"), s.vec3("target"), std::nullopt};
    if (s.has("at")) scene.camera->at = s.not_negative("at");
    if (scene.camera->at > scene.duration)
      s.fail("at", fmt::format("a time not after the end of the run, {} s", scene.duration));
    if (scene.camera->eye == scene.camera->target) s.fail("target", "a point other than the eye");
  }
  if (first_order) {
    for (const std::string_view key :
         {"spring", "constraint", "springs", "pins", "gravity", "drag", "wind", "aerodynamics", "sphere", "plane"})
      if (file.has(key)) file.fail(key, fmt::format("no {} with [rotation], {}", key, without_mass));
    for (const TomlTable& p : file.sections("particle"))
      for (const std::string_view key : {"mass", "velocity"})
        if (p.has(key)) p.fail(key, fmt::format("no {} with [rotation], {}", key, without_mass));
  }
  file.finish();
  if (!first_order) scene.model.particles.place_pins(scene.start);
  scene.hash = hash_of(scene);
  return scene;
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& file, const std::string& name) {
  check_keys(text, file, scene_keys());
  return expand(TomlTable::parse_text(text, file), name);
}

Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

double Scene::size() const {
  const double diagonal = (start.x.rowwise().maxCoeff() - start.x.rowwise().minCoeff()).norm();
  if (diagonal > 0) return diagonal;
  double length = model.first_order() ? largest_column(start.x) : 0;
  if (!model.first_order()) {
    Vec3 a = Vec3::Zero();
    if (const auto* gravity = model.find<Gravity>()) a += gravity->acceleration;
    if (const auto* wind = model.find<Wind>()) a += wind->acceleration.mean;
    length = duration * (largest_column(start.v) + a.norm() * duration / 2);
  }
  if (const auto* spheres = model.find<Spheres>())
    for (const Sphere& sphere : spheres->list)
      length = length > 0 ? std::min(length, sphere.contact_radius()) : sphere.contact_radius();
  if (const auto* planes = model.find<Planes>())  // opposite planes limit the motion
    for (const Plane& a : planes->list)
      for (const Plane& b : planes->list)
        if (const auto width = width_between(a, b)) length = std::min(length, *width);
  return length > 0 ? length : 1;
}

}  // namespace crosscheck
