// Hand-outs contain what students need, and nothing secret.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/commands.h"
#include "tests/coursework/grader/grade.h"
#include "tests/coursework/grader/handout.h"
#include "tests/coursework/test/helpers.h"

namespace coursework {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  return files;
}

/// True for heads of loops, includes and declarations, which code on the same subject has in common.
bool says_little(const std::string& line) {
  return (line.starts_with("for (") && line.ends_with("{")) || line.starts_with("#include ") ||
         (line.starts_with("struct ") && line.ends_with(";"));
}

/// Lines without indentation that are too long to coincide by chance.
std::set<std::string> telling_lines(const fs::path& file) {
  std::set<std::string> lines;
  std::istringstream in(content_of_file(file));
  for (std::string line; std::getline(in, line);) {
    const size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos) continue;
    line = line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
    if (line.size() >= 16 && !says_little(line)) lines.insert(line);
  }
  return lines;
}

struct Handout {
  crosscheck::TemporaryFolder scratch{"handout"};
  fs::path folder = scratch.path / "given";
  explicit Handout(const Assignment& assignment) { write_handout(assignment, folder); }
  std::string all() const {
    std::string text;
    for (const fs::path& file : files_below(folder)) text += content_of_file(file) + "\n";
    return text;
  }
};

TEST(Handout, HoldsWhatTheStudentNeeds) {
  ASSERT_FALSE(assignments().empty());
  for (const Assignment& assignment : assignments()) {
    const Handout handout(assignment);
    std::vector<std::string> wanted = {
        "handout.md",           "README.md",          "CMakeLists.txt",     "check/public_cases.txt",
        "check/check_main.cpp", "check/texts.en.txt", "check/common.en.txt"};
    if (assignment.takes_whole_program())
      wanted.insert(wanted.end(), {"ClothSystem.h", "vecmath/vecmath.h", "check/stubs/GL/glut.h", "check/probe/own.h"});
    else
      for (const Part& part : assignment.parts) wanted.push_back(std::string(part.name) + ".cpp");
    for (const std::string& file : wanted) EXPECT_TRUE(fs::exists(handout.folder / file)) << assignment.name << file;
    std::ifstream in(handout.folder / "check/public_cases.txt");
    const PublicTests tests = read_cases(in);
    const std::string lecture = content_of_file(handout.folder / "handout.md");
    for (const PublicTest& test : tests.tests)
      EXPECT_NE(lecture.find(" " + test.read + "\n"), std::string::npos) << test.id << ": no heading " << test.read;
  }
}

/// A line is secret if it occurs in a file that is not handed out, and in no file that is handed out.
TEST(Handout, HasNoLineOfSolutionStylesMistakesAndTests) {
  for (const Assignment& assignment : assignments()) {
    std::set<std::string> secret;
    std::string shown, judging;  // texts of whole files, because a line may be the beginning of a longer one
    const fs::path from = assignment.folder();
    std::vector<fs::path> secrets;
    for (const fs::path& file : files_below(from)) {
      const std::string inside = fs::relative(file, from).generic_string();
      bool given = false;
      for (const char* begin : {"handout.", "starter/", "calls", "texts.", "stubs/"})
        given = given || inside.starts_with(begin);
      // the code that judges a whole program's answers by their features is also handed out
      bool judges = false;
      if (assignment.takes_whole_program())
        for (const char* begin : {"probe/", "looks", "motion", "oracles", "replay", "shapes", "springs"})
          judges = judges || inside.starts_with(begin);
      if (given || judges)
        (given ? shown : judging) += content_of_file(file) + "\n";
      else
        secrets.push_back(file);
    }
    for (const fs::path& file : files_below(from.parent_path() / "check")) shown += content_of_file(file) + "\n";
    for (const fs::path& file : secrets) {
      // The grader's own sources may share lines with the code that judges. A line of a solution there is a leak.
      const std::string inside = fs::relative(file, from).generic_string();
      const bool ours =
          (inside.starts_with("base/") || inside.find('/') == std::string::npos) && file.extension() != ".txt";
      const std::string known = ours ? shown + judging : shown;
      for (const std::string& line : telling_lines(file))
        if (known.find(line) == std::string::npos) secret.insert(line);
    }
    // the hand-out's texts omit descriptions of mistakes
    const Texts texts = Texts::read((from / "texts.en.txt").string());
    int mistakes = 0;
    for (const auto& [key, text] : texts.all())
      if (key.starts_with("mistake.")) secret.insert(key), secret.insert(text), ++mistakes;
    EXPECT_GE(secret.size(), 100u) << "what is looked for has gone";
    EXPECT_GE(mistakes, 12) << assignment.name;
    const Handout handout(assignment);
    const std::string all = handout.all();
    std::set<std::string> lines;
    for (const fs::path& file : files_below(handout.folder)) lines.merge(telling_lines(file));
    for (const std::string& line : secret) {
      // the head of a plain loop may occur in another line by chance; a longer text does not
      const bool found = line.size() < 32 ? lines.count(line) > 0 : all.find(line) != std::string::npos;
      EXPECT_FALSE(found) << assignment.name << ": " << line;
    }
  }
}

/// True for a short decimal number, up to rounding: zero, 0.2, 1.5.
bool is_plain(double value) { return std::abs(value) < 1e-12 || fmt::format("{:.12g}", value).size() <= 6; }

/// Numbers of a file of public tests that have many digits, as written in the file.
std::set<std::string> long_numbers(const PublicTests& tests) {
  std::ostringstream out;
  write_cases(out, tests);
  std::istringstream in(out.str());
  std::set<std::string> numbers;
  for (std::string word; in >> word;)
    if (word.size() > 12 && word.find_first_not_of("0123456789.e+-") == std::string::npos && !is_plain(std::stod(word)))
      numbers.insert(word);
  return numbers;
}

TEST(Handout, HasNoHiddenNumber) {
  for (const Assignment& assignment : assignments()) {
    auto hidden = [&](std::uint64_t seed) {
      PublicTests tests;
      for (const coursework::Test& test : assignment.tests) {
        Random random(hidden_seed(seed, test));
        tests.tests.push_back({std::string(test.id), "", "", 1, test.cases(random)});
      }
      return long_numbers(tests);
    };
    // probes draw their states from their last input
    for (const coursework::Test& test : assignment.tests) {
      if (!test.reduce || !assignment.takes_whole_program()) continue;
      Random shown(public_seed(assignment, test)), later(hidden_seed(1, test));
      EXPECT_NE(test.cases(shown).at(0).in.back(), test.cases(later).at(0).in.back()) << test.id;
    }
    const std::set<std::string> one = hidden(1), other = hidden(2);
    const std::set<std::string> given = long_numbers(public_tests(assignment));
    const std::string all = Handout(assignment).all();
    EXPECT_GT(one.size(), 50u) << assignment.name;
    for (const std::string& number : one) {
      // a number that is identical for every seed is a constant of the test, not a secret
      if (other.count(number)) continue;
      EXPECT_EQ(given.count(number), 0u) << assignment.name << ": " << number;
      EXPECT_EQ(all.find(number), std::string::npos) << assignment.name << ": " << number;
    }
  }
}

TEST(Handout, DoesNotWriteOverAnythingOfOthers) {
  const crosscheck::TemporaryFolder scratch("handout");
  const Assignment &one = assignments()[0], &other = assignments()[1];
  const std::string folder = (scratch.path / "given").string();
  const auto refusal = [&](const Assignment& assignment) -> std::string {
    try {
      assignment_command({.assignment = std::string(assignment.name), .out = folder});
    } catch (const crosscheck::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(one), "");
  crosscheck::write_file(fs::path(folder) / "README.md", "the lecturer's own words");
  EXPECT_EQ(refusal(one), "");
  EXPECT_EQ(content_of_file(fs::path(folder) / "README.md.yours"), "the lecturer's own words");
  EXPECT_NE(refusal(other).find(fmt::format("holds a result of crosscheck assignment {}", one.name)),
            std::string::npos);
  fs::remove(fs::path(folder) / "crosscheck.json");
  EXPECT_NE(refusal(one).find("give an empty or a new folder"), std::string::npos);
}

}  // namespace
}  // namespace coursework
