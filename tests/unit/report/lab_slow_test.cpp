// mysim as WebAssembly reproduces native results in Node and in a browser, for every shipped scene and stepper. Other
// tests use the lab like a reader.

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <deque>
#include <memory>

#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/installation.h"
#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/lab/live_run.h"
#include "report/page/lab_html.h"
#include "report/page/page.h"
#include "report/page/player_html.h"
#include "report/player/packed_numbers.h"
#include "tests/unit/golden_hashes.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/in_browser.h"

// the package of clang comes first, because CI installs the text between "package" and the next blank
#define NEEDS_LAB                                                                                               \
  if (!has_lab_module())                                                                                        \
  GTEST_SKIP() << "package clang,lld,libc++-dev-wasm32,libclang-rt-dev-wasm32,binaryen was not installed when " \
                  "this was built: mysim is not tested as WebAssembly"

namespace crosscheck {
namespace {

using namespace testing_tools;
namespace fs = std::filesystem;

/// A run of `steps` steps by the native build.
struct NativeRun {
  std::string scene, stepper;
  double duration = 0;
  int steps = 0;
  bool exact = false;  // identical bits are required
  std::string fingerprint;
  double t = 0;
  Points x;
};

class LabModule : public InBrowser {
 protected:
  void SetUp() override {
    InBrowser::SetUp();
    setenv("CROSSCHECK_INSTRUCTIONS", "baseline", 1);
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

  /// Runs of all steppers that support the scene. Implicit and adaptive steppers stop at the time at which a
  /// perturbation has grown a thousandfold.
  static std::vector<NativeRun> native_runs(const std::vector<Scene>& scenes, int steps) {
    std::vector<NativeRun> runs;
    for (const Scene& scene : scenes)
      for (const Stepper& rule : steppers()) {
        NativeRun run{scene.name, std::string(rule.name)};
        run.exact = has_same_bits_everywhere(rule);
        run.steps = run.exact ? steps : std::clamp(static_cast<int>(scene.window / scene.step), 1, steps);
        LiveRun live(scene);
        try {
          live.start({run.stepper, scene.step, 1e-6, run.duration = golden_duration(scene), false});
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
    Json list = Json::array();
    for (const NativeRun& run : runs)
      list.push_back({{"scene", run.scene},
                      {"stepper", run.stepper},
                      {"steps", run.steps},
                      {"exact", run.exact},
                      {"duration", run.duration}});
    return dump(list);
  }

  static void compare(const std::vector<NativeRun>& native, const JsonField& seen) {
    size_t i = 0, exact = 0;
    const GoldenHashes golden = golden_hashes();
    for (const JsonField& entry : seen.elements()) {
      const NativeRun& run = native.at(i++);
      SCOPED_TRACE(fmt::format("{} by {}, {} steps", run.scene, run.stepper, run.steps));
      ASSERT_FALSE(entry.find("refused")) << entry["refused"].text();
      if (run.exact) {
        EXPECT_EQ(entry["fingerprint"].text(), run.fingerprint);
        if (run.steps == golden_steps) {
          EXPECT_EQ(run.fingerprint, golden.at({run.scene, run.stepper}));
        }
        ++exact;
        continue;
      }
      // solvers stop at a residual of 1e-12, which means errors of 1e-10 m over a run of some metres; within the
      // window these errors grow at most a thousandfold
      EXPECT_NEAR(entry["t"].number(), run.t, 1e-9);
      const std::vector<double> places = entry["places"].numbers();
      ASSERT_EQ(places.size(), static_cast<size_t>(run.x.size()));
      const Eigen::Map<const Points> x(places.data(), 3, run.x.cols());
      EXPECT_LT(largest_column(x - run.x), 1e-7);
    }
    EXPECT_EQ(i, native.size());
    EXPECT_GT(exact, 60u);  // 20 scenes, most of which have seven rules with exact results
  }

  /// A page with only the lab, and a self-test in the scope of its scripts. `call` is an expression whose value is the
  /// test's result.
  fs::path page_with(const std::vector<Scene>& scenes, const std::string& script, const std::string& call) const {
    std::string page = lab_page_html(scenes);
    const std::string own = page_script("lab_page");
    page.replace(page.rfind(own), own.size(), page_script("inner") + "</script><script>" + script + "\n");
    const std::string end = "</body>";
    page.insert(page.rfind(end),
                "<script>(async () => {\n  let seen;\n  try {\n    seen = await " + call +
                    ";\n  } catch (problem) {\n    seen = {problem: String(problem.stack ?? problem)};\n  }\n"
                    "  const note = document.createElement('script');\n  note.type = 'application/json';\n"
                    "  note.id = 'seen';\n  note.textContent = JSON.stringify(seen).replaceAll('<', '\\\\u003c');\n"
                    "  document.body.append(note);\n})();</script>\n");
    const fs::path file = folder_ / "lab.html";
    write_file(file, page);
    return file;
  }
  static std::string self_test(const char* name) {
    return read(fs::path(CROSSCHECK_SOURCE) / "tests/unit/report" / name);
  }

  static std::vector<Scene> scenes_of(const std::vector<std::string>& names) {
    std::vector<Scene> scenes;
    for (const std::string& name : names) scenes.push_back(load_scene(name));
    return scenes;
  }

  /// Runs the lab in real time, and fails on each line that it reports. `edit` modifies the page before it is loaded;
  /// `place` is appended to the page's address.
  JsonField use(const std::vector<Scene>& scenes, const std::string& call, void (*edit)(std::string& page) = nullptr,
                const std::string& place = "") {
    real_time_ = true;
    const fs::path file = page_with(
        scenes, self_test("real_time.js") + self_test("lab_use_selftest.js") + self_test("lab_guide_selftest.js"),
        "inRealTime(() => " + call + ")");
    if (edit) {
      std::string page = read(file);
      edit(page);
      write_file(file, page);
    }
    JsonField all = seen(file.string() + place, {});
    if (const auto problem = all.find("problem")) ADD_FAILURE() << problem->text();
    if (const auto lines = all.find("lines"))
      for (const std::string& line : lines->texts()) ADD_FAILURE() << line;
    return all;
  }

  /// Runs the scenes that the lab saved natively, and expects identical bits.
  static void run_natively(const JsonField& all, size_t count) {
    const auto saves = all.find("saves");
    ASSERT_TRUE(saves);
    EXPECT_EQ(saves->size(), count);
    for (const JsonField& save : saves->elements()) {
      SCOPED_TRACE(save["name"].text() + ": " + save["command"].text());
      const Scene scene = parse_scene(save["text"].text(), "saved.toml", "saved");
      EXPECT_EQ(scene.method, save["method"].text());
      EXPECT_EQ(scene.step, save["step"].number());
      LiveRun live(scene);
      live.start({scene.method, scene.step, 1e-6, scene.duration, false});
      live.advance(1e300, static_cast<int>(save["steps"].whole()));
      EXPECT_EQ(live.fingerprint(), save["fingerprint"].text());
    }
  }
};

TEST_F(LabModule, GivesTheNativeBitsInNode) {
  NEEDS_PROGRAM("node", "nodejs", "mysim is not tested as WebAssembly outside a browser");
  NEEDS_LAB;
  const std::vector<Scene> scenes = shipped();
  // Node and Chromium use the same WebAssembly engine. If Chromium is available, the test in Chromium covers the long
  // runs.
  const std::vector<NativeRun> native = native_runs(scenes, on_path("chromium") ? 100 : 1000);
  Json texts = Json::object();
  for (const Scene& scene : scenes) texts[scene.name] = scene.source;
  const std::string module = base64(gzipped(content_of_file(lab_module_file())));
  write_file(
      folder_ / "lab.js",
      "globalThis.window = globalThis;\nglobalThis.document = {getElementById: () => ({textContent: JSON.stringify('" +
          module + "')})};\nconst labScenes = () => (" + dump(texts) + ");\n" +
          content_of_file(programs_folder() / "page/inner_engine.js") + self_test("lab_selftest.js") + "\nrunAll(" +
          json_of(native) + ").then(seen => process.stdout.write(JSON.stringify(seen)));\n");
  const ProgramResult result = run_program({"node", (folder_ / "lab.js").string()}, folder_);
  ASSERT_EQ(result.status, 0) << last_lines(result.err, 20);
  compare(native, JsonField::parse(result.out, "what Node saw"));
}

TEST_F(LabModule, GivesTheNativeBitsInABrowser) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const std::vector<Scene> scenes = shipped();
  const std::vector<NativeRun> native = native_runs(scenes, 1000);
  const JsonField all = seen(page_with(scenes, self_test("lab_selftest.js"), "runAll(" + json_of(native) + ")"), {});
  compare(native, all);
}

TEST_F(LabModule, SlidersChangeTheirNumberAlone) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const JsonField all = use(shipped(), "labUse.sliders(Object.keys(labScenes()))");
  EXPECT_GT(all["moved"].number(), 250);  // three positions per slider
}

TEST_F(LabModule, MarksAreTheNativeCriticalSteps) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const std::vector<Scene> scenes = shipped();
  const JsonField all = use(scenes, "labUse.marks(Object.keys(labScenes()))");
  const auto words = all.find("words");
  ASSERT_TRUE(words);
  int marked = 0;
  for (const Scene& scene : scenes) {
    const LiveRun live(scene);
    for (const auto& [rule, field] : (*words)[scene.name].items()) {
      SCOPED_TRACE(scene.name + " by " + rule);
      const auto& table = steppers();
      const auto row = std::ranges::find(table, rule, &Stepper::name);
      ASSERT_NE(row, table.end());
      const std::optional<double> limit = live.critical_step(*row);
      const std::string text = field.text();
      if (!limit)
        EXPECT_EQ(text, "no critical step is predicted here");
      else if (*limit == 0)
        EXPECT_EQ(text, "predicted: stable at no step");
      else if (!std::isfinite(*limit))
        EXPECT_EQ(text, "predicted: stable at every step");
      else {
        const std::string before = "predicted critical step ";
        ASSERT_TRUE(text.starts_with(before)) << text;
        const size_t unit = text.find(' ', before.size()) + 1;
        const double size = text.compare(unit, 3, "µs") == 0 ? 1e-6 : text.compare(unit, 2, "ms") == 0 ? 1e-3 : 1;
        EXPECT_NEAR(std::stod(text.substr(before.size())) * size / *limit, 1, 0.006) << text;  // to three digits
        ++marked;
      }
    }
  }
  EXPECT_GT(marked, 60);
}

/// Every stepper blows up above its critical step, but not below it.
TEST_F(LabModule, BurstsAboveTheMarkAlone) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const std::vector<Scene> scenes = scenes_of({"cloth-hang", "flag", "spring"});
  const JsonField all = use(scenes, "labUse.bursts()");
  const auto tried = all.find("tried");
  ASSERT_TRUE(tried);
  const auto explicit_rules = std::ranges::count_if(
      steppers(), [](const Stepper& s) { return !s.adaptive && !s.hard_constraints && s.evaluations > 0; });
  EXPECT_EQ(tried->size(), scenes.size() * static_cast<size_t>(explicit_rules));
}

TEST_F(LabModule, NoFrameComputesLongWhileItBursts) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const JsonField all = use(scenes_of({"cloth-hang"}), "labUse.burstsInFrames('cloth-hang')");
  EXPECT_GT(all["frames"].number(), 20);
  // ms; takes the third longest frame, because the machine may have been busy
  EXPECT_LT(all["longest"].numbers().at(2), 100);
}

TEST_F(LabModule, AHandHoldsPinsAndLetsGo) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  use(scenes_of({"cloth-hang"}), "labUse.handByPointer('cloth-hang', 399)");
}

TEST_F(LabModule, AHandHoldsAndLetsGoWhereTheLabDrawsCoarsely) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  EXPECT_EQ(use(scenes_of({"cloth-hang"}), "labUse.dragsCoarsely('cloth-hang', 399)")["checked"].number(), 9);
}

TEST_F(LabModule, TheCircleStandsBeforeAPointLeavesIt) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  EXPECT_EQ(use(scenes_of({"circle", "cloth-hang"}), "labUse.courseFromTheStart()")["checked"].number(), 9);
}

TEST_F(LabModule, SteppersHaveChineseNamesBesideTheirOwn) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  EXPECT_EQ(use(scenes_of({"cloth-hang"}), "labUse.chineseNames()")["names"].items().size(), steppers().size());
}

TEST_F(LabModule, KeysOfThePictureDoWhatAPointerDoes) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  use(scenes_of({"cloth-hang"}), "labUse.keysOfPicture('cloth-hang')");
}

TEST_F(LabModule, ChangedScenesComeBackByLinkAndRunNatively) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  run_natively(use(scenes_of({"cloth-hang", "chain", "circle"}), "labUse.changedScenes()"), 3);
}

TEST_F(LabModule, ScenesChangedByHandComeBackByLinkAndRunNatively) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  run_natively(use(scenes_of({"cloth-hang", "cloth-carried", "cloth-swing"}), "labUse.changedByHand()"), 5);
}

TEST_F(LabModule, StandsAsItsAddressSays) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const auto at = [&](const std::string& place) {
    return use(scenes_of({"cloth-hang", "spring"}), "labUse.byAddress()", nullptr, place);
  };
  const JsonField state = at("#lab=" + base64(R"({"scene":"spring","changes":{"spring.stiffness":50},)"
                                              R"("methods":[{"method":"rk4","step":0.002}]} )"));
  EXPECT_EQ(state["scene"].text(), "spring");
  EXPECT_EQ(state["method"].text(), "rk4");
  EXPECT_EQ(state["step"].number(), 0.002);
  EXPECT_EQ(state["stiffness"].number(), 50);
  EXPECT_EQ(state["t"].number(), 0);
  EXPECT_FALSE(state["running"].boolean());
  const JsonField experiment = at("#experiment=pendulum-energy");
  EXPECT_EQ(experiment["experiment"].text(), "pendulum-energy");
  EXPECT_EQ(experiment["phase"].text(), "ask");
  EXPECT_EQ(experiment["scene"].text(), "pendulum");
  EXPECT_EQ(at("#lab=brokenaddress")["scene"].text(), "cloth-hang");
}

TEST_F(LabModule, DroppedFilesAreOpenedOrRefusedWithTheirLine) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  use(scenes_of({"spring"}), "labUse.drops()");
}

TEST_F(LabModule, NothingMovesBeforeRunWhereMotionIsReduced) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  use(scenes_of({"cloth-hang", "spring"}), "labUse.reducedMotion()");
}

TEST_F(LabModule, TabReachesEveryControl) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const JsonField all =
      use(scenes_of({"cloth-sphere"}),
          "labUse.tabOrder({scene: 'cloth-sphere', methods: [{method: 'leapfrog'}, {method: 'rk4'}]})");
  const auto found = all.find("stops");
  ASSERT_TRUE(found);
  const std::vector<std::string> stops = found->texts();
  // tab stops from the head to the picture, its controls, the methods, the scene's numbers and the export buttons
  auto from = stops.begin();
  for (const char* next :
       {"scene", "language", "picture", "run", "step", "restart", "resetView", "A", "step-A range", "B", "step-B range",
        "sphere.friction range", "grid.mass range", "copyLink", "saveToml", "copyCommand", "openToml"}) {
    from = std::find(from, stops.end(), next);
    ASSERT_NE(from, stops.end()) << next << " is not reached after the previous one, in " << fmt::format("{}", stops);
  }
}

TEST_F(LabModule, SaysPlainlyThatThereIsNoWebAssembly) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const JsonField all = use(scenes_of({"spring"}), "labUse.unavailable()", [](std::string& page) {
    page.insert(page.find("<body"), "<script>delete window.WebAssembly;</script>");
  });
  EXPECT_EQ(all["missing"].text(), "noWasm");
  EXPECT_NE(all["words"].text().find("does not run WebAssembly"), std::string::npos) << all["words"].text();
  EXPECT_EQ(all["still"].text(), "unavailable");
  EXPECT_EQ(all["controls"].number(), 0);
  EXPECT_NE(all["chinese"].text(), all["words"].text());
}

TEST_F(LabModule, ShowsNothingWhereThePageHasNoModule) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const JsonField all = use(scenes_of({"spring"}), "labUse.absent()", [](std::string& page) {
    const size_t begin = page.find("<script type=\"application/json\" id=\"lab-module\">");
    page.erase(begin, page.find("</script>", begin) + 9 - begin);
  });
  EXPECT_EQ(all["state"].text(), "unavailable");
  EXPECT_EQ(all["children"].number(), 0);
  EXPECT_EQ(all["dialogs"].number(), 0);
}

TEST_F(LabModule, APartRunsWhenItIsInSightAndOpensTheWholeLab) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  EXPECT_GT(use(scenes_of({"cloth-hang"}), "labUse.part()",
                [](std::string& page) {
                  const std::string whole = "<live-lab data-alone>";
                  page.replace(
                      page.find(whole), whole.size(),
                      "<div style=\"height: 3000px\"></div><live-lab data-scene=\"cloth-hang\" data-part=\"step\">");
                })["checked"]
                .number(),
            4);
}

TEST_F(LabModule, AFingerDragsAParticleAndMovesASlider) {
  NEEDS_PROGRAM("node", "nodejs", "touch input in the lab is not tested");
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const fs::path page = folder_ / "lab.html";
  write_file(page, lab_page_html(scenes_of({"cloth-hang"})));
  const fs::path script = fs::path(CROSSCHECK_SOURCE) / "tests/unit/report/by_touch.js";
  const ProgramResult result =
      run_program({"node", script.string(), page.string(), (folder_ / "profile").string()}, folder_);
  ASSERT_EQ(result.status, 0) << last_lines(result.err, 20);
  const JsonField saw = JsonField::parse(result.out, "what was touched");
  const JsonField drag = saw["drag"], slider = saw["slider"];
  // the finger moves 60 px to the left and 40 px down; the camera follows partly
  EXPECT_LT(drag["to"][0].number(), drag["from"][0].number() - 30);
  EXPECT_GT(drag["to"][1].number(), drag["from"][1].number() + 15);
  EXPECT_TRUE(drag["byHand"].boolean());
  EXPECT_LT(slider["is"].number(), 0.8 * slider["was"].number());
  // the text above may shift the page by a pixel; a scroll would shift it by 40
  for (const JsonField& each : {drag, slider})
    EXPECT_NEAR(each["scrolled"][0][1].number(), each["scrolled"][1][1].number(), 3) << "the page must not scroll";
}

TEST_F(LabModule, WordsAreThereInBothLanguages) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  const JsonField all = use(scenes_of({"spring"}), "labGuideTest.table()");
  EXPECT_GT(all["keys"].number(), 300);
}

TEST_F(LabModule, GuidedExperimentsGoToTheirEndInEnglish) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  EXPECT_EQ(use({}, "labGuideTest.run('en', true, true)")["steps"].size(), 22u);
}

TEST_F(LabModule, GuidedExperimentsGoToTheirEndInChinese) {
  NEEDS_LAB;
  NEEDS_CHROMIUM;
  EXPECT_EQ(use({}, "labGuideTest.run('zh', false, false)")["steps"].size(), 22u);
}

}  // namespace
}  // namespace crosscheck
