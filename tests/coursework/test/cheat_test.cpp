// Each trick of cheats/ earns nothing on the part it cheats, harms no other part, and leaves nothing behind.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <sstream>

#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/grade.h"
#include "tests/coursework/test/canaries.h"
#include "tests/coursework/test/lanes.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

std::vector<std::string> cheats() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(COURSEWORK_FOLDER) / "cheats"))
    if (entry.path().extension() == ".cpp") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// The assignment with a few of its tests: what a trick does, it does in each.
struct Few {
  Few() : assignment(find_assignment("a1-steppers")) {
    for (const Test& test : assignment.tests)
      for (const char* id : {"1.1", "1.4", "2.1", "3.1"})
        if (test.id == id) tests.push_back(test);
    assignment.tests = tests;
  }
  std::vector<Test> tests;
  Assignment assignment;
};

/// Rows {t, h, x, next} of the public tests' inputs and answers, where a call is one step of a system.
std::string public_table(const Assignment& assignment) {
  std::ostringstream out;
  out.precision(17);
  const auto list = [&out](const double* from, std::size_t n) {
    out << '{';
    for (std::size_t i = 0; i < n; ++i) out << from[i] << ", ";
    out << '}';
  };
  for (const Test& test : assignment.tests) {
    Random random(public_seed(assignment, test));
    for (const Case& each : test.cases(random)) {
      if (each.call != "euler.linear") continue;
      const auto n = static_cast<std::size_t>(each.in[0]);
      out << '{' << each.in[2] << ", " << each.in[3] << ", ";
      list(&each.in[4], n);
      out << ", ";
      list(each.expected.data(), n);
      out << "},\n";
    }
  }
  return out.str();
}

class CheatTest : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  static std::string lane_name() { return std::get<0>(GetParam()); }
  static fs::path cheat() { return fs::path(COURSEWORK_FOLDER) / "cheats" / (std::get<1>(GetParam()) + ".cpp"); }

  /// The cheat as a student would hand it in: one file, with all that could be known about this machine.
  std::string source() const {
    std::string text = content_of_file(cheat());
    std::string shared = content_of_file(cheat().parent_path() / "cheat.h");
    shared = replaced(shared, "#pragma once", "");
    text = replaced(text, "#include \"cheat.h\"", shared);
    text = replaced(text, "#include \"public_table.inc\"", public_table(few_.assignment));
    return "#define RESULTS \"" + canaries_.results().string() + "\"\n#define HOME_FOLDER \"" +
           canaries_.home().string() + "\"\n#define TESTS \"" + canaries_.tests().string() + "\"\n" + text;
  }

  Few few_;
  Canaries canaries_;
};

/// What its second line says: keys of the texts, any of which will do. Wrong numbers may be wrong in number as well.
std::vector<std::string> expected(const fs::path& cheat) {
  std::istringstream lines(content_of_file(cheat));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  std::istringstream words(line.substr(std::string("// says: ").size()));
  std::vector<std::string> keys{std::istream_iterator<std::string>(words), {}};
  if (std::find(keys.begin(), keys.end(), "differs") != keys.end()) keys.insert(keys.end(), {"size", "shown_only"});
  return keys;
}

/// Whether a sentence was made from one of the texts under these keys.
bool says(const Texts& common, const std::string& said, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    const std::string& text = common.of(common.has("how." + key) ? "how." + key : key);
    if (said.find(text.substr(0, text.find('{'))) != std::string::npos) return true;
  }
  return false;
}

TEST_P(CheatTest, EarnsNothingAndHarmsNothing) {
  adopt_orphans();
  std::unique_ptr<Lane> lane;
  try {
    lane = choose_lane(lane_name(), false);
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();
  }
  ASSERT_FALSE(sees(*lane, canaries_.tests()));
  ASSERT_FALSE(sees(*lane, canaries_.results()));
  Submission submission;
  submission.name = cheat().stem().string();
  submission.files["euler.cpp"] = source();
  for (const char* part : {"trapezoidal.cpp", "rk4.cpp"})
    submission.files[part] = content_of_file(canaries_.tests() / "solution" / part);
  GradeOptions options;
  options.seed = 7;
  options.common = Texts::read((fs::path(COURSEWORK_FOLDER) / "check/common.en.txt").string());
  const Result result = grade(few_.assignment, submission, *lane, options);
  ASSERT_TRUE(result.complete);
  for (const TestResult& test : result.tests) {
    const bool cheated = test.part == "euler";
    EXPECT_EQ(test.earned, cheated ? 0 : test.points)
        << test.id << ' ' << (test.hidden ? "hidden: " : "public: ") << test.said;
    if (cheated) {
      EXPECT_TRUE(says(options.common, test.said, expected(cheat()))) << test.id << ": " << test.said;
    }
    EXPECT_EQ(test.said.find("root:"), std::string::npos) << test.said;
  }
  EXPECT_EQ(canaries_.harm(), "");
  EXPECT_EQ(left_running(), std::set<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Each, CheatTest,
                         testing::Combine(testing::Values("bwrap", "uid"), testing::ValuesIn(cheats())),
                         [](const auto& of) { return std::get<0>(of.param) + "_" + std::get<1>(of.param); });

}  // namespace
}  // namespace coursework
