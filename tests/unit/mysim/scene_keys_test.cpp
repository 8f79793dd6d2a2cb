// Scene files: keys of constraints, spring laws, dashpots, air, spheres and blocks, their errors, and their effect on
// the fingerprint.

#include <map>

#include "mysim/base/errors.h"
#include "mysim/scene/grid.h"
#include "tests/unit/helpers.h"

namespace crosscheck {

namespace {

using namespace testing_tools;

// the header from scene_text() has nine lines, so these start at line ten
constexpr auto block_text = R"([grid]
size = [3, 4, 2]
origin = [0, 0, 0]
u = [1, 0, 0]
v = [0, 2, 0]
w = [0, 0, 0.5]
mass = 1.2
dashpot = 0.03
[grid.stiffness]
structural = 30
shear = 20
bend = 10
[[particle]]
position = [0, 5, 0]
mass = 0.5
[[particle]]
position = [0, 6, 0]
mass = 0.5
[[spring]]
ends = [0, 24]
stiffness = 7
dashpot = 0.25
[[constraint]]
ends = [24, 25]
length = 1
[springs]
law = "bullet-link"
[aerodynamics]
density = 1.25
coefficient = 1.5
velocity = [0, 0, 5]
[aerodynamics.gusts]
variation = 1
side = [1.5, 0, 0]
seed = 1
[[sphere]]
centre = [0, -3, 0]
radius = 1
[[sphere]]
centre = [7, -3, 0]
radius = 1.5
friction = 0.5
[sphere.motion]
amplitude = [0, 0.25, 0]
frequency = 0.75
ramp = 0.125
)";

std::string changed(const std::string& from, const std::string& to) {
  std::string text = block_text;
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string fault_of(const std::string& more) { return message_of(scene_text(more)); }

TEST(SceneKeys, AreAllRead) {
  const Scene s = small_scene(block_text);
  EXPECT_EQ(s.model.particles.size(), 26);
  const auto* springs = s.model.find<Springs>();
  ASSERT_TRUE(springs);
  EXPECT_EQ(springs->law, SpringLaw::bullet_link);
  const auto* dashpots = s.model.find<Dashpots>();
  ASSERT_TRUE(dashpots);
  EXPECT_EQ(dashpots->list.size(), springs->list.size());  // all springs of the grid, and the single spring
  EXPECT_EQ(dashpots->list.front().c, 0.03);
  EXPECT_EQ(dashpots->list.back().c, 0.25);
  const auto* constraints = s.model.find<Constraints>();
  ASSERT_TRUE(constraints);
  ASSERT_EQ(constraints->list.size(), 1u);
  EXPECT_EQ(constraints->list[0].length, 1);
  const auto* air = s.model.find<Aerodynamics>();
  ASSERT_TRUE(air && air->velocity.gusts);
  EXPECT_EQ(air->triangles, s.triangles);
  EXPECT_EQ(air->density, 1.25);
  EXPECT_EQ(air->velocity.mean, Vec3(0, 0, 5));
  const auto* spheres = s.model.find<Spheres>();
  ASSERT_TRUE(spheres);
  ASSERT_EQ(spheres->list.size(), 2u);
  EXPECT_FALSE(spheres->list[0].motion);
  ASSERT_TRUE(spheres->list[1].motion);
  EXPECT_EQ(spheres->list[1].motion->amplitude, Vec3(0, 0.25, 0));
}

struct Fault {
  const char *from, *to;    // text and its replacement
  const char* starts_with;  // beginning of the message
  const char* expected;     // substring of the message
};

TEST(SceneKeys, FaultsNameTheLineTheKeyAndWhatWasExpected) {
  static constexpr Fault faults[] = {
      {"size = [3, 4, 2]", "size = [3, 4, 1]", "bad.toml:11: grid.size: ", "or three (a block), particles along u"},
      {"size = [3, 4, 2]", "size = [3000, 4000, 2]", "bad.toml:11: grid.size: ", "at most ten million in all"},
      {"size = [3, 4, 2]", "size = [3]", "bad.toml:11: grid.size: ", "two whole numbers from 2"},
      {"w = [0, 0, 0.5]", "", "bad.toml:10: grid.w: ", "is missing; expected three finite numbers"},
      {"w = [0, 0, 0.5]", "w = [1, 1, 0]", "bad.toml:15: grid.w: ", "expected a side out of the plane of u and v"},
      {"w = [0, 0, 0.5]", "w = [0, 0, -0.5]", "bad.toml:15: grid.w: ", "on the side of u x v"},
      {"size = [3, 4, 2]", "size = [3, 8]", "bad.toml:15: grid.w: ", "expected no w with a size of two numbers"},
      {"dashpot = 0.03", "dashpot = 0", "bad.toml:17: grid.dashpot: ", "expected a number above zero, got 0"},
      {"dashpot = 0.03", "inextensible = \"shear\"", "bad.toml:17: grid.inextensible: ", "expected \"structural\""},
      {"dashpot = 0.03", "inextensible = true", "bad.toml:17: grid.inextensible: ", "expected \"structural\""},
      {"dashpot = 0.03", "inextensible = \"structural\"",
       "bad.toml:19: grid.stiffness.structural: ", "expected no stiffness with"},
      {"dashpot = 0.25", "dashpot = -1", "bad.toml:31: spring[0].dashpot: ", "expected a number above zero, got -1"},
      {"dashpot = 0.25", "damping = 1", "bad.toml:31: spring[0].damping: ", "unknown key"},
      {"dashpot = 0.25", "family = \"bent\"", "bad.toml:31: spring[0].family: ",
       "expected \"structural\", \"shear\" or \"bend\", got \"bent\"; did you mean 'bend'?"},
      {"ends = [24, 25]", "ends = [24, 24]", "bad.toml:33: constraint[0].ends: ", "two different particles"},
      {"ends = [24, 25]", "ends = [24, 26]",
       "bad.toml:33: constraint[0].ends[1]: ", "a particle from 0 to 25 (there are 26), got 26"},
      {"ends = [24, 25]", "", "bad.toml:32: constraint[0].ends: ", "is missing"},
      {"length = 1", "length = 1.5", "bad.toml:33: constraint[0].ends: ",
       "expected ends that are 1.5 m apart at the start (their fixed distance), got 1 m"},
      {"length = 1", "length = 0", "bad.toml:34: constraint[0].length: ", "expected a number above zero, got 0"},
      {"length = 1", "rest = 1", "bad.toml:34: constraint[0].rest: ", "unknown key"},
      {"position = [0, 6, 0]", "position = [0, 5, 0]", "bad.toml:33: constraint[0].ends: ", "got 0 m"},
      {"law = \"bullet-link\"", "law = \"link\"",
       "bad.toml:36: springs.law: ", "expected \"hooke\" or \"bullet-link\""},
      {"law = \"bullet-link\"", "", "bad.toml:35: springs.law: ", "is missing; expected \"hooke\" or \"bullet-link\""},
      {"law = \"bullet-link\"", "law = 3", "bad.toml:36: springs.law: ", "expected a text in quotes, got 3"},
      {"density = 1.25", "density = 0", "bad.toml:38: aerodynamics.density: ", "expected a number above zero"},
      {"coefficient = 1.5", "", "bad.toml:37: aerodynamics.coefficient: ", "is missing"},
      {"velocity = [0, 0, 5]", "velocity = 5", "bad.toml:40: aerodynamics.velocity: ", "three finite numbers"},
      {"velocity = [0, 0, 5]", "acceleration = [0, 0, 5]",
       "bad.toml:40: aerodynamics.acceleration: ", "unknown key; it belongs to [gravity] or [wind]"},
      {"variation = 1", "variation = -1", "bad.toml:42: aerodynamics.gusts.variation: ", "not below zero"},
      {"[aerodynamics]", "[wind]\nacceleration = [0, 0, 1]\n[aerodynamics]",
       "bad.toml:37: wind: ", "expected one kind of wind, [wind] or [aerodynamics]"},
      {"radius = 1.5", "radius = 9",
       "bad.toml:50: sphere[1].radius: ", "expected no particle inside radius + margin at the start, got particle 0"},
      {"radius = 1.5", "", "bad.toml:48: sphere[1].radius: ", "is missing"},
      {"friction = 0.5", "mu = 0.5", "bad.toml:51: sphere[1].mu: ", "unknown key"},
      {"amplitude = [0, 0.25, 0]", "", "bad.toml:52: sphere[1].motion.amplitude: ", "is missing"},
      {"frequency = 0.75", "frequency = 0", "bad.toml:54: sphere[1].motion.frequency: ", "above zero, got 0"},
      {"ramp = 0.125", "ramp = 0.125\nphase = 1", "bad.toml:56: sphere[1].motion.phase: ", "unknown key"}};
  for (const Fault& fault : faults) {
    SCOPED_TRACE(fmt::format("{} -> {}", fault.from, fault.to));
    const std::string message = fault_of(changed(fault.from, fault.to));
    EXPECT_TRUE(begins(message, fault.starts_with));
    EXPECT_TRUE(contains(message, fault.expected));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

const std::string two_particles =
    "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 1\n";

TEST(SceneKeys, AirNeedsTrianglesAndALawNeedsSprings) {
  EXPECT_TRUE(
      contains(fault_of(two_particles + "[aerodynamics]\ndensity = 1\ncoefficient = 1\nvelocity = [1, 0, 0]\n"),
               "bad.toml:19: aerodynamics.velocity: expected a scene with a [grid]: air presses on its triangles"));
  EXPECT_TRUE(contains(fault_of(two_particles + "[springs]\nlaw = \"hooke\"\n"),
                       "bad.toml:17: springs.law: expected at least one spring that follows it, got none"));
  EXPECT_TRUE(contains(fault_of(two_particles + "[sphere]\ncentre = [9, 9, 9]\nradius = 1\n[sphere.motion]\n"
                                                "amplitude = [0, 1, 0]\nfrequency = 1\n"),
                       "bad.toml:19: sphere.motion.ramp: is missing"));
}

TEST(SceneKeys, SingleSpringsMayBelongToAFamilyWhichPhysicsDoesNotSee) {
  const std::string spring = two_particles + "[[spring]]\nends = [0, 1]\nstiffness = 1\n";
  const Scene single = small_scene(spring), shear = small_scene(spring + "family = \"shear\"\n");
  EXPECT_EQ(single.model.find<Springs>()->list[0].family, Family::single);
  EXPECT_EQ(shear.model.find<Springs>()->list[0].family, Family::shear);
  EXPECT_EQ(single.hash, shear.hash);
}

TEST(SceneKeys, SpheresAreTablesAndNotNone) {
  for (const auto& [written, expected] :
       {std::pair{"sphere = []\n", "sphere: expected a table [sphere] or tables [[sphere]]"},
        {"sphere = 3\n", "sphere: expected a table [sphere] with centre = "}}) {
    try {
      parse_scene(written + scene_text(two_particles), "bad.toml");
      ADD_FAILURE() << written;
    } catch (const InputError& e) {
      EXPECT_TRUE(contains(e.what(), std::string("bad.toml:1: ") + expected));
    }
  }
}

TEST(SceneKeys, MovedPinsBesideHardDistancesAreRefused) {
  EXPECT_TRUE(
      contains(fault_of(two_particles + "[[constraint]]\nends = [0, 1]\n[pins]\nparticles = [0]\n[pins.motion]\n"
                                        "amplitude = [0, 1, 0]\nfrequency = 1\nramp = 1\n"),
               "pins.motion: expected fixed pins"));
}

TEST(SceneKeys, AnInextensibleGridHasConstraintsForItsStructuralFamily) {
  const Scene s = small_scene(
      "[grid]\nsize = [4, 3]\norigin = [0, 0, 0]\nu = [1.5, 0, 0]\nv = [0, 0, 1]\nmass = 1\n"
      "inextensible = \"structural\"\n[grid.stiffness]\nbend = 10\n");
  EXPECT_EQ(s.model.find<Constraints>()->list.size(), 3u * 3 + 4 * 2);
  EXPECT_EQ(largest_constraint_error(*s.model.find<Constraints>(), s.start.x), 0);
  for (const Spring& spring : s.model.find<Springs>()->list) EXPECT_EQ(spring.family, Family::bend);
  const Scene bare = small_scene(
      "[grid]\nsize = [4, 3]\norigin = [0, 0, 0]\nu = [1.5, 0, 0]\nv = [0, 0, 1]\nmass = 1\n"
      "inextensible = \"structural\"\n");
  EXPECT_FALSE(bare.model.find<Springs>());
}

TEST(SceneKeys, EveryOneChangesTheFingerprint) {
  const std::string hash = small_scene(block_text).hash;
  const std::pair<const char*, const char*> changes[] = {{"size = [3, 4, 2]", "size = [4, 3, 2]"},
                                                         {"w = [0, 0, 0.5]", "w = [0, 0, 0.6]"},
                                                         {"dashpot = 0.03", "dashpot = 0.04"},
                                                         {"dashpot = 0.03", ""},
                                                         {"dashpot = 0.25", "dashpot = 0.26"},
                                                         {"dashpot = 0.25", ""},
                                                         {"ends = [24, 25]", "ends = [25, 24]"},
                                                         {"length = 1", "length = 1.0000000000000002"},
                                                         {"[[constraint]]\nends = [24, 25]\nlength = 1", ""},
                                                         {"\"bullet-link\"", "\"hooke\""},
                                                         {"density = 1.25", "density = 1.3"},
                                                         {"coefficient = 1.5", "coefficient = 1.6"},
                                                         {"velocity = [0, 0, 5]", "velocity = [0, 0, 6]"},
                                                         {"variation = 1", "variation = 0.9"},
                                                         {"side = [1.5", "side = [1.6"},
                                                         {"seed = 1", "seed = 2"},
                                                         {"[[sphere]]\ncentre = [0, -3, 0]\nradius = 1\n", ""},
                                                         {"centre = [7, -3, 0]", "centre = [7, -4, 0]"},
                                                         {"radius = 1.5", "radius = 1.6"},
                                                         {"friction = 0.5", "friction = 0.6"},
                                                         {"amplitude = [0, 0.25", "amplitude = [0, 0.35"},
                                                         {"frequency = 0.75", "frequency = 0.8"},
                                                         {"ramp = 0.125", "ramp = 0.25"}};
  for (const auto& [from, to] : changes) EXPECT_NE(small_scene(changed(from, to)).hash, hash) << from << " " << to;
  EXPECT_EQ(small_scene(changed("ramp = 0.125", "ramp = 0.125  # a note")).hash, hash);
}

TEST(SceneKeys, AHardGridIsAnotherSceneThanASoftOne) {
  const std::string grid = "[grid]\nsize = [4, 3]\norigin = [0, 0, 0]\nu = [1.5, 0, 0]\nv = [0, 0, 1]\nmass = 1\n";
  EXPECT_NE(small_scene(grid + "inextensible = \"structural\"\n").hash,
            small_scene(grid + "stiffness = {structural = 1}\n").hash);
}

}  // namespace

// Tests blocks: number of springs of each family by formula, distances of neighbours, and a closed surface oriented
// outwards.

namespace {

using namespace testing_tools;

constexpr std::array<int, 3> sizes[] = {{2, 2, 2}, {2, 3, 4}, {5, 3, 2}, {4, 4, 4}, {3, 2, 7}};
const Vec3 sides[] = {{2, 0, 0}, {0.3, 1.5, 0}, {0.1, -0.2, 1.2}};  // an oblique box

Scene block(const std::array<int, 3>& n) {
  return small_scene(
      fmt::format("[grid]\nsize = [{}, {}, {}]\norigin = [1, 2, 3]\nu = [2, 0, 0]\nv = [0.3, 1.5, 0]\n"
                  "w = [0.1, -0.2, 1.2]\nmass = 1.5\n[grid.stiffness]\nstructural = 30\nshear = 20\nbend = 10\n",
                  n[0], n[1], n[2]));
}

TEST(Block, HasTheCountedSpringsAndMass) {
  for (const auto& n : sizes) {
    SCOPED_TRACE(fmt::format("{} x {} x {}", n[0], n[1], n[2]));
    const Scene s = block(n);
    const int all = n[0] * n[1] * n[2];
    std::map<Family, int> count;
    std::map<std::pair<int, int>, int> seen;
    for (const Spring& spring : s.model.find<Springs>()->list) {
      ++count[spring.family];
      EXPECT_EQ(++seen[std::minmax(spring.a, spring.b)], 1) << "duplicate pair";
    }
    int structural = 0, shear = 0, bend = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const int next = n[(axis + 1) % 3], across = all / n[axis] / next;
      structural += all / n[axis] * (n[axis] - 1);
      bend += all / n[axis] * (n[axis] - 2);
      shear += 2 * (n[axis] - 1) * (next - 1) * across;  // both diagonals of each face of each cell, once
    }
    EXPECT_EQ(count[Family::structural], structural);
    EXPECT_EQ(count[Family::shear], shear);
    EXPECT_EQ(count[Family::bend], bend);
    EXPECT_EQ(s.model.particles.size(), all);
    EXPECT_NEAR(s.model.particles.mass.sum(), 1.5, all * eps * 1.5);  // one rounding per addition
    const Vec3 far = Vec3(1, 2, 3) + sides[0] + sides[1] + sides[2];
    EXPECT_LT((s.start.x.col(all - 1) - far).norm(), 32 * eps);  // some ulps of 4 m
  }
}

TEST(Block, SpringsJoinTheRightNeighboursAtTheirDistance) {
  const std::array<int, 3> n = {4, 3, 5};
  const Scene s = block(n);
  for (const Spring& spring : s.model.find<Springs>()->list) {
    Vec3 d = Vec3::Zero();
    int steps[3], a = spring.a, b = spring.b, taken = 0, longest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      steps[axis] = a % n[axis] - b % n[axis];
      a /= n[axis], b /= n[axis];
      d += double(steps[axis]) / (n[axis] - 1) * sides[axis];
      taken += std::abs(steps[axis]), longest = std::max(longest, std::abs(steps[axis]));
    }
    const bool right = (spring.family == Family::structural && taken == 1) ||
                       (spring.family == Family::shear && taken == 2 && longest == 1) ||
                       (spring.family == Family::bend && taken == 2 && longest == 2);
    EXPECT_TRUE(right) << spring.a << " " << spring.b;
    EXPECT_EQ(spring.k, spring.family == Family::structural ? 30 : spring.family == Family::shear ? 20 : 10);
    EXPECT_NEAR(spring.rest, d.norm(), 32 * eps);  // differences of coordinates up to 4 m
  }
}

TEST(Block, SurfaceIsClosedAndFacesOutwards) {
  for (const auto& n : sizes) {
    SCOPED_TRACE(fmt::format("{} x {} x {}", n[0], n[1], n[2]));
    const Scene s = block(n);
    Vec3 area = Vec3::Zero();
    double volume = 0;
    std::map<std::pair<int, int>, int> edges;
    for (const auto& [a, b, c] : s.triangles) {
      const Vec3 x = s.start.x.col(a), y = s.start.x.col(b), z = s.start.x.col(c);
      area += 0.5 * (y - x).cross(z - x);
      volume += x.dot(y.cross(z)) / 6;
      for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        EXPECT_EQ(++edges[edge], 1) << "two triangles traverse an edge in the same direction";
    }
    // every edge belongs to two triangles, in opposite directions
    for (const auto& [edge, count] : edges) EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    const double expected = sides[0].cross(sides[1]).dot(sides[2]);
    EXPECT_EQ(static_cast<int>(s.triangles.size()),
              4 * ((n[0] - 1) * (n[1] - 1) + (n[1] - 1) * (n[2] - 1) + (n[2] - 1) * (n[0] - 1)));
    // Up to 150 triangles with coordinates up to 5 m: areas sum products of two coordinates, volumes products of three.
    EXPECT_LT(area.norm(), 150 * 25 * eps);
    EXPECT_NEAR(volume, expected, 150 * 125 * eps);  // positive for outward orientation (divergence theorem)
  }
}

}  // namespace
}  // namespace crosscheck
