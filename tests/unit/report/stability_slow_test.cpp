// Tests limits of a hanging cloth, rows of limits, stability maps and their figure.

#include <algorithm>
#include <filesystem>

#include "experiments/stability/map.h"
#include "experiments/stability/margin.h"
#include "experiments/stability/stability.h"
#include "report/figures/figure.h"
#include "tests/unit/experiments/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

Scene small_hanging_cloth() { return *map_scene(load_scene("cloth-hang"), false); }

TEST(ClothHang, HoldsSixPerCentBelowThePredictedLimitAndFailsSixPerCentAbove) {
  const BaseState base = base_state_of(load_scene("cloth-hang"));
  ASSERT_TRUE(base.at_rest);
  for (const char* name :
       {"mysim/rk4", "mysim/symplectic-euler", "mysim/leapfrog", "mysim/suzuki4", "bullet/deformable-explicit"}) {
    SCOPED_TRACE(name);
    const Method method = find_method(name);
    const PredictedLimit p = predicted_limit(*stepper_of(method), base.spectrum);
    for (const double part : {0.94, 1.06}) {
      // 5 s
      const long steps = std::lround(5 / (part * p.limit));
      const PerturbedRun trial = run_perturbed(method, base, part * p.limit, steps, {p.mode});
      EXPECT_EQ(trial.held(), part < 1) << part << ": " << name_of(trial.verdict) << ", growth " << trial.growth;
    }
  }
}

TEST(ClothHang, UnderDragSlowRulesGrowOrDecayAsPredictedBesideTheirLimit) {
  const BaseState base = base_state_of(small_hanging_cloth());
  ASSERT_TRUE(base.at_rest);
  for (const char* name : {"mysim/explicit-euler", "mysim/trapezoidal"}) {
    const Method method = find_method(name);
    const PredictedLimit p = predicted_limit(*method.stepper, base.spectrum);
    ASSERT_GT(p.limit, 0);
    const Vibration v = base.spectrum.modes[p.mode];
    EXPECT_EQ(v.omega, base.spectrum.omega);
    for (const double part : {0.94, 0.98, 1.02, 1.06}) {
      SCOPED_TRACE(fmt::format("{} at {} of its limit", name, part));
      const double h = part * p.limit, expected = std::log(growth_per_step(*method.stepper, v, h));
      EXPECT_EQ(expected > 0, part > 1);
      const PerturbedRun trial = run_perturbed(method, base, h, 2000, {p.mode});
      ASSERT_TRUE(trial.of_mode);
      EXPECT_EQ(trial.held(), part < 1);
      // rounding and nonlinearity may change the amplitude by 1e-6 in 2000 steps
      EXPECT_NEAR(std::log(trial.per_step), expected, 1e-6 / 2000 + 0.01 * std::abs(expected));
    }
  }
}

TEST(Map, FailsWhereTheoryDrawsTheLineAndHardlyChangesInRunsTenTimesLonger) {
  for (const MapKind& kind : map_kinds())
    for (const char* name :
         {"mysim/explicit-euler", "mysim/rk4", "mysim/symplectic-euler", "mysim/leapfrog", "mysim/trapezoidal"}) {
      SCOPED_TRACE(fmt::format("{} over {}", name, kind.name));
      TableSet rows;
      add_map(kind, load_scene("spring"), find_method(name), {7, 9, 1000, true}, rows);
      const Table &map = *rows.table("stability-map"), &limits = *rows.table("stability-map-limit"),
                  &check = *rows.table("stability-map-check");
      ASSERT_EQ(map.rows.size(), 63);
      ASSERT_EQ(limits.rows.size(), 7);
      for (size_t i = 0; i < map.rows.size(); ++i) {
        const double h = std::get<double>(map.at(i, "step")),
                     limit = std::get<double>(limits.at(i / 9, "predicted limit"));
        // without drag, the trapezoidal rule's amplitude grows by (h omega)^4 / 8 per step, which is too little to
        // measure if the step is short
        const bool slow = limit == 0 && std::string(name) == "mysim/trapezoidal";
        if (!slow && std::abs(h / limit - 1) > 0.02) {
          EXPECT_EQ(std::get<std::string>(map.at(i, "verdict")) == "ok", h < limit) << h << " against " << limit;
        }
      }
      EXPECT_EQ(std::get<long>(check.at(0, "cells")), 63);
      EXPECT_LT(std::get<long>(check.at(0, "changed")), 0.01 * 63);
    }
}

TEST(Map, OfAClothHardlyChangesInRunsTenTimesLonger) {
  for (const MapKind& kind : map_kinds()) {
    TableSet rows;
    add_map(kind, small_hanging_cloth(), find_method("mysim/symplectic-euler"), {5, 7, 1000, true}, rows);
    EXPECT_EQ(std::get<long>(rows.table("stability-map-check")->at(0, "changed")), 0) << kind.name;
  }
}

TEST(Map, SaysWhichCellsWereRefusedAndIsNoneWhereAllWere) {
  const Scene spring = load_scene("spring");
  const double omega = base_state_of(spring).spectrum.omega;
  TableSet rows;
  add_map(map_kinds()[0], spring, refusing_above(1 / omega), {3, 9, 300, true}, rows);
  const Table &cells = *rows.table("stability-map"), &limits = *rows.table("stability-map-limit");
  long refused = 0;
  for (size_t i = 0; i < cells.rows.size(); ++i) {
    const bool longer = std::get<double>(cells.at(i, "step")) * omega > 1;
    EXPECT_EQ(std::get<std::string>(cells.at(i, "verdict")) == "unsupported", longer);
    EXPECT_EQ(std::holds_alternative<std::monostate>(cells.at(i, "end")), longer);
    refused += longer;
  }
  EXPECT_EQ(refused, 3 * 4);  // four steps in each of three rows: h omega = 20, 8.4, 3.6 and 1.5
  EXPECT_EQ(std::get<long>(rows.table("stability-map-check")->at(0, "cells")), 27 - refused);
  // at a hundred times the stiffness, leapfrog fails at steps shorter than those that it refuses; at a hundredth,
  // nothing fails
  EXPECT_TRUE(std::holds_alternative<double>(limits.at(2, "failed")));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(limits.at(0, "failed")));

  TableSet none;
  add_map(map_kinds()[0], spring, refusing_above(0), {3, 9, 300, true}, none);
  EXPECT_TRUE(none.tables.empty());
  ASSERT_EQ(none.notes.size(), 1u);
  EXPECT_TRUE(contains(none.notes[0], "no cell has a result: too long"));
}

TEST(Map, KnowsWhatItIsMadeOf) {
  EXPECT_EQ(map_scene(load_scene("spring"), false)->name, "spring");
  for (const char* name : {"cloth-hang", "cloth-stiff"})
    for (const bool full : {false, true}) {
      const Scene cloth = *map_scene(load_scene(name), full);
      EXPECT_EQ(cloth.name, std::string(name) + "-6");
      EXPECT_EQ(cloth.start.x.cols(), 36);
    }
  EXPECT_FALSE(map_scene(load_scene("jelly"), false));
  EXPECT_EQ(map_scene(load_scene("jelly"), true)->name, "jelly");
  EXPECT_FALSE(map_scene(load_scene("projectile"), true));
  // a scene of a user that has the name of a shipped scene
  const Scene own =
      parse_scene(std::regex_replace(text_of("cloth-hang"), std::regex("mass = 0.25"), "mass = 0.5"), "cloth-hang");
  EXPECT_NEAR(map_scene(own, false)->model.particles.mass.sum(), 0.5, 1e-12);
}

TEST(Map, IsAsFineAsItsCostAllows) {
  const Method leapfrog = find_method("leapfrog"), pbd = find_method("bullet/pbd");
  const Scene spring = load_scene("spring"), jelly = load_scene("jelly"), cloth = small_hanging_cloth();
  EXPECT_EQ(map_size(leapfrog, cloth, false)->columns, 12);
  EXPECT_EQ(map_size(pbd, cloth, false)->columns, 9);
  EXPECT_TRUE(map_size(leapfrog, spring, false)->check);
  EXPECT_FALSE(map_size(leapfrog, cloth, false)->check);
  EXPECT_EQ(map_size(leapfrog, spring, true)->columns, 25);
  EXPECT_EQ(map_size(find_method("implicit-euler"), jelly, true), std::nullopt);
}

TEST(Maps, AreDrawnOfEveryWayOfBreaking) {
  std::vector<std::string> drawn;
  for (const Method& m : builtin_methods())
    if (is_mapped(m)) drawn.push_back(m.name);
  EXPECT_EQ(drawn,
            (std::vector<std::string>{"mysim/explicit-euler", "mysim/rk4", "mysim/symplectic-euler",
                                      "bullet/deformable-explicit", "bullet/deformable-implicit", "bullet/pbd"}));
  EXPECT_FALSE(is_mapped(find_method("symplectic-euler+sticky")));
}

TEST(Limits, AreSearchedAsFarAsTheirCostAllows) {
  const Method leapfrog = find_method("leapfrog"), implicit = find_method("implicit-euler"),
               theirs = find_method("bullet/deformable-explicit");
  const Scene spring = load_scene("spring"), cloth = load_scene("cloth-hang");
  EXPECT_EQ(effort_for(implicit, cloth, false).steps, 100);
  EXPECT_EQ(effort_for(theirs, cloth, false).steps, 1000);
  for (const Method& method : {leapfrog, theirs}) EXPECT_EQ(effort_for(method, spring, false).steps, 4000);
  EXPECT_EQ(effort_for(leapfrog, spring, true).steps, 20000);
  EXPECT_EQ(effort_for(leapfrog, spring, true).precision, 0.001);
  EXPECT_EQ(effort_for(find_method("implicit-midpoint"), cloth, true).precision, 0.5);
  for (const Scene& scene : {spring, cloth, load_scene("cloth-sphere")})
    for (const Method& method : {leapfrog, implicit, theirs, find_method("suzuki4")}) {
      const Effort quick = effort_for(method, scene, false), full = effort_for(method, scene, true);
      EXPECT_GE(full.steps, quick.steps) << method.name << " on " << scene.name;
      EXPECT_LE(full.precision, quick.precision) << method.name << " on " << scene.name;
    }
}

TableSet limit_of(const char* method, const char* scene, const Effort& effort) {
  TableSet rows;
  add_limit(load_scene(scene), find_method(method), effort, rows);
  return rows;
}
const std::string& reason_of(const TableSet& rows) {
  return std::get<std::string>(rows.table("stability")->at(0, "reason"));
}

TEST(Limits, AreRowsWithTheWidthOfTheirBracket) {
  const TableSet fine = limit_of("leapfrog", "spring", {1000, 0.005}),
                 coarse = limit_of("leapfrog", "spring", {1000, 0.5});
  for (const auto& [rows, widest] : {std::pair{&fine, 0.005}, std::pair{&coarse, 0.5}}) {
    const Table& t = *rows->table("stability");
    const double precision = std::get<double>(t.at(0, "precision"));
    // bisection of the logarithm stops below `widest`; the search before the bisection climbs in steps of a tenth
    EXPECT_GT(precision, std::min(widest / 2.1, 0.09));
    EXPECT_LE(precision, widest);
    EXPECT_DOUBLE_EQ(precision, std::get<double>(t.at(0, "failed")) / std::get<double>(t.at(0, "held")) - 1);
    EXPECT_LE(std::abs(std::get<double>(t.at(0, "deviation"))), precision);
    EXPECT_EQ(reason_of(*rows), "");  // a deviation within the bracket needs no reason
  }
  EXPECT_GT(std::abs(std::get<double>(coarse.table("stability")->at(0, "deviation"))), 0.01);
  EXPECT_EQ(reason_of(limit_of("bullet/pbd", "spring", {300, 0.1})), "no linear theory is known for its rule");
}

TEST(Failures, OfAClothGrowAsTheoryAndAreSeenInFourMoments) {
  const Scene cloth = small_hanging_cloth();
  TableSet rows;
  add_limit(cloth, find_method("leapfrog"), {1000, 0.01}, rows);
  const std::vector<FailureRow> steps = rows_of<FailureRow>(*rows.table("stability-failure"));
  ASSERT_GE(steps.size(), 4u);
  EXPECT_EQ(std::ranges::count(steps, true, &FailureRow::still), 4);
  EXPECT_NEAR(steps[0].h, 1.75 * steps[0].limit, 1e-12);
  // h omega = 3.5: amplitudes grow by a factor of 10.1 per step, and energies by a factor of about a hundred
  EXPECT_NEAR(*steps[0].growth, 103, 3);
  for (size_t i = 0; i < steps.size(); ++i) {
    EXPECT_NEAR(steps[i].t, static_cast<double>(steps[i].step) * steps[i].h, 1e-9);
    EXPECT_EQ(steps[i].step, steps[0].step + static_cast<long>(i));
  }
  EXPECT_GT(steps.back().kinetic, 100 * *steps.back().holding);
  // a repetition with the same rule gives identical numbers; a rule that is not shown gives none
  TableSet again;
  add_failure(cloth, find_method("leapfrog"), steps[0].limit, steps[0].growth, again);
  EXPECT_EQ(rows.table("stability-failure")->rows, again.table("stability-failure")->rows);
  TableSet other;
  add_limit(cloth, find_method("rk4"), {300, 0.1}, other);
  EXPECT_EQ(other.table("stability-failure"), nullptr);
}

TEST(Failures, AreNoneWhereNothingGrows) {
  // nothing moves, so nothing can grow
  const Scene still = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 1\n[[spring]]\nends "
      "= [0, 1]\nstiffness = 100\nrest = 1\n[pins]\nparticles = [0]\n");
  TableSet rows;
  add_failure(still, find_method("leapfrog"), 0.2, 103, rows);
  EXPECT_EQ(rows.table("stability-failure"), nullptr);
}

TEST(Limits, OfARotationAreThoseOfTheory) {
  for (const char* method : {"explicit-euler", "trapezoidal"}) {
    const TableSet rows = limit_of(method, "circle", {4000, 0.01});
    const Table &t = *rows.table("stability"), &growth = *rows.table("stability-growth");
    EXPECT_EQ(std::get<std::string>(t.at(0, "prediction")), "no stable step");
    EXPECT_EQ(std::get<std::string>(t.at(0, "measurement")), "no stable step");
    EXPECT_EQ(reason_of(rows), "");
    ASSERT_EQ(growth.rows.size(), 3u);
    // in each of up to 2000 steps, rounding errs by 1e-16; the growth per step is at least 1.2e-5
    for (size_t i = 0; i < 3; ++i) EXPECT_LT(std::abs(std::get<double>(growth.at(i, "deviation"))), 1e-8);
  }
}

TEST(Stability, HasAPointForEveryQuestionAndANoteForWhatIsNotAsked) {
  Request request;
  request.scenes = {load_scene("spring"), load_scene("circle"), load_scene("jelly")};
  request.methods = find_methods("leapfrog,dopri5,symplectic-euler+sticky");
  std::vector<std::string> asked, notes;
  for (const Point& point : stability_points(request)) {
    if (!point.content.empty()) {
      asked.push_back(point.name);
      continue;
    }
    TableSet rows;
    point.compute(rows);
    EXPECT_TRUE(rows.tables.empty());
    notes.insert(notes.end(), rows.notes.begin(), rows.notes.end());
  }
  EXPECT_EQ(asked,
            (std::vector<std::string>{"stability: mysim/leapfrog on spring",
                                      "stability: map of step and stiffness, mysim/leapfrog on spring",
                                      "stability: map of step and drag, mysim/leapfrog on spring",
                                      "stability: mysim/leapfrog on circle", "stability: mysim/leapfrog on jelly"}));
  ASSERT_EQ(notes.size(), 7u);
  EXPECT_EQ(notes[0], "stability leaves out mysim/dopri5: its steps follow a tolerance");
  EXPECT_EQ(notes[1], "stability leaves out mysim/symplectic-euler+sticky: its contact rule does not change the limit");
  EXPECT_EQ(notes[6], "stability draws no map of jelly: hundreds of runs take too long; --full includes them");
}

HeatMap small_map() {
  HeatMap map;
  map.name = "small-map";
  map.title = "A map, of 2 x 2";
  map.x_label = "time step / s";
  map.y_label = "drag rate / (1/s)";
  map.kinds = {{"stable", "#D8E8F0"}, {"fails, it does", "#D55E00"}, {"never met", "#000000"}};
  for (const char* title : {"one", "another's"})
    map.panels.push_back(
        {title, {{1e-3, 1, 0}, {1e-2, 1, 1}, {1e-3, 10, 1}, {1e-2, 10, 1}}, {{3e-3, 1}, {3e-3, 10}}, {{3e-3, 1}}});
  return map;
}

class HeatMaps : public InFolder {};

TEST_F(HeatMaps, ShowEveryKindThatOccursAndNoOther) {
  const Drawing d = drawing_of(small_map());
  EXPECT_EQ(d.data.rows.size(), 2 * (4 + 2 + 1));
  EXPECT_TRUE(contains(d.script, "'stable'"));
  EXPECT_FALSE(contains(d.script, "never met"));
  EXPECT_TRUE(contains(d.script, "predicted limit"));
  EXPECT_TRUE(contains(d.script, "measured limit"));
  draw(d, {}, folder_);
  for (const char* ending : {".svg", ".pdf", ".png"})
    EXPECT_GT(std::filesystem::file_size(folder_ / (std::string("small-map") + ending)), 1000) << ending;
}

TEST_F(HeatMaps, RefuseWhatCannotBeDrawn) {
  const auto message = [](const HeatMap& map) -> std::string {
    try {
      drawing_of(map);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  };
  HeatMap empty = small_map();
  empty.panels.clear();
  EXPECT_TRUE(contains(message(empty), "small-map: nothing to draw"));
  HeatMap negative = small_map();
  negative.panels[0].cells[0].x = 0;
  EXPECT_TRUE(contains(message(negative), "small-map: a value is not above zero"));
}

}  // namespace
}  // namespace crosscheck
