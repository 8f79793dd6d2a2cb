// Statements in hand-written texts that were once wrong and corrected must remain correct.

#include <fstream>

#include "experiments/experiment.h"
#include "experiments/scenes/scenes.h"
#include "experiments/sweep/sweep.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

std::string file_text(const std::string& name) {
  std::ifstream in(CROSSCHECK_SOURCE "/" + name);
  if (!in) throw std::runtime_error(name + " cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> lines_with(const std::string& word) {
  std::vector<std::string> lines;
  std::istringstream in(file_text("reference/README.md"));
  for (std::string line; std::getline(in, line);)
    if (line.find(word) != std::string::npos) lines.push_back(line);
  return lines;
}

TEST(Statements, BulletsExplicitWorldIsSymplecticEulerWhereItSaysSoItself) {
  // With dashpots, Bullet's explicit world reports a different law, so that the README must not promise the same rule
  // for them.
  const Scene jelly = load_scene("jelly");
  ASSERT_TRUE(jelly.model.find<Dashpots>());
  const Outcome with = run_and_record("bullet/deformable-explicit", jelly, {jelly.step, 2 * jelly.step, 1}).outcome;
  EXPECT_TRUE(std::any_of(with.different_law.begin(), with.different_law.end(),
                          [](const std::string& law) { return law.starts_with("dashpots"); }));
  const auto rows = lines_with("| `bullet/deformable-explicit` |");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_TRUE(contains(rows[0], "to round-off where nothing touches and no spring has a dashpot"));
}

TEST(Statements, MethodsNameNoOptionThatTheyRefuse) {
  // `run` refuses --step for adaptive methods
  for (const Stepper& s : steppers()) {
    if (!s.adaptive) continue;
    std::string what(s.what);
    EXPECT_TRUE(contains(what, "give --tol, not --step")) << s.name;
    what.erase(what.find("--step"), 6);
    EXPECT_EQ(what.find("--step"), std::string::npos) << s.name << ": " << what;
  }
}

TEST(Statements, OrderSaysWhyItLeavesOutLargeScenes) {
  Request request;
  request.scenes = {load_scene("cloth-hang")};
  const TableSet tables = computed(find_experiment("order").points(request));
  ASSERT_EQ(tables.notes.size(), 1u);
  // speed-accuracy measures the orders of four rules on this scene: 1.00, 2.02, 4.14 and 4.02
  EXPECT_EQ(tables.notes[0],
            "order leaves out cloth-hang: its runs would take too long; speed-accuracy shows its error at each step");
}

TEST(Statements, ATruthIsSaidToBeFoundByWhoFoundIt) {
  const Scene s = load_scene("pendulum");
  const auto truth = truth_of(s, {s.step, 0.2, 4});
  ASSERT_TRUE(truth);
  EXPECT_TRUE(contains(truth->how, "mysim/rk4 at"));
  EXPECT_TRUE(contains(truth->how, "compared with odeint (Boost"));
  EXPECT_EQ(truth->how.find("SUNDIALS"), std::string::npos);
}

}  // namespace
}  // namespace crosscheck
