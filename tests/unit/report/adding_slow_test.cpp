// A new stepper, term, scene, engine, experiment, chart or assignment needs one new file and rows in one table, and is
// then available in the whole program.

#include <gtest/gtest.h>

#include "mysim/base/files.h"
#include "tests/unit/compiler.h"
#include "tests/unit/helpers.h"
#include "tests/unit/report/adding/additions.h"
#include "tests/unit/report/telling_apart.h"

namespace crosscheck::testing_tools {
namespace {

namespace fs = std::filesystem;
const fs::path source = CROSSCHECK_SOURCE;

Addition addition(const std::string& name) {
  return read_addition(source / "tests/unit/report/adding" / (name + ".txt"));
}

std::vector<std::string> paths_of(const auto& files) {
  std::vector<std::string> paths;
  for (const auto& [path, content] : files) paths.push_back(path);
  return paths;
}

struct Place {
  const char* what;
  std::vector<std::string> tables;
  const char* list;  // null if the new file is not listed: a header, or not a source
};
const std::vector<Place> places = {
    {"stepper", {"mysim/steppers/steppers.cpp"}, "mysim/CMakeLists.txt"},
    {"scene", {"experiments/scenes/scenes.cpp"}, nullptr},
    {"engine", {"reference/method.cpp"}, "reference/CMakeLists.txt"},
    {"experiment", {"experiments/experiment.cpp"}, "experiments/CMakeLists.txt"},
    {"chart", {"report/figures/charts.cpp"}, "report/CMakeLists.txt"},
    {"assignment", {"tests/coursework/grader/assignments.cpp"}, "tests/coursework/CMakeLists.txt"},
    // the tables are the list of terms and the table of their readers
    {"term", {"mysim/model/model.h", "mysim/scene/scene.cpp"}, nullptr},
};

/// Expects that all changes apply to the current files, and that no file gets more than `most` changes or additional
/// lines.
void expect_changes(const std::map<std::string, std::vector<Addition::Change>>& files, long most) {
  for (const auto& [path, changes] : files) {
    const std::string before = read_file(source / path, "a source"), after = with_changes(before, changes);
    const long lines = std::count(after.begin(), after.end(), '\n') - std::count(before.begin(), before.end(), '\n');
    EXPECT_NE(before, after) << path;
    EXPECT_LE(static_cast<long>(changes.size()), most) << path;
    EXPECT_LE(lines, most) << path;
  }
}

TEST(Adding, TakesOneFileAndRowsOfTheTable) {
  for (const Place& place : places) {
    SCOPED_TRACE(place.what);
    const Addition a = addition(place.what);
    EXPECT_EQ(a.created.size(), 1u);
    for (const auto& [path, text] : a.created) EXPECT_FALSE(fs::exists(source / path)) << path;
    EXPECT_EQ(paths_of(a.edited), place.tables);
    EXPECT_EQ(paths_of(a.listed), place.list ? std::vector<std::string>{place.list} : std::vector<std::string>{});
    // a scene's table gets a row; a table of sources also gets a declaration
    expect_changes(a.edited, a.created.begin()->first.ends_with(".toml") ? 1 : 2);
    expect_changes(a.listed, 1);
  }
}

TEST(Adding, ALineThatDoesNotStandThereOnceIsRefused) {
  const std::vector<Addition::Change> change = {{"b", "b\nc"}};
  EXPECT_EQ(with_changes("a\nb\nd\n", change), "a\nb\nc\nd\n");
  EXPECT_THROW(with_changes("a\nd\n", change), std::invalid_argument);
  EXPECT_THROW(with_changes("a\nb\nb \nb\n", change), std::invalid_argument);
}

/// Checks the syntax of an original or added file. The addition's files come first in the include path.
ProgramResult compiled(const Addition& a, const std::string& file) {
  const TemporaryFolder folder("adding");
  write_addition(a, source, folder.path);
  return check_syntax((fs::exists(folder.path / file) ? folder.path : source) / file, {"-I", folder.path.string()});
}

TEST(Adding, WhatIsNotLinkedHereCompilesAsItIsDescribed) {
  for (const char* what : {"engine", "chart", "assignment"}) {
    const Addition a = addition(what);
    for (const auto& files : {paths_of(a.created), paths_of(a.edited)})
      for (const std::string& file : files) {
        const ProgramResult end = compiled(a, file);
        EXPECT_EQ(end.status, 0) << file << ": " << end.err;
      }
  }
}

/// Code that must handle every term (listed in new_term_slow_test) does not compile until it handles the new one. The
/// engine's code compiles.
TEST(Adding, ATermIsTakenByTheEngineAndAskedAboutElsewhere) {
  const Addition term = addition("term");
  for (const char* file : {"mysim/model/system.cpp", "mysim/implicit/newton.cpp"}) {
    const ProgramResult end = compiled(term, file);
    EXPECT_EQ(end.status, 0) << file << ": " << end.err;
  }
  const ProgramResult end = compiled(term, "mysim/model/energy.cpp");
  EXPECT_NE(end.status, 0);
  EXPECT_TRUE(contains(end.err, "Tide"));
}

/// Output, including tables, of the program with an additional stepper, scene, engine and experiment.
std::string told(std::vector<std::string> words) {
  const TemporaryFolder folder("adding");
  words.insert(words.begin(), CROSSCHECK_EXTENDED);
  const ProgramResult end = run_program(words, folder.path, {"CROSSCHECK_LOCK=" + (folder.path / "lock").string()});
  EXPECT_EQ(end.status, 0) << end.err;
  std::string all = end.out;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path))
    if (entry.path().extension() == ".csv") all += read_file(entry.path(), "a table");
  return all;
}

TEST(Adding, NewcomersAreListed) {
  EXPECT_TRUE(contains(told({"list", "methods", "--json"}), "\"mysim/ralston\""));
  EXPECT_TRUE(contains(told({"list", "methods", "--json"}), "\"toy/step\""));
  EXPECT_TRUE(contains(told({"list", "scenes", "--json"}), "\"two-masses\""));
  EXPECT_TRUE(contains(told({"list", "experiments", "--json"}), "\"census\""));
}

TEST(Adding, NewcomersWorkTogether) {
  EXPECT_TRUE(contains(told({"compare", "two-masses", "--methods", "ralston,rk4"}), "mysim/ralston"));
  EXPECT_TRUE(contains(told({"experiment", "census", "two-masses", "spring", "--jobs", "1"}), "two-masses,3"));
}

TEST(Adding, AThirdEngineIsInTablesChartsFindingsAndMaps) {
  const TemporaryFolder folder("adding");
  const fs::path out = folder.path / "out";
  const ProgramResult end = run_program({CROSSCHECK_EXTENDED, "report", "two-masses", "--quick", "--out", out.string()},
                                        folder.path, {"CROSSCHECK_LOCK=" + (folder.path / "lock").string()});
  ASSERT_EQ(end.status, 0) << end.err;
  for (const char* table :
       {"engines", "energy", "speed-accuracy", "speed-accuracy-engines-cost", "stability", "stability-map"})
    EXPECT_TRUE(contains(read_file(out / "data" / (std::string(table) + ".csv"), "a table"), "toy/step")) << table;
  int figures = 0;
  EXPECT_EQ(looking_alike_in(out / "figures", figures), "");
  EXPECT_GE(figures, 13);
  // toy/step is the second built-in method with a spare style, after the new stepper; this is the style's dash
  const std::string chart = read_file(out / "figures/two-masses-error.gp", "a chart");
  EXPECT_TRUE(contains(chart, "toy/step"));
  EXPECT_TRUE(contains(chart, "(7,3,1,3,1,3)"));
  const std::string report = read_file(out / "report.json", "a report");
  for (const char* said : {"mysim, Bullet and Toy differ by at most ", "Toy's step needs ",
                           "Same rule, same step: Toy's step differs from mysim by at most ",
                           "For an error of 1 % of the motion Toy needs "})
    EXPECT_TRUE(contains(report, said)) << said;
  EXPECT_FALSE(contains(report, "of which Toy has none")) << "nothing is known about its rules";
}

TEST(Adding, AThirdEngineIsNewToItsBaselines) {
  const std::string regress = told({"regress", "spring", "--figures", "0"});
  EXPECT_TRUE(contains(regress, "new        toy/step: "));
  EXPECT_TRUE(contains(regress, ", 0 failed"));
}

}  // namespace
}  // namespace crosscheck::testing_tools
