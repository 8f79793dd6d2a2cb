// Packed numbers survive a round trip, positions are within the stated bound, recorded runs equal those of the
// experiment, and inconsistent entries are refused.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "experiments/metrics.h"
#include "experiments/observers.h"
#include "experiments/scenes/scenes.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/stability/map.h"
#include "mysim/base/files.h"
#include "mysim/model/energy.h"
#include "report/player/packed_numbers.h"
#include "report/player/runs.h"
#include "report/player/stage.h"
#include "tests/unit/experiments/helpers.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/readers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(PackedNumbers, AnyNumbersComeBack) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    const size_t columns = 1 + random() % 40;
    std::vector<std::uint16_t> numbers(columns * (random() % 100));
    for (auto& n : numbers) n = static_cast<std::uint16_t>(random());
    const std::string bytes = pack(numbers, columns);
    EXPECT_EQ(unpacked(bytes, numbers.size(), columns), numbers) << "seed " << seed;
    EXPECT_EQ(unpack(bytes, numbers.size(), columns), numbers) << "seed " << seed;
  }
}

TEST(PackedNumbers, RefuseBytesThatHoldOthers) {
  const std::string good = pack(std::vector<std::uint16_t>(100, 7), 1);
  EXPECT_EQ(unpack(good, 100, 1).size(), 100u);
  for (const size_t count : {size_t{0}, size_t{99}, size_t{101}, size_t{1} << 36, size_t{1} << 62})
    EXPECT_ANY_THROW(unpack(good, count, 1)) << count;
  EXPECT_ANY_THROW(unpack(good.substr(0, good.size() - 1), 100, 1)) << "truncated data";
  EXPECT_ANY_THROW(unpack(good + "x", 100, 1)) << "data after the end";
  EXPECT_ANY_THROW(unpack("no gzip at all", 100, 1));
}

std::string all_rows(const TableSet& rows) {
  std::string all;
  for (const Table& t : rows.tables)
    for (const auto& row : t.rows) all += t.name + ": " + csv_row(row) + "\n";
  return all;
}

/// Copies of recorded runs, which outlive the call that recorded them.
struct Kept {
  std::string of, method;
  Scene scene;
  std::vector<RecordedRun> runs;
  RecordedRuns watched() const { return {of, scene, method, runs}; }
};
RunCallback keeping(std::vector<Kept>& kept) {
  return [&kept](const RecordedRuns& w) { kept.push_back({w.of, w.method, w.scene, w.runs}); };
}

class Runs : public InFolder {
 protected:
  /// Stores runs at the scene's own step.
  void keep(const Scene& scene, const std::vector<std::string>& methods) {
    RunsWriter writer(folder_);
    Request request;
    request.scenes = {scene};
    writer.keep_truth(scene, run_of(request, scene));
    for (const std::string& name : methods) {
      const MethodResult& r = result_of(request, scene, find_method(name), results_);
      writer.keep({"engines", scene, name, {{r.outcome, r.trajectory}}}, run_of(request, scene));
    }
    read_index();
  }
  void read_index() {
    index_ = JsonField::parse(dump(take_index(folder_)), "index");
    files_ = run_files(index_, folder_, true);
  }
  const RunFile& file(const std::string& set, const std::string& method) const {
    for (const RunFile& each : files_)
      if (each.set == set && each.method == method) return each;
    throw std::out_of_range(set + " by " + method);
  }
  /// Coordinates (frames x 3 x particles), decoded by an independent reader.
  static std::vector<double> coordinates(const RunFile& file, const Json& run) {
    const std::string bytes = InFolder::read(file.file).substr(run["offset"].get<size_t>(), run["bytes"].get<size_t>());
    const size_t columns = 3 * static_cast<size_t>(file.particles);
    std::vector<double> all;
    for (const std::uint16_t number : unpacked(bytes, run["frames"].get<size_t>() * columns, columns)) {
      const size_t axis = all.size() % columns / static_cast<size_t>(file.particles);
      all.push_back(run["low"][axis].get<double>() + run["unit"].get<double>() * number);
    }
    return all;
  }
  /// Largest difference (m) between a coordinate in the file and in the trajectory; frames are `stride` samples apart.
  static double largest_off(const RunFile& file, size_t place, const Trajectory& path, int stride) {
    const Json& run = file.entry["runs"][place];
    const std::vector<double> all = coordinates(file, run);
    const auto n = static_cast<size_t>(file.particles);
    double worst = 0;
    for (size_t f = 0; f < run["frames"].get<size_t>(); ++f)
      for (size_t axis = 0; axis < 3; ++axis)
        for (size_t i = 0; i < n; ++i)
          worst = std::max(worst, std::abs(all[(3 * f + axis) * n + i] -
                                           path.x[f * static_cast<size_t>(stride)](static_cast<Eigen::Index>(axis),
                                                                                   static_cast<Eigen::Index>(i))));
    return worst;
  }
  JsonField index_ = JsonField::parse("[]", "none");
  std::vector<RunFile> files_;
  MethodResults results_;
};

TEST_F(Runs, HoldPositionsErrorsAndEnergiesOfTheirFramesWithinTheBound) {
  const Scene scene = load_scene("chain");
  keep(scene, {"mysim/leapfrog", "mysim/symplectic-euler", "bullet/deformable-explicit"});
  const int stride = frame_stride(scene);
  const auto truth = truth_of(scene, default_run(scene));
  ASSERT_TRUE(truth);
  EXPECT_LE(largest_off(file("chain-truth", "truth"), 0, truth->trajectory, stride), 4e-5)
      << "m: the resolution of 16 bits";
  for (const MethodResult& r : results_) {
    SCOPED_TRACE(r.method);
    const RunFile& own = file("chain-engines", r.method);
    const Json& run = own.entry["runs"][0];
    ASSERT_EQ(run["frames"], 151);
    EXPECT_EQ(run["times"].dump(), "[0.0,3.0]");
    EXPECT_EQ(run["verdict"], "ok");
    EXPECT_GT(run["bound"].get<double>(), 0);
    EXPECT_LE(largest_off(own, 0, r.trajectory, stride), run["bound"].get<double>() * (1 + 1e-9));
    EXPECT_EQ(positions_of(own, 0).size(), 151u);
    EXPECT_NEAR(positions_of(own, 0)[7](1, 2), coordinates(own, run)[7 * 12 + 4 + 2], 1e-12);
    for (size_t f = 0; f < 151; ++f) {
      const size_t sample = f * static_cast<size_t>(stride);
      const Points& x = r.trajectory.x[sample];
      const double off = rms_distance(x, truth->trajectory.x[sample]);
      if (!run["error"][f].is_null()) {
        EXPECT_NEAR(run["error"][f].get<double>(), off, 1e-3 * off);
      }
      const double kinetic = energy_of(scene.model, {0, x, r.trajectory.v[sample]}).kinetic;
      EXPECT_NEAR(run["energy"][f].get<double>(), kinetic, 1e-3 * kinetic);
    }
  }
  EXPECT_EQ(positions_of(file("chain-engines", "mysim/symplectic-euler"), 0),
            positions_of(file("chain-engines", "bullet/deformable-explicit"), 0))
      << "identical rules have identical motions on the same lattice";
}

TEST_F(Runs, ThatBlewUpEndInSightAndSayWhenAndWhy) {
  const Scene scene = load_scene("chain");
  keep(scene, {"mysim/explicit-euler"});
  const RunFile& own = file("chain-engines", "mysim/explicit-euler");
  const Json& failed = own.entry["runs"][0];
  EXPECT_LT(failed["frames"], 76);
  EXPECT_EQ(failed["verdict"], "energy");
  EXPECT_EQ(failed["reason"], "ten times too fast");
  EXPECT_LE(failed["times"].back(), failed["failed"]);
  for (const Points& x : positions_of(own, 0)) EXPECT_LT(x.cwiseAbs().maxCoeff(), 20) << "coordinate in m";
}

TEST_F(Runs, HaveErrorsForAsLongAsTheTruthIsKnown) {
  const Scene scene = load_scene("cloth-sphere");
  keep(scene, {"mysim/leapfrog"});
  const Json &truth = file("cloth-sphere-truth", "truth").entry["runs"][0],
             &run = file("cloth-sphere-engines", "mysim/leapfrog").entry["runs"][0];
  EXPECT_NEAR(truth["times"].back().get<double>(), scene.window, 0.05);
  EXPECT_NEAR(run["times"].back().get<double>(), scene.duration, 1e-9);
  EXPECT_FALSE(run["error"][1].is_null());
  EXPECT_TRUE(run["error"].back().is_null());
  EXPECT_FALSE(run["energy"].back().is_null());
}

TEST_F(Runs, OfAnOutsideProgramAreKeptAsAnyOthers) {
  const Scene scene = load_scene("chain");
  const std::string name = "exec:/tools/my engine";
  Recorder recorder;
  const Outcome out = run_method(find_method("mysim/rk4"), scene, default_run(scene), {&recorder});
  RunsWriter(folder_).keep({"engines", scene, name, {{out, recorder.trajectory}}}, default_run(scene));
  read_index();
  ASSERT_EQ(files_.size(), 1u);
  EXPECT_EQ(files_[0].method, name);
  EXPECT_EQ(files_[0].entry["file"], "runs/chain-engines/exec--tools-my-engine.u16.gz");
}

TEST(LastFrames, AreAtLeastEightToAPeriodOrEveryStep) {
  const double omega = 2 * M_PI;
  for (const double h : {1e-3, 0.03, 0.2, 0.9}) {
    LastFrames last(omega, h);
    for (int i = 0; i <= 10000; ++i) last.observe({h * i, Points::Constant(3, 1, i), Points::Zero(3, 1)}, false);
    const Trajectory path = last.path();
    ASSERT_EQ(path.frames(), 25);
    for (int f = 1; f < 25; ++f) EXPECT_LE(path.t[f] - path.t[f - 1], std::max(h, 1 / 8. + h / 2) * (1 + 1e-9)) << h;
    EXPECT_GT(path.t.back(), 10000 * h - std::max(h, 1 / 8. + h)) << "expected the last frames, h " << h;
  }
}

TEST(LastFrames, OfAShortRunAreAllOfItAsFarAsItIsFinite) {
  LastFrames last(0, 1e-3);
  for (int i = 0; i < 5; ++i) last.observe({1e-3 * i, Points::Zero(3, 2), Points::Zero(3, 2)}, false);
  last.observe({5e-3, Points::Constant(3, 2, NAN), Points::Zero(3, 2)}, false);
  EXPECT_EQ(last.path().frames(), 5);
}

/// Expects that every method delivers its runs, and that rows are identical with and without recording. Counts failed
/// runs.
void expect_watching_changes_no_row(const std::string& methods, int& failed) {
  Request request;
  request.methods = find_methods(methods);
  const Scene scene = load_scene("pendulum");
  std::vector<Kept> kept;
  TableSet rows, unwatched;
  speed_accuracy_on(request, scene, unwatched);
  request.on_runs = keeping(kept);
  speed_accuracy_on(request, scene, rows);
  EXPECT_EQ(all_rows(rows), all_rows(unwatched));
  EXPECT_EQ(kept.size(), request.methods.size());
  for (const Kept& k : kept)
    for (const RecordedRun& run : k.runs) {
      failed += run.outcome.verdict != Verdict::ok;
      EXPECT_GT(run.path.frames(), 0) << k.method << ": failed runs must have frames too";
    }
}

TEST(RecordedRuns, ChangeNoRow) {
  int failed = 0;
  expect_watching_changes_no_row("leapfrog,explicit-euler,dopri5,implicit-euler,odeint/dopri5,bullet/pbd", failed);
  EXPECT_GT(failed, 0);
  for (const char* method : {"explicit-euler", "bullet/pbd", "bullet/deformable-explicit"}) {
    SCOPED_TRACE(method);
    std::vector<Kept> kept;
    TableSet map, unwatched_map;
    add_map(map_kinds()[0], load_scene("spring"), find_method(method), {3, 6, 300, false}, map, keeping(kept));
    add_map(map_kinds()[0], load_scene("spring"), find_method(method), {3, 6, 300, false}, unwatched_map);
    EXPECT_EQ(all_rows(map), all_rows(unwatched_map));
  }
}

TEST(RecordedRuns, OfSundialsChangeNoRow) {
  NEEDS_SUNDIALS;
  int failed = 0;
  expect_watching_changes_no_row("sundials/arkode", failed);
}

TEST_F(Runs, OfAChartLieInTheOrderOfItsRows) {
  Request request;
  request.scenes = {load_scene("chain")};
  request.methods = find_methods("mysim/leapfrog,mysim/explicit-euler,bullet/pbd,mysim/dopri5");
  const Scene& scene = request.scenes[0];
  std::vector<Kept> kept;
  request.on_runs = keeping(kept);
  TableSet rows;
  speed_accuracy_on(request, scene, rows);
  ASSERT_EQ(kept.size(), 4u);
  RunsWriter writer(folder_);
  for (const Kept& k : kept) writer.keep(k.watched(), run_of(request, scene));
  read_index();
  size_t row = 0, whole = 0, failed = 0;
  const Table& table = *rows.table("speed-accuracy");
  for (const Kept& k : kept) {
    const RunFile& marks = file("chain-speed-accuracy", k.method);
    for (size_t r = 0; r < k.runs.size(); ++r, ++row) {
      ASSERT_EQ(std::get<std::string>(table.at(row, "method")), k.method);
      const Json& run = marks.entry["runs"][r];
      const Trajectory& path = k.runs[r].path;
      if (run.is_null()) continue;
      EXPECT_EQ(std::get<std::string>(table.at(row, "verdict")), run["verdict"].get<std::string>());
      EXPECT_LE(run["frames"], 31);
      const bool last = run.contains("last_pictures");
      EXPECT_EQ(last, run["verdict"] != "ok");
      EXPECT_LE(largest_off(marks, r, path, last ? 1 : 5), run["bound"].get<double>() * (1 + 1e-9));
      if (last) {
        EXPECT_NEAR(run["times"].back().get<double>(), k.runs[r].outcome.end, 0.5) << "expected the last frames";
      }
      ++(last ? failed : whole);
    }
  }
  EXPECT_EQ(row, table.rows.size());
  EXPECT_GT(whole, 10u);
  EXPECT_GT(failed, 2u);
}

TEST_F(Runs, OfAMapAreTheLastPicturesOfItsCells) {
  for (const char* name : {"spring", "normal-modes", "cloth-hang"}) {
    SCOPED_TRACE(name);
    const Scene scene = *map_scene(load_scene(name), false);
    std::vector<Kept> kept;
    TableSet rows;
    add_map(map_kinds()[0], scene, find_method("mysim/leapfrog"), {3, 6, 300, false}, rows, keeping(kept));
    ASSERT_EQ(kept.size(), 1u);
    RunsWriter(folder_).keep(kept[0].watched(), default_run(scene));
    read_index();
    ASSERT_EQ(files_.size(), 1u);
    const Json& run = files_[0].entry["runs"][0];
    ASSERT_EQ(run["frames"], 18) << "one per row of the table";
    const std::vector<Points> pictures = positions_of(files_[0], 0);
    size_t shown = 0, cut = 0;
    for (size_t c = 0; c < 18; ++c) {
      const RecordedRun& cell = kept[0].runs[c];
      EXPECT_LT((pictures[c] - *cell.rest).cwiseAbs().maxCoeff(), 2.01 * scene.size());
      if (run["times"][c].is_null()) continue;
      ++shown;
      size_t at = 0;
      while (at + 1 < cell.path.t.size() && cell.path.t[at] < run["times"][c].get<double>() * (1 - 1e-3)) ++at;
      EXPECT_LT((pictures[c] - cell.path.x[at]).cwiseAbs().maxCoeff(), run["bound"].get<double>() * (1 + 1e-9)) << c;
      cut += at + 1 < cell.path.t.size();
    }
    EXPECT_GT(shown, 6u);
    EXPECT_LT(cut, shown) << "most cells end within view";
  }
}

TEST_F(Runs, OfDenormalPositionsAreKept) {
  Scene scene = load_scene("spring");
  scene.samples = 1;
  Trajectory path;
  for (const double t : {0., 1.}) {
    path.t.push_back(t), path.x.push_back(scene.start.x * 0), path.v.push_back(path.x.back());
    path.x.back()(0, 0) = 1e-310;
  }
  Outcome out;
  out.step = 1;
  RunsWriter(folder_).keep({"engines", scene, "mysim/rk4", {{out, path}}}, default_run(scene));
  read_index();
  EXPECT_EQ(positions_of(files_.at(0), 0).size(), 2u);
}

TEST_F(Runs, WithEntriesThatLieAreRefused) {
  keep(load_scene("chain"), {"mysim/rk4"});
  const Json good = index_.json();
  const auto said = [&](const std::function<void(Json & entry, Json & run)>& change) -> std::string {
    Json bad = good;
    change(bad[0], bad[0]["runs"][0]);
    try {
      run_files(JsonField::parse(dump(bad), "rep/report.json"), folder_, true);
      return "accepted";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(said([](Json&, Json&) {}), "accepted");
  const auto expect_refused = [&](const std::string& what,
                                  const std::function<void(Json & entry, Json & run)>& change) {
    const std::string message = said(change);
    EXPECT_TRUE(contains(message, "rep/report.json") || contains(message, ".u16.gz") || contains(message, "secret"))
        << what << ": " << message;
    EXPECT_FALSE(contains(message, "\n")) << message;
  };
  expect_refused("another file", [](Json& e, Json&) { e["file"] = "../../secret"; });
  expect_refused("no particles", [](Json& e, Json&) { e["particles"] = 0; });
  expect_refused("more particles", [](Json& e, Json&) { e["particles"] = 65535; });
  expect_refused("no list", [](Json& e, Json&) { e["runs"] = 3; });
  for (const char* name : {"frames", "low", "unit", "bound", "offset", "bytes", "times"})
    expect_refused(name, [&](Json&, Json& run) { run.erase(name); });
  for (const char* name : {"frames", "offset", "bytes"})
    for (const Json& value : {Json(-1), Json(1.5), Json("3"), Json(9'000'000'000'000'000'000), Json(0)})
      if (!(value == 0 && std::string(name) == "offset"))
        expect_refused(name, [&](Json&, Json& run) { run[name] = value; });
  expect_refused("two frames more", [](Json&, Json& run) { run["frames"] = run["frames"].get<int>() + 2; });
  expect_refused("bytes of the next", [](Json&, Json& run) { run["offset"] = 3; });
  expect_refused("unit", [](Json&, Json& run) { run["unit"] = 0; });
  expect_refused("low", [](Json&, Json& run) { run["low"] = {0, 0}; });
  expect_refused("times", [](Json&, Json& run) { run["times"] = {0, 1, 2}; });
  expect_refused("words for numbers", [](Json&, Json& run) { run["energy"] = Json::array({"a"}); });
  write_file(files_[0].file, "no gzip");
  EXPECT_NE(said([](Json&, Json&) {}), "accepted");
  std::filesystem::remove(files_[0].file);
  EXPECT_NE(said([](Json&, Json&) {}), "accepted");
}

TEST(Stage, HoldsSpringsPinsAndTimesOfItsScene) {
  const Scene scene = load_scene("chain");
  const JsonField stage = JsonField::parse(stage_json(scene, {scene.start.x}, std::nullopt), "stage");
  EXPECT_EQ(stage["times"].size(), 151u);
  EXPECT_EQ(stage["springs"]["families"][0]["count"].number(), scene.model.particles.size() - 1);
  EXPECT_TRUE(stage["floor"].is_null()) << "planar motions have no floor";
  const JsonField ends = stage["springs"]["ends"];
  const auto numbers =
      unpacked(bytes_of_base64(ends["data"].text()), ends["count"].natural(), ends["columns"].natural());
  ASSERT_EQ(numbers.size(), 2 * scene.model.find<Springs>()->list.size());
  EXPECT_EQ(numbers[0], scene.model.find<Springs>()->list[0].a);
  EXPECT_EQ(stage_json(scene, true).find("\"toml\"") != std::string::npos, true);
}

}  // namespace
}  // namespace crosscheck
