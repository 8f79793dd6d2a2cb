// Bullet compared with mysim on the shipped scenes, in both precisions. Differences are bounded by the measured growth
// of a perturbation.

#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/scenes/scenes.h"
#include "mysim/model/system.h"
#include "reference/certificate/certificate.h"
#include "reference/method.h"
#include "tests/unit/experiments/helpers.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/random_scenes.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Runs the scene at its own step; expects the run to finish.
MethodRun play(const std::string& method, const Scene& scene) {
  MethodRun a = run_and_record(method, scene, default_run(scene));
  EXPECT_EQ(a.outcome.verdict, Verdict::ok) << method << ": " << a.outcome.reason;
  return a;
}

void expect_identity(const std::string& name, const std::string& carried_by) {
  const Scene scene = load_scene(name);
  const MethodRun ours = play("symplectic-euler", scene), theirs = play("bullet/deformable-explicit", scene);
  ASSERT_TRUE(theirs.outcome.readback);
  EXPECT_TRUE(contains(theirs.outcome.readback->mapped.at("stiffness"), carried_by));
  EXPECT_FALSE(certify("bullet/deformable-explicit", scene, theirs.outcome).mismatch());
  const double apart = sup_distance(ours.trajectory, theirs.trajectory, scene.window);
  const double growth = perturbation_growth(find_method("symplectic-euler"), scene, scene.step, scene.window);
  fmt::print("{}: {:.3g} m apart, growth {:.3g}\n", name, apart, growth);
  EXPECT_LE(apart, 1e-12);  // required bound: round-off due to the summation order (1e-15 m), times growth
  EXPECT_LT(growth, 1e3);
}

TEST(BulletCloth, HangIsIdenticalByBulletsOwnForce) { expect_identity("cloth-hang", "Bullet's own mass-spring force"); }
TEST(BulletCloth, SwingIsIdentical) { expect_identity("cloth-swing", "Bullet's own mass-spring force"); }
TEST(BulletCloth, WindIsIdentical) { expect_identity("cloth-wind", "Bullet's own mass-spring force"); }

TEST(BulletCloth, ThreeStiffnessesAreIdenticalByOurForceClass) {
  Scene scene = load_scene("cloth-hang");
  for (Spring& s : scene.model.find<Springs>()->list)
    s.k = s.family == Family::structural ? 200 : s.family == Family::shear ? 180 : 160;
  scene.duration = scene.window = 1;
  scene.samples = 30;
  const MethodRun ours = play("symplectic-euler", scene), theirs = play("bullet/deformable-explicit", scene);
  EXPECT_TRUE(contains(theirs.outcome.readback->mapped.at("stiffness"), "force class of our own"));
  EXPECT_LE(sup_distance(ours.trajectory, theirs.trajectory), 1e-12);
}

TEST(Scenes, PerturbationsGrowLessThanAThousandfoldInTheWindowForEveryStableStepper) {
  for (const auto& name : shipped_scenes()) {
    const Scene scene = load_scene(std::string(name));
    const double omega = scene.model.first_order() ? 0 : highest_frequency(scene.model, scene.start);
    int stable = 0;
    bool own = false;
    for (const Stepper& s : steppers()) {
      // Implicit steps take many evaluations, so they are run only on scenes that use them.
      if (s.evaluations == 0 && s.name != scene.method) continue;
      if (omega > 0 && s.limit(omega, uniform_drag_rate(scene.model).value_or(0)) < scene.step) continue;
      if (s.adaptive) continue;  // its steps change with the perturbation, so that growth shows only the tolerance
      SCOPED_TRACE(fmt::format("{} {}", name, s.name));
      const Method method = find_method(std::string(s.name));
      // Runs the scene's own method to the end, to find where the window of predictability ends. Runs the other methods
      // over the declared window.
      const bool to_the_end = s.name == scene.method;
      Recorder r;
      crosscheck::Run run = default_run(scene);
      if (!to_the_end)
        run.duration = scene.window,
        run.samples = std::max(1, static_cast<int>(scene.samples * scene.window / scene.duration));
      if (run_method(method, scene, run, {&r}).verdict != Verdict::ok) continue;
      ++stable;
      own |= to_the_end;
      const Growth growing = growth_of(method, scene, run, &r.trajectory);
      const double growth = growing.until(scene.window);
      fmt::print("{:12} {:16} growth {:.3g}\n", name, s.name, growth);
      if (to_the_end) {
        fmt::print("{:12} declared window {:.3g} s, measured {:.3g} s\n", name, scene.window, growing.window());
        // the last sample in the declared window must be predictable
        EXPECT_GT(growing.window(), scene.window - 1.001 * scene.duration / scene.samples);
      }
      EXPECT_GT(growth, 0);
      // The windows were chosen so that this bound holds. Dissipative first-order rules have a larger bound: in effect,
      // they simulate a cloth with another stiffness (xpbd with one sweep per step: growth 6e3 on cloth-hang).
      EXPECT_LT(growth, s.order == 1 && !s.symplectic ? 1e4 : 1e3);
    }
    EXPECT_TRUE(own) << name;
    // At least three rules are stable: the two symplectic rules and rk4 or, in first-order scenes, the three rules that
    // support them. On special scenes, only few rules are stable.
    const bool special = scene.model.find<Constraints>() || scene.method == "implicit-euler";
    EXPECT_GE(stable, special ? 1 : 3) << name;
  }
}

/// Time (s) at the end of the first step with a contact.
class FirstTouch : public Observer {
 public:
  bool every_step() const override { return true; }
  Verdict observe(const State& s, bool) override {
    if (touched_) time = std::min(time, s.t);
    return Verdict::ok;
  }
  void contact(double) override { touched_ = true; }
  double time = INFINITY;

 private:
  bool touched_ = false;
};

TEST(BulletDrape, AgreesUntilTheWindowAndInTheMeanAfterwards) {
  const Scene scene = load_scene("cloth-sphere");
  const MethodRun ours = play("symplectic-euler", scene), theirs = play("bullet/deformable-explicit", scene);
  FirstTouch touch;
  run_method(find_method("symplectic-euler"), scene, default_run(scene), {&touch});
  EXPECT_NEAR(scene.window, touch.time + 0.3, 0.01);  // the scene file gives two decimals
  const auto sampled = first_contact(scene, ours.trajectory);
  ASSERT_TRUE(sampled);
  EXPECT_NEAR(*sampled, touch.time, 0.02 + scene.step);  // the next sample is at most 0.02 s later
  const double rms = sup_rms(ours.trajectory, theirs.trajectory, scene.window);
  double mean_apart = 0, closest = 0;
  for (int i = 0; i < ours.trajectory.frames(); ++i) {
    mean_apart =
        std::max(mean_apart,
                 (centre_of_mass(scene, ours.trajectory.x[i]) - centre_of_mass(scene, theirs.trajectory.x[i])).norm());
    closest = std::min(closest, *clearance(scene, theirs.trajectory.t[i], theirs.trajectory.x[i]));
    EXPECT_GE(*clearance(scene, ours.trajectory.t[i], ours.trajectory.x[i]), -1e-13);  // round-off of the radius
  }
  fmt::print("cloth-sphere: touch {:.3g} s, rms {:.3g} m, centre of mass {:.3g} m, clearance {:.3g} m\n", touch.time,
             rms, mean_apart, closest);
  // The bounds allow for Bullet's use of the normals at old positions, which lets nodes hop by (v h)^2 / 2R in each
  // step.
  EXPECT_LE(rms, 2e-3);
  EXPECT_LE(mean_apart, 5e-3);
  EXPECT_GE(closest, -1e-3);  // error: 6e-6 m from voxels of 0.005 m, plus one hop
}

}  // namespace

// Bullet's explicit world is mysim's symplectic Euler. Compared on every contact-free shipped scene at three steps and
// in three sizes, and on 200 random networks; bit for bit if sums are taken in Bullet's order.

namespace {

using namespace testing_tools;

/// Allowed difference, m. Both engines sum the same forces in different orders. In each step, the results differ by
/// about 1e-15 m (an ulp of some metres). Over thousands of steps these differences accumulate like a random walk, to
/// about 1e-13 m, and grow like any perturbation. The bound is at least 1e-12 m because the rounding of velocities adds
/// a drift of sqrt(N) T h eps k L / m in N steps. (Springs of 200 000 N/m in a cloth coarser than those tested here
/// reach 4e-12 m in that way.)
double allowed(double growth) { return 1e-13 * std::max(10.0, growth); }

struct Comparison {
  double apart, growth;
};

Comparison compare(const Scene& scene, const crosscheck::Run& run) {
  const MethodRun ours = run_and_record("symplectic-euler", scene, run),
                  theirs = run_and_record("bullet/deformable-explicit", scene, run);
  EXPECT_EQ(ours.outcome.verdict, Verdict::ok) << ours.outcome.reason;
  EXPECT_EQ(theirs.outcome.verdict, Verdict::ok) << theirs.outcome.reason;
  EXPECT_TRUE(theirs.outcome.different_law.empty());
  EXPECT_FALSE(certify("bullet/deformable-explicit", scene, theirs.outcome).mismatch());
  EXPECT_GT(motion_of(ours.trajectory), 1e-4);
  Scene shortened = scene;  // growth is measured at the samples of this run
  shortened.duration = run.duration, shortened.samples = run.samples;
  return {sup_distance(ours.trajectory, theirs.trajectory),
          perturbation_growth(find_method("symplectic-euler"), shortened, run.step, run.duration)};
}

bool compared(const Scene& scene) {
  const Model& model = scene.model;
  return !model.first_order() && !has_contact(model) && !model.find<Dashpots>() && !model.find<Constraints>();
}

TEST(BulletIdentity, OnEveryContactFreeShippedSceneAtThreeStepsInThreeSizes) {
  int scenes = 0;
  for (const auto& name : shipped_scenes()) {
    if (!compared(load_scene(std::string(name)))) continue;
    ++scenes;
    double worst = 0, most = 0;
    for (const Scene& scene : three_sizes(std::string(name))) {
      const double omega = highest_frequency(scene.model, scene.start);
      const double limit =
          omega > 0 ? stepper("symplectic-euler").limit(omega, uniform_drag_rate(scene.model).value_or(0)) : INFINITY;
      const double middle = scene.step < 0.8 * limit ? scene.step : limit / 2;
      for (const double step : {middle / 2, middle, std::min(1.5 * middle, 0.9 * limit)}) {
        SCOPED_TRACE(fmt::format("{} ({} particles, {:.3g} m) at {:.3g} s", name, scene.model.particles.size(),
                                 scene.size(), step));
        const auto [apart, growth] = compare(scene, {step, std::min(scene.window, 1500 * step), 20});
        EXPECT_LE(apart, allowed(growth)) << "growth " << growth;
        EXPECT_LT(growth, 1e3);  // if it grew more, the bound would test little
        worst = std::max(worst, apart / allowed(growth)), most = std::max(most, growth);
      }
    }
    fmt::print("{:16} at most {:.2g} of the bound, growth up to {:.3g}\n", name, worst, most);
  }
  EXPECT_EQ(scenes, 15);
}

TEST(BulletIdentity, OnTwoHundredRandomContactFreeScenes) {
  double worst = 0, most = 0;
  int by_bullet = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene = random_contact_free_scene(seed);
    if (seed % 2 == 1)  // two stiffnesses, lower than before, because Bullet's own force supports at most two
      for (Spring& s : scene.model.find<Springs>()->list) s.k = s.k < 100 ? 10 : 100;
    const auto [apart, growth] = compare(scene, default_run(scene));
    EXPECT_LE(apart, allowed(growth)) << "growth " << growth;
    EXPECT_LT(growth, 1e3);
    worst = std::max(worst, apart / allowed(growth)), most = std::max(most, growth);
    const Outcome out = run_and_record("bullet/deformable-explicit", scene, {scene.step, scene.step, 1}).outcome;
    by_bullet += out.readback->mapped.at("stiffness").starts_with("Bullet's own");
  }
  EXPECT_GE(by_bullet, 100);
  fmt::print("random scenes: at most {:.2g} of the bound, growth up to {:.3g}, {} by Bullet's own force\n", worst, most,
             by_bullet);
}

/// Symplectic Euler in Bullet's order of operations: impulses h f are summed into w link by link, then those of
/// gravity; v += w (1/m); v loses the fraction h gamma; x += h v. The force of a link is k (d - n r) with n = d (1 /
/// |d|).
std::vector<Points> in_bullets_order(const Scene& scene, const crosscheck::Run& run) {
  const Model& model = scene.model;
  const int n = model.particles.size();
  const auto [h, steps, samples] = time_grid(run);
  const double share = h * uniform_drag_rate(model).value_or(0), kept = 1 - share;
  const Vec3 g = model.find<Gravity>()->acceleration / kept;
  Points x = scene.start.x, v = scene.start.v, w(3, n);
  std::vector<Points> frames{x};
  for (int step = 1; step <= steps * samples; ++step) {
    w.setZero();
    for (const Spring& s : model.find<Springs>()->list) {
      const Vec3 d = x.col(s.b) - x.col(s.a);
      const double length = std::sqrt(d.x() * d.x() + d.y() * d.y() + d.z() * d.z());
      const Vec3 along = d * (1 / length);
      const Vec3 impulse = (h * (s.k / kept)) * (d - along * s.rest);
      w.col(s.a) += impulse;
      w.col(s.b) -= impulse;
    }
    for (int i = 0; i < n; ++i) {
      if (model.particles.pinned[i]) continue;
      const double inverse = 1 / model.particles.mass[i];
      w.col(i) += (h * g) * (1 / inverse);
      v.col(i) += inverse * w.col(i);
      v.col(i) *= kept;
      x.col(i) += h * v.col(i);
    }
    if (step % steps == 0) frames.push_back(x);
  }
  return frames;
}

TEST(BulletIdentity, BitForBitInBulletsOrderOfOperations) {
  for (const Scene& scene :
       {load_scene("spring"), load_scene("pendulum"), load_scene("chain"), without_drag(load_scene("chain")),
        with_grid("cloth-hang", 6), without_drag(with_grid("cloth-hang", 8)), load_scene("cloth-student")}) {
    SCOPED_TRACE(scene.name);
    const crosscheck::Run run{scene.step, std::min(scene.duration, 2.0), 20};
    const Trajectory theirs = run_and_record("bullet/deformable-explicit", scene, run).trajectory;
    const std::vector<Points> loop = in_bullets_order(scene, run);
    ASSERT_EQ(theirs.x.size(), loop.size());
    for (size_t i = 0; i < loop.size(); ++i)
      EXPECT_EQ((theirs.x[i] - loop[i]).cwiseAbs().maxCoeff(), 0) << "frame " << i;
  }
}

using namespace testing_tools;

TEST(Bullet32, IsSymplecticEulerWithinTheRoundOffOfSinglePrecision) {
  int compared = 0;
  for (const auto& name : shipped_scenes()) {
    const Scene scene = load_scene(std::string(name));
    if (has_contact(scene.model)) continue;
    SCOPED_TRACE(name);
    // one second of the cloths: 2000 steps are enough for the random walk
    const double until = scene.start.x.cols() > 50 ? std::min(1.0, scene.window) : scene.window;
    const int samples = std::max(2, static_cast<int>(std::lround(scene.samples * until / scene.duration)));
    const crosscheck::Run run{scene.step, until, samples};
    const MethodRun theirs = run_and_record("bullet32/deformable-explicit", scene, run);
    if (theirs.outcome.verdict == Verdict::unsupported) {
      EXPECT_EQ(run_and_record("bullet/deformable-explicit", scene, run).outcome.reason, theirs.outcome.reason);
      continue;
    }
    const MethodRun ours = run_and_record("symplectic-euler", scene, run);
    ASSERT_EQ(theirs.outcome.verdict == Verdict::ok, ours.outcome.verdict == Verdict::ok) << theirs.outcome.reason;
    if (ours.outcome.verdict != Verdict::ok) {
      // A stiff cloth blows up at this step in any precision. Bullet clamps speeds, so that its run may be flagged for
      // stretch before it is flagged for energy.
      EXPECT_EQ(ours.outcome.verdict, Verdict::energy);
      EXPECT_TRUE(theirs.outcome.verdict == Verdict::energy || theirs.outcome.verdict == Verdict::stretch)
          << theirs.outcome.reason;
      continue;
    }
    EXPECT_FALSE(certify("bullet32", scene, theirs.outcome).mismatch());
    const double growth = perturbation_growth(find_method("symplectic-euler"), scene, scene.step, until);
    const double motion = motion_of(ours.trajectory);
    const auto bound = single_precision_bound(scene, motion, growth, ours.outcome.steps);
    ASSERT_TRUE(bound);
    const double apart = sup_distance(ours.trajectory, theirs.trajectory);
    EXPECT_LE(apart, *bound);
    // Single precision loses at least half an ulp of the motion at least once; double precision does not.
    EXPECT_GT(apart, 3e-8 * motion);
    EXPECT_GT(apart,
              1e6 * sup_distance(ours.trajectory, run_and_record("bullet/deformable-explicit", scene, run).trajectory));
    ++compared;
  }
  EXPECT_GE(compared, 8);
}

TEST(Bullet32, SaysThatItIsSingleAndPassesOptionsOn) {
  const Scene scene = load_scene("chain");
  const crosscheck::Run run{scene.step, 0.1, 5};
  const Outcome one = run_and_record("bullet32/pbd", scene, run).outcome,
                ten = run_and_record("bullet32/pbd+n=10", scene, run).outcome;
  ASSERT_TRUE(one.readback && ten.readback);
  EXPECT_EQ(one.readback->precision, "single");
  EXPECT_TRUE(contains(one.readback->mapped.at("stiffness"), "-1/1)"));
  EXPECT_TRUE(contains(ten.readback->mapped.at("stiffness"), "-1/10)"));
  EXPECT_EQ(one.different_law, run_and_record("bullet/pbd", scene, run).outcome.different_law);
  EXPECT_GT(one.process_seconds, 0);
  for (const Outcome& out : {one, ten}) {
    const Certificate certificate = certify("bullet32/pbd", scene, out);
    EXPECT_FALSE(certificate.mismatch());
    bool said = false;
    for (const CertificateRow& row : certificate.rows)
      said |= row.quantity == "precision" && row.parity == Parity::different_law;
    EXPECT_TRUE(said);
  }
  EXPECT_EQ(run_and_record("bullet32/deformable-explicit", load_scene("slide"), {1e-3, 0.1, 2}).outcome.verdict,
            Verdict::ok);
  EXPECT_TRUE(
      contains(run_and_record("bullet32/pbd", load_scene("circle"), {1e-2, 0.1, 2}).outcome.reason, "first-order"));
}

TEST(Bullet32, RunsWhenNamedOnly) {
  Request request;
  for (const Method& m : methods_of(request, load_scene("chain"))) EXPECT_FALSE(m.name.starts_with("bullet32/"));
  int known = 0;
  for (const Method& m : all_methods()) known += m.name.starts_with("bullet32/");
  EXPECT_GE(known, 2);
  EXPECT_EQ(find_method("bullet32/deformable-explicit").rule, "") << "its round-off is of a different magnitude";
}

}  // namespace
}  // namespace crosscheck
