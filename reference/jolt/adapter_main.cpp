// Jolt, compiled for this machine, as a program of the engine protocol: the same soft body, options and laws as in
// jolt_engine.js (README.md).
//
//   PROGRAM scene.json OUTDIR [n=N] [frame=scene | frame=world]

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "mysim/base/errors.h"
#include "mysim/model/system.h"
#include "mysim/run/engine.h"
#include "reference/jolt/soft_body.h"
#include "reference/protocol/adapter.h"

using namespace crosscheck;

namespace {

struct Options {
  int iterations = 1;
  bool frame_of_world = false;
};

Options options_of(const std::vector<std::string>& asked) {
  Options options;
  for (const std::string& option : asked) {
    if (option == "frame=world" || option == "frame=scene") {
      options.frame_of_world = option == "frame=world";
      continue;
    }
    if (!option.starts_with("n=")) throw Unsupported("unknown option " + option + ": expected n= or frame=");
    const char *begin = option.data() + 2, *end = option.data() + option.size();
    const auto [read, error] = std::from_chars(begin, end, options.iterations);
    if (error != std::errc() || read != end || options.iterations < 1 || options.iterations > 1'000'000)
      throw Unsupported("n= is a whole number from 1 to 1000000");
  }
  return options;
}

jolt::Triple triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec3(const jolt::Triple& v) { return {v[0], v[1], v[2]}; }

/// Throws Unsupported for what Jolt does not have.
void require_supported(const Scene& scene, const Run& run, int iterations) {
  const Model& model = scene.model;
  if (model.first_order()) throw Unsupported("Jolt has no first-order systems");
  const Overloaded lacks{
      [](const Bending&) {
        throw Unsupported("not in Jolt: bending: Jolt bends by angles between triangles, not by a rigidity in N m");
      },
      [](const Dashpots&) {
        throw Unsupported("not in Jolt: dashpots: Jolt damps velocities only, not along springs");
      },
      [](const Aerodynamics&) {
        throw Unsupported("not in Jolt: aerodynamics: Jolt has no forces of the air on triangles");
      },
      [](const Rotation&) { throw Unsupported("not in Jolt: first-order fields"); },
      [](const Springs& springs) {
        if (springs.law != SpringLaw::hooke)
          throw Unsupported(fmt::format("springs of the law {}: Jolt has Hooke's", name_of(springs.law)));
      },
      [](const Spheres& spheres) {
        if (spheres.moving())
          throw Unsupported("moving spheres: in contact Jolt takes the velocity of a sphere that is led for zero");
      },
      [](const Planes&) { throw Unsupported("planes: this adapter hands Jolt spheres only"); },
      [](const OneOf<Gravity, Constraints, Drag, Wind> auto&) {},
  };
  for (const Term& term : model.terms) std::visit(lacks, term);
  const std::optional<double> rate = uniform_drag_rate(model);
  if (!rate) throw Unsupported("drag that differs between particles: Jolt has one damping (1/s) for a body");
  if (*rate * time_grid(run).h >= iterations) throw Unsupported("drag that takes all speed in one sub-step");
}

/// Springs, then hard distances.
std::vector<jolt::Edge> edges_of(const Model& model) {
  std::vector<jolt::Edge> edges;
  if (const auto* springs = model.find<Springs>())
    for (const Spring& s : springs->list) edges.push_back({s.a, s.b, s.rest, 1 / s.k});
  if (const auto* constraints = model.find<Constraints>())
    for (const auto& [a, b, length] : constraints->list) edges.push_back({a, b, length, 0});
  return edges;
}

std::vector<jolt::Vertex> vertices_of(const Scene& scene) {
  const Particles& particles = scene.model.particles;
  std::vector<jolt::Vertex> vertices;
  for (int i = 0; i < particles.size(); ++i)
    vertices.push_back(
        {triple(scene.start.x.col(i)), triple(scene.start.v.col(i)), particles.pinned[i] ? 0 : 1 / particles.mass[i]});
  return vertices;
}

std::vector<jolt::Ball> balls_of(const Model& model) {
  std::vector<jolt::Ball> balls;
  if (const auto* spheres = model.find<Spheres>())
    for (const Sphere& s : spheres->list)
      balls.push_back({triple(s.centre), s.contact_radius(), s.friction, s.restitution});
  return balls;
}

jolt::Settings settings_of(const Scene& scene, const Options& options) {
  jolt::Settings settings{{}, options.iterations, *uniform_drag_rate(scene.model)};
  const Points& x = scene.start.x;
  if (!options.frame_of_world)  // the middle of the box, where coordinates are smallest
    for (int k = 0; k < 3; ++k) settings.origin[k] = float((x.row(k).minCoeff() + x.row(k).maxCoeff()) / 2);
  return settings;
}

/// The forces of the springs at x, as Jolt computes them, N: each spring alone, from a free vertex in the origin, where
/// small moves are not rounded away, to a held one, in one step d. The vertex has w d^2 = 1e-6 compliance, so that it
/// moves by w d^2 k (L - r) to a millionth.
Points spring_forces(const Model& model, const Points& x) {
  Points forces = Points::Zero(3, x.cols());
  const auto* springs = model.find<Springs>();
  if (!springs) return forces;
  constexpr double d = 1. / 1024;       // s
  constexpr std::size_t at_once = 500;  // Jolt sorts a body's edges, which takes the square of their count
  const std::vector<Spring>& all = springs->list;
  for (std::size_t first = 0; first < all.size(); first += at_once) {
    const std::size_t count = std::min(at_once, all.size() - first);
    std::vector<jolt::Vertex> vertices;
    std::vector<jolt::Edge> edges;
    for (std::size_t i = 0; i < count; ++i) {
      const Spring& s = all[first + i];
      const int vertex = static_cast<int>(2 * i);
      vertices.push_back({{}, {}, 1e-6 / (s.k * d * d)});
      vertices.push_back({triple(x.col(s.b) - x.col(s.a)), {}, 0});
      edges.push_back({vertex, vertex + 1, s.rest, 1 / s.k});
    }
    jolt::SoftBody body(vertices, edges, {}, {});
    body.set_gravity({});
    body.step(d);
    for (std::size_t i = 0; i < count; ++i) {
      const int vertex = static_cast<int>(2 * i);
      const Vec3 force = vec3(body.moved(vertex)) / (body.inverse_mass(vertex) * d * d);
      forces.col(all[first + i].a) += force;
      forces.col(all[first + i].b) -= force;
    }
  }
  return forces;
}

class JoltWorld : public World {
 public:
  JoltWorld(const Scene& scene, double h, const Options& options)
      : scene_(scene),
        h_(h),
        options_(options),
        settings_(settings_of(scene, options)),
        body_(vertices_of(scene), edges_of(scene.model), balls_of(scene.model), settings_) {
    const auto* gravity = scene.model.find<Gravity>();
    gravity_ = gravity ? gravity->acceleration : Vec3::Zero();
    wind_ = scene.model.find<Wind>();
    body_.set_gravity(triple(gravity_));
    state_.x.resize(3, scene.model.particles.size());
    state_.v.resizeLike(state_.x);
    built_ = state(0);
  }

  void step(double t, double t_next) override {
    // to free particles gravity and wind are one, and Jolt is told so
    if (wind_) body_.set_gravity(triple(gravity_ + wind_->acceleration.at(t)));
    const Particles& particles = scene_.model.particles;
    if (!particles.move) {
      body_.step(h_);
      return;
    }
    // a held vertex moves by its velocity; its place is set too, since n sub-steps round n times
    const Vec3 from = displacement_at(*particles.move, t), to = displacement_at(*particles.move, t_next);
    for (const int pin : particles.pins) body_.set_velocity(pin, triple((to - from) / h_));
    body_.step(h_);
    for (size_t p = 0; p < particles.pins.size(); ++p)
      body_.place(particles.pins[p], triple(particles.pin_home.col(static_cast<int>(p)) + to));
  }

  const State& state(double t) override {
    state_.t = t;
    body_.read(state_.x.data(), state_.v.data());
    return state_;
  }

  std::optional<Readback> read_back() override {
    Readback r;
    const int n = static_cast<int>(state_.x.cols());
    for (int i = 0; i < n; ++i) {
      const double w = body_.inverse_mass(i);
      r.mass.push_back(w > 0 ? 1 / w : 0);
      r.pinned.push_back(w == 0);
    }
    for (const jolt::Edge& edge : body_.edges_like(edges_of(scene_.model)))
      r.links.push_back(
          {edge.a, edge.b, edge.rest, edge.compliance > 0 ? std::optional(1 / edge.compliance) : std::nullopt});
    body_.set_gravity(triple(gravity_));
    r.gravity = vec3(body_.gravity());
    const jolt::Settings settings = body_.settings();
    r.drag = std::vector<double>(n, settings.damping);
    r.spheres.emplace();
    Readback::Places later{0.382 * scene_.duration, {}, {}, {}};
    for (const jolt::Ball& ball : body_.balls()) {
      r.spheres->push_back({vec3(ball.centre), ball.radius, ball.friction, ball.restitution});
      later.centres.push_back(vec3(ball.centre));
    }
    later.pins = pins_at(later.t);
    r.later = later;
    r.probe = probe(*r.gravity, r.mass);
    r.start = built_;
    r.step = float(h_);
    r.precision = "single";
    r.may_sleep = body_.may_sleep();
    r.mapped = {{"stiffness", "compliance of an edge, 1 / k (m/N)"}, {"drag", "linear damping (1/s)"}};
    if (wind_) r.mapped["wind"] = "gravity, set anew before each step";
    if (!r.spheres->empty()) r.mapped["spheres"] = "static spheres of radius + margin, vertices without radius";
    r.settings = {{"Jolt", jolt::version()},
                  {"iterations", std::to_string(settings.iterations)},
                  {"frame", options_.frame_of_world ? "world" : "scene"},
                  {"largest speed", fmt::format("{:g} m/s", body_.largest_speed())}};
    return r;
  }

 private:
  /// Where Jolt holds the pins when it is told to, m: they are put there for a moment.
  Points pins_at(double t) {
    const Particles& particles = scene_.model.particles;
    const State now = state_;
    Points pins(3, particles.pins.size());
    const Vec3 shift = particles.move ? displacement_at(*particles.move, t) : Vec3::Zero();
    for (size_t p = 0; p < particles.pins.size(); ++p)
      if (particles.move) body_.place(particles.pins[p], triple(particles.pin_home.col(static_cast<int>(p)) + shift));
    const State& there = state(now.t);
    for (size_t p = 0; p < particles.pins.size(); ++p) pins.col(static_cast<int>(p)) = there.x.col(particles.pins[p]);
    for (const int pin : particles.pins)
      if (particles.move) body_.place(pin, triple(now.x.col(pin)));
    return pins;
  }

  ForceProbe probe(const Vec3& gravity, const std::vector<double>& mass) {
    const int n = static_cast<int>(mass.size());
    ForceProbe probe{.t = 0.3, .x = 1.1 * scene_.start.x, .v = Points::Zero(3, n)};
    probe.springs = spring_forces(scene_.model, probe.x);
    probe.dashpots = probe.wind = Points::Zero(3, n);
    if (!wind_) return probe;
    body_.set_gravity(triple(gravity_ + wind_->acceleration.at(probe.t)));
    const Vec3 extra = vec3(body_.gravity()) - gravity;
    for (int i = 0; i < n; ++i) probe.wind.col(i) = mass[i] * extra;
    return probe;
  }

  const Scene& scene_;
  double h_;  // s
  Options options_;
  jolt::Settings settings_;
  jolt::SoftBody body_;
  Vec3 gravity_;
  const Wind* wind_;
  State state_, built_;
};

Engine engine_of(const std::vector<std::string>& asked) {
  const Options options = options_of(asked);
  return [options](const Scene& scene, const Run& run, Observer& observer) {
    require_supported(scene, run, options.iterations);
    JoltWorld world(scene, time_grid(run).h, options);
    Outcome out = run_loop(world, run, observer);
    out.evaluations = 2 * options.iterations * out.steps;  // as mysim's xpbd counts its passes
    const auto* spheres = scene.model.find<Spheres>();
    // a step begins above the ball, on the plane that was tangent where the step before began: that takes half of
    // v^2 / R more off the depth, from which friction is computed
    if (spheres &&
        std::any_of(spheres->list.begin(), spheres->list.end(), [](const Sphere& s) { return s.friction > 0; }))
      out.different_law.push_back(
          "friction: on a ball of radius R it is mu m (g_n - 3/2 v^2 / R) with one iteration, not mu m (g_n - v^2 / "
          "R)");
    return out;
  };
}

}  // namespace

int main(int argc, char** argv) {
  const jolt::Library library;
  return run_as_program(argc, argv, engine_of);
}
