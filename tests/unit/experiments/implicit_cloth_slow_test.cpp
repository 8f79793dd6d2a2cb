// Implicit steps of large cloths, which take seconds.

#include <gtest/gtest.h>

#include "experiments/scenes/cloths.h"
#include "mysim/implicit/newton.h"

namespace crosscheck {
namespace {

/// Before it wrinkles to either side, a flat cloth stays near saddles of the potential, where Newton's steps are short.
TEST(ImplicitCloth, WrinklesOfALargeSheetAtLongStepsAreFound) {
  const Scene scene = hanging_cloth(128);
  System f(scene.model);
  ImplicitStep step(f);
  State s = scene.start;
  for (int i = 0; i < 8; ++i) {
    ASSERT_NO_THROW(s = step.solve(s, 1 / 70.)) << "step " << i;
    EXPECT_LT(step.descent().back(), step.descent().front()) << "step " << i;
  }
}

}  // namespace
}  // namespace crosscheck
