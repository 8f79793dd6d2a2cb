// Runs that a click plays: unpacked they are the runs that the experiment made, and watching changes no row.
#include <gtest/gtest.h>

#include "experiments/last_pictures.h"
#include "experiments/scenes.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/stability/map.h"
#include "mysim/json.h"
#include "report/player/cell_motions.h"
#include "report/player/run_motions.h"
#include "report/player/shown.h"
#include "tests/unit/optional_packages.h"
#include "tests/unit/resized.h"
#include "tests/unit/unpacked.h"

namespace crosscheck {
namespace {

using testing_tools::unpacked;

std::vector<std::uint16_t> numbers_of(const JsonField& p) {
  return unpacked(p["count"].natural(), p["lag"].natural(), p["order"].whole_number(0, 9), p["data"].text());
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

/// Watched runs outlive the driver that made them.
struct Kept {
  std::string of, method;
  Scene scene;
  std::vector<WatchedRun> runs;
  WatchedRuns watched() const { return {of, scene, method, runs}; }
};
RunCallback keeping(std::vector<Kept>& kept) {
  return [&kept](const WatchedRuns& w) { kept.push_back({w.of, w.method, w.scene, w.runs}); };
}

TEST(LastPictures, AreAtLeastEightToAPeriodOrEveryStep) {
  const double omega = 2 * M_PI;  // a period of 1 s
  for (const double h : {1e-3, 0.03, 0.2, 0.9}) {
    LastPictures last(omega, h);
    for (int i = 0; i <= 10000; ++i) last.observe({h * i, Points::Constant(3, 1, i), Points::Zero(3, 1)}, false);
    const Trajectory path = last.path();
    ASSERT_EQ(path.frames(), 25);
    for (int f = 1; f < 25; ++f) EXPECT_LE(path.t[f] - path.t[f - 1], std::max(h, 1 / 8. + h / 2) * (1 + 1e-9)) << h;
    EXPECT_GT(path.t.back(), 10000 * h - std::max(h, 1 / 8. + h)) << "they are the last ones, h " << h;
  }
}

TEST(LastPictures, OfAShortRunAreAllOfItAsFarAsItIsFinite) {
  LastPictures last(0, 1e-3);
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
    map_on(map_kinds()[0], load_scene("spring"), find_method(method), {3, 6, 300, false}, map, keeping(kept));
    map_on(map_kinds()[0], load_scene("spring"), find_method(method), {3, 6, 300, false}, unwatched_map);
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
    map_on(kind, scene, find_method("mysim/leapfrog"), size, rows, keeping(kept));
    map_on(kind, scene, find_method("mysim/leapfrog"), size, unwatched);
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
  const Lattice lattice = lattice_of({shown_of(*truth, stride)});
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
