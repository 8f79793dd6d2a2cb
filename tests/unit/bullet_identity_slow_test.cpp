// Bullet's explicit world is mysim's symplectic Euler: on every contact-free shipped scene at three steps and in three
// sizes, on 200 random networks, and bit for bit where the sums are taken in Bullet's order.
#include "experiments/metrics.h"
#include "mysim/frequency.h"
#include "reference/certificate.h"
#include "tests/unit/random_scenes.h"
#include "tests/unit/resized.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Both sum the same forces in another order: a difference of some 1e-15 m (an ulp of some metres) in each step, which
/// adds up like a random walk over thousands of steps, to 100 times that, and grows as every perturbation does. No
/// tighter than 1e-12 m: what rounding does to velocities drifts on, by sqrt(N) T h eps k L / m in N steps. (Springs of
/// 200 000 N/m in a cloth coarser than those tried here reach 4e-12 m by that.)
double allowed(double growth) { return 1e-13 * std::max(10.0, growth); }

struct Comparison {
  double apart, growth;
};

Comparison compare(const Scene& scene, const crosscheck::Run& run) {
  const Answered ours = answer("symplectic-euler", scene, run),
                 theirs = answer("bullet/deformable-explicit", scene, run);
  EXPECT_EQ(ours.outcome.verdict, Verdict::ok) << ours.outcome.reason;
  EXPECT_EQ(theirs.outcome.verdict, Verdict::ok) << theirs.outcome.reason;
  EXPECT_TRUE(theirs.outcome.different_law.empty());
  EXPECT_FALSE(certify("bullet/deformable-explicit", scene, theirs.outcome).mismatch());
  EXPECT_GT(motion_of(ours.trajectory), 1e-4);
  Scene shortened = scene;  // the growth is measured at the samples of this run
  shortened.duration = run.duration, shortened.samples = run.samples;
  return {sup_distance(ours.trajectory, theirs.trajectory),
          perturbation_growth(find_method("symplectic-euler"), shortened, run.step, run.duration)};
}

bool compared(const Scene& scene) {
  const Model& model = scene.model;
  return !model.first_order() && !model.find<Spheres>() && !model.find<Dashpots>() && !model.find<Constraints>();
}

TEST(BulletIdentity, OnEveryContactFreeShippedSceneAtThreeStepsInThreeSizes) {
  int scenes = 0;
  for (const auto name : shipped_scenes()) {
    if (!compared(load_scene(std::string(name)))) continue;
    ++scenes;
    double worst = 0, most = 0;
    for (const Scene& scene : three_sizes(std::string(name))) {
      const double omega = fastest_frequency(scene.model, scene.start);
      const double limit =
          omega > 0 ? stepper("symplectic-euler").limit(omega, uniform_drag_rate(scene.model).value_or(0)) : INFINITY;
      const double middle = scene.step < 0.8 * limit ? scene.step : limit / 2;
      for (const double step : {middle / 2, middle, std::min(1.5 * middle, 0.9 * limit)}) {
        SCOPED_TRACE(fmt::format("{} ({} particles, {:.3g} m) at {:.3g} s", name, scene.model.particles.size(),
                                 scene.size(), step));
        const auto [apart, growth] = compare(scene, {step, std::min(scene.window, 1500 * step), 20});
        EXPECT_LE(apart, allowed(growth)) << "growth " << growth;
        EXPECT_LT(growth, 1e3);  // else little would be tested
        worst = std::max(worst, apart / allowed(growth)), most = std::max(most, growth);
      }
    }
    fmt::print("{:16} at most {:.2g} of the bound, growth up to {:.3g}\n", name, worst, most);
  }
  EXPECT_EQ(scenes, 12);
}

TEST(BulletIdentity, OnTwoHundredRandomContactFreeScenes) {
  double worst = 0, most = 0;
  int by_bullet = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene = random_contact_free_scene(seed);
    if (seed % 2 == 1)  // two stiffnesses, softer than before: Bullet's own force can carry them
      for (Spring& s : scene.model.find<Springs>()->list) s.k = s.k < 100 ? 10 : 100;
    const auto [apart, growth] = compare(scene, default_run(scene));
    EXPECT_LE(apart, allowed(growth)) << "growth " << growth;
    EXPECT_LT(growth, 1e3);
    worst = std::max(worst, apart / allowed(growth)), most = std::max(most, growth);
    const Outcome out = answer("bullet/deformable-explicit", scene, {scene.step, scene.step, 1}).outcome;
    by_bullet += out.readback->mapped.at("stiffness").starts_with("Bullet's own");
  }
  EXPECT_GE(by_bullet, 100);
  fmt::print("random scenes: at most {:.2g} of the bound, growth up to {:.3g}, {} by Bullet's own force\n", worst, most,
             by_bullet);
}

/// Symplectic Euler in Bullet's order: impulses h f are summed link by link, then gravity's; v += w (1/m); v loses the
/// share h gamma; x += h v. The force of a link is k (d - n r) with n = d (1 / |d|).
std::vector<Points> in_bullets_order(const Scene& scene, const crosscheck::Run& run) {
  const Model& model = scene.model;
  const int n = model.particles.size();
  const auto [h, steps, samples] = plan(run);
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
    const Trajectory theirs = answer("bullet/deformable-explicit", scene, run).trajectory;
    const std::vector<Points> loop = in_bullets_order(scene, run);
    ASSERT_EQ(theirs.x.size(), loop.size());
    for (size_t i = 0; i < loop.size(); ++i)
      EXPECT_EQ((theirs.x[i] - loop[i]).cwiseAbs().maxCoeff(), 0) << "frame " << i;
  }
}

}  // namespace
}  // namespace crosscheck
