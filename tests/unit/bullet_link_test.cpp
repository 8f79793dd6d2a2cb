// Bullet's link law and hard distances: to what its position-based world converges, and what each world refuses.
#include "experiments/scenes.h"
#include "reference/certificate.h"
#include "reference/method.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(BulletLink, PositionBasedWorldConvergesToItsLinkLawAndNotToHookes) {
  const Scene linked = load_scene("chain-link");
  Scene hooke = linked;
  hooke.model.find<Springs>()->law = SpringLaw::hooke;
  const crosscheck::Run fine{1e-4, 1.5, 30};
  const Trajectory to_link = answer("rk4", linked, fine).trajectory, to_hooke = answer("rk4", hooke, fine).trajectory;
  std::vector<double> link, law;
  for (const double h : {1e-3, 5e-4, 2.5e-4, 1.25e-4}) {
    const Trajectory t = answer("bullet/pbd", linked, {h, 1.5, 30}).trajectory;
    link.push_back(sup_rms(t, to_link));
    law.push_back(sup_rms(t, to_hooke));
  }
  fmt::print("bullet/pbd from its link law {:.3g} to {:.3g} m, from Hooke's {:.3g} to {:.3g} m\n", link.front(),
             link.back(), law.front(), law.back());
  for (size_t i = 1; i < link.size(); ++i)
    EXPECT_NEAR(slope(link[i - 1], link[i]), 1, 0.1);  // first order; the next term is h omega = 0.03
  // what is left against Hooke is the law: a tenth of the force at these strains
  EXPECT_GT(law.back(), 10 * link.back());
  EXPECT_GT(law.back(), 0.01);
}

TEST(BulletLink, ExplicitWorldFollowsTheLinkLawToRoundOff) {
  const Scene scene = load_scene("chain-link");
  const Answered ours = answer("symplectic-euler", scene, default_run(scene)),
                 theirs = answer("bullet/deformable-explicit", scene, default_run(scene));
  EXPECT_LE(sup_distance(ours.trajectory, theirs.trajectory), 1e-12);  // the bound of the identity tests
  EXPECT_FALSE(certify("bullet/deformable-explicit", scene, theirs.outcome).mismatch());
  // an engine that pulled by Hooke's law would be found out
  Scene hooke = scene;
  hooke.model.find<Springs>()->law = SpringLaw::hooke;
  const Answered other = answer("bullet/deformable-explicit", hooke, default_run(scene));
  EXPECT_TRUE(certify("bullet/deformable-explicit", scene, other.outcome).mismatch());
}

TEST(BulletLink, HardDistancesAreLinksThatGiveWayToNothing) {
  for (const auto name : {"rod", "cloth-inextensible"}) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene(name);
    const crosscheck::Run run{scene.step, 0.5, 10};
    const Answered one = answer("bullet/pbd", scene, run), ten = answer("bullet/pbd+n=10", scene, run);
    const Certificate certificate = certify("bullet/pbd", scene, one.outcome);
    EXPECT_FALSE(certificate.mismatch());
    bool told = false;
    for (const CertificateRow& row : certificate.rows) told |= row.quantity == "hard distances";
    EXPECT_TRUE(told);
    auto stretch = [&](const Answered& a) {
      double worst = 0;
      for (const Points& x : a.trajectory.x)
        worst = std::max(worst, largest_stretch(*scene.model.find<Constraints>(), x));
      return worst;
    };
    EXPECT_LT(stretch(one), 0.02);
    EXPECT_LT(stretch(ten), 0.5 * stretch(one));  // more iterations help
    EXPECT_LT(sup_rms(one.trajectory, truth_of(scene, run)->trajectory), 0.02);
    // a length that was changed on the way is a mismatch
    Outcome wrong = one.outcome;
    wrong.readback->links.back().rest *= 1.001;
    EXPECT_TRUE(certify("bullet/pbd", scene, wrong).mismatch());
    const Outcome refused = answer("bullet/deformable-explicit", scene, run).outcome;
    EXPECT_EQ(refused.verdict, Verdict::unsupported);
    EXPECT_TRUE(contains(refused.reason, "no hard distances"));
  }
}

TEST(BulletLink, EverySceneIsHandedOverOrRefusedWithTheReason) {
  const std::pair<std::string, std::string> refused[] = {{"circle", "first-order"}, {"bounce", "restitution"}};
  for (const auto name : shipped_scenes())
    for (const auto method : {"bullet/deformable-explicit", "bullet/deformable-implicit", "bullet/pbd"}) {
      const Scene scene = load_scene(std::string(name));
      const Outcome out = answer(method, scene, {scene.step, 2 * scene.step, 1}).outcome;
      std::string reason;
      for (const auto& [which, why] : refused)
        if (which == name) reason = why;
      if (scene.model.find<Constraints>() && method != std::string("bullet/pbd")) reason = "hard distances";
      EXPECT_EQ(out.verdict == Verdict::unsupported, !reason.empty()) << name << ", " << method << ": " << out.reason;
      EXPECT_TRUE(contains(out.reason, reason));
    }
}

}  // namespace
}  // namespace crosscheck
