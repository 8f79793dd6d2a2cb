// Methods: names, options and messages. A missing feature gives a row, and every method runs on every shipped scene.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "experiments/metrics.h"
#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "reference/method.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

std::string refusal(const std::string& name) {
  try {
    find_method(name);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Methods, NamesAreUniqueAndFoundAgain) {
  std::set<std::string> names;
  for (const Method& m : all_methods()) {
    SCOPED_TRACE(m.name);
    EXPECT_TRUE(names.insert(m.name).second) << "duplicate name";
    EXPECT_EQ(find_method(m.name).name, m.name);
    EXPECT_FALSE(m.what.empty());
    EXPECT_TRUE(m.engine);
  }
  for (const Stepper& s : steppers()) EXPECT_TRUE(names.contains("mysim/" + std::string(s.name)));
}

TEST(Methods, EachIsOfAFamilyOfTheTable) {
  EXPECT_EQ(std::ranges::count_if(method_families(), &MethodFamily::is_subject), 1);
  for (const MethodFamily& family : method_families()) {
    if (!family.methods) continue;
    const std::string prefix = std::string(family.name) + "/";
    for (const MethodRow& row : family.methods()) EXPECT_TRUE(row.name.starts_with(prefix)) << row.name;
    EXPECT_TRUE(family.representative.empty() || builtin_method(family.representative)) << family.name;
  }
  for (const Method& m : all_methods()) EXPECT_TRUE(m.name.starts_with(std::string(m.family().name) + "/")) << m.name;
  EXPECT_EQ(&family_of("exec:./a/b"), &family_of("exec"));
}

TEST(Methods, NoProductFileAsksForAnEngineByTheBeginningOfAName) {
  int files = 0;
  for (const auto room : {"mysim", "reference", "experiments", "report"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(CROSSCHECK_SOURCE) / room)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
      const std::string text = read_file(entry.path(), "a source");
      ++files;
      for (const MethodFamily& family : method_families())
        EXPECT_FALSE(contains(text, fmt::format("starts_with(\"{}", family.name)) && family.name != "file" &&
                     family.name != "exec")
            << entry.path() << " tests for " << family.name;
    }
  EXPECT_GT(files, 100);
}

/// Files that contain method names as data: Bullet's settings, rows of the bench, and chart styles of methods and
/// classes.
constexpr std::string_view name_methods_as_data[] = {
    "experiments/disagreements/table.cpp", "experiments/stiffness/stiffness.cpp", "experiments/stiffness/effective.cpp",
    "experiments/bench/bench.cpp",         "report/commands/grader.cpp",          "report/figures/figure.cpp"};

TEST(Methods, NoOtherFileNamesAMethodOfAPeer) {
  for (const auto room : {"experiments", "report"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(CROSSCHECK_SOURCE) / room)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
      const std::string path = std::filesystem::relative(entry.path(), CROSSCHECK_SOURCE).string();
      if (std::ranges::count(name_methods_as_data, path) > 0) continue;
      const std::string text = read_file(entry.path(), "a source");
      for (const MethodFamily* peer : default_peers())
        EXPECT_FALSE(contains(text, fmt::format("\"{}/", peer->name))) << path;
    }
}

TEST(Methods, PropertiesStandInTheirRows) {
  EXPECT_TRUE(find_method("truth/exact-discrete+implicit-euler").implicit);
  EXPECT_TRUE(find_method("truth/exact-discrete+implicit-midpoint").implicit);
  EXPECT_FALSE(find_method("truth/exact-discrete+leapfrog").implicit);
  EXPECT_TRUE(find_method("leapfrog+sticky").sticky_contact);
  EXPECT_FALSE(find_method("leapfrog").sticky_contact);
  for (const Method& m : builtin_methods()) {
    SCOPED_TRACE(m.name);
    EXPECT_EQ(m.counts_evaluations, m.family().role != Role::peer || (!m.implicit && !m.position_based));
  }
  EXPECT_EQ(builtin_without_options("bullet/pbd+n=10"), builtin_method("bullet/pbd"));
  EXPECT_EQ(builtin_without_options("truth/exact-discrete+rk4"), builtin_method("truth/exact-discrete+rk4"));
  EXPECT_EQ(builtin_without_options("exec:./pbd+n=10"), nullptr);
  EXPECT_EQ(subject_method([](const Stepper& s) { return s.order == 4 && !s.symplectic; }), "mysim/rk4");
  EXPECT_EQ(subject_method([](const Stepper& s) { return s.order == 9; }), "");
}

TEST(Methods, TheFirstPeerIsWhomSingleColumnsAreAbout) {
  ASSERT_FALSE(default_peers().empty());
  EXPECT_EQ(default_peers().front()->title, "Bullet");
  for (const MethodFamily& family : method_families()) EXPECT_EQ(is_first_peer(family), family.name == "bullet");
}

TEST(Methods, ABareNameMeansMysimAndOptionsFollowAPlus) {
  EXPECT_EQ(find_method("rk4").name, "mysim/rk4");
  EXPECT_EQ(find_method("rk4").stepper, &stepper("rk4"));
  EXPECT_EQ(find_method("leapfrog+sticky").name, "mysim/leapfrog+sticky");
  EXPECT_EQ(find_method("bullet/pbd+n=10").name, "bullet/pbd+n=10");
  // Options for contact do not change the rule on contact-free scenes; other options do.
  EXPECT_EQ(rule_of(find_method("symplectic-euler")), rule_of(find_method("bullet/deformable-explicit")));
  EXPECT_EQ(rule_of(find_method("symplectic-euler+sticky")), rule_of(find_method("symplectic-euler")));
  EXPECT_EQ(rule_of(find_method("implicit-euler+linear")), rule_of(find_method("bullet/deformable-implicit+tight")));
  EXPECT_NE(rule_of(find_method("leapfrog+events")), rule_of(find_method("leapfrog")));
  EXPECT_NE(find_method("implicit-euler+linear").rule, find_method("implicit-euler").rule);
  for (const auto other : {"bullet/deformable-explicit+default-rest", "bullet/deformable-explicit+default-margin",
                           "bullet/deformable-explicit+default-sleep", "bullet/deformable-implicit",
                           "bullet/deformable-implicit+tight+shipped", "bullet/pbd"})
    EXPECT_EQ(find_method(other).rule, "") << other;
  const auto several = find_methods("rk4,bullet/pbd,truth/exact");
  ASSERT_EQ(several.size(), 3u);
  EXPECT_EQ(several[1].name, "bullet/pbd");
}

TEST(Methods, UnknownNamesAndOptionsAreRefusedInOneLineThatHelps) {
  EXPECT_EQ(refusal("rk5"), "unknown method 'rk5'; did you mean 'rk4'? (`crosscheck list methods` shows all)");
  const std::pair<const char*, const char*> cases[] = {
      {"leapfrog+threads=0",
       "unknown option '+threads=0'; expected +events, +sticky, +fast, +single, +plain, +threads=N or none"},
      {"leapfrog+threads=2x", "unknown option '+threads=2x'"},
      {"rk4+single", "method mysim/rk4: unknown option '+single'; expected +sticky or none"},
      {"symplectic-euler+events",
       "expected +events with leapfrog or implicit-midpoint only; it needs a rule of order 2"},
      {"rk4+events", "method mysim/rk4: expected +events with leapfrog or implicit-midpoint only"},
      {"suzuki4+events", "expected +events with leapfrog or implicit-midpoint only"},
      {"trapezoidal+events", "expected +events with leapfrog or implicit-midpoint only"},
      {"dopri5+events", "expected +events with leapfrog or implicit-midpoint only"},
      {"leapfrog+events+single", "+events requires double precision; expected no +single"},
      {"leapfrog+single+events", "+events requires double precision; expected no +single"},
      {"leapfrog+single+plain",
       "method mysim/leapfrog: +single and +plain each choose how a step is computed; expected one of them"},
      {"suzuki4+fast+single", "+fast and +single each choose how a step is computed; expected one of them"},
      {"implicit-midpoint+single", "unknown option '+single'; expected +events, +sticky or none"},
      {"implicit-euler+single", "unknown option '+single'; expected +linear, +sticky or none"},
      {"xpbd+single", "unknown option '+single'; expected +sticky or none"},
      {"bullet/pbd+single", "method bullet/pbd: unknown option '+single'"},
      {"odeint/rk4+single", "method odeint/rk4: unknown option '+single'; expected none"},
      {"truth/converged+single", "method truth/converged: unknown option '+single'; expected none"},
      {"rk4+stick", "method mysim/rk4: unknown option '+stick'; expected +sticky or none"},
      {"implicit-euler+x", "unknown option '+x'; expected +linear, +sticky or none"},
      {"rk4+linear", "method mysim/rk4: unknown option '+linear'; expected +sticky or none"},
      {"implicit-euler+line", "unknown option '+line'; expected +linear, +sticky or none"},
      {"rk4+sticky=1", "unknown option '+sticky=1'"},
      {"bullet/deformable-explicit+n=2",
       "method bullet/deformable-explicit: unknown option '+n=2'; expected +default-rest, +default-margin, "
       "+default-sleep, +voxel=0.0001 to +voxel=1 (m), +gravity-factor=0.01 to +gravity-factor=100, +kLST=0 to "
       "+kLST=1e6, +bodies alone, +in-pieces (in a separate process) or none"},
      {"bullet/deformable-explicit+in-pieces",
       "method bullet/deformable-explicit: +in-pieces may hang and has no time limit here; expected a separate "
       "process: bullet32/deformable-explicit+in-pieces+timeout=SECONDS, or exec:"},
      {"bullet/deformable-explicit+bodies+default-rest", "unknown option '+bodies'; expected +bodies without other"},
      {"bullet/deformable-explicit+timeout=1", "unknown option '+timeout=1'"},
      {"bullet32/pbd+timeout=0", "method bullet32/pbd: timeout: expected seconds above zero, got '0'"},
      {"bullet/pbd+kLST=-1", "unknown option '+kLST=-1'"},
      {"bullet/pbd+gravity-factor=0", "unknown option '+gravity-factor=0'"},
      {"bullet/pbd+in-pieces", "unknown option '+in-pieces'"},
      {"bullet/deformable-explicit+voxel=0", "unknown option '+voxel=0'"},
      {"bullet/deformable-explicit+voxel=0.02m", "unknown option '+voxel=0.02m'"},
      {"bullet/pbd+voxel=2", "unknown option '+voxel=2'"},
      {"bullet/deformable-implicit+n=2",
       "method bullet/deformable-implicit: unknown option '+n=2'; expected +tight, +shipped, +unprojected or none"},
      {"bullet/deformable-implicit+tight=1", "'+tight=1'"},
      {"bullet/deformable-explicit+tight", "'+tight'"},
      {"bullet/pbd+demos", "'+demos'; expected +n=1 to +n=1000 (iterations), +demo, +own-wind, +default-rest, +def"},
      {"bullet/pbd+", "'+'"},
      {"bullet/pbd+n=0", "method bullet/pbd: unknown option '+n=0'; expected +n=1 to +n=1000"},
      {"bullet/pbd+n=1001", "'+n=1001'"},
      {"bullet/pbd+n=ten", "'+n=ten'"},
      {"bullet/pbd+n=2x", "'+n=2x'"},
      {"bullet/pbd+n=-1", "'+n=-1'"},
      {"bullet/pbd+n", "'+n'"},
      {"bullet/pbd+m=2", "'+m=2'"},
      {"truth/exact-discrete",
       "method truth/exact-discrete: the rule is missing; expected one of the rules +explicit-euler, +trap"},
      {"truth/exact-discrete+dopri5", "unknown option '+dopri5'; expected one of the rules +explicit-euler, "},
      {"truth/exact-discrete+rk4=2", "unknown option '+rk4=2'; expected one of the rules +explicit-euler, "},
      {"truth/exact-discrete+rk4+linear", "unknown option '+linear'; expected one of the rules +explicit-euler, "},
      {"bullet32/pbd+n=0", "unknown option '+n=0'"},
      {"truth/exact+sticky", "method truth/exact: unknown option '+sticky'"}};
  for (const auto& [name, message] : cases) EXPECT_TRUE(contains(refusal(name), message));
  for (const auto name : {"", "bullet/", "/rk4", "rk4 ", "RK4", "bullet/pbd/x"})
    EXPECT_TRUE(contains(refusal(name), "unknown method")) << name;
  EXPECT_THROW(find_methods("rk4,,leapfrog"), InputError);
}

TEST(Methods, WhatAMethodLacksIsARowAndNoCrash) {
  const Scene circle = load_scene("circle");
  Recorder r;
  const Outcome out = run_method(find_method("leapfrog"), circle, {0.05, 1, 10}, {&r});
  EXPECT_EQ(out.verdict, Verdict::unsupported);
  EXPECT_TRUE(contains(out.reason, "first-order"));
  EXPECT_EQ(r.trajectory.frames(), 0);
}

TEST(Methods, EveryOneMeetsEveryShippedScene) {
  for (const auto& name : shipped_scenes()) {
    const Scene scene = load_scene(std::string(name));
    int accepted = 0;
    for (const Method& m : all_methods()) {
      SCOPED_TRACE(fmt::format("{} {}", name, m.name));
      Recorder r;
      const Outcome out = run_method(m, scene, {scene.step, 0.05, 2}, {&r});
      if (out.verdict == Verdict::unsupported) {
        EXPECT_FALSE(out.reason.empty());
        continue;
      }
      ++accepted;
      // Adaptive methods follow their tolerance, and their mean step is at most the duration.
      EXPECT_LE(out.step, out.tolerance > 0 ? 0.05 : scene.step * (1 + 1e-9));
      if (out.verdict != Verdict::ok) continue;  // explicit Euler on a stiff cloth fails with a verdict in its row
      ASSERT_EQ(r.trajectory.frames(), 3);
      EXPECT_NEAR(out.end, 0.05, 4 * eps);
      for (const Points& x : r.trajectory.x) EXPECT_TRUE(x.allFinite());
      // engines in single precision round the initial state to 24 bits
      const double rounding = m.name.starts_with("bullet32/") ? 6e-8 * largest_column(scene.start.x) : 0;
      EXPECT_LE(largest_column(r.trajectory.x[0] - scene.start.x), rounding);
    }
    // every stepper that supports the scene must accept it
    for (const Stepper& s : steppers()) accepted -= takes(s, scene);
    EXPECT_GE(accepted, 0);
  }
}

TEST(Methods, EveryMethodAgreesWithTheTruthOnTheSpring) {
  const Scene scene = load_scene("spring");
  const crosscheck::Run run{1e-4, 1, 20};
  Recorder exact;
  ASSERT_EQ(run_method(find_method("truth/exact"), scene, run, {&exact}).verdict, Verdict::ok);
  for (const Method& m : all_methods()) {
    SCOPED_TRACE(m.name);
    Recorder r;
    const Outcome out = run_method(m, scene, run, {&r});
    if (out.verdict == Verdict::unsupported || !out.different_law.empty()) continue;
    // A first-order rule is off by at most h omega^2 t / 2 = 5e-3, relative to the amplitude of 0.2 m.
    EXPECT_LT(sup_rms(r.trajectory, exact.trajectory), 1e-3);
  }
}

TEST(Metrics, OfKnownStates) {
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 9\n[[particle]]\nposition = [2, 0, 0]\nmass = 1\n"
      "[[particle]]\nposition = [0, 4, 0]\nmass = 3\n[pins]\nparticles = [0]\n[sphere]\n"
      "centre = [2, -1.5, 0]\nradius = 1\nmargin = 0.25\n");
  EXPECT_EQ(centre_of_mass(scene, scene.start.x), Vec3(0.5, 3, 0));  // excluding pins
  EXPECT_DOUBLE_EQ(*clearance(scene, 0, scene.start.x), 0.25);
  EXPECT_FALSE(creep(scene, 0, scene.start.x, scene.start.v));  // no contact
  Points x = scene.start.x, v = scene.start.v;
  x.col(1) = Vec3(2, -0.25, 0);
  v.col(1) = Vec3(0.3, 5, 0.4);
  EXPECT_DOUBLE_EQ(*creep(scene, 0, x, v), 0.5);  // only the motion along the surface counts
  EXPECT_FALSE(clearance(small_cloth(), 0, small_cloth().start.x));
  Trajectory t{{0, 1}, {scene.start.x, x}, {v, v}};
  EXPECT_DOUBLE_EQ(motion_of(t), 0.25 / std::sqrt(3.0));
}

}  // namespace
}  // namespace crosscheck
