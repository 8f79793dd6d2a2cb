// mysim as WebAssembly gives what it gives natively: in Node and in a browser, for every shipped scene and stepper. And
// the lab as its readers use it, in a browser.

#include <cstdlib>

#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "report/base/assets.h"
#include "report/lab/live_run.h"
#include "report/page/lab_html.h"
#include "report/page/page.h"
#include "report/player/packed_numbers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/in_browser.h"

// clang's package first: CI installs what stands between "package" and the blank
#define NEEDS_LAB                                                                                                  \
  if (!has_lab_module())                                                                                           \
  GTEST_SKIP() << "package clang-14,lld-14,libc++-14-dev-wasm32,libclang-rt-14-dev-wasm32 was not installed when " \
                  "this was built: mysim is not run as WebAssembly"

namespace crosscheck {
namespace {

using namespace testing_tools;
namespace fs = std::filesystem;

/// A run of so many steps, as a native build makes it.
struct NativeRun {
  std::string scene, stepper;
  int steps = 0;
  bool exact = false;  // the same bits are asked for
  std::string fingerprint;
  double t = 0;
  Points x;
};

class LabModule : public InBrowser {
 protected:
  void SetUp() override {
    InBrowser::SetUp();
    setenv("CROSSCHECK_INSTRUCTIONS", "sse2", 1);
  }
  void TearDown() override {
    unsetenv("CROSSCHECK_INSTRUCTIONS");
    InBrowser::TearDown();
  }

  static std::vector<Scene> shipped() {
    std::vector<Scene> scenes;
    for (const auto name : shipped_scenes()) scenes.push_back(load_scene(std::string(name)));
    return scenes;
  }

  /// Every stepper that takes the scene, over a thousand steps; those that solve equations, or choose their steps, up
  /// to where a perturbation grows a thousandfold.
  static std::vector<NativeRun> native_runs(const std::vector<Scene>& scenes) {
    std::vector<NativeRun> runs;
    for (const Scene& scene : scenes)
      for (const Stepper& rule : steppers()) {
        NativeRun run{scene.name, std::string(rule.name)};
        run.exact = !rule.adaptive && (rule.evaluations > 0 || rule.hard_constraints);
        run.steps = run.exact ? 1000 : std::clamp(static_cast<int>(scene.window / scene.step), 1, 1000);
        LiveRun live(scene);
        try {
          live.start({run.stepper, scene.step, 1e-6, scene.duration, false});
        } catch (const Unsupported&) {
          continue;
        }
        try {
          live.advance(1e300, run.steps);
        } catch (const SolverFailure&) {
          continue;
        }
        run.fingerprint = live.fingerprint(), run.t = live.time(), run.x = live.state().x;
        runs.push_back(std::move(run));
      }
    return runs;
  }

  static std::string json_of(const std::vector<NativeRun>& runs) {
    Json list = Json::list();
    for (const NativeRun& run : runs)
      list.push({{"scene", run.scene}, {"stepper", run.stepper}, {"steps", run.steps}, {"exact", run.exact}});
    return list.dump();
  }

  static void compare(const std::vector<NativeRun>& native, const JsonField& seen) {
    size_t i = 0, exact = 0;
    for (const JsonField& entry : seen.elements()) {
      const NativeRun& run = native.at(i++);
      SCOPED_TRACE(fmt::format("{} by {}, {} steps", run.scene, run.stepper, run.steps));
      ASSERT_FALSE(entry.find("refused")) << entry["refused"].text();
      if (run.exact) {
        EXPECT_EQ(entry["fingerprint"].text(), run.fingerprint);
        ++exact;
        continue;
      }
      // Solvers stop at 1e-12 of their residual, and sums in another order differ by less; 1e-10 m over a run of some
      // metres, which a window lets grow a thousandfold at most.
      EXPECT_NEAR(entry["t"].number(), run.t, 1e-9);
      const std::vector<double> places = entry["places"].numbers();
      ASSERT_EQ(places.size(), static_cast<size_t>(run.x.size()));
      const Eigen::Map<const Points> x(places.data(), 3, run.x.cols());
      EXPECT_LT(largest_column(x - run.x), 1e-7);
    }
    EXPECT_EQ(i, native.size());
    EXPECT_GT(exact, 60u);  // 20 scenes, most of which take seven such rules
  }

  /// The page with the lab alone, and a self-test in the scope of its scripts: a function that returns what it saw.
  fs::path page_with(const std::vector<Scene>& scenes, const std::string& script, const std::string& call) const {
    std::string page = lab_page_html(scenes);
    const std::string end = "})();</script>";
    const size_t at = page.rfind(end);
    page.insert(at, script + "\n;(async () => {\n  let seen;\n  try {\n    seen = await " + call +
                        ";\n  } catch (problem) {\n    seen = {problem: String(problem.stack ?? problem)};\n  }\n"
                        "  const note = document.createElement('script');\n  note.type = 'application/json';\n"
                        "  note.id = 'seen';\n  note.textContent = JSON.stringify(seen).replaceAll('<', '\\\\u003c');\n"
                        "  document.body.append(note);\n})();\n");
    const fs::path file = folder_ / "lab.html";
    write_file(file, page);
    return file;
  }
  static std::string self_test(const char* name) {
    return read(fs::path(CROSSCHECK_SOURCE) / "tests/unit/report" / name);
  }
};

TEST_F(LabModule, GivesTheNativeBitsInNode) {
  NEEDS_LAB;
  NEEDS_PROGRAM("node", "nodejs", "mysim is not run as WebAssembly outside a browser");
  const std::vector<Scene> scenes = shipped();
  const std::vector<NativeRun> native = native_runs(scenes);
  Json texts = Json::object();
  for (const Scene& scene : scenes) texts[scene.name]["toml"] = scene.source;
  const std::string module = base64(gzipped(content_of_file(lab_module_file())));
  write_file(
      folder_ / "lab.js",
      "globalThis.window = globalThis;\nconst document = {getElementById: () => ({textContent: JSON.stringify('" +
          module + "')})};\nconst labScenes = () => (" + texts.dump() + ");\n" + asset("player/unpack.js") +
          asset("lab/scene_text.js") + asset("lab/engine.js") + self_test("lab_selftest.js") + "\nrunAll(" +
          json_of(native) + ").then(seen => process.stdout.write(JSON.stringify(seen)));\n");
  const ProgramResult result = run_program({"node", (folder_ / "lab.js").string()}, folder_);
  ASSERT_EQ(result.status, 0) << last_lines(result.err, 20);
  compare(native, JsonField::parse(result.out, "what Node saw"));
}

TEST_F(LabModule, GivesTheNativeBitsInABrowser) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const std::vector<Scene> scenes = shipped();
  const std::vector<NativeRun> native = native_runs(scenes);
  const JsonField all = seen(page_with(scenes, self_test("lab_selftest.js"), "runAll(" + json_of(native) + ")"), {});
  compare(native, all);
}

TEST_F(LabModule, FingerprintsAreThoseOfAnyInstructionSet) {
  const std::vector<Scene> scenes{load_scene("chain"), load_scene("cloth-hang")};
  const Json own = lab_fingerprints_json(scenes);
  unsetenv("CROSSCHECK_INSTRUCTIONS");
  const LabFingerprints all = lab_fingerprints(scenes);
  const JsonField expected = JsonField::parse(own.dump(), "fingerprints");
  for (const Scene& scene : scenes) {
    EXPECT_GE(all.at(scene.name).size(), 7u);
    for (const auto& [rule, digits] : all.at(scene.name)) EXPECT_EQ(digits, expected[scene.name][rule].text()) << rule;
  }
}

}  // namespace
}  // namespace crosscheck
