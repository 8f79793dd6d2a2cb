// scene.json, run.json and .npy: written values are read back bit for bit, errors in files are named, and frames are
// written to disk as they arrive.

#include <sys/resource.h>

#include <csignal>

#include "mysim/base/json.h"
#include "reference/certificate/certificate.h"
#include "reference/protocol/crosscheck_engine.h"
#include "reference/protocol/run_json.h"
#include "reference/protocol/scene_json.h"
#include "reference/protocol/trajectory_files.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
using SceneJson = InFolder;
using RunJson = InFolder;
using Npy = InFolder;

TEST_F(SceneJson, GivesEveryShippedSceneAndItsRunBackToTheBit) {
  std::vector<Scene> scenes{small_cloth(), small_cloth_in_air()};
  scenes[1].hash = hash_of(scenes[1]);
  for (const auto& name : shipped_scene_names()) scenes.push_back(shipped_scene(std::string(name)));
  for (const Scene& scene : scenes) {
    SCOPED_TRACE(scene.name);
    crosscheck::Run run = default_run(scene);
    run.step *= 0.7;  // does not divide the sampling interval
    const EngineTask task = read_scene_json(write("scene.json", scene_json(scene, run, {"n=10", "shipped"})));
    EXPECT_EQ(task.scene.hash, scene.hash);
    EXPECT_EQ(task.scene.start.x, scene.start.x);
    EXPECT_EQ(task.scene.start.v, scene.start.v);
    EXPECT_EQ(task.scene.triangles, scene.triangles);
    EXPECT_EQ(task.scene.model.particles.pin_home, scene.model.particles.pin_home);
    EXPECT_EQ(time_grid(task.run).h, time_grid(run).h);
    EXPECT_EQ(time_grid(task.run).steps_per_sample, time_grid(run).steps_per_sample);
    EXPECT_EQ(task.run.tolerance, run.tolerance);
    EXPECT_EQ(task.options, (std::vector<std::string>{"n=10", "shipped"}));
    // trajectories must agree bit for bit, which also tests properties that the hash does not cover
    const Stepper& rule = stepper(scene.model.first_order() ? "rk4" : "symplectic-euler");
    if (!takes(rule, scene)) continue;
    const crosscheck::Run few{scene.step, 10 * scene.step, 10};
    EXPECT_TRUE(identical(trajectory_of(rule, task.scene, few), trajectory_of(rule, scene, few)));
  }
}

TEST_F(SceneJson, SaysPinsAndGustsOutright) {
  const Scene scene = small_cloth();
  const JsonField json = JsonField::parse(scene_json(scene, default_run(scene), {}), "scene.json");
  const std::vector<double> times = json["run"]["times"].numbers();
  ASSERT_EQ(times.size(), 11u);
  EXPECT_EQ(json["run"]["steps_per_sample"].whole() * json["run"]["step"].number() * 10, times[10]);
  const std::vector<JsonField> displacements = json["pins"]["displacement"].elements(),
                               terms = json["terms"].elements();
  const JsonField gusts = (*std::find_if(terms.begin(), terms.end(),
                                         [](const JsonField& t) { return t["type"].text() == "wind"; }))["gusts"];
  const WindSignal& wind_signal = scene.model.find<Wind>()->acceleration;
  for (size_t i = 0; i < times.size(); ++i) {
    const double t = times[i];
    for (int j = 0; j < 3; ++j)
      EXPECT_EQ(displacements[i].numbers()[j], displacement_at(*scene.model.particles.move, t)[j]);
    // sum of the waves as an external engine would compute it
    auto gust = [&](const char* which) {
      double sum = 0;
      for (const JsonField& w : gusts[which].elements())
        sum += w["weight"].number() * std::sin(w["omega"].number() * t + w["phase"].number());
      return sum;
    };
    const Vec3 sum =
        wind_signal.mean * (1 + gusts["variation"].number() * gust("along")) + wind_signal.gusts->side * gust("across");
    EXPECT_LE((sum - wind_signal.at(t)).norm(), 1e-14 * wind_signal.mean.norm());  // a few roundings
  }
}

TEST_F(SceneJson, RefusesWhatIsBrokenAndNamesThePlace) {
  const Scene scene = small_cloth();
  const std::string good = scene_json(scene, default_run(scene), {});
  const struct {
    std::string from, to, message;
  } cases[] = {{"\"version\": 1", "\"version\": 2", "version: expected a whole number from 1 to 1"},
               {"\"crosscheck-scene\"", "\"other\"", "format: expected crosscheck-scene"},
               {"\"hooke\"", "\"cubic\"", "terms[0].law: expected hooke or bullet-link"},
               {"\"stiffness\":40.0", "\"stiffness\":\"40\"", "terms[0].list[0].stiffness: expected a number"},
               {"\"a\":0", "\"a\":25", "terms[0].list[0].a: expected a whole number from 0 to 24"},
               {"\"rest_length\"", "\"length\"", "terms[0].list[0]: expected the key \"rest_length\""},
               {"\"particles\": {\"count\":25", "\"particles\": {\"count\":24", "particles.x: expected 24 triples"},
               {"{\n", "[\n", "expected one JSON object"}};
  for (const auto& [from, to, message] : cases) {
    std::string text = good;
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    const std::string said = refusal_of([&] { read_scene_json(write("scene.json", text)); });
    EXPECT_TRUE(contains(said, message));
    EXPECT_TRUE(begins(said, (folder_ / "scene.json").string()));
  }
  EXPECT_TRUE(contains(refusal_of([&] { read_scene_json(folder_ / "none.json"); }), "cannot be read"));
  // a term of a later version is valid in the file: engines refuse it
  std::string later = good;
  later.replace(later.find("\"type\":\"gravity\""), 16, "\"type\":\"magnet\"");
  try {
    read_scene_json(write("scene.json", later));
    ADD_FAILURE() << "expected an error";
  } catch (const Unsupported& lack) {
    EXPECT_STREQ(lack.what(), "unknown term magnet");
  }
}

TEST_F(SceneJson, TheExampleOfThePageIsWhatIsWritten) {
  const std::string page = read(std::string(CROSSCHECK_SOURCE) + "/reference/protocol/PROTOCOL.md");
  const std::string begin = "```json\n";
  const size_t at = page.find(begin) + begin.size();
  const std::string example = page.substr(at, page.find("```", at) - at);
  const EngineTask task = read_scene_json(write("scene.json", example));
  EXPECT_EQ(scene_json(task.scene, task.run, task.options), example);
  for (const char* key :
       {"springs", "dashpots", "constraints", "gravity", "drag", "wind", "aerodynamics", "sphere", "plane", "rotation"})
    EXPECT_TRUE(contains(page, fmt::format("| `{}` |", key)));
}

TEST_F(RunJson, GivesAnOutcomeBack) {
  const Scene scene = small_cloth();
  Outcome out = run_and_record("bullet/deformable-explicit", scene, {1e-3, 0.1, 2}).outcome;
  ASSERT_TRUE(out.readback && out.readback->probe);
  out.readback->start = scene.start;
  out.readback->spheres.emplace().push_back({{1, 2, 3}, 0.5, std::nullopt, 0.25});
  ASSERT_TRUE(out.readback->later);
  out.readback->later->centres = {{1, 2, 4}};
  out.readback->margin = 0.01;
  out.readback->drag = std::vector<double>(25, 2);
  out.readback->links[3].stiffness = 1.0 / 3;
  out.different_law = {"springs: otherwise"};
  Outcome back;
  read_run_json(write("run.json", run_json(out)), back);
  EXPECT_EQ(run_json(back), run_json(out));  // the file contains everything known about the run
  EXPECT_EQ(back.readback->mass, out.readback->mass);
  EXPECT_EQ(back.readback->pinned, out.readback->pinned);
  EXPECT_EQ(back.readback->probe->springs, out.readback->probe->springs);
  EXPECT_EQ(back.readback->start->x, scene.start.x);
  EXPECT_EQ(back.readback->later->pins, out.readback->later->pins);
  EXPECT_EQ(back.readback->later->centres, out.readback->later->centres);
  EXPECT_EQ(back.readback->mapped, out.readback->mapped);
  EXPECT_EQ(*back.readback->links[3].stiffness, 1.0 / 3);
  EXPECT_EQ(back.cpu_seconds, out.cpu_seconds);
  EXPECT_EQ(back.steps, out.steps);
}

TEST_F(RunJson, RefusesWhatIsBrokenAndNamesThePlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "expected one JSON object"},
      {"{\"steps\": NaN}", "expected one JSON object"},
      {"{\"steps\": NaN}", "steps: expected a finite number"},
      {"{\"readback\": {\"links\": [{\"stiffness\": inf}]}}", "readback.links[0].stiffness: expected a finite number"},
      {"{\"cpu_seconds\": -1}", "run.json: cpu_seconds: expected seconds from 0 to 1e+09, got -1"},
      {"{\"cpu_seconds\": 1e30}", "run.json: cpu_seconds: expected seconds from 0 to 1e+09, got 1e+30"},
      {"{\"steps\": -1}", "run.json: steps: expected a number of them, from 0 to 2^53, got -1"},
      {"{\"steps\": 1e300}", "run.json: steps: expected a number of them, from 0 to 2^53"},
      {"{\"force_evaluations\": 1e17}", "run.json: force_evaluations: expected a number of them"},
      {"{\"coincident_springs\": -3}", "run.json: coincident_springs: expected a number of them"},
      {"{\"step\": 1e300}", "run.json: step: expected seconds above 0, at most 2"},
      {"{\"step\": 0}", "run.json: step: expected seconds above 0, at most 2"},
      {"{\"end\": 3}", "run.json: end: expected seconds from 0 to 2"},
      {"{\"verdict\": \"timeout\"}", "run.json: verdict: expected ok, energy, nan, solver or frozen"},
      {"{\"different_law\": [\"springs\"]}", "different_law[0]: expected a sentence"},
      {"{\"readback\": {\"mass\": [1, 2], \"pinned\": [0]}}", "readback.pinned: expected as many entries"},
      {"{\"readback\": {\"mass\": [1], \"pinned\": [0]}}", "readback: expected the key \"links\""},
      {"{\"readback\": {\"mass\": [1], \"pinned\": [0], \"links\": [], \"precision\": \"half\"}}",
       "readback.precision: expected double or single"},
      {"{\"readback\": {\"mass\": [1], \"pinned\": [0], \"links\": [{\"a\": 0, \"b\": 1}]}}", "links[0].b: expected"}};
  for (const auto& [text, message] : cases) {
    Outcome out;
    EXPECT_TRUE(contains(refusal_of([&] { read_run_json(write("run.json", text), out, 2); }), message)) << text;
  }
}

TEST_F(RunJson, TheShippedHeaderWritesAllThatTheCertificateAsks) {
  namespace engine = crosscheck_engine;
  const Scene scene = shipped_scene("slide");
  engine::RunReport report;
  report.cpu_seconds = 0.5, report.steps = 7, report.step = scene.step;
  report.verdict = "solver", report.reason = "no root", report.end = 0.25;
  report.different_law = {"springs: a \"law\"\nof its own"};
  engine::Readback& r = report.readback.emplace();
  r.mass = {1}, r.pinned = {0}, r.gravity = engine::Vec{0, -9.81, 0}, r.drag = std::vector<double>{0};
  r.spheres = std::vector<engine::Ball>{{{0, 0, 0}, 1.02, 0.2, 0}};
  r.margin = 0.02, r.may_sleep = false, r.step = scene.step;
  r.start_x = {{0, 1.02, 0}}, r.start_v = {{1, 0, 0}};
  r.later = engine::Places{1, {}, {{0, 0, 0}}};
  r.probe = engine::Probe{0, {{0, 2, 0}}, {{0, 0, 0}}, {}, {{0, 0, 0}}, {{0, 0, 0}}};
  r.mapped = {{"friction", "as mu"}}, r.settings = {{"iterations", "10"}};
  engine::write_run_json((folder_ / "run.json").string(), report);
  Outcome out;
  read_run_json(folder_ / "run.json", out, scene.duration);
  EXPECT_EQ(out.verdict, Verdict::solver);
  EXPECT_EQ(out.reason, "no root");
  EXPECT_EQ(out.end, 0.25);
  EXPECT_EQ(out.cpu_seconds, 0.5);
  EXPECT_EQ(out.steps, 7);
  EXPECT_EQ(out.evaluations, 0) << "evaluations are not counted";
  EXPECT_EQ(out.different_law, report.different_law);
  EXPECT_EQ(out.readback->settings, r.settings);
  out.different_law.clear();
  for (const CertificateRow& row : certify("engine", scene, out).rows)
    EXPECT_EQ(row.parity, Parity::match) << row.quantity << ": " << row.read_back;
}

TEST_F(RunJson, TheShippedHeaderLeavesOutWhatIsHardOrUnknown) {
  namespace engine = crosscheck_engine;
  engine::RunReport report;
  engine::Readback& r = report.readback.emplace();
  r.mass = {1, 1, 1}, r.pinned = {1, 0, 0};
  r.links = {{0, 1, engine::hard, 0.5}, {1, 2, engine::unknown, 0.25}, {0, 2, 40, 0.75}};
  engine::write_run_json((folder_ / "run.json").string(), report);
  Outcome out;
  read_run_json(folder_ / "run.json", out);
  ASSERT_EQ(out.readback->links.size(), 3u);
  EXPECT_FALSE(out.readback->links[0].stiffness);
  EXPECT_FALSE(out.readback->links[1].stiffness);
  EXPECT_EQ(out.readback->links[2].stiffness, 40);
  EXPECT_EQ(out.readback->links[1].rest, 0.25);
  EXPECT_FALSE(out.readback->gravity || out.readback->drag || out.readback->spheres || out.readback->margin ||
               out.readback->may_sleep || out.readback->step || out.readback->start || out.readback->later ||
               out.readback->probe);
}

/// A .npy file with this header and `bytes` bytes of data.
std::string npy_file(const std::string& dictionary, size_t bytes, int version = 1) {
  std::string text = "\x93NUMPY";
  text += static_cast<char>(version);
  text += '\0';
  text += static_cast<char>(dictionary.size());
  text += std::string(version == 1 ? 1 : 3, '\0');
  return text + dictionary + std::string(bytes, '\0');
}

TEST_F(Npy, IsReadBackToTheBitInBothPrecisionsAndFormats) {
  Random random(1);
  std::vector<Points> frames(3, Points(3, 2));
  for (Points& x : frames)
    for (double& value : x.reshaped()) value = random.between(-1, 1);
  EXPECT_EQ(read_npy(write("f8.npy", npy_bytes(frames)), 3, 3, 2), frames);
  std::string single = npy_file("{'descr': '<f4', 'fortran_order': False, 'shape': (3, 2, 3), }", 0, 2);
  for (const Points& x : frames) {
    const Eigen::Matrix3Xf rounded = x.cast<float>();
    single.append(reinterpret_cast<const char*>(rounded.data()), sizeof(float) * rounded.size());
  }
  const std::vector<Points> back = read_npy(write("f4.npy", single), 1, 5, 2);
  ASSERT_EQ(back.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(back[i], frames[i].cast<float>().cast<double>());
}

TEST_F(Npy, RefusesEverythingElseAndSaysWhatWasExpected) {
  const std::string head = "{'descr': '<f8', 'fortran_order': False, 'shape': ";
  const struct {
    std::string text, message;
  } cases[] = {{"nonsense", "expected a .npy file"},
               {npy_file("{'descr': '<f8'}", 48), "expected a .npy header"},
               {npy_file(head + "(1, 2, 3)}", 48, 3), "expected .npy format 1.0 or 2.0, got 3.0"},
               {npy_file("{'descr': '>f8', 'fortran_order': False, 'shape': (1, 2, 3)}", 48), "little endian"},
               {npy_file("{'descr': '<i8', 'fortran_order': False, 'shape': (1, 2, 3)}", 48), "got '<i8'"},
               {npy_file("{'descr': '<f8', 'fortran_order': True, 'shape': (1, 2, 3)}", 48), "expected C order"},
               {npy_file(head + "(6,)}", 48), "expected shape (1, 2, 3): 1 frames of 2 particles, got (6,)"},
               {npy_file(head + "(1, 3, 2)}", 48), "got (1, 3, 2)"},
               {npy_file(head + "(1, 4, 3)}", 96), "got (1, 4, 3): another number of particles"},
               {npy_file(head + "(2, 2, 3)}", 96), "got (2, 2, 3): another number of frames"},
               {npy_file(head + "(1, 2, 3)}", 40), "shorter than its header says"},
               {npy_file(head + "(1, 2, 3)}", 56), "longer than its header says"},
               {npy_file(head + "(999999999999999999999, 2, 3)}", 48), "expected a .npy header"},
               {std::string("\x93NUMPY\x02\0\xff\xff\xff\xff", 12), "expected a header of at most 65535 bytes"}};
  for (const auto& [text, message] : cases) {
    const std::string said = refusal_of([&] { read_npy(write("x.npy", text), 1, 1, 2); });
    EXPECT_TRUE(contains(said, message));
    EXPECT_TRUE(begins(said, (folder_ / "x.npy").string()));
  }
}

using namespace testing_tools;

class FramesOnDisk : public InFolder {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) list.push_back(entry.path().filename());
    std::sort(list.begin(), list.end());
    return list;
  }
};

TEST_F(FramesOnDisk, AreTheBytesOfTheTrajectoryInMemory) {
  const struct {
    std::string method;
    Scene scene;
    bool velocities;
  } cases[] = {{"leapfrog", small_cloth(), true},
               {"dopri5", small_cloth(), true},
               {"bullet/pbd", shipped_scene("chain"), true},
               {"rk4", shipped_scene("circle"), false}};
  for (const auto& [method, scene, velocities] : cases) {
    SCOPED_TRACE(scene.name + " " + method);
    std::filesystem::remove(folder_ / "velocities.npy");
    Recorder kept;
    TrajectoryWriter files(folder_);
    ASSERT_EQ(run_method(find_method(method), scene, default_run(scene), {&kept, &files}).verdict, Verdict::ok);
    files.finish();
    EXPECT_EQ(files.times(), kept.trajectory.t);
    EXPECT_EQ(read(folder_ / "trajectory.npy"), npy_bytes(kept.trajectory.x));
    EXPECT_EQ(std::filesystem::exists(folder_ / "velocities.npy"), velocities);
    if (velocities) {
      EXPECT_EQ(read(folder_ / "velocities.npy"), npy_bytes(kept.trajectory.v));
    }
  }
}

TEST_F(FramesOnDisk, OfARunThatFailsAreAsManyAsThereWere) {
  const Scene scene = shipped_scene("cloth-hang");
  const crosscheck::Run run = default_run(scene);
  Recorder kept;
  TrajectoryWriter files(folder_);
  ASSERT_EQ(run_method(find_method("explicit-euler"), scene, run, {&kept, &files}).verdict, Verdict::energy);
  files.finish();
  const int frames = kept.trajectory.frames();
  ASSERT_LT(frames, run.samples);
  ASSERT_GT(frames, 1);
  EXPECT_EQ(read_npy(folder_ / "trajectory.npy", frames, frames, scene.model.particles.size()), kept.trajectory.x);
  EXPECT_EQ(read_npy(folder_ / "velocities.npy", frames, frames, scene.model.particles.size()), kept.trajectory.v);
}

TEST_F(FramesOnDisk, LeaveWhatWasThereUntilTheyAreWhole) {
  write("trajectory.npy", "old");
  const Scene scene = small_cloth();
  {
    TrajectoryWriter cut(folder_);
    cut.observe(scene.start, true);
    EXPECT_EQ(read(folder_ / "trajectory.npy"), "old");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "velocities.npy"));
  }
  EXPECT_EQ(names(), std::vector<std::string>{"trajectory.npy"}) << "incomplete files must be removed";
  EXPECT_EQ(read(folder_ / "trajectory.npy"), "old");

  TrajectoryWriter whole(folder_);
  whole.observe(scene.start, true);
  whole.finish();
  EXPECT_EQ(names(), (std::vector<std::string>{"trajectory.npy", "velocities.npy"}));
  EXPECT_EQ(read(folder_ / "trajectory.npy"), npy_bytes({scene.start.x}));
}

TEST_F(FramesOnDisk, SayWhichFileCannotBeWritten) {
  const Scene scene = small_cloth();
  EXPECT_TRUE(contains(refusal_of([&] { TrajectoryWriter(write("file", "") / "x").observe(scene.start, true); }),
                       "file/x/trajectory.npy: cannot be written; expected a folder with write permission"));
  // a limit of 1000 bytes for the process emulates a full disk
  const auto write_more = [&] {
    const rlimit limit{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
    const std::string said = refusal_of([&] {
      TrajectoryWriter files(folder_);
      for (int i = 0; i < 100; ++i) files.observe(scene.start, true);
      files.finish();
    });
    std::fputs(said.c_str(), stderr);
    std::_Exit(names() == std::vector<std::string>{"file"} ? 2 : 1);
  };
  EXPECT_EXIT(write_more(), testing::ExitedWithCode(2), "(velocities|trajectory).npy: cannot be written; expected");
}

TEST(NpyHeader, HasOneLengthWhateverTheNumbers) {
  for (const auto& [frames, particles] : {std::pair{0L, 0L}, {1L, 9L}, {1000001L, 10000000L}})
    EXPECT_EQ(npy_header(frames, particles).size(), 128u);
}

}  // namespace
}  // namespace crosscheck
