
#include "experiments/translate/translated_run.h"

#include "experiments/metrics.h"
#include "tests/unit/experiments/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TranslatedRun run(const Scene& scene, const std::string& to, double h) {
  const Translation t = translate(scene, find_target(to, 0), h);
  return run_translated(scene, t, *t.target.runs);
}

TEST(TranslatedRun, ErrsAsTheEngineDoes) {
  // Translating a scene and translating it back yields the scene up to rounding. The remaining error is that of the
  // engine at this step.
  const Scene scene = load_scene("chain");
  for (const std::string to : {"bullet/pbd+n=4", "bullet/deformable-implicit", "mysim/xpbd"}) {
    const crosscheck::Run at = default_run(scene);
    const TranslatedRun translated = run(scene, to, time_grid(at).h);
    const MethodRun own = run_and_record(to, scene, at);
    const auto truth = truth_of(scene, at);
    ASSERT_TRUE(truth && translated.error) << to;
    const double error = largest_rms_distance(own.trajectory, truth->trajectory, scene.window);
    EXPECT_GT(error, 100 * truth->error_bar);
    EXPECT_NEAR(*translated.error, error, 1e-6 * error) << to;
    EXPECT_FALSE(translated.difference);
    EXPECT_EQ(translated.motion, motion_of(truth->trajectory));
  }
}

TEST(TranslatedRun, OfOneSliderIsWorseThanOfOneForEachLink) {
  // strains are 1e-4, for which the link law agrees with Hooke's law to 5e-5
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 0.1\n[[particle]]\nposition = [0, -1, 0]\nmass = 0.1\n[[particle]]\n"
      "position = [0, -2, 0]\nmass = 0.1\n[[spring]]\nends = [0, 1]\nstiffness = 200\n[[spring]]\nends = [1, 2]\n"
      "stiffness = 200\n[pins]\nparticles = [0]\n[gravity]\nacceleration = [0, -0.05, 0]\n");
  const double h = 1e-3;
  const TranslatedRun links = run(scene, "bullet/pbd+n=5", h), slider = run(scene, "godot", h);
  ASSERT_TRUE(links.error && slider.error);
  EXPECT_GT(*slider.error, 2 * *links.error) << "the link to the pin is twice as stiff";
  EXPECT_EQ(slider.method, "bullet/pbd+n=5");
}

TEST(TranslatedRun, WithContactOfWhichNoTruthIsKnownIsADifferenceAndNoError) {
  // Two particles on a spring above a moving ball, which they reach after 0.2 s. The ball is listed twice, which the
  // second solution does not support, so that only the solution under the contact rule remains.
  const std::string ball =
      "[[sphere]]\ncentre = [0, 0, 0]\nradius = 1\nmargin = 0.1\nfriction = 0.3\n"
      "[sphere.motion]\namplitude = [0, 0.01, 0]\nfrequency = 0.5\nramp = 0.5\n";
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 1.3, 0]\nmass = 0.1\n[[particle]]\nposition = [0.2, 1.3, 0]\nmass = "
      "0.1\n[[spring]]\n"
      "ends = [0, 1]\nstiffness = 100\n" +
          ball + ball + "[gravity]\nacceleration = [0, -9.81, 0]\n",
      0.4, 1e-3, 40);
  const TranslatedRun translated = run(scene, "bullet/deformable-explicit", 1e-3);
  EXPECT_EQ(translated.outcome.verdict, Verdict::ok) << translated.outcome.reason;
  EXPECT_FALSE(translated.error);
  ASSERT_TRUE(translated.difference);
  EXPECT_GT(*translated.difference, 0);
  EXPECT_TRUE(translated.beside.find("contact rule") != std::string::npos ||
              translated.beside.find("another engine") != std::string::npos)
      << translated.beside;
}

TEST(TranslatedRun, ThatFailsHasNoNumber) {
  const Scene scene = load_scene("chain");
  const TranslatedRun refused = run(load_scene("rod"), "bullet/deformable-implicit", 1e-3);
  EXPECT_EQ(refused.outcome.verdict, Verdict::unsupported);
  EXPECT_FALSE(refused.error || refused.difference);
  const TranslatedRun burst = run(scene, "mysim/leapfrog", 0.1);
  EXPECT_NE(burst.outcome.verdict, Verdict::ok) << "expected a blow-up far beyond its critical step";
  EXPECT_FALSE(burst.error || burst.difference);
}

}  // namespace
}  // namespace crosscheck
