// Reference solutions with contact: the limit of mysim's own contact rule as long as the runs show an order of
// convergence, and statistics after that time.

#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/scenes/scenes.h"
#include "mysim/run/crossings.h"
#include "reference/truth/exact/exact.h"
#include "reference/truth/truth.h"
#include "tests/unit/experiments/advise_case.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(ContactTruth, FollowsADrapeFor300MillisecondsAndAFinerRunLiesWithinTheBar) {
  const Scene scene = load_scene("cloth-sphere");
  const auto truth = contact_truth(scene, default_run(scene));
  ASSERT_TRUE(truth);
  EXPECT_TRUE(truth->under_contact_rule);
  EXPECT_EQ(truth->tier, Tier::converged);
  EXPECT_NEAR(truth->until, scene.window, 1e-9);  // the window ends 0.3 s after the first touch
  EXPECT_EQ(truth->trajectory.t.back(), truth->until);
  EXPECT_EQ(truth->error_bars.size(), truth->trajectory.t.size());
  EXPECT_TRUE(contains(truth->how, "under mysim's contact rule; other contact rules differ"));
  EXPECT_LT(truth->error_bar, 1e-4);  // a fifth of the scene's tolerance
  const Trajectory finer =
      trajectory_of(stepper("leapfrog"), scene, {scene.step / 64, truth->until, truth->trajectory.frames() - 1});
  const double off = sup_rms(truth->trajectory, finer);
  fmt::print("drape: bar {:.2g} m, {:.2g} m from half the step\n", truth->error_bar, off);
  EXPECT_LT(off, truth->error_bar);
  EXPECT_GT(off, truth->error_bar / 40);
}

TEST(ContactTruth, OfADrapeIsThatOfTwoRulesWithoutACommonEquationUntilItIsSensitive) {
  Scene scene = load_scene("cloth-sphere");
  scene.duration = scene.window = 0.7, scene.samples = 35;
  const crosscheck::Run run = default_run(scene);
  const auto truth = time_stepping_truth(scene, run);
  ASSERT_TRUE(truth);
  EXPECT_FALSE(truth->under_contact_rule);
  EXPECT_EQ(truth->tier, Tier::converged);
  // At 0.56 s, a perturbation has grown a thousandfold, and the two rules begin to differ.
  EXPECT_GT(truth->until, 0.47);
  EXPECT_LT(truth->until, 0.57);
  EXPECT_EQ(truth->trajectory.t.back(), truth->until);
  EXPECT_EQ(truth->error_bars.size(), truth->trajectory.t.size());
  EXPECT_LE(truth->error_bar, scene.tolerance / 3);
  // a third rule of mysim, which neither solution uses
  Recorder recorder;
  Ledger ledger(scene.model, ContactLoss::reported);
  run_method(find_method("rk4"), scene, {scene.step / 16, truth->until, truth->trajectory.frames() - 1},
             {&recorder, &ledger});
  const double off = sup_rms(truth->trajectory, recorder.trajectory);
  fmt::print("drape: bar {:.2g} m, {:.2g} m from another rule, until {:.2g} s\n", truth->error_bar, off, truth->until);
  EXPECT_LT(off, truth->error_bar);
  EXPECT_GT(off, truth->error_bar / 40);
  ASSERT_EQ(truth->contact.size(), truth->trajectory.t.size());
  const double taken = ledger.rows().back().contact, bar = truth->contact_bars.back();
  fmt::print("drape: contact takes {:.6g} J, bar {:.2g} J, {:.6g} J by another rule\n", truth->contact.back(), bar,
             taken);
  EXPECT_LT(std::abs(taken - truth->contact.back()), bar);
  EXPECT_GT(std::abs(taken - truth->contact.back()), bar / 40);
  EXPECT_LT(bar, 0.005 * taken);
}

TEST(ContactTruth, ThatEndsEarlyIsHeldAgainstNothingLater) {
  // samples after the end of the truth have a motion but no error
  Scene scene = load_scene("cloth-sphere");
  scene.duration = scene.window = 0.7, scene.samples = 35;
  Request request;
  request.scenes = {scene};
  request.methods = find_methods("leapfrog");
  MethodResults results;
  TableSet tables;
  engines_on(request, scene, results, tables);
  const double until = std::get<double>(tables.table("engines")->at(0, "truth until"));
  EXPECT_LT(until, 0.57);
  EXPECT_GT(std::get<double>(tables.table("engines")->at(0, "largest error")), 0);
  const Table& rows = *tables.table("cloth-sphere-engines");
  EXPECT_NEAR(std::get<double>(rows.at(rows.rows.size() - 1, "t")), 0.7, 1e-9);
  for (size_t i = 0; i < rows.rows.size(); ++i)
    EXPECT_EQ(std::holds_alternative<double>(rows.at(i, "error")),
              std::get<double>(rows.at(i, "t")) <= until * (1 + 1e-9));
}

TEST(ContactTruth, OfOneParticleCoversTheExactSlide) {
  const Scene scene = load_scene("slide");
  const auto exact = exact_solution(scene);
  for (const auto& truth : {contact_truth(scene, default_run(scene)), time_stepping_truth(scene, default_run(scene))}) {
    ASSERT_TRUE(truth && exact);
    EXPECT_EQ(std::min(truth->until, scene.duration), scene.window)
        << truth->how;  // a single particle is followed to the end
    double error = 0;
    for (int i = 0; i < truth->trajectory.frames(); ++i)
      error = std::max(error, rms_distance(truth->trajectory.x[i], exact->at(truth->trajectory.t[i]).x));
    fmt::print("slide: bar {:.2g} m, error {:.2g} m, {}\n", truth->error_bar, error, truth->how);
    EXPECT_LT(error, truth->error_bar) << truth->how;
    // friction is the only dissipation in this scene
    const auto energy = [&](int i) { return energy_of(scene.model, exact->at(truth->trajectory.t[i])).total(); };
    for (size_t i = 0; i < truth->contact.size(); ++i)
      EXPECT_NEAR(truth->contact[i], energy(0) - energy(static_cast<int>(i)), truth->contact_bars[i] + 1e-12) << i;
    EXPECT_EQ(truth->contact.empty(), truth->under_contact_rule);
    // The other solution is of second order. Its error may be far below its bar, which comes from a comparison with a
    // first-order one.
    if (truth->under_contact_rule) {
      EXPECT_GT(error, truth->error_bar / 40);
    }
  }
}

TEST(ContactTruth, BarsCoverThirtyRandomScenesOnPlanes) {
  const Method method = find_method("implicit-midpoint+events");
  int to_the_end = 0, rebound = 0;
  double closest = INFINITY;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = random_plane_scene(seed);
    rebound += scene.model.find<Planes>()->list[0].restitution > 0;
    const auto truth = truth_of(scene, default_run(scene));
    ASSERT_TRUE(truth);
    EXPECT_FALSE(truth->under_contact_rule);
    to_the_end += std::isinf(truth->until);
    const Trajectory& path = truth->trajectory;
    const double bar = truth->error_bar;
    const crosscheck::Run run{scene.step, path.t.back(), path.frames() - 1};
    Recorder finer;
    run_event_driven(scene, {run.step, run.duration, run.samples, 1e-14}, finer);
    const double off = sup_rms(path, finer.trajectory);
    EXPECT_LE(off, bar);
    closest = std::min(closest, bar / off);
    // a third rule, whose uncertainty is the change by its last refinement
    Recorder coarse, fine;
    for (const auto& [recorder, part] : {std::pair{&coarse, 64}, {&fine, 128}})
      run_method(method, scene, {scene.step / part, run.duration, run.samples}, {recorder});
    EXPECT_LE(sup_rms(path, fine.trajectory), bar + sup_rms(fine.trajectory, coarse.trajectory));
  }
  fmt::print("random planes: {} with restitution, {} known to the end, bar over error at least {:.2g}\n", rebound,
             to_the_end, closest);
  EXPECT_GT(std::min(rebound, 30 - rebound), 10);
  EXPECT_GE(to_the_end, 25);
}

TEST(ContactTruth, IsNoneWhereNothingTouchesOrNoOrderIsSeen) {
  const Scene drape = load_scene("cloth-sphere");
  EXPECT_FALSE(contact_truth(drape, {1e-3, 0.1, 10}));  // still falling
  const Scene jelly = load_scene("jelly");
  EXPECT_FALSE(contact_truth(jelly, default_run(jelly)));  // no order: its corners hit the ball one after the other
}

TEST(ContactTruth, IsCalledADifferenceInTheTables) {
  Request request;
  request.scenes = {load_scene("cloth-carried")};
  request.scenes[0].duration = 0.4;
  request.scenes[0].samples = 20;
  request.scenes[0].window = 0.4;
  request.methods = find_methods("leapfrog,symplectic-euler");
  // The second solution does not support two spheres at once, so only the limit of the contact rule remains.
  auto& spheres = std::get<Spheres>(*std::ranges::find_if(
      request.scenes[0].model.terms, [](const Term& t) { return std::holds_alternative<Spheres>(t); }));
  spheres.list.push_back(spheres.list.front());
  MethodResults results;
  TableSet result;
  engines_on(request, request.scenes[0], results, result);
  const Table& summary = *result.table("engines");
  for (size_t i = 0; i < summary.rows.size(); ++i) {
    EXPECT_TRUE(std::holds_alternative<std::monostate>(summary.at(i, "largest error")));
    EXPECT_GT(std::get<double>(summary.at(i, "largest difference from converged contact")), 0);
    EXPECT_NEAR(std::get<double>(summary.at(i, "truth until")), 0.36, 1e-9);  // first touch at 0.06 s
    EXPECT_EQ(std::get<std::string>(summary.at(i, "truth tier")), "converged, mysim's contact rule");
  }
  const Table& rows = *result.table("cloth-carried-engines");
  for (size_t i = 0; i < rows.rows.size(); ++i) {
    EXPECT_TRUE(std::holds_alternative<std::monostate>(rows.at(i, "error")));
    EXPECT_EQ(std::holds_alternative<double>(rows.at(i, "difference from converged contact")),
              std::get<double>(rows.at(i, "t")) < 0.361);
  }
}

TEST(ContactTruth, AdvicePromisesOnRandomScenesAndKeepsItAfterEveryStep) {
  // scenes of particles, a chain and a net; their seeds are among the twenty of `advise_trials contact 1 20`
  for (const unsigned seed : {6u, 7u, 20u}) {
    const ContactCase c = contact_case(random_contact_scene(seed), 0.01);
    EXPECT_TRUE(c.promised) << seed << ": " << c.why;
    EXPECT_LE(c.error, c.tolerance) << seed;
    EXPECT_TRUE(c.met) << seed << ": " << c.method;
  }
}

TEST(FloorDrop, KeepsAPerturbationSmallToTheEndOfItsWindowAndEndsInOneState) {
  const Scene scene = load_scene("floor-drop");
  const Method method = find_method(scene.method);
  const crosscheck::Run run = default_run(scene);
  constexpr double size = 1e-10;  // m
  const Trajectory plain = run_and_record(scene.method, scene, run).trajectory;
  const auto expected = contact_quantities(scene, plain);
  CrossingDetector crossings(scene.triangles);
  double growth = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Recorder recorder;
    const Scene start = perturbed(scene, size, seed);
    ASSERT_EQ(run_method(method, start, run, {&recorder}).verdict, Verdict::ok);
    const Trajectory& path = recorder.trajectory;
    for (int i = 0; i < path.frames(); ++i) {
      EXPECT_EQ(crossings.piercing_edges(path.x[i]), 0) << path.t[i];
      if (path.t[i] <= scene.window * (1 + 1e-9))
        growth = std::max(growth, largest_column(path.x[i] - plain.x[i]) / size);
    }
    // the final height, clearance, energies and outline differ by about the size of the perturbation
    const auto end = contact_quantities(start, path);
    for (size_t q = 0; q < end.size(); ++q) EXPECT_NEAR(end[q].mean, expected[q].mean, 10 * size) << end[q].quantity;
  }
  fmt::print("floor-drop: a perturbation grows {:.3g}-fold at most\n", growth);
  EXPECT_LT(growth, 10);  // as the scene's text states
  EXPECT_GT(growth, 1);
  EXPECT_EQ(scene.window, scene.duration);
}

TEST(FloorDrop, TruthCoversAnotherRuleToTheEnd) {
  const Scene scene = load_scene("floor-drop");
  const auto truth = truth_of(scene, default_run(scene));
  ASSERT_TRUE(truth);
  EXPECT_FALSE(truth->under_contact_rule);
  EXPECT_GE(std::min(truth->until, scene.duration), scene.window);
  EXPECT_LE(truth->error_bar, scene.tolerance / 3);
  // rk4 is neither of the two methods behind the truth
  const Trajectory other = run_and_record("rk4", scene, {scene.step / 16, scene.duration, scene.samples}).trajectory;
  const double off = sup_rms(truth->trajectory, other);
  fmt::print("floor-drop: bar {:.2g} m, {:.2g} m from another rule\n", truth->error_bar, off);
  EXPECT_LT(off, truth->error_bar);
  EXPECT_GT(off, truth->error_bar / 40);
}

TEST(ContactStatistics, SpreadIsThatOfThePerturbationAndSeedsAreFixed) {
  Scene scene = load_scene("jelly");
  scene.duration = 1;
  scene.samples = 20;
  const Method method = find_method("symplectic-euler");
  const crosscheck::Run run{1e-3, 1, 20};
  const auto first = contact_statistics(method, scene, run), again = contact_statistics(method, scene, run);
  ASSERT_EQ(first.size(), 5u);
  const Trajectory plain = run_and_record("symplectic-euler", scene, run).trajectory;
  const double plain_values[] = {centre_of_mass(scene, plain.x.back()).y(), 0, 0, 0};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(first[i].mean, again[i].mean);
    EXPECT_EQ(first[i].deviation, again[i].deviation);
  }
  EXPECT_EQ(first[0].quantity, "height of the centre of mass at the end");
  // The motion is not sensitive: the mean agrees with the unperturbed run, up to the effect (modified by contact) of
  // moving 216 particles by 1e-6 m.
  EXPECT_NEAR(first[0].mean, plain_values[0], 1e-5);
  EXPECT_GT(first[0].deviation, 1e-10);
  EXPECT_LT(first[0].deviation, 1e-5);
  EXPECT_GT(first[3].mean, 0.05);  // J: a weight of 49 N compresses the springs by some millimetres
  EXPECT_TRUE(contact_statistics(find_method("odeint/rk4"), scene, run).empty());
}

}  // namespace
}  // namespace crosscheck
