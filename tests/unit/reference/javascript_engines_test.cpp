// The JavaScript module for engines: its forces and motions agree with mysim's, and serve mode answers like single
// calls.

#include <fmt/format.h>

#include <regex>

#include "reference/certificate/certificate.h"
#include "reference/protocol/scene_json.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
namespace fs = std::filesystem;

class JavaScriptEngines : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    NEEDS_PROGRAM("node", "nodejs", "the JavaScript module is not tested");
  }
  static std::string engine() { return CROSSCHECK_SOURCE "/tests/unit/reference/module_engine.mjs"; }
  static crosscheck::Run short_run(const Scene& scene) { return {scene.step, 100 * scene.step, 4}; }

  /// Files of an answer, without the CPU time.
  std::string answer(const std::string& out) const {
    const std::string run = read(folder_ / out / "run.json");
    return read(folder_ / out / "trajectory.npy") + read(folder_ / out / "velocities.npy") +
           std::regex_replace(run, std::regex("\"cpu_seconds\":[^,]*,"), "");
  }
};

TEST_F(JavaScriptEngines, ModulePassesItsUnitTests) {
  const ProgramResult result =
      run_program({"node", CROSSCHECK_SOURCE "/tests/unit/reference/module_test.mjs"}, folder_);
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(JavaScriptEngines, ForcesAndMotionsAreThoseOfMysim) {
  std::vector<Scene> scenes{
      small_scene("[pins]\nparticles = [0]\n[[particle]]\nposition = [0, 0, 0]\nmass = 1\n"
                  "[[particle]]\nposition = [0.3, -1, 0]\nmass = 0.5\n"
                  "[[spring]]\nends = [0, 1]\nstiffness = 80\nrest = 1\ndashpot = 0.3\n")};
  for (const auto name : {"chain", "chain-link", "cloth-cantilever"}) scenes.push_back(shipped_scene(name));
  for (const Scene& scene : scenes) {
    SCOPED_TRACE(scene.name);
    const MethodRun ours = run_and_record("symplectic-euler", scene, short_run(scene));
    const MethodRun theirs = run_and_record("exec:" + engine(), scene, short_run(scene));
    ASSERT_EQ(theirs.outcome.verdict, Verdict::ok) << theirs.outcome.reason;
    EXPECT_EQ(theirs.outcome.remark, "");
    // only the summation order differs: 1e-15 m times a growth of perturbations below 1e3
    EXPECT_LE(sup_distance(ours.trajectory, theirs.trajectory), 1e-12);
    for (const CertificateRow& row : certify("engine", scene, theirs.outcome).rows)
      EXPECT_EQ(row.parity, Parity::match) << row.quantity << ": " << row.read_back;
  }
}

TEST_F(JavaScriptEngines, ServedAnswersEqualThoseOfSingleCalls) {
  struct Call {
    const char* scene;
    std::vector<std::string> options;
    int status;
  };
  const Call calls[] = {{"chain", {}, 0},  {"slide", {}, 3},         {"cloth-wind", {}, 0}, {"chain", {"fail=50"}, 0},
                        {"circle", {}, 3}, {"chain", {"what=1"}, 3}, {"chain-link", {}, 0}, {"chain", {}, 0}};
  std::string lines;
  std::vector<std::string> reasons;
  for (size_t i = 0; i < std::size(calls); ++i) {
    const Scene scene = shipped_scene(calls[i].scene);
    const std::string file = write(fmt::format("{}.json", i), scene_json(scene, short_run(scene), calls[i].options));
    for (const char* kind : {"single", "served"}) fs::create_directories(folder_ / fmt::format("{}{}", kind, i));
    const ProgramResult single =
        run_program({engine(), file, (folder_ / fmt::format("single{}", i)).string()}, folder_);
    EXPECT_EQ(single.status, calls[i].status) << single.err;
    reasons.push_back(single.err);
    lines +=
        fmt::format("{{\"scene\": \"{}\", \"out\": \"{}\"}}\n", file, (folder_ / fmt::format("served{}", i)).string());
  }
  lines += "no JSON\n";
  write("lines", lines);
  const ProgramResult served = run_program({"sh", "-c", "exec '" + engine() + "' --serve < lines"}, folder_);
  EXPECT_EQ(served.status, 0) << served.err;
  std::istringstream answers(served.out);
  std::string line;
  for (size_t i = 0; i < std::size(calls); ++i) {
    SCOPED_TRACE(fmt::format("{}: {}", i, calls[i].scene));
    ASSERT_TRUE(std::getline(answers, line));
    const JsonField told = JsonField::parse(line, "answer");
    EXPECT_EQ(told["status"].whole(), calls[i].status);
    if (calls[i].status == 0) {
      EXPECT_EQ(answer(fmt::format("served{}", i)), answer(fmt::format("single{}", i)));
    } else {
      EXPECT_EQ(told["reason"].text() + "\n", reasons[i]);
    }
  }
  ASSERT_TRUE(std::getline(answers, line));
  EXPECT_EQ(JsonField::parse(line, "answer")["status"].whole(), 1);
  EXPECT_FALSE(std::getline(answers, line)) << "expected one line per scene on stdout: " << line;
  EXPECT_TRUE(contains(read(folder_ / "served0/run.json"), "\"serves\":true"));
  EXPECT_TRUE(contains(read(folder_ / "served3/run.json"), "\"verdict\":\"solver\",\"reason\":\"option fail\""));
}

}  // namespace
}  // namespace crosscheck
