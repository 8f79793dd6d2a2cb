// A cloth far too stiff for explicit rules, a minute long: every implicit step descends, and nothing blows up.
#include "mysim/implicit/newton.h"
#include "mysim/observers/watch.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(ImplicitEulerForAMinute, DescendsInEveryStepOfAStiffClothAndStaysBounded) {
  const Scene scene = small_scene(std::string("[grid]\nsize = [10, 10]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\n"
                                              "v = [0, 0, 1]\nmass = 0.25\n[grid.stiffness]\nstructural = 2e5\n"
                                              "shear = 2e5\nbend = 2e5\n[pins]\nparticles = [0, 9]\n"
                                              "[drag]\ngamma = 4\n") +
                                  gravity_text);
  const double h = 1.0 / 60;  // s; explicit rules need h < 8e-5 s
  System f(scene.model);
  ImplicitStep step(f);
  Watch watch(scene.model);
  State s = scene.start;
  watch.observe(s, true);
  long newton_steps = 0;
  int most = 0;
  double highest_rise = 0;
  for (int n = 1; n <= 3600; ++n) {
    ASSERT_NO_THROW(s = step.solve(s, h)) << n;
    s.t = n * h;
    scene.model.particles.place_pins(s);
    const std::vector<double>& values = step.descent();
    // two values differ by the rounding of both
    const double rounding = 2 * step.potential().rounding();
    for (size_t i = 1; i < values.size(); ++i) {
      highest_rise = std::max(highest_rise, (values[i] - values[i - 1]) / rounding);
      ASSERT_LE(values[i], values[i - 1] + rounding) << "step " << n;
    }
    newton_steps += static_cast<long>(values.size()) - 1;
    most = std::max(most, static_cast<int>(values.size()) - 1);
    ASSERT_EQ(watch.observe(s, true), Verdict::ok) << n;
    // the cloth hangs within its diagonal (1.4 m) of its pins, but for what the springs give: m g / k = 1e-5 m
    ASSERT_LT(s.x.colwise().norm().maxCoeff(), 2);
  }
  fmt::print("stiff cloth: {:.1f} Newton steps a step, {} at most, {} evaluations, highest rise {:.2g} roundings\n",
             double(newton_steps) / 3600, most, f.evaluations(), highest_rise);
}

}  // namespace
}  // namespace crosscheck
