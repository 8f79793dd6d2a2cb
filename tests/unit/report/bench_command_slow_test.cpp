// Tests `bench` on the command line, with a short plan.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "experiments/bench/bench.h"
#include "experiments/scenes/cloths.h"
#include "experiments/scenes/scenes.h"
#include "mysim/base/json.h"
#include "report/commands/bench.h"
#include "report/commands/commands.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck::testing_tools {
namespace {

BenchSuite tiny_suite() {
  const MicrobenchmarkOptions micro{3, 1e-4};
  const TimedRunOptions turns{3, 1e-3};
  return {{20, 40},
          {"pendulum", "cloth-hang"},
          {{20, {{"odeint/rk4", {1.2, 0.6}}, {"bullet/deformable-explicit", {0.9}}, {"bullet/pbd", {1}, true}}}},
          {20, 0.02, turns},
          {{24}, {60}, micro},
          micro,
          micro,
          turns,
          {{64, 96}, turns}};
}

class CliBench : public Cli {};

TEST_F(CliBench, BadUseIsExitTwoWithAMessage) {
  for (const auto& [words, said] :
       std::vector<std::pair<std::vector<std::string>, std::string>>{{{"bench", "--quick", "--full"}, "--quick"},
                                                                     {{"bench", "--rounds", "3"}, "--rounds"},
                                                                     {{"bench", "cloth-hang"}, "cloth-hang"},
                                                                     {{"bench", "--out"}, "--out"},
                                                                     {{"bench", "--out", "taken/deeper"}, "taken"}}) {
    write("taken", "a file");
    const ProgramResult result = call(words);
    EXPECT_EQ(result.status, 2) << result.out;
    EXPECT_NE(result.err.find(said), std::string::npos) << result.err;
  }
}

TEST_F(CliBench, WritesTablesJsonAndFigureAndSaysEveryLine) {
  const BenchSuite suite = tiny_suite();
  int status = 1;
  testing::internal::CaptureStdout();
  EXPECT_NO_THROW(status = bench_command({false, folder_, "crosscheck bench"}, suite));
  const std::string said = testing::internal::GetCapturedStdout();
  ASSERT_EQ(status, 0) << said;

  const JsonField json = JsonField::parse_file(folder_ / "bench.json");
  std::vector<std::string> words{"odeint/rk4", "other model",      "two stiffnesses",        "Bullet's force",
                                 "baseline",   "springs, 40 × 40", "sweep, fastest, double", "60 steps a second"};
  // a machine with a single core does not measure two threads
  if (json["notes"].dump().find("may use only one core") == std::string::npos)
    words.insert(words.end(), {"two threads, 64 × 64", "too small for a second", "% of two cores"});
  const JsonField table = json["tables"]["bench-cost"];
  const std::string csv = rows(folder_ / "bench-cost.csv");
  EXPECT_EQ(static_cast<size_t>(std::count(csv.begin(), csv.end(), '\n')), table["rows"].size() + 1);
  std::string header;
  for (const JsonField& column : table["columns"].elements())
    header += fmt::format("{}{} [{}]", header.empty() ? "" : ",", column["name"].text(), column["unit"].text());
  EXPECT_EQ(csv.substr(0, csv.find('\n')), header);

  std::string provenance;
  for (const JsonField& line : json["provenance"].elements())
    provenance += line["key"].text() + ": " + line["value"].text() + "\n";
  for (const char* key : {"command: crosscheck bench", "build of mysim", "build of Bullet", "build of odeint", "cpu",
                          "scene: sheet-20x20 ", "best instructions"})
    EXPECT_NE(provenance.find(key), std::string::npos) << key;
  for (const char* ending : {".svg", ".png", ".pdf", ".csv", ".gp"})
    EXPECT_TRUE(fs::exists(folder_ / (std::string("bench-ratios") + ending))) << ending;
  for (const std::string& each : words) EXPECT_NE(said.find(each), std::string::npos) << each << "\n" << said;
}

TEST(BenchLines, OfAPeerOneIsTheChief) {
  BenchSuite suite = tiny_suite();
  suite.kernel_sides = {20};
  const std::vector<BenchLine> lines = bench_lines(bench(suite, LockPatience()).rows);
  int chiefs = 0, all = 0;
  for (const BenchLine& line : lines) {
    EXPECT_FALSE(line.detail.empty()) << line.label;
    if (line.work == bench_work::same_error) chiefs += line.representative, ++all;
  }
  EXPECT_EQ(all, 4);
  EXPECT_EQ(chiefs, 3);
}

TEST(BenchPlans, QuickAndFullAskWhatTheTablesPromise) {
  for (const bool full : {false, true}) {
    const BenchSuite suite = bench_suite(full);
    EXPECT_EQ(suite.kernel_sides, (std::vector<int>{64, 128, 256}));
    EXPECT_EQ(suite.scenes.size(), shipped_scenes().size());
    std::set<int> sides;
    for (const BenchSuite::PeerCloth& cloth : suite.cloths) {
      sides.insert(cloth.side);
      for (const Peer& peer : cloth.peers) {
        EXPECT_NO_THROW(find_method(peer.method));
        // position-based links are compared under their own law, or marked as a different model
        EXPECT_EQ(peer.other_model, peer.method.starts_with("bullet/pbd") && cloth.of != hanging_cloth_of_links);
      }
    }
    EXPECT_EQ(sides, full ? (std::set<int>{32, 64, 128}) : (std::set<int>{32, 64}));
  }
}

}  // namespace
}  // namespace crosscheck::testing_tools
