// The independent right-hand side equals mysim's on every shipped scene, so that an error in either one is detected.

#include <array>
#include <span>

#include "reference/truth/independent/integrators.h"
#include "reference/truth/independent/right_hand_side.h"
#include "reference/truth/multipliers.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Shipped scenes without their contacts, and two cloths with every smooth ingredient.
std::vector<Scene> smooth_scenes() {
  std::vector<Scene> scenes{small_cloth(), small_cloth_in_air()};
  for (const auto& name : shipped_scene_names()) scenes.push_back(without_contact(shipped_scene(std::string(name))));
  return scenes;
}

/// A state near the initial state, at a random time: free particles are displaced by up to a tenth of the scene's size,
/// with speeds of 1 m/s.
State random_state(const Scene& scene, unsigned seed) {
  Random random(seed);
  State s = scene.start;
  s.t = random.between(0, scene.duration);
  for (int i = 0; i < s.x.cols(); ++i) s.x.col(i) += 0.1 * scene.size() * random.vector();
  for (int i = 0; i < s.v.cols(); ++i) s.v.col(i) = random.vector();
  if (!scene.model.first_order()) scene.model.particles.place_pins(s);
  return s;
}

StateVector flat(const Scene& scene, const State& s) {
  StateVector y;
  for (const Points* part : {&s.x, &s.v})
    for (int i = 0; i < part->cols(); ++i)
      if (!scene.model.particles.pinned[i]) y.insert(y.end(), part->col(i).begin(), part->col(i).end());
  return y;
}

/// mysim's rates of the free particles.
StateVector rate_by_mysim(const Scene& scene, State s) {
  State rate = s;
  if (scene.model.find<Constraints>())
    MultiplierWorld(scene, scene.step).derivative(s, rate);
  else
    System(scene.model).derivative(s, rate);
  return flat(scene, rate);
}

StateVector rate_apart(const Scene& scene, const State& s) {
  RightHandSide f(scene);
  const StateVector y = flat(scene, s);
  StateVector rate(y.size());
  f(y, rate, s.t);
  return rate;
}

/// Allowed difference (m/s^2) of two accelerations that differ by rounding: 16 roundings of the largest sum of
/// magnitudes at one particle. Lengths are rounded before they are subtracted, so a spring contributes k (L + r).
double round_off(const Scene& scene, const State& s) {
  const Particles& p = scene.model.particles;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(p.size());
  auto both = [&](int a, int b, double newton) { sum[a] += newton, sum[b] += newton; };
  if (const auto* springs = scene.model.find<Springs>())
    for (const Spring& e : springs->list) both(e.a, e.b, e.k * ((s.x.col(e.a) - s.x.col(e.b)).norm() + e.rest));
  if (const auto* bending = scene.model.find<Bending>())
    for_each_pair(*bending,
                  [&](int a, int b, double k) { both(a, b, std::abs(k) * (s.x.col(a).norm() + s.x.col(b).norm())); });
  if (const auto* dashpots = scene.model.find<Dashpots>())
    for (const auto& d : dashpots->list) both(d.a, d.b, d.c * (s.v.col(d.a).norm() + s.v.col(d.b).norm()));
  if (const auto* air = scene.model.find<Aerodynamics>())
    for (const auto& triangle : air->triangles)
      // assumes at most 10 m/s on a triangle as large as the scene
      for (int corner : triangle) sum[corner] += air->density * air->coefficient * 100 * std::pow(scene.size(), 2);
  double largest = scene.model.first_order() ? scene.size() : 0;
  for (int i = 0; i < p.size(); ++i) largest = std::max(largest, sum[i] / p.mass[i] + 30);  // gravity, wind, drag
  // hard distances spread rounding over all connected particles
  const auto* rods = scene.model.find<Constraints>();
  return 16 * eps * largest * (rods ? 10 * static_cast<double>(rods->list.size()) : 1);
}

double apart(const StateVector& a, const StateVector& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST(RightHandSide, IsMysimsToRoundOffOnEveryScene) {
  for (const Scene& scene : smooth_scenes())
    for (unsigned seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(fmt::format("{} {}", scene.name, seed));
      const State s = random_state(scene, seed);
      EXPECT_LE(apart(rate_apart(scene, s), rate_by_mysim(scene, s)), round_off(scene, s));
    }
}

TEST(RightHandSide, PutsPinsWhereTheyAre) {
  const Scene scene = small_cloth();
  RightHandSide f(scene);
  for (const double t : {0.0, 0.1, 0.25, 0.7}) {
    State ours = scene.start, theirs = scene.start;
    ours.t = t;
    scene.model.particles.place_pins(ours);
    f.write_state(f.start(), t, theirs);
    EXPECT_EQ(theirs.t, t);
    EXPECT_LT((ours.x - theirs.x).norm(), 16 * eps);  // amplitude 0.1 m
    EXPECT_LT((ours.v - theirs.v).norm(), 16 * eps * 4);
  }
}

TEST(RightHandSide, ASlipInAnyIngredientShows) {
  struct Slip {
    std::string what;
    Scene scene;
    void (*make)(Scene&);
  };
  Scene link = small_cloth(), circle = shipped_scene("circle");
  link.model.find<Springs>()->law = SpringLaw::bullet_link;
  const Slip slips[] = {
      {"one stiffness", small_cloth(), [](Scene& s) { s.model.find<Springs>()->list[7].k *= 1 + 1e-9; }},
      {"one rest length", small_cloth(), [](Scene& s) { s.model.find<Springs>()->list[7].rest *= 1 + 1e-9; }},
      {"one end", small_cloth(), [](Scene& s) { s.model.find<Springs>()->list[7].a += 1; }},
      {"the law", small_cloth(), [](Scene& s) { s.model.find<Springs>()->law = SpringLaw::bullet_link; }},
      {"one stiffness of a link", link, [](Scene& s) { s.model.find<Springs>()->list[7].k *= 1 + 1e-9; }},
      {"one mass", small_cloth(), [](Scene& s) { s.model.particles.mass[12] *= 1 + 1e-9; }},
      {"gravity", small_cloth(), [](Scene& s) { s.model.find<Gravity>()->acceleration.y() *= 1 + 1e-9; }},
      {"one drag", small_cloth(), [](Scene& s) { s.model.find<Drag>()->c[12] *= 1 + 1e-9; }},
      {"a gust", small_cloth(),
       [](Scene& s) { s.model.find<Wind>()->acceleration.gusts->along.waves[2].omega += 1e-8; }},
      {"the side wind", small_cloth(), [](Scene& s) { s.model.find<Wind>()->acceleration.gusts->side.x() += 1e-8; }},
      {"the hand", small_cloth(), [](Scene& s) { s.model.particles.move->frequency *= 1 + 1e-8; }},
      {"one stencil", small_cloth_in_air(), [](Scene& s) { s.model.find<Bending>()->list[7].k *= 1 + 1e-8; }},
      {"one weight", small_cloth_in_air(), [](Scene& s) { s.model.find<Bending>()->list[7].weight[1] *= 1 + 1e-8; }},
      {"one dashpot", small_cloth_in_air(), [](Scene& s) { s.model.find<Dashpots>()->list[7].c *= 1 + 1e-8; }},
      {"the air", small_cloth_in_air(), [](Scene& s) { s.model.find<Aerodynamics>()->density *= 1 + 1e-8; }},
      {"one corner", small_cloth_in_air(), [](Scene& s) { s.model.find<Aerodynamics>()->triangles[3][0] = 24; }},
      {"a missing rod", shipped_scene("rod"), [](Scene& s) { s.model.find<Constraints>()->list.pop_back(); }},
      {"the rotation", circle, [](Scene& s) { s.model.find<Rotation>()->rate *= 1 + 1e-9; }}};
  for (const Slip& slip : slips) {
    SCOPED_TRACE(slip.what);
    Scene wrong = slip.scene;
    slip.make(wrong);
    double most = 0, allowed = 0;
    for (unsigned seed = 0; seed < 5; ++seed) {
      State s = random_state(slip.scene, seed);
      s.t = 0.2 + 0.1 * seed;  // the pin's motion is still ramping up
      State placed = s;
      if (!wrong.model.first_order()) wrong.model.particles.place_pins(placed);
      most = std::max(most, apart(rate_apart(wrong, placed), rate_by_mysim(slip.scene, s)));
      allowed = std::max(allowed, round_off(slip.scene, s));
    }
    EXPECT_GT(most, 10 * allowed);
  }
}

TEST(RightHandSide, RefusesContactAndForcesThatAreNotUnique) {
  try {
    RightHandSide f(shipped_scene("slide"));
    ADD_FAILURE();
  } catch (const Unsupported& e) {
    EXPECT_TRUE(contains(e.what(), "contact"));
  }
  const Scene row = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 1\n"
      "[[particle]]\nposition = [2, 0, 0]\nmass = 1\n[[constraint]]\nends = [0, 1]\n[[constraint]]\nends = [1, 2]\n"
      "[pins]\nparticles = [0, 2]\n" +
      std::string(gravity_text));
  const Outcome out = run_and_record("odeint/rk4", row, {1e-3, 0.1, 1}).outcome;
  EXPECT_EQ(out.verdict, Verdict::unsupported);
  EXPECT_TRUE(contains(out.reason, "depend on each other"));
}

TEST(RightHandSide, CountsEndsThatMeetAndGivesThemNoForce) {
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 1\n"
      "[[spring]]\nends = [0, 1]\nstiffness = 100\n");
  RightHandSide f(scene);
  StateVector y(12, 0), rate(12, 1);
  f(y, rate, 0);
  EXPECT_EQ(rate, StateVector(12, 0));
  EXPECT_EQ(f.degenerate_springs(), 1);
  EXPECT_EQ(f.evaluations(), 1);
}

TEST(Integrators, OdeintsRungeKuttaIsMysims) {
  for (const Scene& scene : {small_cloth(), small_cloth_in_air(), shipped_scene("chain"), shipped_scene("circle")}) {
    SCOPED_TRACE(scene.name);
    const crosscheck::Run run{scene.step, 1, 10};
    const MethodRun ours = run_and_record("rk4", scene, run), theirs = run_and_record("odeint/rk4", scene, run);
    ASSERT_EQ(theirs.outcome.verdict, Verdict::ok) << theirs.outcome.reason;
    EXPECT_EQ(theirs.outcome.evaluations, 4 * theirs.outcome.steps);
    EXPECT_EQ(theirs.outcome.steps, ours.outcome.steps);
    EXPECT_EQ(ours.trajectory.t, theirs.trajectory.t);
    // each of some thousand steps rounds once, and perturbations grow at most a hundredfold
    EXPECT_LT(sup_rms(ours.trajectory, theirs.trajectory), 1e-11);
  }
}

constexpr std::array sundials_methods{"sundials/arkode", "sundials/arkode+order=4", "sundials/cvode"};

void expect_tolerances_followed(std::span<const char* const> names) {
  const Scene scene = shipped_scene("pendulum");
  const Trajectory fine = run_and_record("rk4", scene, {2e-5, 1, 20}).trajectory;
  for (const std::string name : names) {
    SCOPED_TRACE(name);
    double before = 0;
    for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
      const MethodRun a = run_and_record(name, scene, {1e-3, 1, 20, tolerance});
      EXPECT_EQ(a.outcome.tolerance, tolerance);
      const double error = sup_rms(a.trajectory, fine);
      EXPECT_LT(error, 300 * tolerance);  // local errors of tens of steps add up: the run covers 5 vibrations
      if (before > 0) {
        EXPECT_LT(error, before / 10);
      }
      before = error;
    }
  }
}

TEST(Integrators, FollowTheirTolerance) { expect_tolerances_followed(std::array{"odeint/dopri5"}); }

TEST(Sundials, FollowsItsTolerance) {
  NEEDS_SUNDIALS;
  expect_tolerances_followed(sundials_methods);
}

void expect_times_asked_for(std::span<const char* const> names) {
  const Scene scene = small_cloth();  // its wind makes the monitor observe every step
  for (const std::string name : names) {
    const Method method = find_method(name);
    const crosscheck::Run run{1e-3, 0.5, 7, 1e-8};
    Recorder alone, watched;
    const Outcome out = run_method(method, scene, run, {&watched});
    ASSERT_EQ(out.verdict, Verdict::ok) << out.reason;
    method.engine(scene, run, alone);
    ASSERT_EQ(watched.trajectory.frames(), 8);
    for (int i = 0; i <= 7; ++i) EXPECT_NEAR(watched.trajectory.t[i], 0.5 * i / 7, 4 * eps);
    EXPECT_EQ(alone.trajectory.t.size(), 8u);
    EXPECT_LT(sup_rms(alone.trajectory, watched.trajectory), 1e-13) << name;
  }
}

TEST(Integrators, SampleAtTheTimesAskedForHoweverOftenTheyAreWatched) {
  expect_times_asked_for(std::array{"odeint/dopri5"});
}

TEST(Sundials, SamplesAtTheTimesAskedForHoweverOftenItIsWatched) {
  NEEDS_SUNDIALS;
  expect_times_asked_for(sundials_methods);
}

TEST(Sundials, WhereItIsMissingItsMethodsAreRefusedWithThePackagesName) {
  if (sundials_version()) GTEST_SKIP() << "package libsundials-dev is installed: its absence is not tested";
  for (const char* name : sundials_methods) {
    const Outcome out = run_and_record(name, shipped_scene("pendulum"), {1e-3, 0.1, 2, 1e-6}).outcome;
    EXPECT_EQ(out.verdict, Verdict::unsupported) << name;
    EXPECT_TRUE(contains(out.reason, "libsundials-dev")) << name << ": " << out.reason;
  }
}

TEST(BulirschStoer, TakesNoSliverWhereARampEndsARoundingBesideASample) {
  // 3 * 0.1 and similar products differ from the decimal numbers of the ramps
  for (int tenths = 1; tenths < 10; ++tenths)
    for (const int samples : {10, 20, 30}) {
      SCOPED_TRACE(fmt::format("{} {}", tenths, samples));
      const Scene scene = small_scene(
          fmt::format("[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0.5, -0.3, 0]\n"
                      "mass = 0.3\n[[spring]]\nends = [0, 1]\nstiffness = 100\nrest = 0.5\n[pins]\nparticles = [0]\n"
                      "[pins.motion]\namplitude = [0.2, 0, 0]\nfrequency = 1\nramp = 0.{}\n",
                      tenths));
      NullObserver none;
      EXPECT_EQ(run_odeint_bulirsch_stoer(scene, {1e-3, 1, samples, 1e-9}, none).verdict, Verdict::ok);
    }
}

TEST(Integrators, AreListedAndAskedForByName) {
  for (const auto name :
       {"odeint/rk4", "odeint/dopri5", "sundials/arkode", "sundials/arkode+order=4", "sundials/cvode"}) {
    EXPECT_EQ(find_method(name).name, name);
    EXPECT_EQ(find_method(name).adaptive, std::string(name) != "odeint/rk4");
    EXPECT_THROW(find_method(std::string(name) + "+n=2"), InputError);
  }
}

}  // namespace
}  // namespace crosscheck
