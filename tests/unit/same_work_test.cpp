// What suzuki4 is for: for the same number of force evaluations it is more accurate than rk4.
#include "experiments/scenes.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Error of rk4 at h over that of suzuki4 at 1.25 h: both take 4 evaluations in each h.
double advantage(const Scene& scene, double h, double duration) {
  // sampling at multiples of 5 h, which both steps divide
  const int samples = static_cast<int>(std::lround(duration / (20 * h)));
  const Trajectory truth = trajectory_of(at_fixed_step(stepper("dopri5")), scene, {h / 4, duration, samples});
  Recorder one, other;
  const Outcome a = simulate(stepper("rk4"), ContactRule::coulomb, scene, {h, duration, samples}, one);
  const Outcome b = simulate(stepper("suzuki4"), ContactRule::coulomb, scene, {1.25 * h, duration, samples}, other);
  EXPECT_EQ(a.evaluations, b.evaluations);
  const double rk4 = sup_rms(one.trajectory, truth), suzuki4 = sup_rms(other.trajectory, truth);
  fmt::print("{:12} h = {:.3g} s: rk4 {:.3g} m, suzuki4 {:.3g} m, {:.2f} times\n", scene.name, h, rk4, suzuki4,
             rk4 / suzuki4);
  return rk4 / suzuki4;
}

TEST(SameWork, Suzuki4IsTwiceAsAccurateAsRk4OnTheChain) {
  for (const double h : {2e-3, 1e-3, 5e-4}) EXPECT_GT(advantage(load_scene("chain"), h, 1), 2);
}

TEST(SameWork, Suzuki4IsTwiceAsAccurateAsRk4OnTheHangingCloth) {
  for (const double h : {7.5e-4, 3.75e-4}) EXPECT_GT(advantage(load_scene("cloth-hang"), h, 0.15), 2);
}

}  // namespace
}  // namespace crosscheck
