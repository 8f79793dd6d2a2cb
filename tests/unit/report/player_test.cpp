// What the page's player is given: packed numbers come back, places lie within the stated bound, unpacked runs are
// those of the experiment.

#include <gtest/gtest.h>

#include <random>

#include "experiments/observers.h"
#include "experiments/scenes/scenes.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/stability/map.h"
#include "mysim/base/json.h"
#include "report/player/packed_numbers.h"
#include "report/player/player_data.h"
#include "report/player/run_motions.h"
#include "report/player/thinned_trajectory.h"
#include "tests/unit/experiments/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/readers.h"

namespace crosscheck {
namespace {

using testing_tools::unpacked;

std::vector<std::uint16_t> numbers_of(const JsonField& p) {
  return unpacked(p["count"].natural(), p["lag"].natural(), p["order"].whole_number(0, 9), p["data"].text());
}

/// A number of a lattice, which wrapped at 2^16.
int lattice_number(std::uint16_t n) { return n < 65536 - 24576 ? n : n - 65536; }

TEST(PackedNumbers, AnyNumbersComeBack) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::uint16_t> numbers(random() % 3000);
    for (auto& n : numbers) n = static_cast<std::uint16_t>(random());
    for (const int order : {0, 1, 2}) {
      const size_t lag = 1 + random() % 40;
      const PackedNumbers p = pack(numbers, lag, order);
      EXPECT_EQ(unpacked(p.count, p.lag, p.order, p.data), numbers) << "seed " << seed << ", order " << order;
    }
  }
}

TEST(PackedNumbers, EvenMotionTakesHardlyAnyRoom) {
  std::vector<std::uint16_t> numbers;
  for (int frame = 0; frame < 150; ++frame)
    for (int i = 0; i < 300; ++i) numbers.push_back(static_cast<std::uint16_t>(40 * i + 7 * frame));
  EXPECT_LT(pack(numbers, 300, 2).data.size(), 2000u);
}

TEST(QuantisedPositions, NoneIsFurtherFromItsNumberThanTheBound) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(-1, 1);
    // boxes of millimetres to a hundred metres, also far from the origin, also flat
    const double size = std::pow(10, 3.5 * part(random) - 0.5);
    const Vec3 middle = 50 * part(random) * Vec3(part(random), part(random), part(random));
    std::vector<Points> frames(7, Points(3, 40));
    for (Points& x : frames) {
      for (double& c : x.reshaped()) c = size * part(random);
      x.colwise() += middle;
      if (seed % 4 == 0) x.row(2).setConstant(0.25);
    }
    const QuantisedPositions q = quantise(frames);
    // a unit is the 16383rd part of the box, whose edges are 2 `size` at most
    EXPECT_LE(q.bound, std::sqrt(3) / 2 * 2 * size / 16383 + 1e-9);
    double worst = 0;
    size_t at = 0;
    for (const Points& x : frames)
      for (Eigen::Index i = 0; i < x.cols(); ++i, at += 3) {
        Vec3 drawn = q.low;
        for (int k = 0; k < 3; ++k) drawn[k] += q.unit[k] * q.numbers[at + k];
        worst = std::max(worst, (drawn - x.col(i)).norm());
      }
    EXPECT_LE(worst, q.bound) << "seed " << seed;
    EXPECT_GT(worst, q.bound / 3) << "the bound is no larger than it has to be, seed " << seed;
  }
}

TEST(SharedLattice, TellsPlacesAroundItsBoxApartAndRefusesThoseBeyond) {
  Points around = Points::Zero(3, 2);
  around.col(1) << 2, 1, 0;  // m: the longest side is 2
  const Lattice lattice = lattice_around(std::span(&around, 1));
  EXPECT_DOUBLE_EQ(lattice.unit, 2. / 16383);
  for (const double x : {-2.99, -1., 0., 1.7, 4.99}) {
    const auto numbers = lattice.numbers_of(std::vector<Points>{Points::Constant(3, 1, x)});
    ASSERT_TRUE(numbers) << x;
    EXPECT_NEAR(lattice.unit * lattice_number((*numbers)[0]), x, lattice.unit / 2 + 1e-12);
  }
  for (const double x : {-3.01, 5.01, 1e300, double(NAN)})
    EXPECT_FALSE(lattice.numbers_of(std::vector<Points>{Points::Constant(3, 1, x)})) << x;
}

TEST(SharedLattice, OfASinglePlaceIsOneToo) {
  const Lattice lattice = lattice_around(std::vector<Points>{Points::Constant(3, 1, 0.5)});
  EXPECT_GT(lattice.unit, 0);
  EXPECT_TRUE(lattice.numbers_of(std::vector<Points>{Points::Constant(3, 1, 0.5)}));
}

class PlayerData : public testing::Test {
 protected:
  JsonField data_of(const Scene& scene, const std::vector<std::string>& methods) {
    Request request;
    request.scenes = {scene};
    std::vector<const Result*> shown;
    for (const std::string& name : methods) shown.push_back(&result_of(request, scene, find_method(name), answers_));
    return JsonField::parse(player_json(scene, shown, truth_of(scene, run_of(request, scene))), "player");
  }
  Results answers_;
};

TEST_F(PlayerData, PlacesOfTheChainAreThoseOfItsRunInEachFrame) {
  const Scene scene = load_scene("chain");
  const JsonField data = data_of(scene, {"mysim/leapfrog", "mysim/rk4"});
  ASSERT_EQ(data["times"].size(), 151u);
  ASSERT_EQ(data["methods"].size(), 3u) << "two methods and the truth";
  const JsonField method = data["methods"][0];
  const auto numbers = numbers_of(method["places"]);
  const int n = scene.model.particles.size();
  ASSERT_EQ(numbers.size(), 151u * 3 * n);
  EXPECT_FALSE(method.find("over").has_value());
  const double bound = data["finest"].number();
  for (int f = 0; f < 151; ++f)
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(
            method["low"][k].number() + method["unit"][k].number() * lattice_number(numbers[3 * (f * n + i) + k]),
            answers_[0].trajectory.x[f](k, i), bound);
  EXPECT_EQ(data["springs"]["families"][0]["count"].number(), n - 1);
  EXPECT_TRUE(data["floor"].is_null()) << "all lies in a plane";
}

TEST_F(PlayerData, TheSameMotionTwiceTakesItsRoomOnce) {
  const Scene scene = load_scene("chain");
  const JsonField data = data_of(scene, {"mysim/symplectic-euler", "bullet/deformable-explicit"});
  const JsonField ours = data["methods"][0], theirs = data["methods"][1];
  ASSERT_EQ(theirs["over"].number(), 0);
  EXPECT_LT(theirs["places"]["data"].text().size(), 100u);
  // what is left of a motion that is not quite the same comes back
  const JsonField truth = data["methods"][2];
  const auto first = numbers_of(ours["places"]), own = numbers_of(truth["places"]);
  const auto path = truth_of(scene, run_of({{scene}}, scene))->trajectory;
  const auto n = static_cast<size_t>(3 * scene.model.particles.size());
  for (size_t i = 0; i < own.size(); ++i) {
    const auto number = static_cast<std::uint16_t>(own[i] + (truth.find("over").has_value() ? first[i] : 0));
    EXPECT_NEAR(truth["low"][i % 3].number() + truth["unit"][i % 3].number() * lattice_number(number),
                path.x[i / n].reshaped()[static_cast<Eigen::Index>(i % n)], data["finest"].number());
  }
}

TEST_F(PlayerData, ARunThatBlewUpEndsNearTheOthersAndSaysWhenAndWhy) {
  const Scene scene = load_scene("chain");
  const JsonField data = data_of(scene, {"mysim/leapfrog", "mysim/explicit-euler"});
  const JsonField failed = data["methods"][1];
  EXPECT_LT(failed["frames"].number(), 151);
  EXPECT_NE(failed["failure"].text().find(" s"), std::string::npos) << failed["failure"].text();
  EXPECT_EQ(failed["reason"].text(), "ten times too fast");
  EXPECT_LE(failed["stops"].number(), failed["failed"].number());
  for (int k = 0; k < 3; ++k) EXPECT_LT(failed["unit"][k].number() * 16383, 20) << "m: within sight";
  EXPECT_EQ(data["methods"][0]["failure"].text(), "");
}

TEST_F(PlayerData, DistancesFromTheContactRuleAreDifferencesAndEndWithIt) {
  const Scene scene = load_scene("cloth-sphere");
  const JsonField data = data_of(scene, {"mysim/symplectic-euler"});
  ASSERT_TRUE(data["distance"].is_object());
  EXPECT_EQ(data["distance"]["name"].text(), "difference from the converged contact rule");
  const JsonField distance = data["methods"][0]["distance"];
  const double frames = distance["count"].number() / scene.model.particles.size();
  EXPECT_LE((frames - 1) * scene.duration / scene.samples, scene.window + 1e-9);
  const auto levels = numbers_of(distance);
  EXPECT_LE(*std::max_element(levels.begin(), levels.end()), 63);
}

double shortest_of(const Scene& scene) {
  double shortest = INFINITY;
  for (const Spring& s : scene.model.find<Springs>()->list) shortest = std::min(shortest, 1.2 * s.rest);
  return shortest;
}

std::string all_rows(const Rows& rows) {
  std::string all;
  for (const Table& t : rows.tables)
    for (const auto& row : t.rows) all += t.name + ": " + csv_row(row) + "\n";
  return all;
}

/// MonitoredObservers runs outlive the driver that made them.
struct Kept {
  std::string of, method;
  Scene scene;
  std::vector<WatchedRun> runs;
  WatchedRuns watched() const { return {of, scene, method, runs}; }
};
RunCallback keeping(std::vector<Kept>& kept) {
  return [&kept](const WatchedRuns& w) { kept.push_back({w.of, w.method, w.scene, w.runs}); };
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
  Rows rows, unwatched;
  speed_accuracy_on(request, scene, unwatched);
  request.watch = keeping(kept);
  speed_accuracy_on(request, scene, rows);
  EXPECT_EQ(all_rows(rows), all_rows(unwatched));
  EXPECT_EQ(kept.size(), request.methods.size());
  for (const Kept& k : kept)
    for (const WatchedRun& run : k.runs) {
      failed += run.outcome.verdict != Verdict::ok;
      EXPECT_GT(run.path.frames(), 0) << k.method << ": also of what failed there is something to be seen";
    }
}

TEST(WatchedRuns, ChangeNoRow) {
  int failed = 0;
  expect_watching_changes_no_row("leapfrog,explicit-euler,dopri5,implicit-euler,odeint/dopri5,bullet/pbd", failed);
  EXPECT_GT(failed, 0);
  for (const char* method : {"explicit-euler", "bullet/pbd", "bullet/deformable-explicit"}) {
    SCOPED_TRACE(method);
    std::vector<Kept> kept;
    Rows map, unwatched_map;
    add_map(map_kinds()[0], load_scene("spring"), find_method(method), {3, 6, 300, false}, map, keeping(kept));
    add_map(map_kinds()[0], load_scene("spring"), find_method(method), {3, 6, 300, false}, unwatched_map);
    EXPECT_EQ(all_rows(map), all_rows(unwatched_map));
  }
}

TEST(WatchedRuns, OfSundialsChangeNoRow) {
  NEEDS_SUNDIALS;
  int failed = 0;
  expect_watching_changes_no_row("sundials/arkode", failed);
}

/// Some of which hold and some of which fail.
void expect_departures(const Scene& scene) {
  for (const MapKind& kind : map_kinds()) {
    std::vector<Kept> kept;
    Rows rows, unwatched;
    const MapSize size{3, 6, 300, false};
    add_map(kind, scene, find_method("mysim/leapfrog"), size, rows, keeping(kept));
    add_map(kind, scene, find_method("mysim/leapfrog"), size, unwatched);
    EXPECT_EQ(all_rows(rows), all_rows(unwatched));
    ASSERT_EQ(kept.size(), 1u);
    ASSERT_EQ(kept[0].runs.size(), 18u) << "as many as the table has rows";
    const JsonField data = JsonField::parse(cell_motions_json(kept[0].watched()), "player");
    const auto rests = numbers_of(data["rests"]), shapes = numbers_of(data["shapes"]),
               paths = numbers_of(data["paths"]);
    const auto wide = static_cast<size_t>(3 * scene.model.particles.size());
    size_t shape = 0, path = 0;
    int failed = 0;
    for (size_t c = 0; c < 18; ++c) {
      const JsonField cell = data["cells"][c];
      const WatchedRun& run = kept[0].runs[c];
      failed += run.outcome.verdict != Verdict::ok;
      if (cell.is_null()) continue;
      const size_t row = cell[0].natural(), frames = cell[1].natural(), modes = cell[5].size();
      EXPECT_NEAR(cell[3].number(), run.path.t[frames - 1], 1e-3 * run.path.t[frames - 1]);
      // pictures that are not the last ones do not pass for them: then the end of the run is told beside theirs
      const bool left = frames < static_cast<size_t>(run.path.frames());
      EXPECT_NEAR(cell[6].number(), left ? run.outcome.end : 0, 1e-3 * run.outcome.end);
      double largest = 0, worst = 0;
      for (size_t f = 0; f < frames; ++f)
        for (size_t i = 0; i < wide; ++i) {
          double told = 0;
          for (size_t k = 0; k < modes; ++k)
            told += cell[5][k].number() * static_cast<std::int16_t>(shapes[shape + k * wide + i]) *
                    static_cast<std::int16_t>(paths[path + k * frames + f]);
          const double rest = run.rest.reshaped()[static_cast<Eigen::Index>(i)];
          const double off = run.path.x[f].reshaped()[static_cast<Eigen::Index>(i)] - rest;
          largest = std::max(largest, std::abs(off)), worst = std::max(worst, std::abs(told - off));
          EXPECT_NEAR(data["low"][i % 3].number() + data["unit"][i % 3].number() * rests[row * wide + i], rest,
                      data["unit"][i % 3].number());
        }
      // a hundredth is left out; a shape has 127 steps: each adds half of one of them, of at most the largest
      EXPECT_LT(worst, (0.01 + 0.5 / 127 * static_cast<double>(modes) + 1e-3) * largest) << "cell " << c;
      if (cell[4].number() > 1) {
        EXPECT_LE(cell[4].number() * largest, 0.36 * shortest_of(scene)) << "drawn larger, still small";
      }
      shape += modes * wide, path += modes * frames;
    }
    EXPECT_EQ(shape, shapes.size());
    EXPECT_EQ(path, paths.size());
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

TEST(Runs, AreThePlacesOfTheTruthWithWhatTheyAreApart) {
  Request request;
  request.scenes = {load_scene("chain")};
  request.methods = find_methods("mysim/leapfrog,mysim/explicit-euler,bullet/pbd,mysim/dopri5");
  const Scene& scene = request.scenes[0];
  Rows unwatched, rows;
  speed_accuracy_on(request, scene, unwatched);
  std::vector<Kept> kept;
  request.watch = keeping(kept);
  speed_accuracy_on(request, scene, rows);
  EXPECT_EQ(all_rows(rows), all_rows(unwatched));
  ASSERT_EQ(kept.size(), 4u);
  const auto truth = truth_of(scene, run_of(request, scene));
  const int stride = frame_stride(scene);
  const Lattice lattice = lattice_of({thin(*truth, stride)});
  size_t row = 0, whole = 0, failed = 0;
  const Table& table = *rows.table("speed-accuracy");
  for (const Kept& k : kept) {
    const JsonField data = JsonField::parse(run_motions_json(k.watched(), truth), "player");
    EXPECT_EQ(data["name"].text(), k.method);
    const int every = data["every"].whole_number(1, 1000000), grain = data["grain"].whole_number(1, 1000000);
    for (size_t r = 0; r < k.runs.size(); ++r, ++row) {
      ASSERT_EQ(std::get<std::string>(table.at(row, "method")), k.method) << "in the order of the rows";
      const JsonField run = data["runs"][r];
      const Trajectory& path = k.runs[r].path;
      EXPECT_EQ(std::get<std::string>(table.at(row, "verdict")), name_of(k.runs[r].outcome.verdict));
      if (run.is_null()) continue;
      const auto numbers = numbers_of(run["places"]);
      const auto n = path.x[0].cols();
      double worst = 0;
      for (size_t f = 0; f < run["frames"].natural(); ++f)
        for (Eigen::Index i = 0; i < 3 * n; ++i) {
          const auto number = numbers[f * static_cast<size_t>(3 * n) + static_cast<size_t>(i)];
          const auto axis = static_cast<size_t>(i % 3);
          double drawn, is;
          if (run.find("times")) {
            drawn = run["low"][axis].number() + run["unit"][axis].number() * number;
            is = path.x[f].reshaped()[i];
          } else {
            const size_t sample = f * static_cast<size_t>(every * stride);
            const double known =
                std::round((truth->trajectory.x[sample].reshaped()[i] - lattice.low[i % 3]) / lattice.unit);
            drawn = lattice.low[i % 3] + lattice.unit * (known + grain * static_cast<std::int16_t>(number));
            is = path.x[sample].reshaped()[i];
          }
          worst = std::max(worst, std::abs(drawn - is));
        }
      if (run.find("times")) {
        EXPECT_LT(worst, run["unit"][0].number() + run["unit"][1].number()) << "half a unit along an axis";
        EXPECT_NEAR(run["times"].numbers().back(), k.runs[r].outcome.end, 0.5) << "they are the last ones";
        ++failed;
      } else {
        EXPECT_LE(worst, 0.5001 * grain * lattice.unit) << "half a grain";
        ++whole;
      }
    }
  }
  EXPECT_EQ(row, table.rows.size());
  EXPECT_GT(whole, 10u);
  EXPECT_GT(failed, 2u);
}

TEST(Runs, AsGoodAsTheTruthWeighNextToNothing) {
  Request request;
  request.scenes = {testing_tools::with_grid("cloth-hang", 8)};
  request.methods = find_methods("mysim/rk4");
  std::vector<Kept> kept;
  request.watch = keeping(kept);
  Rows rows;
  speed_accuracy_on(request, request.scenes[0], rows);
  const auto truth = truth_of(request.scenes[0], run_of(request, request.scenes[0]));
  const JsonField data = JsonField::parse(run_motions_json(kept.at(0).watched(), truth), "player");
  EXPECT_LT(data["runs"].elements().back()["places"]["data"].text().size(), 200u);
}

TEST(Runs, OfASceneWithoutTruthAreNotPlayed) {
  const Scene scene = load_scene("chain");
  Kept kept{"speed-accuracy", "mysim/rk4", scene, {{}}};
  EXPECT_EQ(run_motions_json(kept.watched(), {}), "");
}

}  // namespace
}  // namespace crosscheck
