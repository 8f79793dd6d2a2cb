// Experiment `speed-accuracy`: statistics of times, Pareto fronts, the cheapest run, and statements about its rows.

#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/estimate.h"
#include "experiments/scenes/scenes.h"
#include "experiments/speed_accuracy/step_search.h"
#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/sweep/sweep.h"
#include "experiments/tables/speed_accuracy.h"
#include "mysim/model/system.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Timing, MedianAndItsIntervalFollowTheOrderOfTheTimes) {
  // With n measured times, the k-th smallest and the k-th largest are a 90 % confidence interval of the median; k is 1
  // from n = 5, 2 from n = 8, 3 from n = 11, and 4 from n = 13.
  const std::vector<std::pair<int, int>> ranks = {{1, 1}, {3, 1}, {5, 1}, {7, 1}, {8, 2}, {10, 2}, {11, 3}, {13, 4}};
  for (const auto& [n, k] : ranks) {
    SCOPED_TRACE(n);
    std::vector<double> times;
    for (int i = n; i > 0; --i) times.push_back(i);  // n to 1, in descending order
    const Timing t = timing_of(times);
    EXPECT_DOUBLE_EQ(t.median, (n + 1) / 2.);
    EXPECT_DOUBLE_EQ(t.low, k);
    EXPECT_DOUBLE_EQ(t.high, n + 1 - k);
    EXPECT_EQ(t.repetitions, n);
  }
  EXPECT_THROW(timing_of({}), std::invalid_argument);
}

TEST(Timing, OneSlowRepetitionMovesNothing) {
  const Timing quiet = timing_of({1, 1, 1, 1, 1, 1, 1, 1, 1}), disturbed = timing_of({1, 1, 1, 1, 50, 1, 1, 1, 1});
  EXPECT_EQ(quiet.median, disturbed.median);
  EXPECT_EQ(quiet.high, disturbed.high);
}

TEST(Timing, RunsTakeTurnsAndShortOnesAreRepeated) {
  std::string order;
  const std::vector<std::function<double()>> runs = {[&] { return order += 'a', 1.; },
                                                     [&] { return order += 'b', 0.4e-3; }};
  const auto times = time_round_robin(runs, {.least = 2, .most = 4, .enough = 1.5, .resolution = 1e-3});
  // Each run begins with a warm-up. That of `a` takes 1 s, which is long enough to count as a repetition. Afterwards,
  // each turn of `b` has three runs, which together take 1 ms; `a` stops after two runs.
  EXPECT_EQ(order, "ababbbbbbbbbbbb");
  EXPECT_EQ(times[0], (std::vector<double>{1, 1}));
  ASSERT_EQ(times[1].size(), 4u);
  EXPECT_DOUBLE_EQ(times[1][0], 0.4e-3);
}

TEST(Timing, ARunThatTakesNoTimeEnds) {
  // The run stands for a program without a clock, or for a refusal. Each call would start a process, and more calls
  // would give no more information.
  int calls = 0;
  const std::vector<std::function<double()>> runs = {[&] { return ++calls, 0.; }, [] { return 1.; }};
  const auto times = time_round_robin(runs, {.least = 5, .most = 7});
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(times[0], std::vector<double>{0});
  EXPECT_EQ(times[1].size(), 5u);
}

TEST(Timing, ADifferenceCountsAboveTheNoiseOnly) {
  const Timing a{1, 0.98, 1.02, 9};
  EXPECT_FALSE(differ(a, a.times(1.02), 0.01));  // intervals overlap
  EXPECT_TRUE(differ(a, a.times(1.1), 0.05));
  EXPECT_FALSE(differ(a, a.times(1.1), 0.15));
  EXPECT_TRUE(differ(a.times(1.1), a, 0.05));
}

TEST(Timing, TheNoiseFloorIsWhatHalvesOfTheRepetitionsDifferBy) {
  using Times = std::vector<std::vector<double>>;
  EXPECT_DOUBLE_EQ(noise_floor(Times{{1, 1, 1, 1}}), 0.01);  // lower bound
  EXPECT_NEAR(noise_floor(Times{{1, 1.2, 1, 1.2}}), 0.2 / 1.1, 1e-12);
  EXPECT_DOUBLE_EQ(noise_floor(Times{{1}}), 0.01);  // a single repetition shows no noise
}

std::vector<WorkPrecisionPoint> tiny() {
  auto point = [](const char* method, double cost, std::optional<double> error) {
    return WorkPrecisionPoint{
        method, SettingKind::step, cost, error.has_value(), error, cost, Timing{cost, 0.99 * cost, 1.01 * cost, 5}};
  };
  return {point("mysim/a", 8, 0.001),   point("mysim/a", 4, 0.01),     point("mysim/a", 2, 0.1),
          point("bullet/b", 5, 0.02),   point("bullet/b", 16, 0.0005), point("mysim/c", 1, {}),
          point("mysim/d", 4.05, 0.01), point("mysim/d", 4, 0.5)};
}

TEST(SpeedAccuracy, TheParetoLineOfAHandMadeCase) {
  std::vector<std::pair<double, double>> line;
  for (const WorkPrecisionPoint& p : pareto_line(tiny(), 0)) line.emplace_back(p.cost, *p.error);
  // The failed run is the cheapest, but does not count. At equal cost, the more accurate run counts.
  EXPECT_EQ(line, (std::vector<std::pair<double, double>>{{2, 0.1}, {4, 0.01}, {8, 0.001}, {16, 0.0005}}));
}

TEST(SpeedAccuracy, BelowTheFloorNobodyIsBetter) {
  const auto line = pareto_line(tiny(), 0.002);
  ASSERT_EQ(line.size(), 3u);
  EXPECT_EQ(line.back().cost, 8);
  EXPECT_EQ(line.back().error, 0.002);
}

TEST(SpeedAccuracy, AProgramIsAnEngineOfItsOwn) {
  EXPECT_EQ(engine_of("mysim/leapfrog+sticky"), "mysim");
  EXPECT_EQ(engine_of("bullet/pbd+voxel=0.02"), "bullet");
  EXPECT_EQ(engine_of("exec:./a"), "exec:./a");
  EXPECT_EQ(engine_of("exec:/opt/b/a+n=10"), "exec:/opt/b/a+n=10");
  EXPECT_EQ(engine_of("exec:a"), "exec:a");
  EXPECT_EQ(engine_of("file:a.npy"), "file:a.npy");
}

TEST(SpeedAccuracy, TheCheapestWithinABoundOnBothSidesOfIt) {
  const auto points = tiny();
  EXPECT_EQ(cheapest(points, 0.01)->cost, 4);
  EXPECT_EQ(cheapest(points, 0.0099)->cost, 8);
  EXPECT_EQ(cheapest(points, 0.02, &MethodFamily::is_default_peer)->cost, 5);
  EXPECT_EQ(cheapest(points, 0.0199, &MethodFamily::is_default_peer)->cost, 16);
  EXPECT_EQ(cheapest(points, 1e-4), nullptr);
  // the time of mysim/d, 4.05, overlaps with 4; bullet/b exceeds the bound
  EXPECT_EQ(statistically_tied(points, *cheapest(points, 0.01), 0.01, 0.01), std::vector<std::string>{"mysim/d"});
}

TriedRun tried(const std::string& method, double step, double cost, std::optional<double> error,
               Verdict verdict = Verdict::ok) {
  return {.method = method, .setting = {false, step}, .verdict = verdict, .error = error, .cost = cost};
}

TEST(Recommendation, IsTheCheapestConfirmedRunAndOfEqualsTheMostAccurate) {
  std::vector<TriedRun> runs{tried("mysim/a", 4, 100, {}, Verdict::energy),
                             tried("mysim/a", 2, 200, 9e-3),
                             tried("mysim/a", 1, 400, 4e-3),
                             tried("mysim/b", 2, 205, 2e-3),
                             tried("mysim/b", 1, 410, 1e-3),
                             tried("mysim/c", 8, 50, 5e-3),  // accidental: the finer run misses the bound
                             tried("mysim/c", 4, 100, 0.02),
                             tried("mysim/d", 8, 50, 5e-3),  // not confirmed by another run
                             tried("mysim/e", 1, 300, 1e-3),
                             tried("mysim/e", 0.5, 600, 1e-3)};
  const auto chosen = recommend(runs, 0.01);
  ASSERT_TRUE(chosen);
  EXPECT_EQ(runs[chosen->run].method, "mysim/b") << "costs 2.5 % more, below the resolution of the search";
  EXPECT_EQ(chosen->tied, std::vector<size_t>{1});
  EXPECT_EQ(chosen->second, std::optional<size_t>(1));
  EXPECT_EQ(chosen->bound, StepBound::none);
  runs[3].cost = 230;  // no longer tied
  EXPECT_EQ(recommend(runs, 0.01)->run, 1u);
  EXPECT_EQ(recommend(runs, 0.01)->bound, StepBound::stability);
  runs[0].verdict = Verdict::ok, runs[0].error = 0.5;
  EXPECT_EQ(recommend(runs, 0.01)->bound, StepBound::accuracy);
  runs[0].verdict = Verdict::timeout;
  EXPECT_EQ(recommend(runs, 0.01)->bound, StepBound::failure) << "a timeout says nothing about stability";
  EXPECT_FALSE(recommend(runs, 1e-4));
  EXPECT_FALSE(recommend({}, 1));
}

TEST(StepSearch, FindsTheSameStepWithTheLadderAndWithout) {
  const Scene scene = load_scene("cloth-hang");
  const crosscheck::Run base = default_run(scene);
  const double interval = base.duration / base.samples, limit = 1.12e-3;
  // rk4 is limited by accuracy, at a higher cost than its rivals; leapfrog is limited by stability; explicit Euler
  // fails at every step
  const auto trial = [&](const Method& m, const Setting& s) -> std::optional<TriedRun> {
    const double evaluations = m.stepper->evaluations * base.duration / s.value;
    const bool fails = m.name == "mysim/leapfrog" ? s.value > limit : m.name == "mysim/explicit-euler";
    const double error = m.name == "mysim/rk4" ? 1e8 * std::pow(s.value, 3) : 100 * s.value * s.value;
    return TriedRun{.verdict = fails ? Verdict::energy : Verdict::ok,
                    .error = fails ? std::optional<double>() : error,
                    .cost = evaluations * 3000};
  };
  const std::vector<Method> methods = find_methods("explicit-euler,leapfrog,rk4");
  std::vector<TriedRun> alone, seeded;
  StepSearch(scene, base, 0.01, trial, alone).search(methods);
  for (const Method& m : methods)
    for (const Setting& s : settings_of(m, scene, base, false)) {
      seeded.push_back(*trial(m, s));
      seeded.back().method = m.name, seeded.back().setting = s;
    }
  const size_t ladder = seeded.size();
  StepSearch(scene, base, 0.01, trial, seeded).search(methods);
  for (const auto& runs : {alone, seeded}) {
    const auto chosen = recommend(runs, 0.01);
    ASSERT_TRUE(chosen);
    const TriedRun& run = runs[chosen->run];
    EXPECT_EQ(run.method, "mysim/leapfrog");
    EXPECT_DOUBLE_EQ(run.setting.value, interval / 30) << "the longest step that divides the sampling interval";
    EXPECT_EQ(chosen->bound, StepBound::stability);
  }
  EXPECT_LE(seeded.size() - ladder, 6u);
  EXPECT_LE(std::ranges::count(alone, "mysim/rk4", &TriedRun::method), 7) << "the search stops once it cannot win";
}

TEST(Point, ATimedOneIsGivenTheRowsOfItsOwn) {
  Point first{"first", "content", [](TableSet& tables) { tables.notes.push_back("computed"); }};
  const Point timed = timed_after(first, "timed", [](const TableSet& rows, TableSet& tables) {
    tables.notes.push_back(rows.notes.empty() ? "nothing" : rows.notes[0] + " before");
  });
  EXPECT_TRUE(timed.timed);
  EXPECT_NE(timed.hash(), first.hash());
  EXPECT_EQ(computed({&timed, 1}).notes, std::vector<std::string>{"computed before"});
}

TEST(SpeedAccuracy, DistancesOverTimeAreLargestAndRms) {
  Trajectory a{{0, 1, 2}, {}, {}}, b = a;
  for (const double d : {0., 3., 4.}) {
    a.x.push_back(Points::Zero(3, 1));
    b.x.push_back(Points::Zero(3, 1));
    b.x.back()(0, 0) = d;
  }
  EXPECT_DOUBLE_EQ(distance_over_time(a, b, 2).largest, 4);
  EXPECT_DOUBLE_EQ(distance_over_time(a, b, 2).over_time, std::sqrt(25 / 3.));
  EXPECT_DOUBLE_EQ(distance_over_time(a, b, 1.5).largest, 3);  // the later difference is ignored
}

TEST(SpeedAccuracy, LaddersHalveTheStep) {
  const Scene scene = load_scene("spring");
  const crosscheck::Run run{1e-3, scene.duration, 10};
  const auto limited = settings_of(find_method("leapfrog"), scene, run, true),
             unlimited = settings_of(find_method("implicit-euler"), scene, run, true),
             adaptive = settings_of(find_method("dopri5"), scene, run, false);
  // Steps divide the sampling interval. Leapfrog fails above its limit of 2 / omega, where one or two runs suffice.
  const double limit = 2 / highest_frequency(scene.model, scene.start);
  const auto beyond = std::count_if(limited.begin(), limited.end(), [&](const Setting& s) { return s.value > limit; });
  EXPECT_GE(limited.front().value, std::min(limit, 64e-3 * 0.9));
  EXPECT_LE(beyond, 2);
  const auto stiff = settings_of(find_method("explicit-euler"), scene, run, true);
  EXPECT_NEAR(stiff.front().value, 8e-3, 1e-4) << "no step is stable without drag, so few settings suffice";
  EXPECT_NEAR(limited.back().value, 1e-3 / 16, 1e-6);
  EXPECT_NEAR(unlimited.front().value, 64e-3, 5e-3);
  ASSERT_EQ(adaptive.size(), 4u);
  EXPECT_TRUE(adaptive.front().tolerance);
  EXPECT_EQ(adaptive.front().applied_to(run).step, run.step);
  int dropped = 0;
  const auto cloth = load_scene("cloth-hang");
  settings_of(find_method("rk4"), cloth, default_run(cloth), false, &dropped);
  EXPECT_GT(dropped, 0);
}

TEST(SpeedAccuracy, OneNewtonStepIsEstimatedLikeAnImplicitRule) {
  const Scene scene = load_scene("cloth-hang");
  const auto seconds = [&](const char* method) { return estimated_seconds(find_method(method), scene, 10); };
  EXPECT_EQ(seconds("implicit-euler+linear"), seconds("implicit-euler"));
  EXPECT_GT(seconds("implicit-euler+linear"), 10 * seconds("leapfrog"));
  EXPECT_EQ(seconds("rk4+sticky"), seconds("rk4"));
}

TEST(SpeedAccuracy, OfLongRunsTheFirstPartIsTimed) {
  const Scene cloth = load_scene("cloth-hang"), ball = load_scene("slide");
  const Setting step{false, cloth.step}, tolerance{true, 1e-4};
  const Method leapfrog = find_method("leapfrog");
  EXPECT_EQ(part_of(leapfrog, cloth, default_run(cloth), step, true).share, 1) << "the run takes less than 0.2 s";
  crosscheck::Run run = default_run(cloth);
  run.duration *= 10, run.samples *= 10;
  const TimedPart part = part_of(leapfrog, cloth, run, step, true);
  EXPECT_LT(part.share, 0.7);
  EXPECT_NEAR(estimated_seconds(leapfrog, cloth, part.run), 0.02, 0.002);
  EXPECT_DOUBLE_EQ(part.run.step, time_grid(step.applied_to(run)).h);
  EXPECT_NEAR(part.run.duration, part.share * run.duration, 1e-9);
  const TimedPart adaptive = part_of(find_method("dopri5"), cloth, run, tolerance, true);
  EXPECT_LT(adaptive.share, 0.7);
  EXPECT_NEAR(adaptive.run.duration / adaptive.run.samples, run.duration / run.samples, 1e-12);  // whole intervals
  // for scenes with contact and external programs, the whole run is timed
  EXPECT_EQ(part_of(leapfrog, ball, {1e-7, 1, 10}, {false, 1e-7}, true).share, 1);
  Method outside = leapfrog;
  outside.fingerprint = "a program";
  EXPECT_EQ(part_of(outside, cloth, run, step, true).share, 1);
}

TEST(SpeedAccuracy, AMethodThatRefusesTheLongestStepIsTimedAtTheOthers) {
  const Scene scene = load_scene("spring");
  Request request;
  request.methods = {find_method("leapfrog")};
  request.methods[0].engine = [inner = request.methods[0].engine](const Scene& s, const crosscheck::Run& run,
                                                                  Observer& observer) {
    if (run.step > 5e-3) throw Unsupported("too long");
    return inner(s, run, observer);
  };
  TableSet tables;
  speed_accuracy_on(request, scene, tables);
  time_speed_accuracy(request, scene, tables, tables);
  const Table &errors = *tables.table("speed-accuracy"), &times = *tables.table("speed-accuracy-timing-cost");
  const auto settings = settings_of(request.methods[0], scene, default_run(scene), false);
  const auto all = std::ssize(settings),
             longer = std::ranges::count_if(settings, [](const Setting&s) { return s.value > 5e-3; });
  ASSERT_GT(longer, 0);
  EXPECT_EQ(std::ssize(errors.rows), all - longer);
  EXPECT_EQ(std::ssize(times.rows), all - longer);
  ASSERT_EQ(tables.notes.size(), 1u);
  EXPECT_TRUE(contains(tables.notes[0], fmt::format("leaves out {} of {} runs of mysim/leapfrog", longer, all)));
  EXPECT_TRUE(contains(tables.notes[0], "refused: too long"));
}

TEST(SpeedAccuracy, ABoundIsMetWithTheTruthsOwnBar) {
  TableSet tables;
  Table t = table_of<SpeedAccuracyRow>();
  // the motion is 1 m, the error bar 2 mm, and the errors are 7 and 9 mm at 20 and 10 evaluations
  for (const auto& [step, evaluations, error] : {std::tuple{0.1, 10l, 9e-3}, std::tuple{0.05, 20l, 7e-3}})
    add(t, SpeedAccuracyRow{.scene = "s",
                            .method = "mysim/a",
                            .requested = step,
                            .step = step,
                            .steps = evaluations,
                            .evaluations = evaluations,
                            .end = 1,
                            .error = error,
                            .error_over_time = error,
                            .motion = 1,
                            .until = 1,
                            .truth = "converged",
                            .truth_bar = 2e-3});
  tables.add(t);
  conclude_speed_accuracy(tables);
  const Table& best = *tables.table("speed-accuracy-cheapest");
  EXPECT_EQ(std::get<double>(best.at(0, "distance")), 9e-3);  // bound: 10 % of 1 m
  EXPECT_EQ(std::get<double>(best.at(1, "distance")), 7e-3);  // bound: 1 % of 1 m, which 9 + 2 mm exceed
  EXPECT_EQ(std::get<std::string>(best.at(2, "remark")), "below the error bar of the reference solution");
}

TableSet rows_of(const Scene& scene, const std::string& methods) {
  Request request;
  request.scenes = {scene};
  request.methods = find_methods(methods);
  auto points = speed_accuracy_points(request);
  std::erase_if(points, [](const Point& p) { return p.timed; });
  TableSet tables = computed(points);
  conclude_speed_accuracy(tables);
  return tables;
}

const Cell& cell(const TableSet& tables, const std::string& method, int i, const std::string& column) {
  const Table& t = *tables.table("speed-accuracy");
  for (size_t row = 0; row < t.rows.size(); ++row)
    if (std::get<std::string>(t.at(row, "method")) == method && i-- == 0) return t.at(row, column);
  throw std::out_of_range(method);
}

TEST(SpeedAccuracy, RowsAreTheSameTwiceAndFailedRunsAreRows) {
  const Scene spring = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1.1, 0, 0]\nmass = 1\n[[spring]]\nends "
      "= [0, 1]\n"
      "stiffness = 400\nrest = 1\n[pins]\nparticles = [0]\n",
      1, 0.04, 5);  // omega = 20/s: leapfrog is stable up to 0.1 s
  const TableSet once = rows_of(spring, "leapfrog,bullet/deformable-explicit"),
                 twice = rows_of(spring, "leapfrog,bullet/deformable-explicit");
  ASSERT_FALSE(once.tables.empty());
  for (const Table& t : once.tables) EXPECT_EQ(csv(t, {}), csv(*twice.table(t.name), {})) << t.name;

  EXPECT_EQ(std::get<std::string>(cell(once, "mysim/leapfrog", 0, "verdict")), "energy");  // at 0.2 s
  EXPECT_GT(std::get<long>(cell(once, "mysim/leapfrog", 0, "evaluations")), 0);
  EXPECT_LT(std::get<double>(cell(once, "mysim/leapfrog", 0, "end")), 1);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(cell(once, "mysim/leapfrog", 0, "largest error")));
  // The error falls with the square of the step, and so does the distance from the finest run.
  const double coarse = std::get<double>(cell(once, "mysim/leapfrog", 3, "largest error")),
               fine = std::get<double>(cell(once, "mysim/leapfrog", 4, "largest error"));
  EXPECT_NEAR(slope(coarse, fine), 2, 0.2);
  EXPECT_NEAR(std::get<double>(cell(once, "mysim/leapfrog", 4, "distance to own finest")) / fine, 1, 0.1);

  // Bullet implements symplectic Euler, which has order 1, so that leapfrog needs fewer evaluations for the same error.
  const Table& best = *once.table("speed-accuracy-cheapest");
  ASSERT_EQ(best.rows.size(), 3u);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(std::get<std::string>(best.at(i, "measure")), "error");
  EXPECT_EQ(std::get<std::string>(best.at(1, "method")), "mysim/leapfrog");
  EXPECT_LE(std::get<double>(best.at(1, "distance")), std::get<double>(best.at(1, "bound")));
  EXPECT_EQ(once.table("speed-accuracy-cost")->rows.size(), 0u);  // nothing was timed
}

TEST(SpeedAccuracy, FirstOrderScenesAreAnsweredByWhoTakesThem) {
  const TableSet tables = rows_of(load_scene("circle"), "rk4,leapfrog,explicit-euler,dopri5");
  auto of_rk4 = [&](int i, const char* column) { return std::get<double>(cell(tables, "mysim/rk4", i, column)); };
  // rk4 has order 4. Steps divide the sampling interval, so that they are not exactly halved.
  EXPECT_NEAR(std::log(of_rk4(2, "largest error") / of_rk4(3, "largest error")) /
                  std::log(of_rk4(2, "step") / of_rk4(3, "step")),
              4, 0.1);
  EXPECT_THROW(cell(tables, "mysim/leapfrog", 0, "verdict"), std::out_of_range);  // needs velocities
  EXPECT_EQ(std::get<std::string>(cell(tables, "mysim/dopri5", 0, "setting")), "tolerance [1]");
  EXPECT_GT(tables.table("speed-accuracy-pareto")->rows.size(), 2u);
}

TEST(SpeedAccuracy, WhereNothingMovesNothingIsCompared) {
  const Scene still = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 1\n"
      "[[spring]]\nends = [0, 1]\nstiffness = 10\nrest = 1\n");
  const TableSet tables = rows_of(still, "leapfrog");
  EXPECT_EQ(tables.table("speed-accuracy"), nullptr);
  ASSERT_EQ(tables.notes.size(), 1u);
  EXPECT_TRUE(contains(tables.notes[0], "leaves out small: nothing moves"));
}

std::string twice(const std::string& text) { return text + text; }

TEST(SpeedAccuracy, FromTheContactRulesAnswerThereAreDifferencesOnly) {
  // A particle slides over a moving ball that is listed twice. The second solution does not support two spheres, and
  // the limit of mysim's contact rule alone does not count as truth.
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 1.02, 0]\nmass = 1\nvelocity = [1, 0, 0]\n" +
      twice("[[sphere]]\ncentre = [0, 0, 0]\nradius = 1\nmargin = 0.02\nfriction = 0.2\n[sphere.motion]\namplitude = "
            "[0, 0.01, 0]\nfrequency = 0.5\nramp = 0.5\n") +
      "[drag]\ngamma = 0.5\n" + gravity_text);
  const TableSet tables = rows_of(scene, "leapfrog");
  const Table& t = *tables.table("speed-accuracy");
  ASSERT_FALSE(t.rows.empty());
  for (size_t i = 0; i < t.rows.size(); ++i) {
    EXPECT_EQ(std::get<std::string>(t.at(i, "truth")), "converged, mysim's contact rule");
    for (const char* column : {"largest error", "error over time"})
      EXPECT_TRUE(std::holds_alternative<std::monostate>(t.at(i, column))) << column;
    EXPECT_GT(std::get<double>(t.at(i, "largest difference from converged contact")), 0);
  }
  const Table& best = *tables.table("speed-accuracy-cheapest");
  ASSERT_EQ(best.rows.size(), 3u);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(std::get<std::string>(best.at(i, "measure")), "difference");
}

TEST(SpeedAccuracy, TimesAreScaledToTheWholeRun) {
  TableSet tables = rows_of(load_scene("spring"), "leapfrog");
  const long evaluations = std::get<long>(cell(tables, "mysim/leapfrog", 3, "evaluations"));
  TableSet timed;
  timed.add(*tables.table("speed-accuracy"));
  // a tenth of the run was timed and took 2 s
  Table t = table_of<SpeedAccuracyTimingRow>();
  add(t, SpeedAccuracyTimingRow{.scene = "spring",
                                .method = "mysim/leapfrog",
                                .requested = std::get<double>(cell(tables, "mysim/leapfrog", 3, "asked")),
                                .part = 0.1,
                                .evaluations = evaluations / 10,
                                .cpu = 2,
                                .cpu_low = 1.9,
                                .cpu_high = 2.2,
                                .repetitions = 5,
                                .noise = 0.03});
  timed.add(t);
  conclude_speed_accuracy(timed);
  const Table& cost = *timed.table("speed-accuracy-cost");
  ASSERT_EQ(cost.rows.size(), 1u);
  const double factor = static_cast<double>(evaluations) / static_cast<double>(evaluations / 10);
  EXPECT_DOUBLE_EQ(std::get<double>(cost.at(0, "cpu")), 2 * factor);
  EXPECT_DOUBLE_EQ(std::get<double>(cost.at(0, "cpu high")), 2.2 * factor);
  EXPECT_EQ(std::get<std::string>(cost.at(0, "build")), "this build");
}

}  // namespace
}  // namespace crosscheck
