// Rows of experiments `energy` and `contact`, with failures and exclusions.

#include "experiments/experiment.h"
#include "experiments/scenes/scenes.h"
#include "experiments/sweep/sweep.h"
#include "mysim/run/observers.h"
#include "report/findings/findings.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/made_up_findings.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

const std::string& text_at(const Table& table, size_t row, const char* column) {
  return std::get<std::string>(table.at(row, column));
}
size_t row_of(const Table& table, const std::string& scene, const std::string& method) {
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (text_at(table, i, "scene") == scene && text_at(table, i, "method") == method) return i;
  throw std::out_of_range(scene + " by " + method);
}
bool empty(const Table& table, size_t row, const char* column) {
  return std::holds_alternative<std::monostate>(table.at(row, column));
}
double number(const Table& table, size_t row, const char* column) { return std::get<double>(table.at(row, column)); }

TEST(EnergyExperiment, LeavesOutWithANoteWhatWouldTakeHours) {
  Request request;
  request.scenes = {load_scene("spring")};
  request.methods = find_methods("dopri5");
  for (const bool dear : {false, true}) {
    if (dear)  // with tiny steps
      request.methods[0].engine = [inner = request.methods[0].engine](const Scene& scene, const crosscheck::Run& run,
                                                                      Observer& observer) {
        Outcome out = inner(scene, run, observer);
        out.evaluations *= 1000000;
        return out;
      };
    const std::vector<Point> points = energy_points(request);
    ASSERT_EQ(points.at(0).name, "energy: spring by mysim/dopri5");
    const TableSet rows = computed({points.data(), 1});
    EXPECT_EQ(rows.table("energy") == nullptr, dear);
    ASSERT_EQ(rows.notes.size(), dear ? 1u : 0u);
    if (dear) {
      EXPECT_TRUE(contains(rows.notes[0], "energy leaves out mysim/dopri5 on spring: a run of 100 s would take"));
    }
  }
}

TEST(EnergyExperiment, TakesImplicitRulesAndTheirClosedFormsAtTenTimesTheStep) {
  Request request;
  request.scenes = {load_scene("spring")};
  request.methods =
      find_methods("implicit-euler,truth/exact-discrete+implicit-euler,leapfrog,truth/exact-discrete+leapfrog");
  const std::vector<Point> points = energy_points(request);
  const TableSet rows = computed({points.data(), 4});
  const Table& energy = *rows.table("energy");
  ASSERT_EQ(energy.rows.size(), 4u);
  for (size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(number(energy, i, "step"), i < 2 ? 1e-2 : 1e-3, 1e-9) << text_at(energy, i, "method");
}

TEST(EnergyExperiment, OfNamedScenesRunsTheseAlone) {
  Request request;
  request.scenes = {load_scene("spring")};
  request.methods = find_methods("symplectic-euler,leapfrog");
  const auto names = [&] {
    std::string all;
    for (const Point& point : energy_points(request)) all += point.name + ";";
    return all;
  };
  EXPECT_TRUE(contains(names(), "all-at-once by") && contains(names(), "numerical damping of")) << names();
  request.scenes_only = true;
  EXPECT_EQ(names(), "energy: spring by mysim/symplectic-euler;energy: spring by mysim/leapfrog;");
}

TEST(EnergyExperiment, ClaimsClosureOnlyWhereLossesAreTold) {
  Request request;
  request.scenes = {load_scene("spring"), load_scene("circle")};
  request.methods = find_methods("symplectic-euler,explicit-euler,bullet/deformable-explicit");
  const TableSet rows = computed(energy_points(request));
  const Table& energy = *rows.table("energy");
  ASSERT_EQ(energy.rows.size(), 6u);  // three runs on spring, and three on the scene with all terms
  EXPECT_TRUE(contains(rows.notes.at(0), "leaves out circle: a first-order system"));

  const size_t told = row_of(energy, "all-at-once", "mysim/symplectic-euler"),
               inferred = row_of(energy, "all-at-once", "bullet/deformable-explicit");
  EXPECT_EQ(std::get<long>(energy.at(told, "closure claimed")), 1);
  EXPECT_EQ(std::get<long>(energy.at(inferred, "closure claimed")), 0);
  EXPECT_EQ(std::get<long>(energy.at(inferred, "contact inferred")), 1);
  for (const char* column : {"residual", "largest residual", "drift", "equivalent drag"}) {
    EXPECT_TRUE(empty(energy, inferred, column)) << column;
    EXPECT_FALSE(empty(energy, told, column)) << column;
  }
  const Table& ledger = *rows.table("all-at-once-ledger");
  for (size_t i = 0; i < ledger.rows.size(); ++i)
    EXPECT_EQ(empty(ledger, i, "residual"), text_at(ledger, i, "method") == "bullet/deformable-explicit");
  // Averaged over the pins' fifty periods, both motions are equal. If the energy per period varies randomly by half its
  // value, two means differ by 0.5 sqrt(2 / 50) = 0.1.
  for (const char* column : {"drag took", "dashpots took", "wind gave", "pins gave"}) {
    EXPECT_GT(number(energy, told, column), 0.01) << column;
    EXPECT_NEAR(number(energy, told, column) / number(energy, inferred, column), 1, 0.1) << column;
  }
  EXPECT_EQ(std::get<long>(energy.at(told, "steps")), 100000);

  // failed runs have rows, too
  for (const char* scene : {"spring", "all-at-once"}) {
    const size_t failed = row_of(energy, scene, "mysim/explicit-euler");
    EXPECT_EQ(text_at(energy, failed, "verdict"), "energy");
    EXPECT_GT(number(energy, failed, "end"), 0);
    EXPECT_LT(number(energy, failed, "end"), 100);
  }
  EXPECT_GT(rows.table("energy-damping")->rows.size(), 20u);

  const std::vector<Finding> findings = energy_findings(rows);
  expect_short(findings);
  EXPECT_TRUE(of_rule(findings, "numerical-damping").empty()) << "no method with numerical damping was requested";
  const Finding& bounded = the(findings, "symplectic-energy");
  EXPECT_EQ(bounded.words.at("bounded"), bounded.words.at("all"));
  // If the growth is linear, the run is ten times as fast as the truth when exp(h omega^2 t / 2) = 10, after 46 s. The
  // verdict comes at the next sample.
  const double end = number(energy, row_of(energy, "spring", "mysim/explicit-euler"), "end");
  const Scene spring = load_scene("spring");
  const crosscheck::Run long_run{spring.step, 200, 1000};
  const double left = static_cast<double>(step_of_leaving(spring, long_run, "explicit-euler",
                                                          motion_bounds_of(spring, long_run)->speed)) *
                      spring.step;
  EXPECT_GT(left, 40);
  EXPECT_GE(end, left);
  EXPECT_LT(end, 1.1 * left);
  const Finding failed = the(findings, "energy-failed");
  EXPECT_EQ(failed.method, "mysim/explicit-euler");
  EXPECT_EQ(failed.words.at("where"), "spring");
  EXPECT_EQ(failed.value, end);
}

TEST(ContactExperiment, HasRowsForWhoFailsAndNotesForWhoHasNoSurface) {
  Request request;
  request.scenes = {load_scene("spring"), load_scene("bounce"), load_scene("slope-slide")};
  request.methods = find_methods("symplectic-euler,symplectic-euler+sticky,explicit-euler,bullet/pbd");
  const TableSet rows = computed(contact_points(request));
  EXPECT_EQ(rows.notes, std::vector<std::string>{"contact leaves out spring: it has no ball or plane"});
  const Table& drape = *rows.table("sphere-drape");
  EXPECT_EQ(drape.rows.size(), 4u * (2 + 2 + 1 + 1));
  // under Coulomb's law the cloth slides off; the sticky sphere holds it
  EXPECT_LT(number(drape, row_of(drape, "drop-aside", "mysim/symplectic-euler"), "centre height"), 0);
  EXPECT_GT(number(drape, row_of(drape, "drop-aside", "mysim/symplectic-euler+sticky"), "centre height"), 0.2);
  const size_t failed = row_of(drape, "drop-aside", "mysim/explicit-euler");
  EXPECT_EQ(text_at(drape, failed, "verdict"), "energy");
  EXPECT_TRUE(empty(drape, failed, "centre height"));
  EXPECT_EQ(text_at(drape, row_of(drape, "bounce", "bullet/pbd"), "verdict"), "unsupported");
  const size_t inferred = row_of(drape, "drop-centred", "bullet/pbd");
  EXPECT_EQ(std::get<long>(drape.at(inferred, "contact inferred")), 1);
  EXPECT_GT(number(drape, inferred, "contact took"), 0);

  const Table& depth = *rows.table("sphere-penetration");
  EXPECT_EQ(depth.rows.size(), 4u * (2 + 2 + 1)) << "a plane has no radius";
  const size_t ours = row_of(depth, "drop-centred", "mysim/symplectic-euler"),
               pbd = row_of(depth, "drop-centred", "bullet/pbd");
  EXPECT_LT(number(depth, ours, "particles"), 1e-9);
  // Flat triangles with edges of 1/12 m touch a ball of 0.5 m. The centre of an equilateral triangle is a^2 / 3 / 2R
  // below the arc (0.46 %). The centre of a right triangle's longest side is below the arc by the square of half that
  // side over 2R (0.69 %), or by 0.84 % if the side is stretched by a tenth.
  EXPECT_GT(number(depth, ours, "triangles"), 0.46);
  EXPECT_LT(number(depth, ours, "triangles"), 0.9);
  EXPECT_GT(number(depth, pbd, "particles"), 0.1);
  EXPECT_GT(number(depth, pbd, "triangles"), number(depth, pbd, "particles"));

  Findings findings;
  for (const auto part : {cone_findings, plane_findings, leaving_findings, drape_findings})
    for (Finding& f : part(rows)) findings.push_back(std::move(f));
  expect_short(findings);
  const Finding cone_of_ours = of_rule(findings, "cone").at(0);
  EXPECT_EQ(cone_of_ours.method, "mysim/symplectic-euler");
  EXPECT_EQ(cone_of_ours.value, 72);
  EXPECT_EQ(cone_of_ours.words.at("planes"), "72 of 72");
  EXPECT_GT(std::abs(of_rule(findings, "leaving").back().value), 1) << "degrees, for pbd";
  EXPECT_EQ(the(findings, "slides-off").method, "mysim/symplectic-euler");
  const auto touching = of_rule(findings, "still-touches");
  ASSERT_EQ(touching.size(), 2u);
  for (const Finding& f : touching) EXPECT_GT(f.value, 0) << f.method;
  EXPECT_TRUE(energy_findings(rows).empty());
  EXPECT_LT(the(findings, "planes").value, 5) << "%, with a step of 1 ms";
  EXPECT_EQ(the(findings, "planes").words.at("refused"), "Bullet");
  EXPECT_EQ(the(findings, "planes-rest").value, 0);
  EXPECT_EQ(the(findings, "planes-rest").words.at("share"), "50 %") << "for explicit Euler";

  const Table& cone = *rows.table("sphere-cone");
  for (size_t i = 0; i < cone.rows.size(); ++i)
    if (text_at(cone, i, "method") == "mysim/symplectic-euler") {
      EXPECT_EQ(text_at(cone, i, "answer"), text_at(cone, i, "answer by theory")) << i;
    }
}

}  // namespace
}  // namespace crosscheck
