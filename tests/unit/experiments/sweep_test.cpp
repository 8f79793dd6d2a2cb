// Sweeps: each point is computed only once, on any machine and in any order; failures are named; shards merge into the
// whole.

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <set>

#include "experiments/scenes/scenes.h"
#include "experiments/sweep/store.h"
#include "experiments/sweep/sweep.h"
#include "experiments/tables/order.h"
#include "experiments/timing/machine.h"
#include "experiments/timing/timing.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "tests/unit/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
namespace fs = std::filesystem;

/// Succeeds if `call` throws an E whose message contains `part`.
template <class E, class F>
::testing::AssertionResult throws(F call, const std::string& part) {
  try {
    call();
  } catch (const E& error) {
    return contains(error.what(), part);
  }
  return ::testing::AssertionFailure() << "no exception was thrown";
}

class Sweep : public InFolder {
 protected:
  Point point(const std::string& name, double value) {
    return {name, "content", [this, name, value](TableSet& tables) {
              note(name);
              Table table{"values", {{"name", "1"}, {"value", "m"}}, {}};
              table.add({name, value});
              tables.add(table);
            }};
  }
  std::vector<Point> several(int count) {
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) points.push_back(point("p" + std::to_string(i), 1.0 / (i + 3)));
    return points;
  }
  /// Writes the name to a file, because points run in other processes.
  void note(const std::string& name) const { std::ofstream(folder_ / "ran", std::ios::app) << name << "\n"; }
  std::vector<std::string> ran() const {
    std::ifstream in(folder_ / "ran");
    std::vector<std::string> names;
    for (std::string line; std::getline(in, line);) names.push_back(line);
    return names;
  }
  std::vector<FailedPoint> run(const std::vector<Point>& points, const SweepOptions& options = {LockPatience(), 2}) {
    Progress progress(static_cast<int>(points.size()));
    return run_points(points, options, store, progress);
  }
  static std::string text(const TableSet& tables) { return table_set_json(tables); }
  TableSet whole(const std::vector<Point>& points) {
    return joined(point_list_of({}, points, {}), {&store, 1}, missing);
  }

  void SetUp() override {
    InFolder::SetUp();
    setenv("CROSSCHECK_LOCK", (folder_ / "lock").c_str(), 1);  // the tests do not wait for other runs
    store = Store(folder_ / "points");
  }
  Store store{""};
  std::vector<std::string> missing;
};

TEST_F(Sweep, RowsComeBackToTheSameBits) {
  Table table{"t", {{"name", "1"}, {"x", "m"}, {"n", "1"}}, {}};
  for (const double x : std::vector<double>{1, 0.1, -0.0, 5e-324, 1.7976931348623157e308, NAN, INFINITY, -INFINITY})
    table.add({"a,\"b\"\n", x, 7l});
  table.add({Cell(), Cell(), Cell()});
  TableSet tables;
  tables.add(table);
  tables.notes = {"left out"};
  tables.certificates = {{"m", "s", {{"mass", "1 kg", "as asked", "1 kg", Parity::different_law}}}};
  const TableSet back = read_table_set(table_set_json(tables));
  ASSERT_EQ(back.tables.size(), 1u);
  EXPECT_EQ(csv(back.tables[0], {}), csv(table, {}));
  for (size_t i = 0; i < table.rows.size(); ++i)
    for (size_t j = 0; j < 3; ++j) EXPECT_EQ(back.tables[0].rows[i][j].index(), table.rows[i][j].index());
  EXPECT_TRUE(std::signbit(std::get<double>(back.tables[0].rows[2][1])));
  EXPECT_EQ(back.notes, tables.notes);
  EXPECT_EQ(back.certificates[0].rows[0].parity, Parity::different_law);
}

TEST_F(Sweep, WhatIsNoRowsIsRefusedInWords) {
  for (const char* text : {"", "{}", "[1]", "{\"tables\": [{\"name\": 1}]}"})
    EXPECT_TRUE(throws<InputError>([&] { read_table_set(text); }, "expected JSON of tables, certificates and notes"));
  const TableSet good{{{"t", {{"scene", "1"}, {"note", "1"}}, {{std::string("s"), std::string("two\nlines")}}}},
                      {{"rk4", "s", {}}},
                      {}};
  EXPECT_NO_THROW(read_table_set(table_set_json(good)));
  for (const char* name : {"../../OUTSIDE", "/tmp/x", "", ".hidden", "a\nb"}) {
    TableSet bad = good;
    bad.tables[0].name = name;
    EXPECT_THROW(read_table_set(table_set_json(bad)), InputError) << name;
    bad = good, bad.certificates[0].scene = name;
    EXPECT_THROW(read_table_set(table_set_json(bad)), InputError) << name;
  }
  TableSet bad = good;
  bad.tables[0].rows[0][0] = std::string("a\nb");
  EXPECT_THROW(read_table_set(table_set_json(bad)), InputError);
}

TEST_F(Sweep, RowsOfTheSameTableAreAppendedAndNotesSaidOnce) {
  TableSet all;
  for (int i = 0; i < 3; ++i) {
    TableSet tables;
    point("p", i).compute(tables);
    tables.notes = {"the same"};
    all.append(tables);
  }
  EXPECT_EQ(all.table("values")->rows.size(), 3u);
  EXPECT_EQ(all.notes.size(), 1u);
  EXPECT_TRUE(throws<std::logic_error>([&] { all.add({"values", {{"other", "1"}}, {}}); }, "columns differ"));
}

TEST_F(Sweep, ProcessesGiveWhatOneAfterTheOtherGives) {
  const std::vector<Point> points = several(9);
  EXPECT_TRUE(run(points, {LockPatience(), 3}).empty());
  EXPECT_EQ(text(whole(points)), text(computed(points)));
  EXPECT_TRUE(missing.empty());
}

TEST_F(Sweep, NothingFinishedIsRepeatedUnlessItsFileIsDamaged) {
  const std::vector<Point> points = several(5);
  run(points);
  EXPECT_EQ(ran().size(), 5u);
  run(points);
  EXPECT_EQ(ran().size(), 5u);
  std::ofstream(store.folder() / (points[2].hash() + ".json")) << "{\"tables\"";
  run(points);
  EXPECT_EQ(ran().size(), 6u);
  EXPECT_EQ(ran().back(), "p2");
}

TEST_F(Sweep, WaitsForTheMachineALimitedTimeAndMarksTimesMeasuredBesideOtherWork) {
  const int other = open((folder_ / "lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  std::vector<Point> points = several(4);
  points[2].timed = points[3].timed = true;
  EXPECT_TRUE(run(points, {LockPatience(0.2), 2}).empty());
  const TableSet all = whole(points);
  EXPECT_TRUE(missing.empty());
  ASSERT_EQ(all.notes.size(), 2u);
  EXPECT_TRUE(contains(all.notes[0], "p2 was timed during other work"));
  // All locks share one patience. Acquiring a free lock needs no patience.
  LockPatience little(0.1), none(0);
  EXPECT_FALSE(MachineLock(MachineLock::Mode::shared, little).held());
  close(other);
  EXPECT_TRUE(MachineLock(MachineLock::Mode::exclusive, none).held());
  const MachineLock one(MachineLock::Mode::shared, none), two(MachineLock::Mode::shared, none);
  EXPECT_TRUE(one.held() && two.held());
}

TEST_F(Sweep, AllMeasurementsOfACommandWaitTogetherNoLongerThanTheLimit) {
  const int other = open((folder_ / "lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  constexpr double limit = 0.2;  // s
  const LockPatience patience(limit);
  const auto scene = std::make_shared<const Scene>(load_scene("spring"));
  const std::vector<TimedRun> turns{{find_method("leapfrog"), scene, {scene->step, scene->duration, 1}}};
  const auto begun = std::chrono::steady_clock::now();
  for (int i = 0; i < 3; ++i) {
    std::vector<Point> timed{point("timed " + std::to_string(i), 1)};
    timed[0].timed = true;
    EXPECT_TRUE(run(timed, {patience, 1}).empty());
    EXPECT_TRUE(patience.exhausted());
    EXPECT_EQ(whole(timed).notes.size(), 1u);
    EXPECT_EQ(time_round_robin(turns, {1, 1e-5}, patience).size(), 1u);
  }
  // Six separate waits would take six times the limit. The work itself takes 20 ms.
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(), 4 * limit);
  close(other);
}

TEST_F(Sweep, KeepsTablesOfScenesWithNamesOfEveryLength) {
  for (const size_t length : {1u, 199u, 200u}) {
    TableSet tables;
    tables.tables.push_back({std::string(length, 's') + "-speed-accuracy-cost", {{"x", "m"}}, {}});
    store.keep("long", tables);
    EXPECT_TRUE(store.find("long")) << length;
    write_csv(tables.tables[0], {}, folder_);
  }
}

TEST_F(Sweep, NamesTheFaultOfAPointsFileThatCannotBeJoined) {
  const std::vector<Point> points = several(2);
  run(points);
  const std::string file = store.folder() / (points[1].hash() + ".json"), good = *try_read_file(file);
  const auto at = [&](const char* old, const char* other) {
    std::string text = good;
    return text.replace(text.find(old), std::string(old).size(), other);
  };
  for (const std::string& text : {std::string(), good.substr(0, good.size() / 2), at("values", "../../outside"),
                                  at("p1", "a\u001b[2J"), at("\"notes\"", "\"other\"")}) {
    std::ofstream(file) << text;
    missing.clear();
    whole(points);
    ASSERT_EQ(missing.size(), 1u) << text;
    EXPECT_TRUE(contains(missing[0], "p1: " + file + ": expected JSON of tables, certificates and notes: "))
        << missing[0];
  }
}

TEST_F(Sweep, NamesThePointWhoseTableHasOtherColumnsOrTypes) {
  std::vector<Point> points = several(2);
  run(points);
  TableSet other = *store.find(points[1].hash());
  other.tables[0].columns[1].name = "other";
  store.keep(points[1].hash(), other);
  EXPECT_TRUE(throws<InputError>([&] { whole(points); }, "p1, " + points[1].hash() + ".json: table values: "));
  Table typed = table_of<OrderRow>();
  typed.rows.push_back(std::vector<Cell>(typed.columns.size(), Cell(0.5)));
  other.tables = {typed};
  store.keep(points[1].hash(), other);
  missing.clear();
  whole(points);
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_TRUE(contains(missing[0], ".json: ") && contains(missing[0], "table order, column ")) << missing[0];
}

TEST_F(Sweep, AnotherContentOrNameIsAnotherPoint) {
  Point a = point("a", 1), b = a, c = a;
  b.content += " step=2";
  c.name = "b";
  EXPECT_EQ(a.hash(), point("a", 2).hash());  // the hash depends on the inputs, not on the function
  EXPECT_NE(a.hash(), b.hash());
  EXPECT_NE(a.hash(), c.hash());
  EXPECT_EQ(a.hash().size(), 16u);
}

TEST_F(Sweep, WhatThrowsOrDiesIsNamedAndTheOthersGoOn) {
  std::vector<Point> points = several(6);
  points[1].compute = [](TableSet&) { throw InputError("no such spring"); };
  points[3].compute = [](TableSet&) { raise(SIGKILL); };
  points[4].compute = [](TableSet&) { _exit(7); };
  std::map<std::string, std::string> failed;
  for (const FailedPoint& f : run(points)) failed[f.name] = f.why;
  EXPECT_EQ(failed.size(), 3u);
  EXPECT_EQ(failed["p1"], "no such spring");
  EXPECT_TRUE(contains(failed["p3"], "signal 9"));
  EXPECT_EQ(failed["p4"], "it ended early");
  whole(points);
  EXPECT_EQ(missing, (std::vector<std::string>{"p1", "p3", "p4"}));
  // after the repair, the points are computed, and no failure remains
  EXPECT_TRUE(run(several(6)).empty());
}

TEST_F(Sweep, ARowOfAnotherLengthIsNoRow) {
  Table table{"t", {{"a", "1"}, {"b", "1"}}, {}};
  EXPECT_TRUE(throws<std::logic_error>([&] { table.add({1.}); }, "table t: a row of 1 cells under 2 columns"));
  std::vector<Point> points = several(2);
  points[1].compute = [table](TableSet& tables) mutable { table.add({1.}), tables.add(table); };
  const auto failed = run(points);
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_EQ(failed[0].name, "p1");
}

TEST_F(Sweep, WhatFailedBeforeAndDiesNowIsNamedOnce) {
  std::vector<Point> points = several(1);
  points[0].compute = [](TableSet&) { throw InputError("no such spring"); };
  EXPECT_EQ(run(points).at(0).why, "no such spring");
  points[0].compute = [](TableSet&) { raise(SIGKILL); };
  const auto failed = run(points);
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_TRUE(contains(failed[0].why, "signal 9"));
}

TEST_F(Sweep, WhatIsNotThereAfterwardsIsNamedWhoeverLostIt) {
  std::vector<Point> points = several(3);
  points[2].compute = [this, lost = points[1].hash()](TableSet&) { fs::remove(store.folder() / (lost + ".json")); };
  const auto failed = run(points, {LockPatience(), 1});
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_EQ(failed[0].name, "p1");
}

TEST_F(Sweep, EndsWhereChildrenAreIgnored) {
  // simulates a parent that ignores SIGCHLD, so that the system reaps the workers itself
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);  // ends the child if it waits forever
    _exit(run(several(3)).empty() ? 0 : 1);
  }
  std::signal(SIGCHLD, before);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_EQ(ran().size(), 3u);
}

TEST_F(Sweep, KilledInTheMiddleItLosesNothingThatWasFinished) {
  std::vector<Point> points = several(8);
  points[5].compute = [this](TableSet&) {
    note("slow");
    usleep(500000);
    note("went on");
  };
  const pid_t child = fork();
  if (child == 0) {
    run(points, {LockPatience(), 1});
    _exit(0);
  }
  while (ran().size() < 6) usleep(1000);  // waits until five points are done, and the slow one has started
  kill(child, SIGKILL);                   // its worker ends, too
  waitpid(child, nullptr, 0);
  usleep(700000);
  run(several(8), {LockPatience(), 1});
  const std::vector<std::string> names = ran();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 9u);
  EXPECT_EQ(names.size(), 9u) << "no point runs twice";
  EXPECT_EQ(text(whole(several(8))), text(computed(several(8))));
}

TEST_F(Sweep, TimedPointsRunAfterAllOthersOneAtATime) {
  std::vector<Point> points = several(8);
  for (const int i : {0, 3, 4}) {
    points[static_cast<size_t>(i)].timed = true;
    points[static_cast<size_t>(i)].compute = [this, i](TableSet&) {
      note("begin " + std::to_string(i));
      usleep(20000);
      note("end " + std::to_string(i));
    };
  }
  run(points, {LockPatience(), 4});
  const std::vector<std::string> names = ran(), timed(names.end() - 6, names.end());
  EXPECT_EQ(timed, (std::vector<std::string>{"begin 0", "end 0", "begin 3", "end 3", "begin 4", "end 4"}));
}

TEST_F(Sweep, LongPointsBeginFirstAndTheirRowsStandInTheirPlace) {
  std::vector<Point> points = several(4);
  points[2].is_long = true;
  EXPECT_TRUE(run(points, {LockPatience(), 1}).empty());
  EXPECT_EQ(ran(), (std::vector<std::string>{"p2", "p0", "p1", "p3"}));
  EXPECT_EQ(text(whole(points)), text(computed(points)));
}

TEST_F(Sweep, TimedPointsOfOneSweepWaitForThePointsOfAnother) {
  std::vector<Point> others = several(3), timed = {point("timed", 1)};
  for (Point& p : others)
    p.compute = [this, name = p.name](TableSet&) {
      note("begin " + name);
      usleep(50000);
      note("end " + name);
    };
  timed[0].timed = true;
  const pid_t child = fork();
  if (child == 0) {
    setenv("TMPDIR", folder_.c_str(), 1);  // batch systems set a TMPDIR for each job
    run(others, {LockPatience(), 3});
    _exit(0);
  }
  while (ran().size() < 3) usleep(1000);
  Progress progress(1);
  run_points(timed, {LockPatience(), 1}, Store(folder_ / "timed"), progress);
  waitpid(child, nullptr, 0);
  ASSERT_EQ(ran().size(), 7u);
  EXPECT_EQ(ran().back(), "timed");
}

TEST_F(Sweep, ShardsAreDisjointAndJoinToTheWhole) {
  const std::vector<Point> points = several(7);
  std::vector<Store> stores;
  for (int i = 1; i <= 3; ++i) {
    stores.emplace_back(folder_ / std::to_string(i));
    Progress progress(7);
    run_points(points, {LockPatience(), 2, {i, 3}}, stores.back(), progress);
  }
  EXPECT_EQ(ran().size(), 7u);
  const PointList list = point_list_of({}, points, {});
  EXPECT_EQ(text(joined(list, stores, missing)), text(computed(points)));
  EXPECT_TRUE(missing.empty());
  joined(list, std::span(stores).first(2), missing);
  EXPECT_EQ(missing, (std::vector<std::string>{"p2", "p5"}));
}

TEST_F(Sweep, ShardsAreReadFromTwoNumbers) {
  const Shard shard = shard_from("2/8");
  EXPECT_EQ(shard.index, 2);
  EXPECT_EQ(shard.count, 8);
  for (const char* text : {"", "2", "/", "0/2", "3/2", "-1/2", "1/2/3", "1/x", "1.5/2", " 1/2"})
    EXPECT_TRUE(throws<InputError>([&] { shard_from(text); }, "expected I/N with 1 <= I <= N")) << text;
}

TEST_F(Sweep, PointListsComeBackAndDamagedOnesAreRefused) {
  const PointList list = point_list_of({"order"}, several(3), {{"command", "c"}, {"date", "d"}});
  write_point_list(list, folder_);
  const PointList back = read_point_list(folder_);
  EXPECT_EQ(back.points, list.points);
  EXPECT_EQ(back.experiments, list.experiments);
  EXPECT_EQ(back.provenance, list.provenance);
  std::filesystem::create_directories(folder_ / "points");
  std::filesystem::create_symlink("/dev/zero", folder_ / "points/0123456789abcdef.json");
  EXPECT_THROW(read_point_list(folder_), InputError);
  std::filesystem::remove_all(folder_ / "points");
  write_point_list({{}, {{"a point", "../../x"}}, {}}, folder_);
  EXPECT_THROW(read_point_list(folder_), InputError);
  std::ofstream(folder_ / "plan.json") << "{}";
  EXPECT_TRUE(throws<InputError>([&] { read_point_list(folder_); }, "expected experiments, provenance and points"));
  EXPECT_TRUE(throws<InputError>([&] { read_point_list(folder_ / "none"); }, "expected the plan of a sweep"));
}

}  // namespace
}  // namespace crosscheck
