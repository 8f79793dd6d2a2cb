// What the page's player is given: packed numbers come back, places lie within the stated bound, unpacked runs are
// those of the experiment.

#include <gtest/gtest.h>

#include <random>

#include "experiments/observers.h"
#include "experiments/scenes/scenes.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/stability/map.h"
#include "mysim/base/json.h"
#include "mysim/model/energy.h"
#include "report/player/computed_runs.h"
#include "report/player/motions.h"
#include "report/player/packed_numbers.h"
#include "report/player/static_geometry.h"
#include "tests/unit/experiments/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/readers.h"

namespace crosscheck {
namespace {

using testing_tools::unpacked;

std::vector<std::uint16_t> numbers_of(const JsonField& p) {
  return unpacked(p["count"].natural(), p["lag"].natural(), p["order"].whole_number(0, 9), p["data"].text());
}

/// The list of a file's runs; that of cells is packed.
JsonField runs_of(const JsonField& file) {
  if (!file.find("packed")) return file["runs"];
  const std::string bytes = testing_tools::bytes_of_base64(file["packed"].text());
  size_t length = 0;  // the last four bytes of gzip
  for (size_t k = 0; k < 4; ++k) length |= size_t{static_cast<unsigned char>(bytes[bytes.size() - 4 + k])} << 8 * k;
  return JsonField::parse(testing_tools::gunzipped(bytes, length), "cells");
}

/// A file of runs as motions.h says that it is written, read back.
class ReadMotions {
 public:
  ReadMotions(const JsonField& file, int particles)
      : wide_(3 * particles),
        shapes_(numbers_of(file["shapes"])),
        paths_(numbers_of(file["paths"])),
        values_(numbers_of(file["values"])) {
    if (file.find("base")) base_ = read(file["base"], false), centre_ = file["base"]["centre"].numbers();
    for (const JsonField& run : runs_of(file).elements())
      runs_.push_back(run.is_null() ? Run{}
                                    : read(run, !run.find("times") || run.find("step") || run.find("tolerance")));
  }
  struct Run {
    Eigen::MatrixXd apart;  // a column for each frame
    std::vector<std::optional<double>> error, energy;
  };
  const Run& run(size_t i) const { return runs_.at(i); }
  /// Places of the base in a frame.
  Eigen::VectorXd base(Eigen::Index frame) const {
    Eigen::VectorXd x = base_.apart.col(std::min(frame, base_.apart.cols() - 1));
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] += centre_[static_cast<size_t>(i % 3)];
    return x;
  }
  bool all_read() const {
    return at_shape_ == shapes_.size() && at_path_ == paths_.size() && at_value_ == values_.size();
  }

 private:
  Run read(const JsonField& run, bool valued) {
    const size_t modes = run["modes"].natural(), frames = run["frames"].natural();
    Run out{Eigen::MatrixXd::Zero(wide_, static_cast<Eigen::Index>(frames)), {}, {}};
    for (size_t k = 0; k < modes; ++k)
      for (size_t f = 0; f < frames; ++f)
        for (Eigen::Index i = 0; i < wide_; ++i)
          out.apart(i, static_cast<Eigen::Index>(f)) +=
              run["unit"].number() * static_cast<std::int16_t>(shapes_.at(at_shape_ + k * wide_ + i)) *
              run["path"].number() * static_cast<std::int16_t>(paths_.at(at_path_ + k * frames + f));
    at_shape_ += modes * wide_, at_path_ += modes * frames;
    if (valued)
      for (auto* list : {&out.error, &out.energy})
        for (size_t f = 0; f < frames; ++f) {
          const int v = values_.at(at_value_++);
          list->push_back(v == 0 ? std::nullopt : std::optional(v == 1 ? 0. : std::pow(10, (v - 40000) / 2000.)));
        }
    return out;
  }
  Eigen::Index wide_;
  std::vector<std::uint16_t> shapes_, paths_, values_;
  size_t at_shape_ = 0, at_path_ = 0, at_value_ = 0;
  Run base_;
  std::vector<double> centre_;
  std::vector<Run> runs_;
};

TEST(PackedNumbers, AnyNumbersComeBack) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::uint16_t> numbers(random() % 3000);
    for (auto& n : numbers) n = static_cast<std::uint16_t>(random());
    for (const int order : {0, 1, 2}) {
      const size_t lag = 1 + random() % 40;
      const PackedNumbers p = pack(numbers, lag, order);
      EXPECT_EQ(unpacked(p.count, p.lag, p.order, p.data), numbers) << "seed " << seed << ", order " << order;
      EXPECT_EQ(unpack(p), numbers) << "seed " << seed << ", order " << order;
    }
  }
}

TEST(PackedNumbers, ClaimsThatTheDataDoNotHoldAreRefused) {
  const PackedNumbers good = pack(std::vector<std::uint16_t>(100, 7), 1, 1);
  EXPECT_EQ(unpack(good).size(), 100u);
  for (const size_t count : {size_t{101}, size_t{1} << 36, size_t{1} << 63}) {
    PackedNumbers bad = good;
    bad.count = count;
    EXPECT_ANY_THROW(unpack(bad)) << count;
  }
  PackedNumbers bad = good;
  bad.order = 2, bad.lag = (size_t{1} << 63) + 1;
  EXPECT_EQ(unpack(bad).size(), 100u);
}

TEST(PackedNumbers, EvenMotionTakesHardlyAnyRoom) {
  std::vector<std::uint16_t> numbers;
  for (int frame = 0; frame < 150; ++frame)
    for (int i = 0; i < 300; ++i) numbers.push_back(static_cast<std::uint16_t>(40 * i + 7 * frame));
  EXPECT_LT(pack(numbers, 300, 2).data.size(), 2000u);
}

TEST(PackedNumbers, TheSmallestWayIsTaken) {
  std::vector<std::uint16_t> numbers;
  for (int i = 0; i < 3000; ++i) numbers.push_back(static_cast<std::uint16_t>(i % 3 * 20000 + i / 3));
  const PackedNumbers small = pack_small(numbers);
  EXPECT_EQ(unpacked(small.count, small.lag, small.order, small.data), numbers);
  for (const size_t lag : {1, 3})
    for (const int order : {0, 1, 2}) EXPECT_LE(small.data.size(), pack(numbers, lag, order).data.size());
}

class Motions : public testing::Test {
 protected:
  void gather(const Scene& scene, const std::vector<std::string>& methods) {
    Request request;
    request.scenes = {scene};
    base_ = base_of(scene, run_of(request, scene));
    stage_ = JsonField::parse(stage_json(scene, base_), "player");
    for (const std::string& name : methods) {
      const MethodResult& r = result_of(request, scene, find_method(name), answers_);
      files_.push_back(
          JsonField::parse(motions_json({"engines", scene, name, {{r.outcome, r.trajectory}}}, base_), "player"));
    }
  }
  MotionBase base_;
  JsonField stage_ = JsonField::parse("{}", "none");
  std::vector<JsonField> files_;
  MethodResults answers_;
};

TEST_F(Motions, PlacesErrorsAndEnergiesOfTheChainAreThoseOfItsRunInEachFrame) {
  const Scene scene = load_scene("chain");
  gather(scene, {"mysim/leapfrog", "mysim/symplectic-euler", "bullet/deformable-explicit"});
  ASSERT_EQ(stage_["times"].size(), 151u);
  EXPECT_EQ(stage_["springs"]["families"][0]["count"].number(), scene.model.particles.size() - 1);
  EXPECT_TRUE(stage_["floor"].is_null()) << "all lies in a plane";
  ASSERT_TRUE(base_.known);
  const int n = scene.model.particles.size(), stride = frame_stride(scene);
  const ReadMotions known(stage_["known"], n);
  EXPECT_TRUE(known.all_read());
  EXPECT_EQ(known.run(0).apart.cwiseAbs().maxCoeff(), 0) << "the truth is the base";
  for (size_t m = 0; m < files_.size(); ++m) {
    const JsonField run = files_[m]["runs"][0];
    const ReadMotions read(files_[m], n);
    EXPECT_TRUE(read.all_read());
    const int every = run["every"].whole_number(1, 100);
    double largest = 0, worst = 0;
    for (Eigen::Index f = 0; f < read.run(0).apart.cols(); ++f) {
      const auto sample = static_cast<size_t>(f * every * stride);
      const Points &x = answers_[m].trajectory.x[sample], &truth = base_.truth->trajectory.x[sample];
      const Eigen::VectorXd off = (x - truth).reshaped();
      largest = std::max(largest, off.cwiseAbs().maxCoeff());
      worst = std::max(worst, (read.run(0).apart.col(f) - off).cwiseAbs().maxCoeff());
      EXPECT_LT((known.base(f * every) - truth.reshaped()).cwiseAbs().maxCoeff(), scene.size() / 2000);
      const auto at = static_cast<size_t>(f);
      if (read.run(0).error[at])
        EXPECT_NEAR(*read.run(0).error[at], rms_distance(x, truth), 2e-3 * rms_distance(x, truth));
      else
        EXPECT_TRUE(scene.window < answers_[m].trajectory.t[sample] || rms_distance(x, truth) == 0);
      const double kinetic = energy_of(scene.model, {0, x, answers_[m].trajectory.v[sample]}).kinetic;
      EXPECT_NEAR(read.run(0).energy[at].value(), kinetic, 2e-3 * kinetic);
    }
    EXPECT_GT(largest, 0);
    EXPECT_LT(worst, 0.04 * largest) << files_[m]["name"].text() << ": told to a sixtieth of what it departs by";
    if (m == 2) {
      EXPECT_LT((read.run(0).apart - ReadMotions(files_[1], n).run(0).apart).cwiseAbs().maxCoeff(), 1e-9 * largest)
          << "the same rule is the same motion";
    }
  }
}

TEST_F(Motions, ARunThatBlewUpEndsNearTheOthersAndSaysWhenAndWhy) {
  const Scene scene = load_scene("chain");
  gather(scene, {"mysim/explicit-euler"});
  const JsonField failed = files_[0]["runs"][0];
  EXPECT_LT(failed["frames"].number(), 76);
  EXPECT_NE(failed["failure"].text().find(" s"), std::string::npos) << failed["failure"].text();
  EXPECT_EQ(failed["reason"].text(), "ten times too fast");
  EXPECT_LE(failed["stops"].number(), failed["failed"].number());
  EXPECT_LT(ReadMotions(files_[0], scene.model.particles.size()).run(0).apart.cwiseAbs().maxCoeff(), 20)
      << "m: within sight";
}

TEST_F(Motions, DistancesFromATruthThatEndsEarlyEndWithIt) {
  const Scene scene = load_scene("cloth-sphere");
  gather(scene, {"mysim/leapfrog"});
  ASSERT_TRUE(base_.truth);
  ASSERT_NEAR(base_.truth->until, scene.window, 1e-9);
  EXPECT_FALSE(base_.known) << "the base goes on to the end";
  EXPECT_NEAR(base_.t.back(), scene.duration, 1e-9);
  EXPECT_FALSE(stage_["truth"]["rule"].boolean());
  const int n = scene.model.particles.size();
  const ReadMotions known(stage_["known"], n), run(files_[0], n);
  EXPECT_TRUE(known.all_read());
  EXPECT_LT(known.run(0).apart.cols(), static_cast<Eigen::Index>(stage_["times"].size()));
  EXPECT_TRUE(run.run(0).error[1]);
  EXPECT_FALSE(run.run(0).error.back());
  EXPECT_EQ(static_cast<double>(run.run(0).apart.cols() - 1) * files_[0]["runs"][0]["every"].number() + 1,
            static_cast<double>(stage_["times"].size()))
      << "to the end";
}

TEST_F(Motions, OfAnOutsideProgramAreToldAsAnyOthers) {
  const Scene scene = load_scene("chain");
  gather(scene, {"mysim/rk4"});
  const std::string name = "exec:/tools/my engine";
  const std::string text =
      motions_json({"engines", scene, name, {{answers_[0].outcome, answers_[0].trajectory}}}, base_);
  const JsonField file = JsonField::parse(text, "player");
  EXPECT_EQ(file["name"].text(), name);
  EXPECT_EQ(file["shapes"].dump(), files_[0]["shapes"].dump());
}

double shortest_of(const Scene& scene) {
  double shortest = INFINITY;
  for (const Spring& s : scene.model.find<Springs>()->list) shortest = std::min(shortest, 1.2 * s.rest);
  return shortest;
}

std::string all_rows(const TableSet& rows) {
  std::string all;
  for (const Table& t : rows.tables)
    for (const auto& row : t.rows) all += t.name + ": " + csv_row(row) + "\n";
  return all;
}

/// MonitoredObservers runs outlive the driver that made them.
struct Kept {
  std::string of, method;
  Scene scene;
  std::vector<RecordedRun> runs;
  RecordedRuns watched() const { return {of, scene, method, runs}; }
};
RunCallback keeping(std::vector<Kept>& kept) {
  return [&kept](const RecordedRuns& w) { kept.push_back({w.of, w.method, w.scene, w.runs}); };
}

TEST(LastFrames, AreAtLeastEightToAPeriodOrEveryStep) {
  const double omega = 2 * M_PI;  // a period of 1 s
  for (const double h : {1e-3, 0.03, 0.2, 0.9}) {
    LastFrames last(omega, h);
    for (int i = 0; i <= 10000; ++i) last.observe({h * i, Points::Constant(3, 1, i), Points::Zero(3, 1)}, false);
    const Trajectory path = last.path();
    ASSERT_EQ(path.frames(), 25);
    for (int f = 1; f < 25; ++f) EXPECT_LE(path.t[f] - path.t[f - 1], std::max(h, 1 / 8. + h / 2) * (1 + 1e-9)) << h;
    EXPECT_GT(path.t.back(), 10000 * h - std::max(h, 1 / 8. + h)) << "they are the last ones, h " << h;
  }
}

TEST(LastFrames, OfAShortRunAreAllOfItAsFarAsItIsFinite) {
  LastFrames last(0, 1e-3);
  for (int i = 0; i < 5; ++i) last.observe({1e-3 * i, Points::Zero(3, 2), Points::Zero(3, 2)}, false);
  last.observe({5e-3, Points::Constant(3, 2, NAN), Points::Zero(3, 2)}, false);
  EXPECT_EQ(last.path().frames(), 5);
}

/// Each of the methods hands over its runs, and the rows are as without a watch. Counts the runs that failed.
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
      EXPECT_GT(run.path.frames(), 0) << k.method << ": also of what failed there is something to be seen";
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

/// Some of which hold and some of which fail.
void expect_departures(const Scene& scene) {
  for (const MapKind& kind : map_kinds()) {
    std::vector<Kept> kept;
    TableSet rows, unwatched;
    const MapSize size{3, 6, 300, false};
    add_map(kind, scene, find_method("mysim/leapfrog"), size, rows, keeping(kept));
    add_map(kind, scene, find_method("mysim/leapfrog"), size, unwatched);
    EXPECT_EQ(all_rows(rows), all_rows(unwatched));
    ASSERT_EQ(kept.size(), 1u);
    ASSERT_EQ(kept[0].runs.size(), 18u) << "as many as the table has rows";
    const JsonField data = JsonField::parse(motions_json(kept[0].watched(), {}), "player");
    const ReadMotions read(data, scene.model.particles.size());
    EXPECT_TRUE(read.all_read());
    const JsonField cells = runs_of(data);
    const JsonField without = JsonField::parse(cells_for_page(data.dump(), false), "no lab"),
                    with = JsonField::parse(cells_for_page(data.dump(), true), "a lab"), shown = runs_of(with);
    EXPECT_EQ(runs_of(without).dump(), cells.dump());
    EXPECT_FALSE(without.find("starts"));
    EXPECT_TRUE(ReadMotions(with, scene.model.particles.size()).all_read());
    for (size_t c = 0; c < 18; ++c) {
      ASSERT_EQ(shown[c].is_null(), cells[c].is_null());
      if (cells[c].is_null()) continue;
      for (const char* key : {"frames", "at", "times"}) EXPECT_EQ(shown[c][key].dump(), cells[c][key].dump());
      if (shown[c].find("computed")) {
        EXPECT_EQ(shown[c]["modes"].natural(), 0u);
      }
    }
    int failed = 0;
    for (size_t c = 0; c < 18; ++c) {
      const JsonField cell = cells[c];
      const RecordedRun& run = kept[0].runs[c];
      failed += run.outcome.verdict != Verdict::ok;
      if (cell.is_null()) continue;
      const size_t frames = cell["frames"].natural();
      EXPECT_NEAR(cell["times"][1].number(), run.path.t[frames - 1], 1e-3 * run.path.t[frames - 1]);
      // pictures that are not the last ones do not pass for them: then the end of the run is told beside theirs
      const bool left = frames < static_cast<size_t>(run.path.frames());
      EXPECT_EQ(cell.find("left").has_value(), left);
      if (left) {
        EXPECT_NEAR(cell["left"].number(), run.outcome.end, 1e-3 * run.outcome.end);
      }
      EXPECT_LT((read.base(static_cast<Eigen::Index>(cell["at"].natural())) - run.cell->rest.reshaped())
                    .cwiseAbs()
                    .maxCoeff(),
                scene.size() / 2000);
      double largest = 0, worst = 0;
      for (size_t f = 0; f < frames; ++f) {
        const Eigen::VectorXd off = (run.path.x[f] - run.cell->rest).reshaped();
        largest = std::max(largest, off.cwiseAbs().maxCoeff());
        worst = std::max(worst, (read.run(c).apart.col(static_cast<Eigen::Index>(f)) - off).cwiseAbs().maxCoeff());
      }
      EXPECT_LT(worst, 0.04 * largest) << "cell " << c;
      if (cell.find("larger")) {
        EXPECT_LE(cell["larger"].number() * largest, 0.36 * shortest_of(scene)) << "drawn larger, still small";
      }
    }
    EXPECT_GT(failed, 0);
    EXPECT_LT(failed, 18);
  }
}
TEST(Cells, AreTheirDeparturesFromRestWithinAHundredthOfTheLargest) {
  for (const char* name : {"spring", "normal-modes", "cloth-hang"}) {
    SCOPED_TRACE(name);
    expect_departures(*map_scene(load_scene(name), false));
  }
}

/// Strong drag at a long step leaves departures that no double but a denormal one holds.
TEST(Cells, AMotionThatDragHasTakenIsTold) {
  std::vector<Kept> kept;
  TableSet rows;
  add_map(map_kinds()[0], *map_scene(load_scene("spring"), false), find_method("mysim/leapfrog"), {3, 6, 300, false},
          rows, keeping(kept));
  for (RecordedRun& run : kept.at(0).runs) {
    run.cell->rest.setZero();
    for (Points& x : run.path.x) x.setZero(), x(0, 0) = 1e-310;
  }
  EXPECT_NO_THROW(motions_json(kept[0].watched(), {}));
}

TEST(Runs, AreThePlacesOfTheirRunsInTheOrderOfTheRows) {
  Request request;
  request.scenes = {load_scene("chain")};
  request.methods = find_methods("mysim/leapfrog,mysim/explicit-euler,bullet/pbd,mysim/dopri5");
  const Scene& scene = request.scenes[0];
  TableSet unwatched, rows;
  speed_accuracy_on(request, scene, unwatched);
  std::vector<Kept> kept;
  request.on_runs = keeping(kept);
  speed_accuracy_on(request, scene, rows);
  EXPECT_EQ(all_rows(rows), all_rows(unwatched));
  ASSERT_EQ(kept.size(), 4u);
  const MotionBase base = base_of(scene, run_of(request, scene));
  const int stride = frame_stride(scene);
  size_t row = 0, whole = 0, failed = 0;
  const Table& table = *rows.table("speed-accuracy");
  for (const Kept& k : kept) {
    const JsonField data = JsonField::parse(motions_json(k.watched(), base), "player");
    EXPECT_EQ(data["name"].text(), k.method);
    const ReadMotions read(data, scene.model.particles.size());
    EXPECT_TRUE(read.all_read());
    for (size_t r = 0; r < k.runs.size(); ++r, ++row) {
      ASSERT_EQ(std::get<std::string>(table.at(row, "method")), k.method) << "in the order of the rows";
      const JsonField run = data["runs"][r];
      const Trajectory& path = k.runs[r].path;
      EXPECT_EQ(std::get<std::string>(table.at(row, "verdict")), name_of(k.runs[r].outcome.verdict));
      if (run.is_null()) continue;
      const bool pictures = run.find("times").has_value();
      double worst = 0, largest = 0;
      for (size_t f = 0; f < run["frames"].natural(); ++f) {
        const size_t sample = pictures ? f : f * run["every"].natural() * static_cast<size_t>(stride);
        const Points& from = pictures ? base.x[0] : base.truth->trajectory.x[sample];
        const Eigen::VectorXd off = (path.x[sample] - from).reshaped();
        largest = std::max(largest, off.cwiseAbs().maxCoeff());
        worst = std::max(worst, (read.run(r).apart.col(static_cast<Eigen::Index>(f)) - off).cwiseAbs().maxCoeff());
      }
      EXPECT_LE(worst, 0.06 * largest + base.truth->error_bar);
      if (pictures) {
        EXPECT_NEAR(run["times"].numbers().back(), k.runs[r].outcome.end, 0.5) << "they are the last ones";
        ++failed;
      } else {
        ++whole;
      }
    }
  }
  EXPECT_EQ(row, table.rows.size());
  EXPECT_GT(whole, 10u);
  EXPECT_GT(failed, 2u);
}

TEST(ComputedRuns, AreThoseOfRulesThatABrowserHas) {
  for (const char* name : {"mysim/leapfrog", "mysim/rk4+sticky", "mysim/implicit-euler+linear", "mysim/dopri5"})
    EXPECT_TRUE(is_computed_in_page(name)) << name;
  for (const char* name : {"mysim/leapfrog+fast", "mysim/leapfrog+linear", "mysim/leapfrog+threads=2", "bullet/pbd",
                           "exec:/a/program", "truth", "mysim/nothing"})
    EXPECT_FALSE(is_computed_in_page(name)) << name;
}

TEST(ComputedRuns, KeepTheirWordsAndValuesAndLeaveTheirMotionsOut) {
  Request request;
  request.scenes = {load_scene("chain")};
  request.methods = find_methods("mysim/leapfrog,mysim/explicit-euler,mysim/rk4,bullet/pbd");
  const Scene& scene = request.scenes[0];
  std::vector<Kept> kept;
  request.on_runs = keeping(kept);
  TableSet rows;
  speed_accuracy_on(request, scene, rows);
  const MotionBase base = base_of(scene, run_of(request, scene));
  std::vector<std::string> before, after;
  for (const Kept& k : kept) before.push_back(motions_json(k.watched(), base));
  after = before;
  std::vector<FileOfRuns> files;
  for (std::string& json : after) files.push_back({false, &json});
  leave_out_computed(files, {"mysim/leapfrog 5"});
  size_t references = 0, computed = 0, failed = 0;
  for (size_t i = 0; i < after.size(); ++i) {
    const JsonField was = JsonField::parse(before[i], "before"), now = JsonField::parse(after[i], "after");
    if (now["name"].text() == "bullet/pbd") {
      EXPECT_EQ(after[i], before[i]) << "of another engine all is stored";
      continue;
    }
    EXPECT_EQ(now["values"].dump(), was["values"].dump());
    const int particles = scene.model.particles.size();
    const ReadMotions old(was, particles), left(now, particles);
    EXPECT_TRUE(left.all_read());
    for (size_t r = 0; r < was["runs"].size(); ++r) {
      const JsonField run = now["runs"][r];
      if (run.is_null()) continue;
      for (const char* key : {"frames", "stops", "step"}) EXPECT_EQ(run[key].dump(), was["runs"][r][key].dump());
      references += run.find("reference").has_value(), failed += run.find("times").has_value();
      if (run.find("computed")) {
        ++computed;
        EXPECT_EQ(run["modes"].natural(), 0u);
        EXPECT_FALSE(run.find("failure"));
        EXPECT_NE(fmt::format("{} {}", now["name"].text(), r), "mysim/leapfrog 5") << "it stays";
      } else {
        EXPECT_EQ(left.run(r).apart, old.run(r).apart);
      }
    }
  }
  EXPECT_EQ(references, 1u);
  EXPECT_GT(computed, 10u);
  EXPECT_GT(failed, 2u) << "the last pictures of what failed stay";
}

TEST(ComputedRuns, AreStoredWhereNoneTiesThemToTheBase) {
  std::string file =
      R"({"name": "mysim/leapfrog", "runs": [null], "shapes": {"count": 0, "lag": 1, "order": 0, "data": ""},
    "paths": {"count": 0, "lag": 1, "order": 0, "data": ""}, "values": null})";
  const std::string before = file;
  const FileOfRuns files[] = {{true, &file}};
  leave_out_computed(files, {});
  EXPECT_EQ(file, before);
}

TEST(ComputedRuns, OfAFileThatClaimsMoreNumbersThanItHasAreRefused) {
  const auto file_of = [](const std::string& modes, const std::string& frames) {
    const std::string six = dump(packed_json(pack_small({1, 2, 3, 4, 5, 6})));
    return fmt::format(R"({{"name": "mysim/leapfrog", "runs": [{{"modes": {}, "frames": {}, "unit": 1, "path": 1}}],
    "shapes": {}, "paths": {}, "values": null}})",
                       modes, frames, six, six);
  };
  const auto left_out = [](std::string file) {
    const FileOfRuns files[] = {{true, &file}};
    leave_out_computed(files, {});
  };
  for (const auto& [modes, frames] : {std::pair("1", "6"), {"2", "3"}, {"6", "1"}, {"0", "9000000000"}})
    EXPECT_NO_THROW(left_out(file_of(modes, frames))) << modes << " " << frames;
  for (const auto& [modes, frames] : {std::pair("1", "7"),
                                      {"1", "3000000"},
                                      {"2", "4"},
                                      {"7", "0"},
                                      {"9000000000000000000", "3"},
                                      {"18446744073709551615", "18446744073709551615"}})
    EXPECT_THROW(left_out(file_of(modes, frames)), InputError) << modes << " " << frames;
}

TEST(Runs, AsGoodAsTheTruthWeighNextToNothing) {
  Request request;
  request.scenes = {testing_tools::with_grid("cloth-hang", 8)};
  request.methods = find_methods("mysim/rk4");
  std::vector<Kept> kept;
  request.on_runs = keeping(kept);
  TableSet rows;
  speed_accuracy_on(request, request.scenes[0], rows);
  MotionBase base = base_of(request.scenes[0], run_of(request, request.scenes[0]));
  Kept& runs = kept.at(0);
  runs.runs = {{runs.runs.back().outcome, base.truth->trajectory}};
  EXPECT_LT(motions_json(runs.watched(), base).size(), 900u);
}

TEST(Runs, OfASceneWithoutTruthAreToldAgainstItsOwnMethod) {
  Scene scene = load_scene("chain");
  Recorder recorder;
  const Outcome out = run_method(find_method("mysim/rk4"), scene, default_run(scene), {&recorder});
  MotionBase base = base_of(scene, default_run(scene));
  base.truth.reset();
  const Kept kept{"speed-accuracy", "mysim/rk4", scene, {{out, recorder.trajectory}}};
  const JsonField data = JsonField::parse(motions_json(kept.watched(), base), "player");
  EXPECT_EQ(data["runs"].size(), 1u);
  EXPECT_FALSE(ReadMotions(data, scene.model.particles.size()).run(0).error[3]) << "no error without a truth";
}

}  // namespace
}  // namespace crosscheck
