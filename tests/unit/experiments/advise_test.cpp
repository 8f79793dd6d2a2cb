
#include <fmt/ranges.h>

#include <numbers>

#include "experiments/advise/advice.h"
#include "experiments/advise/dense_truth.h"
#include "experiments/advise/fit.h"
#include "experiments/measures.h"
#include "experiments/scenes/scenes.h"
#include "experiments/tables/speed_accuracy.h"
#include "mysim/scene/toml.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// A mass on a vertical spring of 1 m that starts at its rest length.
std::string mass_on_spring(const std::string& mass, const std::string& k, const std::string& more = "") {
  return scene_text("[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0, -1, 0]\nmass = " +
                        mass + "\n[[spring]]\nends = [0, 1]\nstiffness = " + k +
                        "\nrest = 1\n[pins]\nparticles = [0]\n" + std::string(gravity_text) + more,
                    2, 1e-2, 20);
}

TEST(Measures, OfASpringHaveClosedForms) {
  const double m = 0.5, k = 80, gamma = 1.5;
  const Scene free = parse_scene(mass_on_spring("0.5", "80"), "free"),
              damped = parse_scene(mass_on_spring("0.5", "80", "[drag]\ngamma = 1.5\n"), "damped");
  EXPECT_NEAR(*sag_of(free), m * 9.81 / k, 1e-4 * m * 9.81 / k);
  const double period = 2 * std::numbers::pi * std::sqrt(m / k);
  for (const double about : {period, 3 * period, period / 10})
    EXPECT_NEAR(*period_of(free, about), period, 1e-4 * period);
  EXPECT_NEAR(*max_stretch_of(free), 2 * m * 9.81 / k, 1e-4 * 2 * m * 9.81 / k);
  // With the scene's own method, leapfrog, periods are shorter by (h omega)^2 / 24, here 6.7e-4.
  EXPECT_NEAR(*period_of(free, period, MeasuredBy::own_method), period * (1 - 16e-3 / 24), 1e-4 * period);
  // The energy decays as exp(-gamma t), with a ripple of gamma / omega.
  const double settle = std::log(1e3) / gamma, ripple = 1 / std::sqrt(k / m);
  for (const double about : {settle, settle / 2, 3 * settle})
    EXPECT_NEAR(*settle_time_of(damped, about), settle, ripple);
  EXPECT_FALSE(sag_of(load_scene("circle")));
  EXPECT_FALSE(period_of(load_scene("circle"), 1));
  EXPECT_FALSE(period_of(load_scene("projectile"), 1));  // no oscillation
}

TEST(Fit, ReachesWishesWithinTwoPercent) {
  const double g = 9.81;
  const auto square = [](double x) { return x * x; };
  struct Row {
    std::string text, unknown;
    double expected;
  };
  const Row table[] = {
      {mass_on_spring("0.5", "\"fit\"", "[wish]\nsag = 0.05\n"), "stiffness", 0.5 * g / 0.05},
      {mass_on_spring("\"fit\"", "80", "[wish]\nsag = 0.1\n"), "mass", 80 * 0.1 / g},
      {mass_on_spring("0.5", "\"fit\"", "[wish]\nperiod = 0.7\n"), "stiffness",
       0.5 * square(2 * std::numbers::pi / 0.7)},
      {mass_on_spring("0.5", "\"fit\"", "[wish]\nmax_stretch = 0.2\n"), "stiffness", 2 * 0.5 * g / 0.2},
      {mass_on_spring("0.5", "80", "[drag]\ngamma = \"fit\"\n[wish]\nsettle_time = 3\n"), "drag rate",
       std::log(1e3) / 3},
  };
  for (const Row& row : table) {
    SCOPED_TRACE(row.text);
    const FitResult fitted = fit_to_wishes(row.text, "wish.toml");
    ASSERT_EQ(fitted.unknowns.size(), 1u);
    EXPECT_EQ(fitted.unknowns[0].name, row.unknown);
    EXPECT_NEAR(fitted.wishes[0].reached, fitted.wishes[0].wished, 0.02 * fitted.wishes[0].wished);
    // Stiffness scales with the square of the period. A settling time has a ripple of gamma / omega, here 0.1.
    EXPECT_NEAR(fitted.unknowns[0].value, row.expected, (row.unknown == "drag rate" ? 0.1 : 0.04) * row.expected);
    EXPECT_FALSE(has_unknowns(fitted.toml, "fitted"));
    EXPECT_EQ(parse_scene(fitted.toml, "wish.toml").hash, fitted.scene.hash);
    EXPECT_EQ(run_and_record(fitted.scene.method, fitted.scene, default_run(fitted.scene)).outcome.verdict,
              Verdict::ok);
  }
}

std::string mass_under_pins(int pins, const std::string& k, const std::string& more) {
  std::string text = "[[particle]]\nposition = [0, -1, 0]\nmass = 0.5\n", list;
  for (int i = 1; i <= pins; ++i) {
    text += fmt::format("[[particle]]\nposition = [{}, 0, 0]\nmass = 1\n[[spring]]\nends = [0, {}]\nstiffness = {}\n",
                        0.01 * (i - (pins + 1) / 2.), i, k);
    list += fmt::format("{}{}", i > 1 ? ", " : "", i);
  }
  return scene_text(text + "[pins]\nparticles = [" + list + "]\n" + gravity_text + more, 2, 1e-2, 20);
}

TEST(Fit, WishesHoldInARunOfItsFile) {
  for (const std::string& text : {mass_on_spring("0.3", "\"fit\"", "[wish]\nperiod = 0.7\n"),
                                  mass_under_pins(50, "\"fit\"", "[wish]\nperiod = 0.4\n"),
                                  mass_on_spring("0.5", "80", "[drag]\ngamma = \"fit\"\n[wish]\nsettle_time = 3\n")}) {
    SCOPED_TRACE(text.substr(0, 300));
    const FitResult fitted = fit_to_wishes(text, "wish.toml");
    const WishResult& w = fitted.wishes[0];
    EXPECT_TRUE(w.kept()) << w.own << " of " << w.reached;
    const auto at = [&](const Scene& s) {
      return w.name == "period" ? *period_of(s, w.wished, MeasuredBy::own_method)
                                : *settle_time_of(s, w.wished, MeasuredBy::own_method);
    };
    EXPECT_EQ(at(fitted.scene), w.own);
    // The scene's value is the limit of its runs as the step tends to zero.
    Scene finer = fitted.scene;
    finer.step /= 16;
    EXPECT_NEAR(at(finer), w.reached, 3e-4 * w.reached);
    EXPECT_NEAR(w.own, w.wished, 1e-3 * w.wished);
  }
}

TEST(Fit, FindsTwoAtOnce) {
  const FitResult f = fit_to_wishes(
      mass_on_spring("0.5", "\"fit\"", "[drag]\ngamma = \"fit\"\n[wish]\nsag = 0.05\nsettle_time = 3\n"), "two.toml");
  ASSERT_EQ(f.wishes.size(), 2u);
  for (const WishResult& w : f.wishes) EXPECT_NEAR(w.reached, w.wished, 0.02 * w.wished) << w.name;
  const auto stiffness =
      std::find_if(f.unknowns.begin(), f.unknowns.end(), [](const auto& u) { return u.name == "stiffness"; });
  ASSERT_NE(stiffness, f.unknowns.end());
  EXPECT_NEAR(stiffness->value, 0.5 * 9.81 / 0.05, 0.02 * 0.5 * 9.81 / 0.05);
}

TEST(Fit, RefusesWhatItCannotDo) {
  // The message says that files with "fit" are for `advise`.
  EXPECT_TRUE(contains(message_of(mass_on_spring("0.5", "\"fit\"")),
                       "spring[0].stiffness: expected a number above zero; \"fit\" is for `crosscheck advise`"));
  EXPECT_TRUE(contains(message_of(mass_on_spring("0.5", "80", "[wish]\n")), "expected at least one of sag, period"));
  EXPECT_TRUE(
      contains(message_of(mass_on_spring("0.5", "80", "[wish]\nsag = 0\n")), "wish.sag: expected a number above"));
  EXPECT_TRUE(contains(message_of(mass_on_spring("0.5", "80", "[wish]\nsags = 1\n")), "wish"));
  struct Row {
    std::string text;
    std::vector<std::string> expected;
  };
  const Row bad[] = {
      {mass_on_spring("0.5", "\"fit\""), {"wish: expected as many wishes", "(1: stiffness), got 0"}},
      {mass_on_spring("\"fit\"", "\"fit\"", "[wish]\nperiod = 1\n"), {"(2: ", "stiffness", "mass", "got 1"}},
      {mass_on_spring("0.5", "80",
                      "[drag]\ngamma = 1\n[sphere]\ncentre = [0, -9, 0]\nradius = \"fit\"\n[wish]\nsag = 1\n"),
       {"sphere.radius: expected a value; only stiffness, mass, drag and dashpot can be fitted"}},
  };
  for (const Row& row : bad) try {
      fit_to_wishes(row.text, "bad.toml");
      ADD_FAILURE() << row.text;
    } catch (const InputError& e) {
      EXPECT_TRUE(begins(e.what(), "bad.toml: "));
      for (const std::string& part : row.expected) EXPECT_TRUE(contains(e.what(), part));
    }
  const Row never[] = {
      {mass_on_spring("0.5", "\"fit\"", "[sphere]\ncentre = [0, -9, 0]\nradius = 1\n[wish]\nsag = 0.05\n"),
       {"sag cannot be measured in this scene"}},
      // drag does not change the sag of a spring
      {mass_on_spring("0.5", "80", "[drag]\ngamma = \"fit\"\n[wish]\nsag = 1\n"), {"sag = 1 m cannot be reached"}},
  };
  for (const Row& row : never) try {
      fit_to_wishes(row.text, "never.toml");
      ADD_FAILURE() << row.text;
    } catch (const CannotGuarantee& e) {
      for (const std::string& part : row.expected) EXPECT_TRUE(contains(e.what(), part));
    }
}

TEST(TomlDocument, ChangesATomlFileKeyByKey) {
  TomlDocument file("a = 1\n[b]\nc = \"fit\"\n[[d]]\ne = \"fit\"\nf = 2.5\n[[d]]\ne = 3\n", "doc");
  EXPECT_EQ(file.where("fit"), (std::vector<std::string>{"b.c", "d[0].e"}));
  file.set("b.c", 0.1);
  file.set("d[0].e", 1. / 3);
  file.set("b.new", std::vector<int>{1, 2});
  file.erase("d[].f");
  file.erase("nothing.there");
  const TomlDocument again(file.text(), "again");
  EXPECT_TRUE(again.where("fit").empty());
  EXPECT_TRUE(again.has("b.new"));
  EXPECT_FALSE(again.has("d[0].f"));
  EXPECT_EQ(TomlTable::parse_text(file.text(), "again").sections("d")[0].number("e"), 1. / 3);
  EXPECT_EQ(TomlTable::parse_text(file.text(), "again").section("b").integers("new"), (std::vector<int>{1, 2}));
  try {
    file.set("x.y", 1.);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "doc: x: no such table");
  }
}

TEST(Advise, TakesTheLongestStepThatMeetsTheTolerance) {
  for (const auto& [name, method] :
       {std::pair{"spring", "leapfrog"}, {"spring", "symplectic-euler"}, {"circle", "rk4"}}) {
    const Scene scene = load_scene(name);
    for (const double tolerance : {1e-2, 1e-4}) {
      SCOPED_TRACE(fmt::format("{} {} {}", name, method, tolerance));
      const Advice a = advise(scene, tolerance, {find_method(method)});
      const Trial& t = a.trials[a.chosen];
      EXPECT_LE(*t.error + a.error_bar, tolerance);
      EXPECT_NEAR(a.checked, *t.error, 1e-9 * tolerance + 1e-12);
      // at an order of at least 1, twice the step has about twice the error or more; steps divide the sampling interval
      const auto truth = truth_of(scene, default_run(scene));
      crosscheck::Run twice = default_run(scene);
      twice.step = 2 * t.step;
      const double steps = scene.duration / scene.samples / t.step;
      if (steps > 1.5) {
        EXPECT_GT(sup_rms(run_and_record(method, scene, twice).trajectory, truth->trajectory), tolerance);
      }
      EXPECT_EQ(parse_scene(a.toml, name).method, "mysim/" + std::string(method));
    }
  }
}

/// A mass of 0.5 kg, pulled down by 0.1 m, on a spring of 1 m and 300 N/m without gravity, for twelve periods. If
/// `springs` > 1, a row of such springs and masses.
Scene sampled_spring(double samples_in_a_period, int springs = 1) {
  const double period = 2 * std::numbers::pi * std::sqrt(0.5 / 300), duration = 12 * period;
  std::string text = "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n";
  for (int i = 1; i <= springs; ++i)
    text += fmt::format(
        "[[particle]]\nposition = [{}, {}, 0]\nmass = 0.5\n[[spring]]\nends = [{}, {}]\nstiffness = 300\nrest = 1\n",
        springs > 1 && i == springs ? 0.2 : 0., -i - (i == springs ? 0.1 : 0.), i - 1, i);
  text += "[pins]\nparticles = [0]\n";
  return parse_scene(scene_text(text, duration, period / 200, static_cast<int>(std::lround(12 * samples_in_a_period))),
                     "sampled");
}

TEST(Advise, KeepsItsPromiseBetweenTheSamples) {
  // With one sample per period, the samples show no motion; with two, only the turning points. A bent row of two
  // springs has no closed form.
  for (const auto& [scene, truth_is] : {std::pair{sampled_spring(1), Tier::exact},
                                        {sampled_spring(2), Tier::exact},
                                        {sampled_spring(3), Tier::exact},
                                        {sampled_spring(1, 2), Tier::converged}})
    for (const double tolerance : {1e-2, 1e-3}) {
      SCOPED_TRACE(fmt::format("{} samples, {} m", scene.samples, tolerance));
      const Advice a =
          advise(scene, tolerance, find_methods("leapfrog,symplectic-euler,rk4,dopri5,implicit-midpoint,suzuki4"));
      EXPECT_EQ(a.tier, truth_is);
      // compares with the truth after every step, or at 1000 times if the method is adaptive
      const Scene written = parse_scene(a.toml, "sampled");
      crosscheck::Run run = default_run(written);
      const Method method = find_method(written.method);
      run.samples = method.adaptive ? 1000 : static_cast<int>(std::lround(run.duration / time_grid(run).h));
      const Trajectory dense = run_and_record(written.method, written, run).trajectory;
      Scene finer = scene;
      finer.step /= 4;
      const auto truth = truth_of(finer, {finer.step, run.duration, run.samples});
      ASSERT_TRUE(truth);
      const double error = largest_rms_distance(dense, truth->trajectory, a.until);
      EXPECT_LE(error, tolerance) << written.method;
      EXPECT_GT(error, 0.02 * tolerance) << "more precise than necessary: " << written.method;
    }
}

TEST(Advise, KeepsItsPromiseBetweenTheSamplesOfAFlightWithoutVibrations) {
  for (const double tolerance : {5.05493e-10, 1e-6, 1e-4}) {
    const Scene scene = load_scene("projectile");
    const Scene written = parse_scene(advise(scene, tolerance, find_methods("dopri5")).toml, scene.name);
    crosscheck::Run run = default_run(written);
    run.samples *= 20;
    const Trajectory dense = run_and_record("dopri5", written, run).trajectory;
    EXPECT_LE(largest_rms_distance(dense, truth_of(scene, run)->trajectory), tolerance);
  }
}

TEST(Advise, ChecksTheVeryRunOfItsFile) {
  for (const auto& [scene, tolerance] : {std::pair{load_scene("circle"), 6e-4},
                                         {load_scene("circle"), 3e-5},
                                         {sampled_spring(3), 1e-3},
                                         {sampled_spring(1, 2), 1e-4}}) {
    SCOPED_TRACE(fmt::format("{} {}", scene.name, tolerance));
    const Advice a = advise(scene, tolerance, {find_method("dopri5")});
    const Scene written = parse_scene(a.toml, scene.name);
    EXPECT_EQ(default_run(written).tolerance, a.trials[a.chosen].relative);  // bit for bit
    const DenseTruth path(scene, tolerance);
    MaxErrorObserver farthest(path);
    run_method(find_method("dopri5"), written, observed_run(find_method("dopri5"), written, path), {&farthest});
    EXPECT_EQ(farthest.distance(), a.checked);
    EXPECT_EQ(*a.trials[a.chosen].error, a.checked);
    // a run without an observer takes the same steps
    const Trajectory plain = run_and_record("dopri5", written, default_run(written)).trajectory;
    const Trajectory observed =
        run_and_record("dopri5", written, observed_run(find_method("dopri5"), written, path)).trajectory;
    EXPECT_TRUE(identical(plain, observed));
    double error = 0;
    for (int i = 0; i < plain.frames(); ++i) error = std::max(error, rms_distance(plain.x[i], path.at(plain.t[i])));
    EXPECT_LE(error, a.checked * (1 + 1e-9));
    EXPECT_LE(a.checked + a.error_bar, tolerance);
  }
}

TEST(Advise, StepKeepsTheWishesOfAScene) {
  const Scene scene = parse_scene(mass_on_spring("0.5", "80", "[wish]\nperiod = 0.5\n"), "wish");
  const Advice a = advise(scene, 1e-2, {find_method("leapfrog")});
  ASSERT_EQ(a.wishes.size(), 1u);
  EXPECT_TRUE(a.wishes[0].kept());
  const double period = 2 * std::numbers::pi * std::sqrt(0.5 / 80);
  EXPECT_NEAR(a.wishes[0].reached, period, 1e-4 * period);
  EXPECT_NEAR(*period_of(parse_scene(a.toml, "wish"), 0.5, MeasuredBy::own_method), period, 6e-4 * period);
}

TEST(Advise, SeesTheFastestMotionOfAScene) {
  EXPECT_NEAR(fastest_motion(sampled_spring(1)), std::sqrt(300 / 0.5), 1e-2);
  EXPECT_EQ(fastest_motion(load_scene("projectile")), 0);
  // A moving pin may be faster than the particle on its spring.
  const Scene led = parse_scene(
      mass_on_spring("0.5", "80", "[pins.motion]\namplitude = [0, 0.01, 0]\nfrequency = 40\nramp = 0.1\n"), "led");
  EXPECT_NEAR(fastest_motion(led), 80 * std::numbers::pi, 1e-9);
}

TEST(Advise, LeavesOutOfTheModelWhatTheToleranceAllows) {
  const Scene scene = parse_scene(mass_on_spring("0.5", "80", "[wind]\nacceleration = [0, 1e-4, 0]\n"), "breath");
  const Advice a = advise(scene, 1e-3, {find_method("leapfrog"), find_method("rk4")});
  EXPECT_EQ(a.left_out, std::vector<std::string>{"wind"});
  EXPECT_FALSE(parse_scene(a.toml, "less").model.find<Wind>());
  EXPECT_TRUE(advise(scene, 1e-6, {find_method("leapfrog"), find_method("rk4")}).left_out.empty());
  EXPECT_TRUE(a.second);
}

TEST(Advise, TakesTheRunThatAReportRecommends) {
  for (const char* name : {"spring", "pendulum", "chain", "slide", "cloth-student"}) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene(name);
    Request request;
    request.scenes = {scene};
    TableSet rows;
    speed_accuracy_on(request, scene, rows);
    const auto table = rows_of<SpeedAccuracyRow>(*rows.table("speed-accuracy"));
    const std::vector<TriedRun> runs = tried_runs(table, name);
    const auto recommended = recommend(runs, 0.01 * table[0].motion - *table[0].truth_bar);
    ASSERT_TRUE(recommended);
    const TriedRun& run = runs[recommended->run];
    const Advice a = advise(scene, 0.01 * table[0].motion, candidates(scene));
    ASSERT_FALSE(a.between_samples);
    const Trial& advised = a.trials[a.of_full.value_or(a.chosen)];
    EXPECT_EQ(advised.method, run.method);
    EXPECT_NEAR((run.setting.tolerance ? advised.relative : advised.step) / run.setting.value, 1, 1e-5);
    EXPECT_EQ(a.bound, recommended->bound);
    EXPECT_EQ(static_cast<double>(advised.outcome.evaluations), run.cost);
  }
}

TEST(Advise, SaysWhyItCannotPromise) {
  const auto why = [](const Scene& scene, double tolerance, const std::string& methods) -> std::string {
    try {
      advise(scene, tolerance, find_methods(methods));
    } catch (const CannotGuarantee& e) {
      return e.what();
    }
    return "";
  };
  const Scene spring = load_scene("spring");
  EXPECT_TRUE(contains(why(spring, 1e-17, "rk4"), "the reference solution is known to"));
  EXPECT_TRUE(contains(why(spring, 10, "rk4"), "nothing in the scene moves by more than"));
  EXPECT_TRUE(contains(why(load_scene("circle"), 1e-3, "leapfrog"), "none of the methods tried comes within"));
  EXPECT_EQ(why(spring, 1e-3, "rk4"), "");
}

}  // namespace
}  // namespace crosscheck
