// The C++ header of the engine protocol as a library for adapters: readers, forces, options and the loop, compared with
// mysim.

#include "mysim/terms/bending.h"
#include "mysim/terms/dashpots.h"
#include "mysim/terms/springs.h"
#include "mysim/terms/surface.h"
#include "mysim/terms/wind.h"
#include "reference/protocol/crosscheck_engine.h"
#include "reference/protocol/scene_json.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
namespace header = crosscheck_engine;

using header::operator+, header::operator-, header::operator*;  // Vec is a std::array, so ADL fails
using Vecs = std::vector<header::Vec>;

Vecs columns(const Points& points) {
  Vecs list;
  for (int i = 0; i < points.cols(); ++i) list.push_back({points(0, i), points(1, i), points(2, i)});
  return list;
}
Points points(const Vecs& list) {
  Points all(3, list.size());
  for (size_t i = 0; i < list.size(); ++i) all.col(static_cast<int>(i)) = Vec3(list[i][0], list[i][1], list[i][2]);
  return all;
}

class EngineHeader : public InFolder {
 protected:
  header::Scene given(const Scene& scene, const std::vector<std::string>& options = {}) const {
    return header::read_scene(write("scene.json", scene_json(scene, default_run(scene), options)));
  }
};

/// A state in which all forces act, and in which one spring has coincident ends.
State moving(const Scene& scene) {
  State state = scene.start;
  state.t = 0.4;
  for (int i = 0; i < state.x.cols(); ++i) {
    state.x.col(i) += 0.02 * Vec3(std::sin(3. * i), std::cos(5. * i), std::sin(7. * i));
    state.v.col(i) = Vec3(std::cos(2. * i), std::sin(4. * i), 1);
  }
  const Spring& first = scene.model.find<Springs>()->list.front();
  state.x.col(first.a) = state.x.col(first.b);
  return state;
}

TEST_F(EngineHeader, ComputesTheForcesOfMysimsTerms) {
  Scene air = small_cloth_in_air();
  std::erase_if(air.model.terms, [](const Term& t) { return std::holds_alternative<Aerodynamics>(t); });
  Scene link = air;
  link.model.find<Springs>()->law = SpringLaw::bullet_link;
  for (const Scene& scene : {small_cloth(), air, link}) {
    const header::Scene read = given(scene);
    const State state = moving(scene);
    const Vecs x = columns(state.x), v = columns(state.v);
    const auto compare = [&](const auto* term, const char* name, const auto& add) {
      SCOPED_TRACE(name);
      Forces ours{Points::Zero(3, state.x.cols()), 0};
      if (term) add_force(*term, scene.model.particles, state, ours);
      Vecs theirs(x.size(), header::Vec{});
      add(theirs);
      // about a dozen terms per particle, with a few roundings each
      EXPECT_LE((points(theirs) - ours.f).norm(), 1e-14 * (1 + ours.f.norm()));
    };
    compare(scene.model.find<Springs>(), "springs", [&](Vecs& f) {
      EXPECT_EQ(header::add_springs(read, x, f), 1) << "expected one spring with coincident ends";
    });
    compare(scene.model.find<Dashpots>(), "dashpots", [&](Vecs& f) { header::add_dashpots(read, x, v, f); });
    compare(scene.model.find<Bending>(), "bending", [&](Vecs& f) { header::add_bending(read, x, f); });
    compare(scene.model.find<Wind>(), "wind", [&](Vecs& f) { header::add_wind(read, state.t, f); });
  }
}

TEST_F(EngineHeader, ReadsSpheresPlanesAndMotions) {
  const Scene carried = shipped_scene("cloth-carried");
  const header::Scene read = given(carried);
  const Sphere& ours = carried.model.find<Spheres>()->list.at(0);
  ASSERT_EQ(read.spheres.size(), carried.model.find<Spheres>()->list.size());
  const header::Sphere& sphere = read.spheres[0];
  EXPECT_EQ(sphere.contact_radius(), ours.contact_radius());
  EXPECT_EQ(sphere.friction, ours.friction);
  ASSERT_TRUE(sphere.motion);
  for (const double t : {0.1, 0.5, 2.}) {
    EXPECT_LE((points({sphere.centre_at(t)}) - ours.centre_at(t)).norm(), 1e-15);
    constexpr double d = 1e-5;  // s; central differences err by d^2 plus round-off / d
    const header::Vec slope = 1 / (2 * d) * (sphere.motion->velocity(t + d) - sphere.motion->velocity(t - d));
    EXPECT_LE(header::length(slope - sphere.motion->acceleration(t)), 1e-7) << t;
  }
  const Scene slope = shipped_scene("slope-slide");
  const header::Scene plane = given(slope);
  ASSERT_EQ(plane.planes.size(), 1u);
  const Surface surface(slope.model.find<Planes>()->list[0]);
  EXPECT_LE((points({plane.planes[0].contact_point_at(0.3)}) - surface.origin_at(0.3)).norm(), 1e-15);
}

TEST_F(EngineHeader, OptionsRefuseWhatIsNotExpected) {
  const auto get = [this](const std::vector<std::string>& options) {
    const header::Scene scene = given(small_cloth(), options);
    header::Options asked(scene);
    const int n = asked.get("n", 4);
    const std::string springs = asked.get("springs", {"tendon", "callback"});
    asked.refuse_others();
    return std::pair(n, springs);
  };
  EXPECT_EQ(get({}), std::pair(4, std::string("tendon")));
  EXPECT_EQ(get({"springs=callback", "n=7"}), std::pair(7, std::string("callback")));
  const auto exits = testing::ExitedWithCode(3);
  EXPECT_EXIT(get({"n=0"}), exits, "option n=0: expected a whole number from 1 to 1000000");
  EXPECT_EXIT(get({"n="}), exits, "option n=: expected");
  EXPECT_EXIT(get({"springs=rope"}), exits, "option springs=rope: expected springs=tendon.callback");
  EXPECT_EXIT(get({"fast"}), exits, "unknown option fast: expected n=4, springs=tendon.callback");
}

/// A world of falling particles that fails after a given time in one of two ways.
struct Faller : header::World {
  explicit Faller(const header::Scene& s) : scene(s), x(s.x), v(s.v) {}
  void step(double t) override {
    if (t > fails_at && throws) throw std::runtime_error("no root");
    if (t > fails_at) x.back()[0] = header::unknown;
    for (size_t i = 0; i < x.size(); ++i) v[i] = v[i] + scene.step * scene.gravity, x[i] = x[i] + scene.step * v[i];
    scene.place_pins(t + scene.step, x, v);
  }
  void read(Vecs& a, Vecs& b) override { a = x, b = v; }
  void report(header::RunReport& run) override {
    run.engine = "Faller 1";
    run.readback->mass = scene.mass;
  }
  const header::Scene& scene;
  Vecs x, v;
  double fails_at = 1e9;
  bool throws = false;
};

TEST_F(EngineHeader, RunWorldFillsInTheReportAndStopsAtFailures) {
  const Scene scene = small_cloth();
  const header::Scene read = given(scene);
  const auto run = [&](double fails_at, bool throws, std::vector<Vecs>& frames) {
    Faller world(read);
    world.fails_at = fails_at, world.throws = throws;
    std::vector<Vecs> speeds;
    header::RunReport report = header::run_world(read, world, frames, speeds);
    EXPECT_EQ(frames.size(), speeds.size());
    return report;
  };
  std::vector<Vecs> frames;
  const header::RunReport good = run(1e9, false, frames);
  EXPECT_EQ(frames.size(), static_cast<size_t>(read.samples) + 1);
  EXPECT_EQ(good.verdict, "");
  EXPECT_EQ(good.steps, static_cast<long>(read.samples) * read.steps_per_sample);
  EXPECT_GE(good.cpu_seconds, 0);
  EXPECT_EQ(good.step, read.step);
  EXPECT_EQ(good.readback->start_x, read.x);
  ASSERT_TRUE(good.readback->later);
  const auto& later = *good.readback->later;
  ASSERT_EQ(later.pins.size(), read.pins.size());
  for (size_t p = 0; p < later.pins.size(); ++p)
    EXPECT_LE(header::length(later.pins[p] - read.pin_at(p, later.t)), 1e-15);
  for (const bool throws : {false, true}) {
    frames.clear();
    const header::RunReport bad = run(0.5 * scene.duration, throws, frames);
    EXPECT_EQ(bad.verdict, throws ? "solver" : "nan");
    EXPECT_EQ(bad.reason, throws ? "no root" : "a state is not finite");
    EXPECT_LT(frames.size(), static_cast<size_t>(read.samples) + 1);
    EXPECT_NEAR(bad.end, 0.5 * scene.duration, 1.01 * read.step * read.steps_per_sample);
    EXPECT_FALSE(bad.readback->later);
  }
}

}  // namespace
}  // namespace crosscheck
