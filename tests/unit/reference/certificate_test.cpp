// The parity certificate matches the scene as built, and detects every manipulation and every real mismatch.

#include <functional>

#include "reference/certificate/certificate.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/mutated_scenes.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Certificate, MatchesOnEveryShippedSceneAndNamesOtherLaws) {
  for (const auto& name : shipped_scene_names())
    for (const auto method : {"bullet/deformable-explicit", "bullet/deformable-implicit",
                              "bullet/deformable-implicit+shipped", "bullet/pbd", "bullet/pbd+n=10"}) {
      SCOPED_TRACE(fmt::format("{} {}", name, method));
      const Scene scene = shipped_scene(std::string(name));
      if (scene.model.first_order()) continue;
      const Outcome out = run_and_record(method, scene, {scene.step, 2 * scene.step, 1}).outcome;
      if (out.verdict == Verdict::unsupported) continue;  // bullet_test.cpp tests the reasons
      ASSERT_TRUE(out.readback);
      for (const CertificateRow& row : certify(method, scene, out).rows)
        EXPECT_EQ(row.parity, row.quantity.starts_with("law of ") ? Parity::different_law : Parity::match)
            << row.quantity << ": requested " << row.requested << ", read back " << row.read_back;
    }
}

TEST(Certificate, RestLengthsSurviveTheFirstStep) {
  // Bullet overwrites rest lengths by the current lengths unless that is disabled. Here the two lengths differ by 10 %.
  for (const auto method : {"bullet/deformable-explicit", "bullet/pbd"}) {
    const Scene scene = shipped_scene("spring");
    const Outcome out = run_and_record(method, scene, {scene.step, 10 * scene.step, 1}).outcome;
    EXPECT_EQ(out.readback->links[0].rest, 1.0);
  }
}

TEST(Certificate, WithoutReadBackNothingIsAttested) {
  const Scene scene = shipped_scene("chain");
  const Certificate c = certify("mysim/rk4", scene, run_and_record("rk4", scene, {1e-2, 0.1, 1}).outcome);
  ASSERT_EQ(c.rows.size(), 1u);
  EXPECT_EQ(c.rows[0].parity, Parity::unattested);
  EXPECT_FALSE(c.mismatch());
}

std::string summary(const std::string& method, const Scene& scene, const Outcome& out) {
  return summary_of(certify(method, scene, out));
}

TEST(Certificate, WhatIsNotToldHasARow) {
  const Scene drape = shipped_scene("cloth-sphere");
  const Outcome honest = run_and_record("bullet/deformable-explicit", drape, {1e-3, 2e-3, 1}).outcome;
  const struct {
    const char* quantity;
    std::function<void(Readback&)> hush;
  } hushed[] = {
      {"spring law", [](Readback& r) { r.probe.reset(); }},
      {"spring law", [](Readback& r) { r.probe->springs.resize(3, 0); }},
      {"gravity", [](Readback& r) { r.gravity.reset(); }},
      {"drag", [](Readback& r) { r.drag.reset(); }},
      {"start", [](Readback& r) { r.start.reset(); }},
      {"spheres", [](Readback& r) { r.spheres.reset(); }},
      {"contact radius", [](Readback& r) { r.spheres->at(0).radius.reset(); }},
      {"friction", [](Readback& r) { r.spheres->at(0).friction.reset(); }},
      {"restitution", [](Readback& r) { r.spheres->at(0).restitution.reset(); }},
      {"step", [](Readback& r) { r.step.reset(); }},
      {"sleeping", [](Readback& r) { r.may_sleep.reset(); }},
      {"nothing else", [](Readback& r) { r.later.reset(); }},  // the scene's sphere is at rest
      {"nothing else", [](Readback& r) { r.probe->wind.resize(3, 0); }},
  };
  EXPECT_TRUE(certify("engine", drape, honest).fully_attested());
  for (const auto& [quantity, hush] : hushed) {
    SCOPED_TRACE(quantity);
    Outcome silent = honest;
    hush(*silent.readback);
    const Certificate c = certify("engine", drape, silent);
    EXPECT_FALSE(c.mismatch());
    EXPECT_FALSE(c.fully_attested());
    EXPECT_TRUE(std::any_of(c.rows.begin(), c.rows.end(), [&](const CertificateRow& row) {
      return row.quantity == quantity && row.parity == Parity::unattested;
    })) << summary_of(c);
    EXPECT_TRUE(contains(summary_of(c), "; not attested: "));
    EXPECT_TRUE(contains(summary_of(c), quantity));
  }
}

TEST(Certificate, AProbeThatStrainsNothingAttestsNothing) {
  const Scene chain = shipped_scene("chain");
  Outcome lazy = run_and_record("bullet/deformable-explicit", chain, {1e-3, 2e-3, 1}).outcome;
  // with all springs at rest, every law gives 0
  for (int i = 1; i < chain.start.x.cols(); ++i)
    lazy.readback->probe->x.col(i) =
        lazy.readback->probe->x.col(i - 1) + chain.model.find<Springs>()->list[i - 1].rest * Vec3(1, 0, 0);
  lazy.readback->probe->springs.setZero();
  EXPECT_TRUE(contains(summary("engine", chain, lazy), "no mismatch; not attested: spring law and stiffness"));
}

TEST(Certificate, SummaryCountsWhatWasReadBack) {
  const Scene chain = shipped_scene("chain");
  const Outcome none = run_and_record("rk4", chain, {1e-2, 0.1, 1}).outcome;
  EXPECT_EQ(summary("engine", chain, none), "nothing was read back; not attested: whole scene");
  const Certificate c{"engine",
                      "scene",
                      {{"masses", "", "", "", Parity::match},
                       {"law of springs", "", "", "", Parity::different_law},
                       {"drag", "", "", "", Parity::unattested}}};
  EXPECT_EQ(summary_of(c), "1 quantity read back, no mismatch; 1 under another law; not attested: drag");
  Certificate wrong = c;
  wrong.rows.push_back({"pins", "", "", "", Parity::mismatch});
  EXPECT_EQ(summary_of(wrong), "2 quantities read back, MISMATCH: pins; 1 under another law; not attested: drag");
}

TEST(Certificate, CatchesEveryTampering) {
  const std::pair<const char*, std::function<void(Readback&)>> tamperings[] = {
      {"a rest length", [](Readback& r) { r.links[40].rest *= 1 + 1e-9; }},
      {"a rest length is nan", [](Readback& r) { r.links[40].rest = NAN; }},
      {"a pin more", [](Readback& r) { r.pinned[30] = 1; }},
      {"a mass", [](Readback& r) { r.mass[30] *= 1 + 1e-9; }},
      {"a mass is nan", [](Readback& r) { r.mass[30] = NAN; }},
      {"a particle less", [](Readback& r) { r.mass.pop_back(), r.pinned.pop_back(); }},
      {"a link's end", [](Readback& r) { ++r.links[7].b; }},
      {"a missing link", [](Readback& r) { r.links.pop_back(); }},
      {"a link twice", [](Readback& r) { r.links.push_back(r.links.back()); }},
      {"gravity twice", [](Readback& r) { *r.gravity *= 2; }},
      {"gravity aside", [](Readback& r) { r.gravity->x() += 1e-6; }},
      {"drag", [](Readback& r) { (*r.drag)[30] *= 1.001; }},
      {"drag is nan", [](Readback& r) { (*r.drag)[30] = NAN; }},
      {"margin", [](Readback& r) { *r.spheres->at(0).radius += 0.005; }},
      {"friction", [](Readback& r) { *r.spheres->at(0).friction *= 0.9; }},
      {"friction is nan", [](Readback& r) { *r.spheres->at(0).friction = NAN; }},
      {"sleeping", [](Readback& r) { r.may_sleep = true; }},
      {"step", [](Readback& r) { *r.step *= 1 + 1e-7; }}};
  const Scene scene = shipped_scene("cloth-sphere");
  for (const auto method : {"bullet/deformable-explicit", "bullet/deformable-implicit", "bullet/pbd"}) {
    const Outcome honest = run_and_record(method, scene, {scene.step, 2 * scene.step, 1}).outcome;
    ASSERT_FALSE(certify(method, scene, honest).mismatch());
    for (const auto& [what, tamper] : tamperings) {
      SCOPED_TRACE(fmt::format("{}: {}", method, what));
      Outcome tampered = honest;
      tamper(*tampered.readback);
      EXPECT_TRUE(certify(method, scene, tampered).mismatch());
    }
    Outcome stiffer = honest;  // one world reports the stiffness per link, the other in the probe
    if (stiffer.readback->probe->springs.size() > 0)
      stiffer.readback->probe->springs.col(5) *= 1.001;
    else
      *stiffer.readback->links[40].stiffness *= 1.001;
    EXPECT_TRUE(certify(method, scene, stiffer).mismatch()) << method;
  }
}

TEST(Certificate, CatchesIngredientsThatTheSceneDoesNotHaveAndOnesThatAreGone) {
  const Scene chain = shipped_scene("chain"), drape = shipped_scene("cloth-sphere");
  const Outcome honest = run_and_record("bullet/deformable-explicit", chain, {1e-3, 2e-3, 1}).outcome;
  auto certified = [&](const std::function<void(Scene&)>& edit) {
    Scene other = chain;
    edit(other);
    return certify("bullet/deformable-explicit", other, honest).mismatch();
  };
  auto without = [](Scene& s, std::string_view term) {
    std::erase_if(s.model.terms, [&](const Term& t) { return name_of(t) == term; });
  };
  EXPECT_FALSE(certified([](Scene&) {}));
  EXPECT_TRUE(certified([&](Scene& s) { without(s, "gravity"); })) << "gravity that is not in the scene";
  EXPECT_TRUE(certified([&](Scene& s) { without(s, "drag"); })) << "drag that is not in the scene";
  EXPECT_TRUE(certified([&](Scene& s) { without(s, "springs"); })) << "springs that are not in the scene";
  // a sphere that the engine does not report must not go unnoticed
  Outcome blind = run_and_record("bullet/deformable-explicit", drape, {1e-3, 2e-3, 1}).outcome;
  blind.readback->spheres.reset();
  bool said = false;
  for (const CertificateRow& row : certify("bullet/deformable-explicit", drape, blind).rows)
    said |= row.quantity == "spheres" && row.parity != Parity::match;
  EXPECT_TRUE(said);
}

}  // namespace

// Each of Bullet's worlds runs a mutant of the scene, and the result is certified against the original scene.

namespace {

using namespace testing_tools;

const std::vector<std::string> worlds = {"bullet/deformable-explicit", "bullet/deformable-implicit", "bullet/pbd"};

Certificate certificate_of(const std::string& method, const Scene& built, const Scene& requested) {
  const crosscheck::Run run{1e-3, 2e-3, 1};
  const Outcome out = run_and_record(method, built, run).outcome;
  EXPECT_TRUE(out.readback) << out.reason;
  return certify(method, requested, out);
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
        // The table lists exceptions: remove them once the world reports these values.
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
TEST(SeededMismatch, OfTheAirIsCaught) { expect_caught(in_air(), of_the_cloth_in_air); }

TEST(SeededMismatch, OfPrescribedMotionsIsCaught) {
  expect_caught(small_cloth(), of_the_swing);
  expect_caught(shipped_scene("cloth-carried"), of_the_carried);
  expect_caught(draped(), of_a_still_one);
  // an engine that does not report motions is assumed to have none
  for (const Scene& scene : {small_cloth(), shipped_scene("cloth-carried")}) {
    Outcome silent = run_and_record("bullet/pbd", scene, {1e-3, 2e-3, 1}).outcome;
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
    Outcome slow = run_and_record(world, scene, {2e-3, 4e-3, 1}).outcome;
    slow.step = 1e-3;  // as requested
    EXPECT_EQ(mismatches(certify(world, scene, slow)), "[step] ") << world;
  }
}

TEST(SeededMismatch, ByBulletsOwnDefaultsIsCaught) {
  const Scene drape = draped(), spring = shipped_scene("spring");
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
