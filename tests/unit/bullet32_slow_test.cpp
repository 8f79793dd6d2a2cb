// Single-precision Bullet, as a program of its own: the same rule within the round-off of 24 bits.
#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/scenes.h"
#include "reference/certificate.h"
#include "reference/method.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Bullet32, IsSymplecticEulerWithinTheRoundOffOfSinglePrecision) {
  int compared = 0;
  for (const auto name : shipped_scenes()) {
    const Scene scene = load_scene(std::string(name));
    if (scene.model.find<Spheres>()) continue;
    SCOPED_TRACE(name);
    // a second of the cloths: 2000 steps are a walk long enough
    const double until = scene.start.x.cols() > 50 ? std::min(1.0, scene.window) : scene.window;
    const int samples = std::max(2, static_cast<int>(std::lround(scene.samples * until / scene.duration)));
    const crosscheck::Run run{scene.step, until, samples};
    const Answered theirs = answer("bullet32/deformable-explicit", scene, run);
    if (theirs.outcome.verdict == Verdict::unsupported) {
      EXPECT_EQ(answer("bullet/deformable-explicit", scene, run).outcome.reason, theirs.outcome.reason);
      continue;
    }
    const Answered ours = answer("symplectic-euler", scene, run);
    ASSERT_EQ(theirs.outcome.verdict == Verdict::ok, ours.outcome.verdict == Verdict::ok) << theirs.outcome.reason;
    if (ours.outcome.verdict != Verdict::ok) {
      // a stiff cloth blows up at this step in any precision; Bullet clamps speeds, so that lengths may tell first
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
    // and it is single precision: half an ulp of the motion is lost at least once, which double precision would not do
    EXPECT_GT(apart, 3e-8 * motion);
    EXPECT_GT(apart, 1e6 * sup_distance(ours.trajectory, answer("bullet/deformable-explicit", scene, run).trajectory));
    ++compared;
  }
  EXPECT_GE(compared, 8);
}

TEST(Bullet32, SaysThatItIsSingleAndPassesOptionsOn) {
  const Scene scene = load_scene("chain");
  const crosscheck::Run run{scene.step, 0.1, 5};
  const Outcome one = answer("bullet32/pbd", scene, run).outcome, ten = answer("bullet32/pbd+n=10", scene, run).outcome;
  ASSERT_TRUE(one.readback && ten.readback);
  EXPECT_EQ(one.readback->precision, "single");
  EXPECT_TRUE(contains(one.readback->mapped.at("stiffness"), "-1/1)"));
  EXPECT_TRUE(contains(ten.readback->mapped.at("stiffness"), "-1/10)"));
  EXPECT_EQ(one.different_law, answer("bullet/pbd", scene, run).outcome.different_law);
  EXPECT_GT(one.process_seconds, 0);
  for (const Outcome& out : {one, ten}) {
    const Certificate certificate = certify("bullet32/pbd", scene, out);
    EXPECT_FALSE(certificate.mismatch());
    bool said = false;
    for (const CertificateRow& row : certificate.rows)
      said |= row.quantity == "precision" && row.parity == Parity::different_law;
    EXPECT_TRUE(said);
  }
  // a contact, and a refusal, come through as they are
  EXPECT_EQ(answer("bullet32/deformable-explicit", load_scene("slide"), {1e-3, 0.1, 2}).outcome.verdict, Verdict::ok);
  EXPECT_TRUE(contains(answer("bullet32/pbd", load_scene("circle"), {1e-2, 0.1, 2}).outcome.reason, "first-order"));
}

TEST(Bullet32, RunsWhenNamedOnly) {
  Request request;
  for (const Method& m : methods_of(request, load_scene("chain"))) EXPECT_FALSE(m.name.starts_with("bullet32/"));
  int known = 0;
  for (const Method& m : all_methods()) known += m.name.starts_with("bullet32/");
  EXPECT_GE(known, 2);
  EXPECT_EQ(find_method("bullet32/deformable-explicit").rule, "") << "its round-off is of another size";
}

}  // namespace
}  // namespace crosscheck
