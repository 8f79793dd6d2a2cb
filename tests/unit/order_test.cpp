// Orders of all steppers, two-sided: first-order scenes, springs, drag, moved pins, dashpots and air.
#include "reference/exact/exact.h"
#include "tests/unit/declared.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Orders, OnCircleAgainstTheExactSolution) {
  const Scene scene = load_scene("circle");
  const auto exact = exact_solution(scene);
  ASSERT_TRUE(exact);
  const crosscheck::Run run{0, 6, 40};
  Trajectory truth;
  for (int i = 0; i <= run.samples; ++i) {
    const State s = exact->at(run.duration * i / run.samples);
    truth.t.push_back(s.t), truth.x.push_back(s.x), truth.v.push_back(s.v);
  }
  for (const Stepper& s : fixed_steppers()) {
    if (!s.first_order) continue;
    SCOPED_TRACE(s.name);
    // the next term of the error changes the slope by about h omega: at most 0.04 here, 0.1 with room
    const double h = s.order == 1 ? 0.002 : s.order == 2 ? 0.02 : 0.1;
    EXPECT_NEAR(measured_order(s, scene, truth, h, run), s.order, 0.1);
  }
}

TEST(Orders, OnPendulumPlainDampedAndMovedByHand) {
  const Scene plain = load_scene("pendulum");
  Scene moved = with_drag(plain, 1);
  moved.model.particles.move = Motion{{0.1, 0.05, 0}, 1, 0.4};
  const double omega = std::sqrt(1000.0);
  const crosscheck::Run run{0, 1, 20};
  const struct {
    std::string name;
    Scene scene;
  } cases[] = {{"plain", plain}, {"drag", with_drag(plain, 2)}, {"moved pin and drag", moved}};
  for (const auto& c : cases) {
    const Trajectory truth = trajectory_of(stepper("rk4"), c.scene, {0.005 / omega, run.duration, run.samples});
    for (const Stepper& s : fixed_steppers()) {
      SCOPED_TRACE(c.name + ", " + std::string(s.name));
      ASSERT_LT(h_omega_for(s.order), 0.6);  // above it rk4 does not show its order (facts/scenes.md, section 4)
      // the next term of the error is smaller by h omega (0.3 at most: it bends the slope by half of that), and
      // amplitude growth (h omega^2 t / 2) bends order 1 by 0.05
      const double order = measured_order(s, c.scene, truth, h_omega_for(s.order) / omega, run);
      fmt::print("pendulum, {:18} {:18} order {:.3f}\n", c.name, s.name, order);
      EXPECT_NEAR(order, s.order, s.order > 4 ? 0.2 : 0.1);
    }
  }
}

TEST(Orders, SurviveDashpotsAirAndPinsMovedByHand) {
  const Scene scene = small_cloth_in_air();
  const crosscheck::Run run{0, 0.25, 5};  // the ramp ends with it: its third derivative jumps there
  const Trajectory truth = trajectory_of(stepper("rk4"), scene, {6.25e-5, run.duration, run.samples});
  for (const Stepper& s : fixed_steppers()) {
    SCOPED_TRACE(s.name);
    // h omega at the cloth's fastest wave (180 rad/s): 0.02, 0.05 and 0.2
    const double h = s.order == 1 ? 1e-4 : s.order == 2 ? 2.5e-4 : 1.25e-3;
    const double order = measured_order(s, scene, truth, h, run);
    fmt::print("cloth in air, {:18} order {:.3f}\n", s.name, order);
    EXPECT_NEAR(order, s.order, 0.25);  // the next term is h omega of the leading one
  }
}

}  // namespace
}  // namespace crosscheck
