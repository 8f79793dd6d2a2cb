// Limits of a hanging cloth, maps of what becomes of runs, and the figure they are drawn in.
#include <filesystem>

#include "experiments/stability/map.h"
#include "report/heat_map.h"
#include "tests/unit/helpers.h"
#include "tests/unit/resized.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

Scene small_hanging_cloth() {
  return read_scene(std::filesystem::path(CROSSCHECK_SOURCE) / "experiments/scenes/stability/cloth-hang-6.toml");
}

TEST(ClothHang, HoldsSixPerCentBelowThePredictedLimitAndFailsSixPerCentAbove) {
  const Subject subject = subject_of(load_scene("cloth-hang"));
  ASSERT_TRUE(subject.at_rest);
  for (const char* name :
       {"mysim/rk4", "mysim/symplectic-euler", "mysim/leapfrog", "mysim/suzuki4", "bullet/deformable-explicit"}) {
    SCOPED_TRACE(name);
    const Method method = find_method(name);
    const Prediction p = predicted_limit(*rule_of(method), subject.spectrum);
    for (const double part : {0.94, 1.06}) {
      // five seconds
      const long steps = std::lround(5 / (part * p.limit));
      const Trial trial = try_step(method, subject, part * p.limit, steps, {p.mode});
      EXPECT_EQ(trial.held(), part < 1) << part << ": " << name_of(trial.verdict) << ", growth " << trial.growth;
    }
  }
}

TEST(ClothHang, UnderDragSlowRulesGrowOrDecayAsPredictedBesideTheirLimit) {
  const Subject subject = subject_of(small_hanging_cloth());
  ASSERT_TRUE(subject.at_rest);
  for (const char* name : {"mysim/explicit-euler", "mysim/trapezoidal"}) {
    const Method method = find_method(name);
    const Prediction p = predicted_limit(*method.stepper, subject.spectrum);
    ASSERT_GT(p.limit, 0);
    const Vibration v = subject.spectrum.modes[p.mode];
    EXPECT_EQ(v.omega, subject.spectrum.omega);
    for (const double part : {0.94, 0.98, 1.02, 1.06}) {
      SCOPED_TRACE(fmt::format("{} at {} of its limit", name, part));
      const double h = part * p.limit, expected = std::log(growth_per_step(*method.stepper, v, h));
      EXPECT_EQ(expected > 0, part > 1);
      const Trial trial = try_step(method, subject, h, 2000, {p.mode});
      ASSERT_TRUE(trial.of_mode);
      EXPECT_EQ(trial.held(), part < 1);
      // 1e-6 of the amplitude in 2000 steps is what rounding and nonlinearity may do
      EXPECT_NEAR(std::log(trial.per_step), expected, 1e-6 / 2000 + 0.01 * std::abs(expected));
    }
  }
}

TEST(Map, FailsWhereTheoryDrawsTheLineAndHardlyChangesInRunsTenTimesLonger) {
  long cells = 0, changed = 0;
  for (const MapKind& kind : map_kinds())
    for (const char* name :
         {"mysim/explicit-euler", "mysim/rk4", "mysim/symplectic-euler", "mysim/leapfrog", "mysim/trapezoidal"}) {
      SCOPED_TRACE(fmt::format("{} over {}", name, kind.name));
      Rows rows;
      map_on(kind, load_scene("spring"), find_method(name), {7, 9, 1000, true}, rows);
      const Table &map = *rows.table("stability-map"), &limits = *rows.table("stability-map-limit"),
                  &check = *rows.table("stability-map-check");
      ASSERT_EQ(map.rows.size(), 63);
      ASSERT_EQ(limits.rows.size(), 7);
      for (size_t i = 0; i < map.rows.size(); ++i) {
        const double h = std::get<double>(map.at(i, "step")),
                     limit = std::get<double>(limits.at(i / 9, "predicted limit"));
        // the trapezoidal rule without drag grows by (h omega)^4 / 8 a step: by less than can be told at short ones
        const bool slow = limit == 0 && std::string(name) == "mysim/trapezoidal";
        if (!slow && std::abs(h / limit - 1) > 0.02) {
          EXPECT_EQ(std::get<std::string>(map.at(i, "verdict")) == "ok", h < limit) << h << " against " << limit;
        }
      }
      cells += std::get<long>(check.at(0, "cells"));
      changed += std::get<long>(check.at(0, "changed"));
    }
  EXPECT_EQ(cells, 10 * 63);
  EXPECT_LT(changed, 0.01 * static_cast<double>(cells));
}

TEST(Map, OfAClothHardlyChangesInRunsTenTimesLonger) {
  for (const MapKind& kind : map_kinds()) {
    Rows rows;
    map_on(kind, small_hanging_cloth(), find_method("mysim/symplectic-euler"), {5, 7, 1000, true}, rows);
    EXPECT_EQ(std::get<long>(rows.table("stability-map-check")->at(0, "changed")), 0) << kind.name;
  }
}

TEST(Map, KnowsWhatItIsMadeOf) {
  EXPECT_EQ(map_scene(load_scene("spring"), false)->name, "spring");
  EXPECT_EQ(map_scene(load_scene("cloth-hang"), false)->start.x.cols(), 36);
  EXPECT_EQ(map_scene(load_scene("cloth-hang"), true)->start.x.cols(), 36);
  EXPECT_FALSE(map_scene(load_scene("cloth-stiff"), false));
  EXPECT_FALSE(map_scene(load_scene("projectile"), true));
}

HeatMap small_map() {
  HeatMap map;
  map.name = "small-map";
  map.title = "A map, of 2 x 2";
  map.x_label = "step / s";
  map.y_label = "drag rate / (1/s)";
  map.kinds = {{"holds", "#D8E8F0"}, {"fails, it does", "#D55E00"}, {"never met", "#000000"}};
  for (const char* title : {"one", "another's"})
    map.panels.push_back(
        {title, {{1e-3, 1, 0}, {1e-2, 1, 1}, {1e-3, 10, 1}, {1e-2, 10, 1}}, {{3e-3, 1}, {3e-3, 10}}, {{3e-3, 1}}});
  return map;
}

class HeatMaps : public InFolder {};

TEST_F(HeatMaps, ShowEveryKindThatOccursAndNoOther) {
  const Drawing d = drawing_of(small_map());
  EXPECT_EQ(d.data.rows.size(), 2 * (4 + 2 + 1));
  EXPECT_TRUE(contains(d.script, "'holds'"));
  EXPECT_FALSE(contains(d.script, "never met"));
  EXPECT_TRUE(contains(d.script, "limit by theory"));
  EXPECT_TRUE(contains(d.script, "limit as measured"));
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
