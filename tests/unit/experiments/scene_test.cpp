// Shipped and random scenes: the table of scenes, the fingerprint, and required information.

#include <map>

#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/scene/grid.h"
#include "reference/method.h"
#include "reference/truth/exact/exact.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/random_scenes.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

std::string grid_text(int nu, int nv, const std::string& stiffness = "structural = 30\nshear = 20\nbend = 10\n") {
  return fmt::format(
      "[grid]\nsize = [{}, {}]\norigin = [1, 2, 3]\nu = [2, 0, 0]\nv = [0, 0.3, 4]\nmass = 1.5\n"
      "[grid.stiffness]\n{}",
      nu, nv, stiffness);
}

TEST(Grid, HasTheCountedSpringsTrianglesAndMass) {
  for (const auto& [nu, nv] : {std::pair{2, 2}, {2, 5}, {3, 4}, {7, 3}, {20, 20}}) {
    SCOPED_TRACE(fmt::format("{} x {}", nu, nv));
    const Scene s = small_scene(grid_text(nu, nv));
    std::map<Family, int> count;
    for (const Spring& spring : s.model.find<Springs>()->list) ++count[spring.family];
    EXPECT_EQ(count[Family::structural], (nu - 1) * nv + nu * (nv - 1));
    EXPECT_EQ(count[Family::shear], 2 * (nu - 1) * (nv - 1));
    EXPECT_EQ(count[Family::bend], (nu - 2) * nv + nu * (nv - 2));
    EXPECT_EQ(static_cast<int>(s.triangles.size()), 2 * (nu - 1) * (nv - 1));
    EXPECT_NEAR(s.model.particles.mass.sum(), 1.5, nu * nv * eps * 1.5);  // one rounding error per addition
    EXPECT_EQ(s.start.x.col(0), Vec3(1, 2, 3));
    EXPECT_EQ(s.start.x.col(nu - 1), Vec3(3, 2, 3));
    EXPECT_TRUE(s.start.x.col(nu * nv - 1).isApprox(Vec3(3, 2.3, 7), 4 * eps));
  }
}

TEST(Grid, SpringsJoinTheRightNeighboursAtTheirDistance) {
  const int nu = 5, nv = 4;
  const Scene s = small_scene(grid_text(nu, nv));
  std::map<std::pair<int, int>, int> seen;
  for (const Spring& spring : s.model.find<Springs>()->list) {
    const int di = std::abs(spring.a % nu - spring.b % nu), dj = std::abs(spring.a / nu - spring.b / nu);
    const bool right = (spring.family == Family::structural && di + dj == 1) ||
                       (spring.family == Family::shear && di == 1 && dj == 1) ||
                       (spring.family == Family::bend && std::max(di, dj) == 2 && std::min(di, dj) == 0);
    EXPECT_TRUE(right) << spring.a << " " << spring.b;
    EXPECT_EQ(spring.k, spring.family == Family::structural ? 30 : spring.family == Family::shear ? 20 : 10);
    const double expected = std::hypot(di * 2.0 / (nu - 1), dj * std::hypot(0.3, 4) / (nv - 1));
    EXPECT_NEAR(spring.rest, expected, 32 * eps);  // rounding of differences between coordinates of up to 7 m
    EXPECT_EQ(++seen[std::minmax(spring.a, spring.b)], 1) << "duplicate pair";
  }
}

TEST(Grid, FamiliesThatAreNotWrittenAreNotThere) {
  const Scene s = small_scene(grid_text(4, 4, "structural = 30\n"));
  for (const Spring& spring : s.model.find<Springs>()->list) EXPECT_EQ(spring.family, Family::structural);
}

TEST(Grid, TrianglesCoverTheClothOnceAndFaceOneWay) {
  const Scene s = small_scene(grid_text(6, 5));
  Vec3 area = Vec3::Zero();
  double absolute = 0;
  for (const auto& [a, b, c] : s.triangles) {
    const Vec3 part = 0.5 * (s.start.x.col(b) - s.start.x.col(a)).cross(s.start.x.col(c) - s.start.x.col(a));
    area += part;
    absolute += part.norm();
  }
  const double whole = Vec3(2, 0, 0).cross(Vec3(0, 0.3, 4)).norm();
  EXPECT_NEAR(area.norm(), whole, 1e3 * eps);  // rounding of 40 triangles with coordinates of up to 7 m
  EXPECT_NEAR(absolute, whole, 1e3 * eps);
}

TEST(SceneHash, ChangesWithEverythingThatEnginesSeeAndNotWithWords) {
  const std::string text = scene_text(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 2\nvelocity = [0, 1, "
      "0]\n"
      "[[spring]]\nends = [0, 1]\nstiffness = 10\nrest = 0.9\n[pins]\nparticles = [0]\n[pins.motion]\n"
      "amplitude = [0.1, 0, 0]\nfrequency = 1.5\nramp = 0.25\n[gravity]\nacceleration = [0, -9, 0]\n[drag]\ngamma = "
      "0.7\n"
      "[wind]\nacceleration = [3, 0, 0]\n[wind.gusts]\nvariation = 0.6\nside = [0, 0, 4]\nseed = 5\n[sphere]\n"
      "centre = [0, -8, 0]\nradius = 1.25\nmargin = 0.02\nfriction = 0.4\nrestitution = 0.3\n"
      "[camera]\neye = [0, 0, 77]\ntarget = [0, 0, 0]\n");
  const std::string hash = parse_scene(text, "a").hash;
  EXPECT_EQ(hash.size(), 16u);
  auto changed = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    EXPECT_NE(other.find(from), std::string::npos) << from;
    other.replace(other.find(from), from.size(), to);
    return parse_scene(other, "b").hash != hash;
  };
  const std::pair<const char*, const char*> seen[] = {{"[1, 0, 0]\nmass", "[1.0000000000000002, 0, 0]\nmass"},
                                                      {"mass = 2", "mass = 3"},
                                                      {"velocity = [0, 1", "velocity = [0, 2"},
                                                      {"ends = [0, 1]", "ends = [1, 0]"},
                                                      {"stiffness = 10", "stiffness = 11"},
                                                      {"rest = 0.9", "rest = 0.8"},
                                                      {"amplitude = [0.1", "amplitude = [0.2"},
                                                      {"frequency = 1.5", "frequency = 2"},
                                                      {"ramp = 0.25", "ramp = 0.5"},
                                                      {"[0, -9, 0]", "[0, -8, 0]"},
                                                      {"gamma = 0.7", "gamma = 0.8"},
                                                      {"gamma = 0.7", "coefficient = 0.7"},
                                                      {"[3, 0, 0]", "[3, 1, 0]"},
                                                      {"variation = 0.6", "variation = 0.5"},
                                                      {"side = [0, 0, 4]", "side = [0, 0, 5]"},
                                                      {"seed = 5", "seed = 6"},
                                                      {"[0, -8, 0]", "[0, -7, 0]"},
                                                      {"radius = 1.25", "radius = 1.5"},
                                                      {"margin = 0.02", "margin = 0.03"},
                                                      {"friction = 0.4", "friction = 0.5"},
                                                      {"restitution = 0.3", "restitution = 0.2"},
                                                      {"restitution = 0.3", ""}};
  for (const auto& [from, to] : seen) EXPECT_TRUE(changed(from, to)) << from;
  const std::pair<const char*, const char*> words[] = {{"\"q\"", "\"other\""},
                                                       {"\"p\"", "\"other\""},
                                                       {"method = \"leapfrog\"", "method = \"rk4\""},
                                                       {"77", "78"},
                                                       {"tolerance = 1e-3", "tolerance = 1e-2"},
                                                       {"window = 1", "window = 0.5"},
                                                       {"gamma = 0.7", "gamma = 0.7  # a note"}};
  for (const auto& [from, to] : words) EXPECT_FALSE(changed(from, to)) << from;
}

TEST(SceneHash, PinsAndMissingTermsCount) {
  const std::string two =
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 1\n";
  std::vector<std::string> hashes;
  for (const std::string& more : {std::string(), std::string("[pins]\nparticles = [0]\n"),
                                  std::string("[pins]\nparticles = [1]\n"), std::string(gravity_text)})
    hashes.push_back(small_scene(two + more).hash);
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::unique(hashes.begin(), hashes.end()), hashes.end());
}

TEST(ShippedScenes, SayWhatTheyAskAndHowTheyWereChosen) {
  std::map<std::string, int> hashes;
  for (const auto& name : shipped_scenes()) {
    SCOPED_TRACE(name);
    const Scene s = load_scene(std::string(name));
    EXPECT_EQ(s.name, name);
    EXPECT_GE(s.question.size(), 20u);
    EXPECT_EQ(s.question.back(), '?');
    EXPECT_GE(s.parameters.size(), 60u);
    EXPECT_LE(s.window, s.duration);
    EXPECT_NO_THROW(find_method(s.method));
    EXPECT_EQ(++hashes[s.hash], 1) << "duplicate scene";
    EXPECT_GT(s.size(), 0);
    EXPECT_TRUE(s.model.first_order() == (s.start.v.cols() == 0));
  }
}

TEST(ShippedScenes, PinsAreWhereTheyStandAtTheStart) {
  for (const auto& name : shipped_scenes()) {
    SCOPED_TRACE(name);
    const Scene s = load_scene(std::string(name));
    if (s.model.first_order()) continue;
    State placed = s.start;
    s.model.particles.place_pins(placed);
    EXPECT_EQ(placed.x, s.start.x);
    EXPECT_EQ(placed.v, s.start.v);
  }
}

using namespace testing_tools;

TEST(RandomScenes, AreTheSameBySeedAndDifferentBySeed) {
  std::set<std::string> hashes;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::string exact = random_exact_scene(seed).hash, network = random_contact_free_scene(seed).hash;
    hashes.insert({exact, network});
    if (seed % 10 > 0) continue;
    EXPECT_EQ(random_exact_scene(seed).hash, exact);
    EXPECT_EQ(random_contact_free_scene(seed).hash, network);
  }
  EXPECT_EQ(hashes.size(), 400u);
}

TEST(RandomScenes, HaveEachIngredientOftenButNotAlways) {
  int damped = 0, dashpots = 0, driven = 0, several = 0;
  for (const Scene& s : random_exact_scenes()) {
    EXPECT_TRUE(exact_solution(s)) << s.name;
    damped += s.model.find<Drag>() != nullptr;
    dashpots += s.model.find<Dashpots>() != nullptr;
    driven += s.model.particles.move.has_value();
    several += s.model.particles.size() - s.model.particles.pins.size() > 1;
    EXPECT_FALSE(s.model.find<Spheres>());
  }
  for (const int each : {damped, dashpots, driven, several}) {
    EXPECT_GE(each, 30);
    EXPECT_LE(each, 120);
  }
}

TEST(RandomScenes, NetworksHoldTogetherAndArePredictable) {
  int moved = 0, drag = 0, gusts = 0, damped = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Scene s = random_contact_free_scene(seed);
    const Model& m = s.model;
    moved += m.particles.move.has_value();
    drag += m.find<Drag>() != nullptr;
    gusts += m.find<Wind>() && m.find<Wind>()->acceleration.gusts;
    damped += m.find<Dashpots>() != nullptr;
    EXPECT_GE(m.particles.size(), 3);
    EXPECT_LE(m.particles.size(), 30);
    EXPECT_FALSE(m.find<Spheres>());
    // a condition on windows (mysim/scene/scene.h); tests every fourth scene only, to save time
    if (seed % 4 == 1) {
      EXPECT_LT(perturbation_growth(find_method("symplectic-euler"), s, s.step, s.window), 1e3);
    }
  }
  for (const int each : {moved, drag, gusts}) {
    EXPECT_GE(each, 40);
    EXPECT_LE(each, 160);
  }
  EXPECT_EQ(damped, 0);
}

TEST(Scenes, AFileThatNamesAProgramNeedsAMethodOfTheCommandLine) {
  const TemporaryFolder here("test");
  const std::string file = here.path / "programs.toml";
  std::string text = load_scene("spring").source;
  const std::string own = load_scene("spring").method;
  text.replace(text.find('"' + own + '"'), own.size() + 2, "\"exec:./x.sh\"");
  write_file(file, text);
  try {
    load_scene(file);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), file + ":")) << error.what();
    EXPECT_TRUE(contains(error.what(),
                         "time.method: expected a method that is no program (programs are named on the "
                         "command line only: --method exec:./x.sh)"))
        << error.what();
  }
  EXPECT_THROW(load_scenes({file}), InputError);
  EXPECT_THROW(scenes_for({}, {file}, false), InputError);
  EXPECT_EQ(load_scene(file, "rk4,leapfrog").method, "rk4");
  EXPECT_EQ(load_scenes({file}, "rk4")[0].method, "rk4");
  EXPECT_EQ(scenes_for({}, {file}, false, "rk4")[0].method, "rk4");
  EXPECT_EQ(load_scene("spring", "rk4").method, own);
}

TEST(Scenes, AnUnknownNameIsAnsweredWithThoseThereAre) {
  try {
    load_scene("cloth-hung");
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "unknown scene 'cloth-hung'; did you mean 'cloth-hang'? (`crosscheck list scenes` shows all)");
  }
}

}  // namespace
}  // namespace crosscheck
