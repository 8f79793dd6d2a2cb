// Speeds in regression tests: the plain loop, the file of blessed speeds, verdicts on invented measurements.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "experiments/regress/speed.h"
#include "experiments/regress/speed_regression.h"
#include "experiments/scenes/scenes.h"
#include "experiments/timing/machine.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/run/observers.h"

namespace crosscheck {
namespace {

TEST(PlainLoop, IsSymplecticEulerWithSpringsAndGravity) {
  for (const char* name : {"spring", "normal-modes", "jelly"}) {
    const Scene scene = load_scene(name);
    PlainLoop loop(scene);
    const int steps = 50;
    EXPECT_GE(loop.seconds_of(steps), 0);
    const crosscheck::Run run{loop.step(), steps * loop.step(), 1};
    Recorder recorder;
    ASSERT_EQ(run_method(find_method("symplectic-euler"), scene, run, {&recorder}).verdict, Verdict::ok);
    const Points& x = recorder.trajectory.x.back();
    const double moved = (x - scene.start.x).cwiseAbs().maxCoeff();
    ASSERT_GT(moved, 0) << name;
    // sums of about twenty forces in another order, a few units in the last place of the places themselves; drag, which
    // the loop leaves out, takes less than 50 steps of its rate times 1e-6 s from what moved
    for (Eigen::Index i = 0; i < x.size(); ++i)
      EXPECT_NEAR(loop.positions()[static_cast<size_t>(i)], x.data()[i], 1e-14 + 1e-3 * moved) << name;
  }
}

const Machine here{"a CPU", "a compiler -O3", "a loop"};

SpeedCase test_case(const std::string& scene, const std::string& method, const std::string& against = "") {
  SpeedCase q{load_scene(scene), find_method(method)};
  if (!against.empty()) q.against = find_method(against);
  return q;
}

BlessedSpeed speed_of(const SpeedCase& q, double ratio, double spread = 0.01) {
  return {q.scene.name, q.scene.hash, q.method.name, ratio, spread, here};
}

TEST(SpeedVerdicts, NoiseIsTenPerCentOrTwiceTheSpread) {
  EXPECT_DOUBLE_EQ(noise_of(0.04), 0.1);
  EXPECT_DOUBLE_EQ(noise_of(0.08), 0.16);
  EXPECT_DOUBLE_EQ(spread_of({1, 2, 1.6, 2, 9}), 1);
  EXPECT_DOUBLE_EQ(spread_of({3, 3, 2, 3, 3}), 0) << "one odd one out";
  // the whole interval has to be beyond
  EXPECT_EQ(direction_of({1.2, 1.11, 1.3}, 0.1), 1);
  EXPECT_EQ(direction_of({1.2, 1.09, 1.3}, 0.1), 0);
  EXPECT_EQ(direction_of({0.8, 0.7, 0.9}, 0.1), -1);
  EXPECT_EQ(direction_of({0.8, 0.7, 0.92}, 0.1), 0);
  EXPECT_EQ(direction_of({1, 0.99, 1.01}, 0.1), 0);
}

/// Rounds of one case whose ratios are all near `middle`.
Ratios rounds(double middle, double other = 0) {
  Ratios ratios;
  for (const double off : {0.99, 1., 1.01, 1., 0.99, 1.01, 1.}) {
    ratios.is.push_back(off * middle);
    if (other > 0) ratios.was.push_back(off * other);
  }
  return ratios;
}

/// Returns for each measurement the next ratio of each scene; the last one for ever.
MeasureSpeeds invented(std::map<std::string, std::vector<double>> ratios) {
  return [ratios = std::move(ratios), count = 0u](const std::vector<SpeedCase>& cases, int) mutable {
    std::vector<Ratios> all;
    for (const SpeedCase& q : cases) {
      const std::vector<double>& list = ratios.at(q.scene.name);
      const double now = list[std::min<size_t>(count, list.size() - 1)];
      all.push_back(now == 0 ? Ratios{} : rounds(now, q.against ? 1 : 0));
    }
    ++count;
    return all;
  };
}

std::map<std::string, SpeedComparison> by_scene(const Speeds& speeds) {
  std::map<std::string, SpeedComparison> all;
  for (const SpeedComparison& row : speeds.rows) all[row.scene] = row;
  return all;
}

TEST(SpeedVerdicts, AChangeCountsWhereEveryMeasurementShowsIt) {
  std::vector<SpeedCase> cases;
  SpeedFile file;
  for (const char* name : {"spring", "chain", "pendulum", "bounce", "slide", "jelly", "flag"})
    cases.push_back(test_case(name, "leapfrog")), file.speeds.push_back(speed_of(cases.back(), 2));
  file.speeds[5].spread = 0.2;
  const Speeds speeds = compared_speeds(cases, &file, here,
                                        invented({{"spring", {2.1}},
                                                  {"chain", {3}},
                                                  {"pendulum", {1.5}},
                                                  {"bounce", {3, 3, 3, 2.1}},  // once not
                                                  {"slide", {3, 3, 1, 3}},     // once the other way
                                                  {"jelly", {2.6}},            // its noise is 40 %
                                                  {"flag", {0}}}));            // refused or failed
  const auto rows = by_scene(speeds);
  EXPECT_EQ(rows.at("spring").state, SpeedStatus::same);
  EXPECT_EQ(rows.at("chain").state, SpeedStatus::slower);
  EXPECT_EQ(rows.at("chain").seen, 4);
  EXPECT_DOUBLE_EQ(rows.at("chain").is, 3);
  EXPECT_DOUBLE_EQ(rows.at("chain").change.median, 1.5);
  EXPECT_EQ(rows.at("pendulum").state, SpeedStatus::faster);
  EXPECT_EQ(rows.at("bounce").state, SpeedStatus::same);
  EXPECT_EQ(rows.at("slide").state, SpeedStatus::same);
  EXPECT_EQ(rows.at("jelly").state, SpeedStatus::same);
  EXPECT_EQ(rows.at("flag").state, SpeedStatus::gone);
  EXPECT_TRUE(failed(SpeedStatus::gone));
  EXPECT_FALSE(speeds.passed());
  EXPECT_TRUE(speeds.notes.empty());
  // what became faster fails nothing
  EXPECT_TRUE(compared_speeds({cases[2]}, &file, here, invented({{"pendulum", {1.5}}})).passed());
}

TEST(SpeedVerdicts, ARunThatVariesALotNowIsGivenMoreNoise) {
  const SpeedCase q = test_case("spring", "leapfrog");
  SpeedFile file;
  file.speeds = {speed_of(q, 1)};
  // every other round takes half again as long: even and odd rounds differ by 40 %
  const MeasureSpeeds uneven = [](const std::vector<SpeedCase>&, int) {
    return std::vector<Ratios>{{{1.2, 1.8, 1.2, 1.8, 1.2, 1.8, 1.2, 1.8}, {}}};
  };
  const Speeds speeds = compared_speeds({q}, &file, here, uneven);
  EXPECT_EQ(speeds.rows.at(0).state, SpeedStatus::same);
  EXPECT_GT(speeds.rows.at(0).noise, 0.5);
}

TEST(SpeedVerdicts, WhatIsOfAnotherKindIsNotCompared) {
  const SpeedCase q = test_case("spring", "leapfrog");
  const auto state = [&](const SpeedFile* file) {
    const Speeds speeds = compared_speeds({q}, file, here, invented({{"spring", {50}}}));
    EXPECT_TRUE(speeds.passed());
    EXPECT_EQ(speeds.notes.size(), 1u);
    EXPECT_FALSE(speeds.rows.at(0).was);
    return std::pair{speeds.rows.at(0).state, speeds.notes.at(0)};
  };
  EXPECT_EQ(state(nullptr).first, SpeedStatus::added);
  SpeedFile file;
  EXPECT_EQ(state(&file).first, SpeedStatus::added);
  EXPECT_EQ(state(&file).second, "1 of 1 speeds not compared: new (not blessed yet)");
  for (const auto part : {&Machine::cpu, &Machine::compiler, &Machine::reference_loop}) {
    file.speeds = {speed_of(q, 5)};
    file.speeds[0].machine.*part = "another";
    EXPECT_EQ(state(&file).first, SpeedStatus::elsewhere);
    EXPECT_NE(state(&file).second.find("another"), std::string::npos);
  }
  file.speeds = {speed_of(q, 5)};
  file.speeds[0].hash = "0123456789abcdef";
  EXPECT_EQ(state(&file).first, SpeedStatus::elsewhere);
  EXPECT_NE(state(&file).second.find("another scene"), std::string::npos);
}

TEST(SpeedVerdicts, WhyASpeedIsNotComparedIsNamed) {
  const SpeedCase q = test_case("spring", "leapfrog");
  const auto note = [&](std::vector<Machine> blessed_on, const Machine& machine) {
    SpeedFile file;
    for (const Machine& m : blessed_on) file.speeds.push_back(speed_of(q, 5)), file.speeds.back().machine = m;
    const Speeds speeds = compared_speeds({q}, &file, machine, invented({{"spring", {50}}}));
    EXPECT_TRUE(speeds.passed());
    EXPECT_EQ(speeds.rows.at(0).state, SpeedStatus::elsewhere);
    return speeds.notes.at(0);
  };
  const std::string begin = "1 of 1 speeds not compared: ";
  const Machine other_cpu{"b CPU", here.compiler, here.reference_loop},
      other_both{"b CPU", "b compiler", here.reference_loop};
  EXPECT_EQ(note({other_cpu}, here), begin + "blessed on another processor (b CPU; this is a CPU)");
  EXPECT_EQ(note({{here.cpu, "b compiler", here.reference_loop}}, here),
            begin + "blessed on another compiler (b compiler; this is a compiler -O3)");
  // of several kinds the one most like this is named
  EXPECT_EQ(note({other_both, other_cpu, other_both}, here), note({other_cpu}, here));
  EXPECT_EQ(note({other_both}, here), begin +
                                          "blessed on another processor (b CPU; this is a CPU) and on another compiler "
                                          "(b compiler; this is a compiler -O3)");
  // a processor that says nothing of itself is like no other, itself included
  const Machine unknown{"", here.compiler, here.reference_loop};
  EXPECT_EQ(note({unknown}, unknown), begin + "this processor cannot be told from others");
}

/// A folder like the one in which Linux describes a processor.
class ProcessorKind : public ::testing::Test {
 protected:
  ProcessorKind() { std::filesystem::create_directories(folder); }
  ~ProcessorKind() override { std::filesystem::remove_all(folder); }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  }
  void cache(int index, const std::string& level, const std::string& type, const std::string& size) const {
    const std::string at = fmt::format("caches/index{}/", index);
    write(at + "level", level + "\n"), write(at + "type", type + "\n"), write(at + "size", size + "\n");
  }
  std::string kind(const std::string& cpuinfo) const {
    write("cpuinfo", cpuinfo);
    return processor_kind(folder / "cpuinfo", folder / "caches");
  }
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("crosscheck-processor-{}", getpid());
};

TEST_F(ProcessorKind, HasNameNumbersCachesAndInstructionSets) {
  cache(0, "1", "Data", "32K"), cache(1, "1", "Instruction", "64K"), cache(2, "3", "Unified", "32768K");
  const std::string text =
      "processor\t: 0\nmodel name\t: AMD EPYC\ncpu family\t: 25\nmodel\t\t: 1\nstepping\t: 1\ncpu MHz\t\t: "
      "2445.4\nflags\t\t: fpu hypervisor sse2 avx2 fma avx rdrand\n\nprocessor\t: 1\nmodel\t\t: 99\n";
  const std::string zen3 = "AMD EPYC, cpu family 25, model 1, stepping 1, L1d 32K, L3 32768K, avx avx2 fma sse2";
  EXPECT_EQ(kind(text), zen3);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    return kind(other.replace(other.find(from), from.size(), to));
  };
  // the same name on another processor, as providers of virtual machines sell it
  for (const auto& [from, to] : {std::pair{"family\t: 25", "family\t: 23"},
                                 {"model\t\t: 1", "model\t\t: 49"},
                                 {"stepping\t: 1", "stepping\t: 0"},
                                 {"AMD EPYC", "AMD EPYC 7763"},
                                 {" avx2", ""},
                                 {" fma", " fma avx512f"}})
    EXPECT_NE(with(from, to), zen3) << from;
  // what changes from hour to hour, and from kernel to kernel, is no other kind
  EXPECT_EQ(with("2445.4", "3300.1"), zen3);
  EXPECT_EQ(with("rdrand", "rdrand ibpb"), zen3);
  EXPECT_EQ(with("avx2 fma", "fma avx2"), zen3);
  EXPECT_EQ(with("AMD EPYC", "AMD|EPYC").find('|'), std::string::npos) << "it parts the fields of the file";
  cache(2, "3", "Unified", "16384K");
  EXPECT_NE(kind(text), zen3);
}

TEST_F(ProcessorKind, OfOtherMakesAndOfNone) {
  EXPECT_EQ(kind("processor\t: 0\nCPU implementer\t: 0x41\nCPU part\t: 0xd0c\nFeatures\t: fp asimd crc32\n"),
            "CPU implementer 0x41, CPU part 0xd0c, asimd");
  EXPECT_EQ(kind("model name\t: a CPU\n"), "") << "a name alone tells nothing";
  EXPECT_EQ(kind(""), "");
  EXPECT_EQ(processor_kind("/nonexistent", "/nonexistent"), "");
  EXPECT_EQ(processor_kind(), processor_kind());
}

TEST(SpeedVerdicts, OneMethodBesideAnotherNeedsNothingStored) {
  const SpeedCase q = test_case("spring", "rk4", "leapfrog");
  const Speeds speeds = compared_speeds({q}, nullptr, here, invented({{"spring", {4}}}));
  EXPECT_EQ(speeds.rows.at(0).state, SpeedStatus::slower);
  EXPECT_DOUBLE_EQ(*speeds.rows.at(0).was, 1);
  EXPECT_DOUBLE_EQ(speeds.rows.at(0).change.median, 4);
  EXPECT_TRUE(speeds.notes.empty());
}

TEST(SpeedBlessings, WhatIsTheSameKeepsItsOwn) {
  const std::vector<SpeedCase> cases{test_case("spring", "leapfrog"), test_case("chain", "leapfrog")};
  const auto speeds = speeds_to_bless(cases, here, invented({{"spring", {5, 5.2, 5, 5, 5, 5.3, 5}}, {"chain", {2}}}));
  ASSERT_EQ(speeds.size(), 2u);
  EXPECT_NEAR(speeds[0].ratio, 5, 1e-12);
  EXPECT_NEAR(speeds[0].spread, 0.04, 1e-12);
  SpeedFile file;
  EXPECT_EQ(merge_into(file, speeds, {"d", "c", "b", "first"}).size(), 2u);
  const std::string before = text_of(file);
  std::vector<BlessedSpeed> near = speeds;
  near[0].ratio = 5.3;
  EXPECT_TRUE(merge_into(file, near, {"d", "c", "b", "again"}).empty());
  EXPECT_EQ(text_of(file), before) << "within the noise nobody's word is needed";
  near[0].ratio = 7;
  EXPECT_EQ(merge_into(file, near, {"d", "c", "b", "slower, and right"}).size(), 1u);
  EXPECT_EQ(file.speeds[0].ratio, 7);
  EXPECT_EQ(file.speeds[0].blessing, 2);
  EXPECT_EQ(file.speeds[1].blessing, 1);
  near[0].machine.cpu = "another";
  merge_into(file, {near[0]}, {"d", "c", "b", "a new machine"});
  EXPECT_EQ(file.speeds.size(), 3u) << "kinds of machine stand side by side";
}

TEST(SpeedCases, AreEachSceneUnderItsOwnMethodAndACloth) {
  const auto all = speed_cases({}, {});
  EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const auto& q) { return q.scene.name != "cloth-32x32"; }),
            static_cast<long>(shipped_scenes().size()));
  for (const SpeedCase& q : all) {
    EXPECT_TRUE(q.method.name.starts_with("mysim/") || q.method.name.starts_with("bullet/")) << q.in_words();
    EXPECT_GE(q.run.duration, 2 * q.scene.step) << q.in_words();
    EXPECT_EQ(q.run.samples, 1) << "the clock stops at samples";
  }
  Selection selection;
  selection.filter = "chain";
  EXPECT_EQ(speed_cases(selection, {}).size(), 1u);
  selection.filter = "cloth-32x32/bullet/*";
  EXPECT_EQ(speed_cases(selection, {}).size(), 3u);
  selection.filter = "chain/mysim/rk4";
  EXPECT_TRUE(speed_cases(selection, {}).empty());
  selection.filter = "chain", selection.methods = {find_method("rk4")};
  EXPECT_EQ(speed_cases(selection, find_method("leapfrog")).size(), 1u);
  EXPECT_TRUE(speed_cases(selection, find_method("exec:" CROSSCHECK_EXAMPLE)).empty());
}

TEST(SpeedMeasurements, LeaveOutWhatARuleRefuses) {
  Selection selection;
  selection.filter = "rod", selection.methods = {find_method("rk4")};
  const auto refused = measured_ratios(speed_cases(selection, find_method("xpbd")), 1, 0);
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_TRUE(refused[0].is.empty());
  selection.filter = "spring";
  const auto taken = measured_ratios(speed_cases(selection, find_method("leapfrog")), 2, 0);
  ASSERT_EQ(taken.size(), 1u);
  EXPECT_EQ(taken[0].is.size(), 2u);
  EXPECT_EQ(taken[0].was.size(), 2u);
  EXPECT_GT(taken[0].is[0], 0);
}

SpeedFile small_file() {
  SpeedFile file;
  file.blessings = {{"2026-01-02", "abc", "g++ -O3", "first"}, {"2026-01-03", "abd", "g++", "new"}};
  file.speeds = {speed_of(test_case("spring", "leapfrog"), 5.125), speed_of(test_case("chain", "rk4"), 0.5, 0.2)};
  file.speeds.push_back(file.speeds[0]);
  file.speeds[2].machine.cpu = "another, older CPU", file.speeds[2].blessing = 2;
  return file;
}

TEST(SpeedFiles, ComeBackAsTheyWere) {
  const TemporaryFolder folder("speeds");
  write_file(speed_file_in(folder.path), text_of(small_file()));
  const auto read = read_speed_file(folder.path);
  ASSERT_TRUE(read);
  EXPECT_EQ(text_of(*read), text_of(small_file()));
  EXPECT_EQ(read->speeds[0].ratio, 5.125);
  EXPECT_EQ(read->speeds[1].spread, 0.2);
  EXPECT_EQ(read->speeds[2].machine.cpu, "another, older CPU");
  EXPECT_EQ(read->blessings[1].reason, "new");
  EXPECT_EQ(find_speed(*read, test_case("spring", "leapfrog"), here), &read->speeds[0]);
  EXPECT_EQ(find_speed(*read, test_case("spring", "rk4"), here), nullptr);
  EXPECT_FALSE(read_speed_file(folder.path / "no-such"));
}

TEST(SpeedFiles, EachDamageIsNamedWithItsLine) {
  const TemporaryFolder folder("speeds");
  const std::string good = text_of(small_file());
  const struct {
    const char *right, *wrong, *says;
  } damages[] = {
      {"# blessing 2: ", "# blessing 3: ", ":3: expected a line '# blessing 2: ...'"},
      {" | first", " | ", ":2: expected DATE | COMMIT | BUILD | REASON, none of them empty"},
      {"# machine 2: ", "# machine 1: ", ":5: expected a line '# machine 2: ...'"},
      {" | a loop", " | ", ":4: expected CPU | COMPILER AND FLAGS | YARDSTICK, none of them empty"},
      {"# rows: 3", "# rows: 4", "expected 4 rows, got 3"},
      {"# rows: 3", "# rose: 3", ":6: expected a line '# rows: ...'"},
      {"scene,hash", "scenes,hash", "expected the header"},
      {",5.125,", ",nan,", "expected a finite number for the ratio, got 'nan'"},
      {",5.125,", ",-5,", "expected a ratio above zero"},
      {",5.125,0.01,", ",5.125,-0.01,", "expected a spread that is not negative"},
      {",5.125,0.01,1,", ",5.125,0.01,3,", "expected the number of a machine from 1 to 2, got 3"},
      {",5.125,0.01,1,1", ",5.125,0.01,1,0", "expected the number of a blessing from 1 to 2, got 0"},
      {",5.125,", ",5,125,", "expected 7 fields, got 8"},
      {"mysim/rk4", "", "expected a scene and a method"},
  };
  for (const auto& [right, wrong, says] : damages) {
    SCOPED_TRACE(wrong);
    std::string text = good;
    ASSERT_NE(text.find(right), std::string::npos);
    text.replace(text.find(right), std::string(right).size(), wrong);
    write_file(speed_file_in(folder.path), text);
    try {
      read_speed_file(folder.path);
      ADD_FAILURE() << "it was read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("speed-cost.csv:"), std::string::npos) << error.what();
    }
  }
  write_file(speed_file_in(folder.path), good.substr(0, good.find("spring,")));
  EXPECT_THROW(read_speed_file(folder.path), InputError);  // no rows
  write_file(speed_file_in(folder.path), "");
  EXPECT_THROW(read_speed_file(folder.path), InputError);
}

SpeedComparison speed(SpeedStatus state, const std::string& scene = "chain") {
  SpeedComparison row{scene, "mysim/rk4", 1., state == SpeedStatus::slower ? 1.4 : 1 / 1.4};
  row.change = {row.is, row.is, row.is, 9};
  row.state = state;
  return row;
}

Comparison comparison(const std::string& quantity, double was, double is, const std::string& scene = "chain") {
  Comparison row{scene, "mysim/rk4", "", quantity, "m", was, is};
  row.tolerance = 1e-6;
  row.state = std::abs(is - was) > row.tolerance ? Status::moved : Status::same;
  return row;
}

Comparison error(double was, double is, const std::string& scene = "chain") {
  return comparison("error against truth", was, is, scene);
}

TEST(SpeedSentences, NameTheChangeAndThatOfTheError) {
  std::vector<Comparison> rows{error(1e-3, 2.3e-3), error(1e-3, 5e-3), error(1e-3, 5e-3), error(1e-3, 5e-3, "spring"),
                               comparison("offset at 1 s", 1, 2)};
  rows[1].without = "drag", rows[2].method = "mysim/leapfrog";
  std::vector<SpeedComparison> speeds{speed(SpeedStatus::faster), speed(SpeedStatus::slower, "rod"),
                                      speed(SpeedStatus::same), speed(SpeedStatus::added)};
  add_sentences(speeds, rows);
  EXPECT_EQ(speeds[0].sentence, "1.4 times faster; error against truth was 0.001, is 0.0023 m");
  EXPECT_EQ(speeds[1].sentence, "1.4 times slower");
  EXPECT_EQ(speeds[2].sentence + speeds[3].sentence, "");
}

}  // namespace
}  // namespace crosscheck
