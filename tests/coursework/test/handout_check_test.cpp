// Hand-outs built as students build them: their `check` reports what the grader reports.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "mysim/base/files.h"
#include "tests/coursework/check/judge.h"
#include "tests/coursework/check/texts.h"
#include "tests/coursework/check/words.h"
#include "tests/coursework/classic/whole_program.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/grade.h"
#include "tests/coursework/grader/handout.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/run.h"
#include "tests/coursework/test/helpers.h"

namespace coursework {
namespace {

namespace fs = std::filesystem;

struct Ran {
  int code = -1;
  std::string said;
};

Ran run(const std::string& command) {
  Ran ran;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("popen: " + command);
  char block[4096];
  for (size_t got; (got = fread(block, 1, sizeof block, pipe)) > 0;) ran.said.append(block, got);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) ran.code = WEXITSTATUS(status);
  return ran;
}

/// A hand-out in a folder, whose files the tests replace as students would.
class Given {
 public:
  explicit Given(const Assignment& assignment) { write_handout(assignment, folder); }

  void put(const classic::Files& files) const {
    for (const auto& [file, content] : files)  // unchanged files are not built again
      if (!fs::exists(folder / file) || content_of_file(folder / file) != content)
        crosscheck::write_file(folder / file, content);
  }
  /// Builds what has changed, and runs `check`. Builds without optimisation, because this compiles fastest.
  Ran check(const std::string& which = "") const {
    const std::string here = folder.string();
    const Ran built =
        run("cmake -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-Werror -S " + here + " -B " + here + "/build");
    if (built.code != 0) return built;
    const Ran made = run("cmake --build " + here + "/build -j 2");
    return made.code != 0 ? made : run(here + "/build/check " + which);
  }

  crosscheck::TemporaryFolder scratch{"handout"};
  fs::path folder = scratch.path / "given";
};

/// The number of points that the README promises: "63" from "..., 63 points in all".
std::string promised(const fs::path& folder) {
  const std::string text = content_of_file(folder / "README.md");
  const size_t end = text.find(" points in all"), begin = text.rfind(' ', end - 1) + 1;
  return text.substr(begin, end - begin);
}

TEST(HandoutCheck, CountsThePointsThatTheReadmePromises) {
  for (const Assignment& assignment : assignments()) {
    const Given handout(assignment);
    std::ifstream in(handout.folder / "check/public_cases.txt");
    int counted = 0;
    for (const PublicTest& test : read_cases(in).tests) counted += test.cases.empty() ? 0 : test.points;
    EXPECT_EQ(promised(handout.folder), std::to_string(counted)) << assignment.name;
  }
  const Given given(find_assignment("a1-steppers"));
  const Ran starter = given.check();
  EXPECT_NE(starter.said.find("Total: 0 of " + promised(given.folder) + " points"), std::string::npos) << starter.said;
}

/// For each plot of the page: true if the student's curve deviates from the right one by more than a pixel somewhere.
std::vector<bool> curves_apart(const fs::path& page) {
  const std::string text = content_of_file(page);
  std::vector<bool> apart;
  std::vector<double> before;
  bool second = false;
  for (size_t at = 0; (at = text.find(" d=\"M", at)) != std::string::npos; second = !second) {
    at += 4;
    std::string path = text.substr(at, text.find('"', at) - at);
    for (char& c : path)
      if (c == 'M' || c == 'L') c = ' ';
    std::istringstream in(path);
    const std::vector<double> points{std::istream_iterator<double>(in), {}};
    if (second) {
      bool far = points.size() != before.size();
      for (size_t i = 0; !far && i < points.size(); ++i) far = std::abs(points[i] - before[i]) > 1;
      apart.push_back(far);
    }
    before = points;
  }
  return apart;
}

/// The grader's feedback on the first wrong public case of a test; empty if all cases are right.
std::string said_by_grader(const Assignment& assignment, const coursework::Test& test, const fs::path& program,
                           const Sandbox& sandbox) {
  const GradeOptions options = options_for(assignment, 1);
  const std::vector<Case> cases = public_cases(assignment, test);
  const std::vector<Answer> answers = run_calls(sandbox, program, cases);
  for (size_t i = 0; i < cases.size(); ++i) {
    const Answer answer = reduced(test, cases[i], answers[i]);
    const Judged judged = judge(cases[i], answer);
    if (judged.right) continue;
    const std::string which =
        cases.size() > 1 ? options.common.fill("which", std::to_string(i + 1), std::to_string(cases.size())) + " " : "";
    return which + words(options.common, options.own, cases[i], answer, judged);
  }
  return "";
}

TEST(HandoutCheck, SaysOfAWholeProgramWhatTheGraderSays) {
  const Assignment& assignment = find_assignment("classic");
  const Texts texts = options_for(assignment, 1).own;
  const Given given(assignment);
  int points = 0;
  for (const coursework::Test& test : assignment.tests) points += test.points;
  const auto total = [&](int earned) {
    return "\nTotal: " + std::to_string(earned) + " of " + std::to_string(points) + " points\n";
  };
  const auto line = [&](const coursework::Test& test, const std::string& what, int earned) {
    const std::string id(test.id);
    return "\n  " + id + " " + texts.of(id + ".title") + ": " + what + ", " + std::to_string(earned) + " of " +
           std::to_string(test.points) + " points\n";
  };

  const Ran starter = given.check();
  EXPECT_EQ(starter.code, 1) << starter.said;
  EXPECT_NE(starter.said.find(total(0)), std::string::npos) << starter.said;

  // one mistake in each of the student's files
  const classic::Files solution = classic::files_below(assignment.folder() / "solution");
  classic::Files wrong = solution;
  std::map<std::string, Mistake> made;  // by part
  std::set<std::string> lost;
  for (const Mistake& mistake : mistakes_of(assignment))
    for (const char* name : {"trapezoidal-second-slope-at-half", "simple-ignores-its-argument",
                             "chain-all-on-the-first", "cloth-shear-one-way"})
      if (mistake.name == name) {
        std::string& source = wrong.at(classic::file_of_part(mistake.part));
        source = with_mistake(source, mistake);
        made[mistake.part] = mistake;
        lost.insert(mistake.loses.begin(), mistake.loses.end());
      }
  ASSERT_EQ(made.size(), 4u);
  given.put(wrong);
  const Ran failing = given.check();
  EXPECT_EQ(failing.code, 1) << failing.said;
  const auto sandbox = choose_sandbox("bare", true);
  const auto builder = builder_for(assignment, *sandbox, *sandbox);
  int earned = 0;
  for (const coursework::Test& test : assignment.tests) {
    if (!lost.count(std::string(test.id))) {
      EXPECT_NE(failing.said.find(line(test, "passed", test.points)), std::string::npos) << test.id << failing.said;
      earned += test.points;
      continue;
    }
    const std::string part(test.part), source = solution.at(classic::file_of_part(part));
    const std::string said =
        said_by_grader(assignment, test, builder->ours(part, with_mistake(source, made.at(part))), *sandbox);
    EXPECT_NE(said, "") << test.id;
    EXPECT_NE(failing.said.find(line(test, "failed", 0) + "      " + said + "\n"), std::string::npos)
        << test.id << ": " << said << "\n"
        << failing.said;
  }
  EXPECT_NE(failing.said.find(total(earned)), std::string::npos) << failing.said;
  // Euler's rule is right, with round and other numbers; the trapezoidal rule is wrong, and so are all motions that it
  // computes
  EXPECT_EQ(curves_apart(given.folder / "mine.html"), (std::vector<bool>{false, false, true, true, true}));

  given.put(solution);
  const Ran right = given.check();
  EXPECT_EQ(right.code, 0) << right.said;
  EXPECT_NE(right.said.find(total(points)), std::string::npos) << right.said;
  EXPECT_EQ(curves_apart(given.folder / "mine.html"), std::vector<bool>(6, false));

  // if a student submits the whole folder, the selection contains no file of ours
  const classic::Selection chosen = classic::choose_files(read_submission(given.folder, {}).files);
  for (const auto& [path, content] : chosen.files)
    EXPECT_TRUE(solution.count(path) || path.starts_with("vecmath/")) << path;
  EXPECT_TRUE(chosen.notes.empty());

  classic::Files crashing = solution;
  std::string& simple = crashing.at("simpleSystem.cpp");
  simple = with_mistake(simple, {"crash", "simple", "  vector<Vector3f> f;", "  vector<Vector3f> f; abort();", {}});
  given.put(crashing);
  const Ran crash = given.check("simple");
  EXPECT_EQ(crash.code, 3);
  const size_t last = crash.said.rfind("\n  3.1 " + texts.of("3.1.title") + ": \n");
  ASSERT_NE(last, std::string::npos) << crash.said;
  EXPECT_NE(crash.said.find("Your code crashed", last), std::string::npos) << crash.said;
  EXPECT_EQ(crash.said.find("3.2 "), std::string::npos) << crash.said;
}

}  // namespace
}  // namespace coursework
