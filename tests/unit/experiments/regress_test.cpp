
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <tuple>

#include "experiments/regress/baseline.h"
#include "experiments/regress/comparison.h"
#include "experiments/regress/quantities.h"
#include "experiments/regress/regress.h"
#include "experiments/regress/tolerance.h"
#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "tests/unit/experiments/test_case.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using testing_tools::test_case;

BaselineRow expected(const std::string& name, double value, double tolerance) {
  return {"mysim/leapfrog", "", false, {{name, "m", value}, tolerance, "why, and why not"}, 1};
}

Baseline small_baseline() {
  Baseline b{"chain",
             "0123456789abcdef",
             {{"2026-01-02", "abc", "g++ -O3", "first"}, {"2026-01-03", "abd", "g++", "new"}},
             {}};
  b.expected = {expected("sag, \"deep\"", 0.1, 1.2e-13), expected("period", -1. / 3, 0.5)};
  b.expected.push_back({"bullet/pbd", "drag", true, {{"verdict", "word", 0, "ok"}, 0, "word"}, 2});
  return b;
}

TEST(Baselines, ComeBackToTheSameBits) {
  const TemporaryFolder folder("baselines");
  write_file(file_of(folder.path, "chain"), text_of(small_baseline()));
  const auto read = read_baseline(folder.path, "chain");
  ASSERT_TRUE(read);
  EXPECT_EQ(text_of(*read), text_of(small_baseline()));
  EXPECT_EQ(read->expected[1].what.quantity.value, -1. / 3);
  EXPECT_EQ(read->expected[0].what.quantity.name, "sag, \"deep\"");
  EXPECT_EQ(read->blessings[1].reason, "new");
  EXPECT_FALSE(read_baseline(folder.path, "no-such-scene"));
}

TEST(Baselines, ThatAreLinksOrPipesAreNotRead) {
  const TemporaryFolder folder("baselines");
  for (const char* file : {"chain.csv", "chain-shape.csv"}) ASSERT_EQ(mkfifo((folder.path / file).c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder.path / "spring.csv");
  EXPECT_THROW(read_baseline(folder.path, "chain"), InputError);
  EXPECT_THROW(read_baseline(folder.path, "spring"), InputError);
  EXPECT_THROW(read_shape(folder.path, "chain", 4), InputError);
}

/// Checks the size of tolerances, because wrong perturbed runs could make a tolerance so large that nothing fails.
TEST(Baselines, ShippedOnesAreOfTheScenesAsTheyAreAndTheirTolerancesCanFail) {
  long all = 0, unpredictable = 0;
  for (const std::string_view name : shipped_scenes()) {
    const Scene scene = load_scene(std::string(name));
    const auto baseline = read_baseline(std::filesystem::path(CROSSCHECK_SOURCE) / "reference/baselines", scene.name);
    ASSERT_TRUE(baseline) << name;
    EXPECT_EQ(baseline->hash, scene.hash) << name;
    std::map<std::tuple<std::string, std::string, std::string>, double> largest;
    const auto key = [](const BaselineRow& e) { return std::tuple{e.method, e.without, e.what.quantity.unit}; };
    for (const BaselineRow& e : baseline->expected)
      largest[key(e)] = std::max(largest[key(e)], std::abs(e.what.quantity.value));
    for (const BaselineRow& e : baseline->expected) {
      ++all;
      const bool beyond = e.what.derivation.ends_with("beyond prediction");
      unpredictable += beyond;
      // explicit Euler gains energy, and amplifies perturbations more than the scene does
      if (beyond && (!e.without.empty() || e.method == "mysim/explicit-euler")) continue;
      if (e.method.starts_with("bullet32/")) continue;  // quantities near zero have large relative rounding errors
      if (e.what.quantity.name == time_of_failure) {  // known to within a sample; with a ball, to within a few samples
        EXPECT_LE(e.what.tolerance, 8 * scene.duration / scene.samples) << name << ", " << e.method;
        continue;
      }
      // If an ingredient is removed, a scene may be less predictable than its window states (the flag without air
      // buckles). The floor of 1e-8 allows for quantities that are zero up to rounding.
      EXPECT_LE(e.what.tolerance, std::max(1e-8, (e.without.empty() ? 0.02 : 0.1) * largest[key(e)]))
          << name << ", " << e.method << " without '" << e.without << "', " << e.what.quantity.name;
    }
  }
  EXPECT_LT(unpredictable, all / 25);
}

TEST(Baselines, EachDamageIsNamedWithItsLine) {
  const TemporaryFolder folder("baselines");
  const std::string good = text_of(small_baseline());
  const struct {
    const char *right, *wrong, *says;
  } damages[] = {
      {"# scene: chain", "# scene: cloth", ":2: expected the scene chain"},
      {"# rows: 3", "# rows: 4", "expected 4 rows, got 3"},
      {"# hash: ", "# hush: ", ":3: expected a line '# hash: ...'"},
      {"# blessing 2: ", "# blessing 3: ", ":5: expected a line '# blessing 2: ...'"},
      {" | first", " | ", ":4: expected DATE | COMMIT | BUILD | REASON, none of them empty"},
      {"method,without", "methods,without", "expected the header"},
      {",1.2e-13,1,", ",nan,1,", "expected a finite number for the tolerance, got 'nan'"},
      {",1.2e-13,1,", ",-1,1,", "expected a tolerance that is not negative"},
      {",1.2e-13,1,", ",1.2e-13,3,", "expected the number of a blessing from 1 to 2, got 3"},
      {",0.5,1,", ",0.5,1,0,", "expected 9 fields, got 10"},
      {"always", "sometimes", "expected always or full, got 'sometimes'"},
      {"\"why, and why not\"", "\"why, and why not", "expected a closing quote"},
  };
  for (const auto& [right, wrong, says] : damages) {
    SCOPED_TRACE(wrong);
    std::string text = good;
    ASSERT_NE(text.find(right), std::string::npos);
    text.replace(text.find(right), std::string(right).size(), wrong);
    write_file(file_of(folder.path, "chain"), text);
    try {
      read_baseline(folder.path, "chain");
      ADD_FAILURE() << "expected an error";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("chain.csv:"), std::string::npos) << error.what();
    }
  }
  write_file(file_of(folder.path, "chain"), good.substr(0, good.find("mysim/leapfrog")));
  EXPECT_THROW(read_baseline(folder.path, "chain"), InputError);  // no rows
}

TEST(Comparison, SaysOfEachQuantityHowItStands) {
  const std::vector<BaselineRow> was{expected("at the edge", 1, 0.25),
                                     expected("beyond", 1, 0.25),
                                     expected("zero but for rounding", 0, 1e-15),
                                     expected("no number", 1, 0.25),
                                     expected("not there", 1, 0.25),
                                     expected("count", 3, 0),
                                     {"mysim/leapfrog", "", false, {{"verdict", "word", 0, "ok"}, 0, "word"}, 1}};
  const std::vector<Quantity> is{
      {"at the edge", "m", 1.25}, {"beyond", "m", 1.2500001}, {"zero but for rounding", "m", -9e-16},
      {"no number", "m", NAN},    {"count", "m", 4},          {"verdict", "word", 0, "nan"},
      {"unheard of", "m", 1}};
  const std::map<std::string, Status> expected_standings{
      {"at the edge", Status::same},     {"beyond", Status::moved},    {"zero but for rounding", Status::same},
      {"no number", Status::not_finite}, {"not there", Status::gone},  {"count", Status::moved},
      {"verdict", Status::moved},        {"unheard of", Status::added}};
  const std::vector<Comparison> rows = compared(test_case(), is, was);
  ASSERT_EQ(rows.size(), expected_standings.size());
  for (const Comparison& row : rows) EXPECT_EQ(row.state, expected_standings.at(row.quantity)) << row.quantity;
  EXPECT_TRUE(failed(Status::gone));
  EXPECT_FALSE(failed(Status::added));
}

TEST(Comparison, AMethodWithoutBaselineRowsIsNewAndFailsNothingButNotFiniteNumbers) {
  const std::vector<Comparison> rows = compared(test_case(), {{"sag", "m", 1}, {"period", "s", NAN}}, {});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].state, Status::added);
  EXPECT_EQ(rows[1].state, Status::not_finite);
}

TEST(Comparison, ARunThatEndedInNoNumbersNeverIsTheSameAndNeverNew) {
  const Quantity verdict{"verdict", "word", 0, "nan"};
  const BaselineRow blessed{"mysim/leapfrog", "", false, {verdict, 0, "word"}, 1};
  EXPECT_EQ(compared(test_case(), {verdict}, {blessed}).at(0).state, Status::not_finite);
  EXPECT_EQ(compared(test_case(), {verdict}, {}).at(0).state, Status::not_finite);
}

TEST(Regression, RefusesScenesOfTheSameNameOrFileName) {
  const TemporaryFolder folder("names");
  const std::string spring = load_scene("spring").source;
  for (const char* name : {"a/s.toml", "b/s.toml", "a/s s.toml", "b/s-s.toml"}) {
    std::filesystem::create_directories((folder.path / name).parent_path());
    write_file(folder.path / name, spring);
  }
  const auto path = [&](const char* name) { return (folder.path / name).string(); };
  for (const std::vector<std::string>& scenes : std::vector<std::vector<std::string>>{
           {path("a/s.toml"), path("b/s.toml")}, {path("a/s s.toml"), path("b/s-s.toml")}, {"spring", "spring"}}) {
    EXPECT_THROW(cases({scenes}), InputError);
  }
  EXPECT_FALSE(cases({{path("a/s.toml"), path("b/s-s.toml")}}).empty());
}

class RegressionOfOneScene : public testing::Test {
 protected:
  Regression regression_with(const std::string& method, const std::string& scene) const {
    return {{{scene}, false, "", {find_method(method)}}, {}, folder_.path / "baselines", folder_.path / "out"};
  }
  BlessResult blessed(const Regression& regression) const {
    Progress progress(0);
    BlessResult result = bless(regression, {"2026-01-02", "abc", "g++", "test"}, progress);
    std::filesystem::create_directories(regression.baselines);
    for (const auto& [file, text] : result.files) write_file(file, text);
    return result;
  }
  RegressionResult regressed(const Regression& regression) const {
    Progress progress(0);
    return regress(regression, progress);
  }
  const TemporaryFolder folder_{"regression"};
};

TEST_F(RegressionOfOneScene, FailsWhereNothingWasMeasured) {
  const Regression refused = regression_with("bullet/pbd", "circle");  // a first-order scene
  EXPECT_FALSE(blessed(refused).measured);
  const RegressionResult result = regressed(refused);
  EXPECT_FALSE(result.measured());
  EXPECT_FALSE(result.passed());
  const Regression measured = regression_with("leapfrog", "spring");
  EXPECT_TRUE(blessed(measured).measured);
  EXPECT_TRUE(regressed(measured).passed());
}

TEST_F(RegressionOfOneScene, BlessingSaysAnewWhichRowsAreOfFullRunsOnly) {
  const Regression regression = regression_with("leapfrog", "spring");
  blessed(regression);
  Baseline baseline = *read_baseline(regression.baselines, "spring");
  for (BaselineRow& row : baseline.expected) row.slow = true;
  baseline.expected.pop_back();
  write_file(file_of(regression.baselines, "spring"), text_of(baseline));
  blessed(regression);
  int kept = 0;
  baseline = *read_baseline(regression.baselines, "spring");
  for (const BaselineRow& row : baseline.expected) {
    EXPECT_FALSE(row.slow) << row.what.quantity.name;
    kept += row.blessing == 1;
  }
  EXPECT_GT(kept, 10);
}

TEST_F(RegressionOfOneScene, TellsAnotherExpansionOfTheSameFileFromAnotherFile) {
  const auto file = folder_.path / "mine.toml";
  const std::string text = load_scene("spring").source;
  write_file(file, text);
  const Regression regression = regression_with("leapfrog", file.string());
  blessed(regression);
  Baseline baseline = *read_baseline(regression.baselines, "mine");
  baseline.hash = "0123456789abcdef";
  write_file(file_of(regression.baselines, "mine"), text_of(baseline));
  const auto note = [&] { return regressed(regression).rows.at(0).note; };
  EXPECT_NE(note().find("the same file now expands to another scene"), std::string::npos) << note();
  write_file(file, text + "# another file\n");
  EXPECT_EQ(note().find("the same file"), std::string::npos) << note();
}

TEST(Comparison, NewMethodsAreThoseOfWhichASceneKnowsNothing) {
  std::vector<Comparison> rows;
  const auto add = [&](const char* scene, const char* method, const char* quantity, Status state) {
    Comparison row;
    row.scene = scene, row.method = method, row.quantity = quantity, row.state = state, row.is = 1;
    if (state == Status::same) row.was = 1;
    rows.push_back(row);
  };
  add("spring", "mysim/rk4", "sag", Status::same);
  add("spring", "mysim/rk4", "period", Status::added);  // a new quantity of a known method
  for (const char* scene : {"spring", "chain"})
    for (const char* quantity : {"sag", "period"}) add(scene, "mysim/new", quantity, Status::added);
  add("chain", "mysim/new", "energy", Status::not_finite);
  add("chain", "mysim/rk4", "sag", Status::added);  // known in another scene, new in this one
  const std::vector<NewMethod> all = new_methods(rows);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].method, "mysim/new");
  EXPECT_EQ(all[0].scenes, 2u);
  EXPECT_EQ(all[0].quantities, 4u);
  EXPECT_EQ(all[1].method, "mysim/rk4");
  EXPECT_EQ(all[1].scenes, 1u);
  EXPECT_EQ(all[1].quantities, 1u);
}

TEST(Comparison, OfEachQuestionTheRowToLookAtFirstIsAWordThenANumberThenACount) {
  const auto row = [](const std::string& scene, const std::string& quantity, double is, double tolerance) {
    Comparison r;
    r.scene = scene, r.method = "mysim/rk4", r.quantity = quantity, r.unit = "m", r.state = Status::moved;
    r.was = 1, r.is = is, r.tolerance = tolerance;
    return r;
  };
  Comparison word = row("chain", "verdict", 1, 0);
  word.unit = "word";
  const std::vector<Comparison> worst =
      worst_comparisons({row("spring", "steps", 2, 0), row("spring", "sag", 2, 0.1), row("spring", "period", 2, 0.5),
                         row("chain", "sag", 9, 1e-9), word, row("rod", "steps", 3, 0)});
  ASSERT_EQ(worst.size(), 3u);
  EXPECT_EQ(worst[0].quantity, "sag") << "ten tolerances off; neither the one that is two off nor the count";
  EXPECT_EQ(worst[1].quantity, "verdict");
  EXPECT_EQ(worst[2].quantity, "steps");
}

TEST(Shapes, ComeBackAndDamagedOnesAreNone) {
  const TemporaryFolder folder("shapes");
  Points x(3, 2);
  x << 1, 2, 3, 4.25, -5, 1e-3;
  const std::string text = shape_text("chain", "mysim/leapfrog", 1.5, x);
  write_file(shape_file(folder.path, "chain"), text);
  const auto shape = read_shape(folder.path, "chain", 2);
  ASSERT_TRUE(shape);
  EXPECT_EQ(shape->t, 1.5);
  EXPECT_EQ(shape->x, x);
  EXPECT_FALSE(read_shape(folder.path, "chain", 3));
  EXPECT_FALSE(read_shape(folder.path, "cloth", 2));
  write_file(shape_file(folder.path, "chain"), text.substr(0, text.size() - 12));
  EXPECT_FALSE(read_shape(folder.path, "chain", 2));
}

using testing_tools::test_case;

Quantities taken(void (*row)(const Observation&, Quantities&), const Case& q, const CaseRun& case_run) {
  Quantities out;
  row({q, case_run}, out);
  return out;
}

TEST(Quantities, SettleTimeIsWhereMotionHasDiedAway) {
  const Case q = test_case("chain");
  CaseRun decaying;
  for (int i = 0; i <= 100; ++i) {
    LedgerRow row{};
    row.t = 0.1 * i;
    row.energy.kinetic = 3 * std::exp(-row.t);
    decaying.ledger.push_back(row);
  }
  const Quantities settled = taken(settle_time, q, decaying);
  ASSERT_EQ(settled.size(), 1u);
  EXPECT_NEAR(settled[0].value, std::log(100.), 1e-12) << "the logarithm of an exponential is linear between samples";
  decaying.ledger.resize(40);  // 4 s: not yet settled
  EXPECT_TRUE(taken(settle_time, q, decaying).empty());
}

TEST(Quantities, OfARunThatSlidesOffABallTheAngleIsThatOfTheClosedForm) {
  const Case q = test_case("slide");
  const CaseRun case_run = run_case(q);
  const Quantities angle = taken(leaving_angle, q, case_run);
  ASSERT_EQ(angle.size(), 1u);
  // Contact ends at 53.1 degrees, and the gap reaches 1 mm a little later.
  EXPECT_GT(angle[0].value, 53.1);
  EXPECT_LT(angle[0].value, 60);
  EXPECT_TRUE(taken(leaving_angle, test_case("bounce"), run_case(test_case("bounce"))).empty());
}

TEST(Quantities, OfAFailedRunWhenItFailedAndWhatItDidBefore) {
  const Case q = test_case("cloth-hang", "explicit-euler");
  const std::vector<QuantityWithTolerance> all = with_tolerances(q);
  std::map<std::string, QuantityWithTolerance> by_name;
  for (const QuantityWithTolerance& t : all) by_name[t.quantity.name] = t;
  ASSERT_NE(by_name["verdict"].quantity.word, "ok");
  ASSERT_TRUE(by_name.contains(time_of_failure));
  const QuantityWithTolerance& when = by_name[time_of_failure];
  EXPECT_GT(when.quantity.value, 0);
  EXPECT_GE(when.tolerance, q.scene.duration / q.scene.samples) << "failures are detected at samples";
  EXPECT_LT(when.tolerance, 0.5 * when.quantity.value + 3 * q.scene.duration / q.scene.samples);
}

TEST(Quantities, SettingsAreWhatTheEngineTells) {
  const auto settings_of = [](const std::string& method) {
    std::map<std::string, std::string> words;
    const Case q = test_case("chain", method);
    for (const Quantity& each : quantities_of(q, run_case(q)))
      if (each.name.starts_with(setting_prefix)) words[each.name] = each.word;
    return words;
  };
  EXPECT_EQ(settings_of("bullet/pbd+n=7")["setting iterations"], "7");
  EXPECT_EQ(settings_of("bullet/deformable-explicit")["setting sleeping"], "off");
  EXPECT_EQ(settings_of("bullet/deformable-explicit+default-sleep")["setting sleeping"], "on");
  EXPECT_EQ(settings_of("bullet/pbd")["setting precision"], "double");
  EXPECT_TRUE(settings_of("mysim/leapfrog").empty());
}

/// The rounding error assumed for a step must cover the difference between two implementations of the same rule.
TEST(Tolerances, HoldBetweenTwoEnginesOfOneRule) {
  for (const char* scene : {"projectile", "chain", "pendulum", "spring"}) {
    const Case ours = test_case(scene, "symplectic-euler"), theirs = test_case(scene, "bullet/deformable-explicit");
    const std::vector<Quantity> is = quantities_of(theirs, run_case(theirs));
    for (const QuantityWithTolerance& was : with_tolerances(ours)) {
      const Quantity* other = find(is, was.quantity.name);
      if (!other || was.quantity.is_word() || was.quantity.count) continue;
      EXPECT_NEAR(other->value, was.quantity.value, was.tolerance) << scene << ", " << was.quantity.name;
    }
  }
}

}  // namespace
}  // namespace crosscheck
