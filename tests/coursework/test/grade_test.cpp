// From a submission to a result, on the smallest assignment: every way to fail has its message and costs its own part.
#include "tests/coursework/grader/grade.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/text_format.h"
#include "tests/coursework/test/helpers.h"
#include "tests/coursework/test/tiny/tiny_assignment.h"

namespace coursework {
namespace {

Result graded(const std::map<std::string, std::string>& changed = {}, std::uint64_t seed = 7) {
  // bare: what is tried here is the grader, not the walls
  const auto lane = choose_lane("bare", true);
  return grade(tiny(), submission_of(tiny(), changed), *lane, options_for(tiny(), seed));
}

double earned_by(const Result& result, const std::string& part) {
  double sum = 0;
  for (const TestResult& test : result.tests)
    if (test.part == part) sum += test.earned;
  return sum;
}

TEST(Grade, SolutionEarnsAllOnAnySeed) {
  for (const std::uint64_t seed : {0, 1, 2, 3}) {
    const Result result = graded({}, seed);
    EXPECT_EQ(result.earned(), 100);
    EXPECT_EQ(result.points(), 100);
    EXPECT_TRUE(result.complete);
    EXPECT_TRUE(result.preflight.empty());
  }
}

struct Failing {
  const char* what;
  const char* source;  // of twice.cpp
  const char* says;
};

TEST(Grade, EveryWayToFailHasItsMessageAndCostsItsOwnPart) {
  const std::string head = "#include \"tiny.h\"\n#include <cstdlib>\n#include <cstdio>\n#include <stdexcept>\n";
  const Failing table[] = {
      {"wrong", "double twice(double x) { return x + 1; }", "First difference at double: expected "},
      {"missing", "", "twice.cpp is missing, so"},
      {"does not compile", "double twice(double x) { return 2 * y; }", "twice.cpp, line 5: 'y' was not declared"},
      {"not defined", "double Twice(double x) { return 2 * x; }", "twice.cpp does not define twice(double)"},
      {"own main", "double twice(double x) { return 2 * x; } int main() {}", "twice.cpp defines main()"},
      {"defined twice",
       "#include <vector>\nstd::vector<double> sums(const std::vector<double>& n) { return n; }\n"
       "double twice(double x) { return 2 * x; }",
       "twice.cpp defines sums("},
      {"crash", "double twice(double x) { volatile int* p = nullptr; return *p + x; }", "crashed (segmentation fault)"},
      {"loop", "double twice(double x) { for (volatile int i = 0;;) i = 1; return x; }", "did not come to an end"},
      {"throws", "double twice(double) { throw std::runtime_error(\"not today\"); }", "exception: not today"},
      {"nan", "double twice(double x) { return x / 0.0 * 0.0; }", "Not a finite number at double"},
      {"memory", "double twice(double x) { std::vector<double> v(20000000000ull, x); return v[1]; }", "more memory"},
      {"exit", "double twice(double) { std::exit(0); }", "ended the program before"},
      {"quick exit", "double twice(double) { std::_Exit(0); }", "ended the program before"},
      {"chatter", "double twice(double) { for (;;) std::puts(\"all tests passed\"); }", "far too much output"},
  };
  for (const Failing& one : table) {
    const std::string source = *one.source ? head + one.source : "";
    const Result result = graded({{"twice.cpp", source}});
    EXPECT_EQ(earned_by(result, "twice"), 0) << one.what;
    EXPECT_EQ(earned_by(result, "sums"), 50) << one.what;
    EXPECT_NE(result.tests[0].said.find(one.says), std::string::npos) << one.what << ": " << result.tests[0].said;
  }
}

TEST(Grade, KnownMistakesLoseTheirTestsAndAreNamed) {
  for (const Mistake& mistake : mistakes_of(tiny())) {
    const std::string file = mistake.part + ".cpp";
    const std::string solution = content_of_file(tiny().folder() / "solution" / file);
    const Result result = graded({{file, with_mistake(solution, mistake)}});
    for (const TestResult& test : result.tests) {
      const bool loses = std::count(mistake.loses.begin(), mistake.loses.end(), test.id) > 0;
      EXPECT_EQ(test.earned, loses ? 0 : test.points) << mistake.name << " " << test.id;
      const std::string cause = "Likely cause: " + options_for(tiny(), 0).own.of("mistake." + mistake.name);
      EXPECT_EQ(test.cause, loses ? cause : "") << mistake.name << " " << test.id;
    }
  }
}

TEST(Grade, OtherMistakesAndTwoAtOnceAreGivenNoName) {
  const std::string solution = content_of_file(tiny().folder() / "solution/sums.cpp");
  std::vector<Mistake> known = mistakes_of(tiny());
  const std::string two = with_mistake(with_mistake(solution, known[1]), known[3]);
  const std::string other = with_mistake(solution, {"other", "sums", "double sum = 0;", "double sum = 3;", {}});
  for (const std::string& source : {two, other}) {
    const Result result = graded({{"sums.cpp", source}});
    EXPECT_EQ(earned_by(result, "twice"), 50);
    EXPECT_EQ(result.tests[1].earned, 0);
    EXPECT_EQ(result.tests[1].cause, common_texts().of("no_cause"));
  }
}

TEST(Grade, ResultIsThereAfterEveryTest) {
  const auto lane = choose_lane("bare", true);
  GradeOptions options = options_for(tiny(), 7);
  std::vector<double> earned;
  std::vector<std::string> said;
  options.so_far = [&](const Result& result) {
    earned.push_back(result.earned());
    said.push_back(total_of(result, options.common));
  };
  grade(tiny(), submission_of(tiny()), *lane, options);
  EXPECT_EQ(earned, (std::vector<double>{0, 30, 50, 65, 85, 95, 100, 100}));
  EXPECT_NE(said[1].find("Public tests so far: 1 of 3 passed; 3 more tests run later."), std::string::npos) << said[1];
  EXPECT_NE(said[3].find("All public tests passed; 3 more run later."), std::string::npos) << said[3];
  EXPECT_EQ(said[6], "Total: 100 of 100 points");
}

TEST(Grade, HiddenTestsAskOtherNumbersOnEachSeedAndPublicOnesTheSame) {
  const coursework::Test& test = tiny().tests[0];
  auto first = [&](std::uint64_t seed) {
    Random random(seed);
    return test.cases(random)[0].in;
  };
  EXPECT_NE(first(hidden_seed(1, test)), first(hidden_seed(2, test)));
  EXPECT_NE(first(hidden_seed(1, test)), first(public_seed(tiny(), test)));
  EXPECT_NE(hidden_seed(1, test), hidden_seed(1, tiny().tests[1]));
  // code that knows the public numbers by heart earns nothing
  std::string source = "#include \"tiny.h\"\ndouble twice(double x) {\n";
  Random random(public_seed(tiny(), test));
  for (const Case& c : test.cases(random)) {
    char line[99];
    std::snprintf(line, sizeof line, "  if (x == %a) return %a;\n", c.in[0], c.expected[0]);
    source += line;
  }
  const Result result = graded({{"twice.cpp", source + "  return 0;\n}\n"}});
  EXPECT_EQ(earned_by(result, "twice"), 0);
  EXPECT_EQ(result.tests[0].said, common_texts().of("shown_only"));
}

}  // namespace
}  // namespace coursework
