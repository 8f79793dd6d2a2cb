// The certificate against mismatches that are really built: a mutant of the scene is run in each of Bullet's worlds and
// certified against the honest scene.
#include "experiments/scenes.h"
#include "reference/certificate.h"
#include "tests/unit/mutations.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

const std::vector<std::string> worlds = {"bullet/deformable-explicit", "bullet/deformable-implicit", "bullet/pbd"};

Certificate certificate_of(const std::string& method, const Scene& built, const Scene& asked) {
  const crosscheck::Run run{1e-3, 2e-3, 1};
  const Outcome out = answer(method, built, run).outcome;
  EXPECT_TRUE(out.readback) << out.reason;
  return certify(method, asked, out);
}

std::string mismatches(const Certificate& c) {
  std::string all;
  for (const CertificateRow& row : c.rows)
    if (row.parity == Parity::mismatch) all += "[" + row.quantity + "] ";
  return all;
}

void expect_caught(const Scene& honest, std::span<const Mutation> mutations) {
  for (const std::string& world : worlds) {
    EXPECT_EQ(mismatches(certificate_of(world, honest, honest)), "") << world;
    for (const Mutation& m : mutations) {
      Scene mutant = honest;
      m.mutate(mutant);
      const Certificate c = certificate_of(world, mutant, honest);
      if (m.blind.contains(world)) {
        // exceptions stand in the table: should the world learn to tell, they are to go
        EXPECT_FALSE(c.mismatch()) << world << ": " << m.what << ": " << mismatches(c);
        continue;
      }
      bool named = false;
      for (const CertificateRow& row : c.rows)
        for (const std::string& q : m.quantities)
          named |= row.parity == Parity::mismatch && row.quantity.starts_with(q);
      EXPECT_TRUE(named) << world << ": " << m.what << ": found " << mismatches(c);
    }
  }
}

TEST(SeededMismatch, OfEveryIngredientIsCaughtInEveryWorldThatCanTell) { expect_caught(draped(), of_the_drape); }
TEST(SeededMismatch, OfTheAirIsCaught) { expect_caught(in_air(), of_the_sheet); }

TEST(SeededMismatch, OfPrescribedMotionsIsCaught) {
  expect_caught(small_cloth(), of_the_swing);
  expect_caught(load_scene("cloth-carried"), of_the_carried);
  expect_caught(draped(), of_a_still_one);
  // an engine that does not tell them is not taken to have them
  for (const Scene& scene : {small_cloth(), load_scene("cloth-carried")}) {
    Outcome silent = answer("bullet/pbd", scene, {1e-3, 2e-3, 1}).outcome;
    silent.readback->later.reset();
    bool said = false;
    for (const CertificateRow& row : certify("bullet/pbd", scene, silent).rows)
      said |= row.quantity.starts_with("motion of") && row.parity == Parity::unattested;
    EXPECT_TRUE(said);
  }
}

TEST(SeededMismatch, OfTheStepIsCaught) {
  for (const std::string& world : worlds) {
    const Scene scene = draped();
    Outcome slow = answer(world, scene, {2e-3, 4e-3, 1}).outcome;
    slow.step = 1e-3;  // as the comparison asked
    EXPECT_EQ(mismatches(certify(world, scene, slow)), "[step] ") << world;
  }
}

TEST(SeededMismatch, ByBulletsOwnDefaultsIsCaught) {
  const Scene drape = draped(), spring = load_scene("spring");
  EXPECT_TRUE(contains(mismatches(certificate_of("bullet/deformable-explicit+default-rest", spring, spring)), "rest"));
  EXPECT_TRUE(contains(mismatches(certificate_of("bullet/pbd+default-rest", spring, spring)), "rest"));
  EXPECT_TRUE(
      contains(mismatches(certificate_of("bullet/deformable-explicit+default-margin", drape, drape)), "[margin]"));
  EXPECT_EQ(mismatches(certificate_of("bullet/deformable-explicit+default-margin", spring, spring)), "");
  for (const Scene& scene : {drape, spring})
    EXPECT_EQ(mismatches(certificate_of("bullet/deformable-explicit+default-sleep", scene, scene)), "[sleeping] ");
}

}  // namespace
}  // namespace crosscheck
