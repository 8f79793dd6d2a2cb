// Grading of submissions and whole classes: every failure has its message and costs only its own part.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "mysim/base/files.h"
#include "tests/coursework/grader/class.h"
#include "tests/coursework/grader/grade.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/result.h"
#include "tests/coursework/grader/run.h"
#include "tests/coursework/grader/suspects.h"
#include "tests/coursework/test/helpers.h"
#include "tests/coursework/test/program.h"
#include "tests/coursework/test/tiny/tiny_assignment.h"

namespace coursework {
namespace {

Result graded(const std::map<std::string, std::string>& changed = {}, std::uint64_t seed = 7,
              double least_cpu = GradeOptions().least_cpu) {
  // these tests are about the grader, not about isolation
  const auto sandbox = choose_sandbox("bare", true);
  GradeOptions options = options_for(tiny(), seed);
  options.least_cpu = least_cpu;
  return grade(tiny(), submission_of(tiny(), changed), *sandbox, options);
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
  const char* source;  // content of twice.cpp
  const char* says;
};

// Endless loops have a separate test below.
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
      {"crash", "double twice(double x) { volatile int* p = nullptr; return *p + x; }",
       "crashed (segmentation fault). A second run ends in line 5 of twice.cpp."},
      {"index",
       "#include <vector>\ndouble twice(double x) { std::vector<double> all(3, x);\n  return all[1] + all[x < 99 ? 3 : "
       "2]; }",
       "crashed (aborted). A second run, with every index checked, shows that line 7 of twice.cpp asks for index 3 of "
       "3 "
       "elements."},
      {"throws", "double twice(double) { throw std::runtime_error(\"not today\"); }", "exception: not today"},
      {"recursion", "double twice(double x) { return twice(x) + 1; }", "a function called itself"},
      {"compiler's memory", "__asm__(\".rept 400000000\\n.quad 0\\n.endr\"); double twice(double x) { return x; }",
       "the compiler needed more than 1024 MB"},
      {"our words", "double twice(double) { throw std::runtime_error(std::string(300, 'q')); }",
       "its message is not shown"},
      {"nan", "double twice(double x) { return x / 0.0 * 0.0; }", "Not a finite number at double"},
      {"memory", "double twice(double x) { std::vector<double> v(20000000000ull, x); return v[1]; }", "more memory"},
      {"exit", "double twice(double) { std::exit(0); }", "ended the program before"},
      {"quick exit", "double twice(double) { std::_Exit(0); }", "ended the program before"},
      {"output", "double twice(double) { for (;;) std::puts(\"all tests passed\"); }", "far too much output"},
  };
  for (const Failing& one : table) {
    const std::string source = *one.source ? head + one.source : "";
    const Result result = graded({{"twice.cpp", source}});
    EXPECT_EQ(earned_by(result, "twice"), 0) << one.what;
    EXPECT_EQ(earned_by(result, "sums"), 50) << one.what;
    EXPECT_NE(result.tests[0].said.find(one.says), std::string::npos) << one.what << ": " << result.tests[0].said;
  }
}

// As in the hand-out, students may add headers next to the parts, even under the names of our headers, and may call
// functions that an earlier part defines.
TEST(Grade, OwnHeadersAreTakenAndOursAreNotReplaced) {
  Submission submission =
      submission_of(tiny(), {{"twice.cpp",
                              "#include \"own/case.h\"\ndouble twice(double x) { return two * x; }\n"
                              "double half(double x) { return x / two; }\n"},
                             {"sums.cpp",
                              "#include <calls.h>\n#include \"tiny.h\"\n"
                              "std::vector<double> sums(const std::vector<double>& n) {\n  std::vector<double> all;\n"
                              "  double sum = 0;\n  for (double x : n) all.push_back(sum += half(twice(x)));\n"
                              "  return all;\n}\n"}});
  submission.files["own/case.h"] = "#include \"tiny.h\"\nconst double two = 2;\n";
  submission.files["calls.h"] = "double half(double);\nnamespace coursework { struct Case {}; struct Unusable {}; }\n";
  submission.files["tiny.h"] = "#error this one is ours\n";
  const auto sandbox = choose_sandbox("bare", true);
  const Result result = grade(tiny(), submission, *sandbox, options_for(tiny(), 7));
  EXPECT_EQ(result.earned(), 100) << text_of(result, common_texts());
  // in a separate source
  submission.files["twice.cpp"] = "double twice(double x) { return 2 * x; }";
  submission.files["half.cpp"] =
      "#include \"calls.h\"\ndouble half(double x) { return x / 2; }\nint main() {}\n"
      "double twice(double) { return 0; }\n";
  const Result beside = grade(tiny(), submission, *sandbox, options_for(tiny(), 7));
  EXPECT_EQ(beside.earned(), 100) << text_of(beside, common_texts());
  submission.files["calls.h"] = "inline double half(double x) { return y / 2; }\n";
  const Result wrong = grade(tiny(), submission, *sandbox, options_for(tiny(), 7));
  EXPECT_EQ(earned_by(wrong, "twice"), 50);
  EXPECT_NE(wrong.remark.find("calls.h, line 1: 'y' was not declared"), std::string::npos) << wrong.remark;
  submission.files.erase("calls.h");
  const Result without = grade(tiny(), submission, *sandbox, options_for(tiny(), 7));
  EXPECT_NE(without.remark.find("sums.cpp, line 1: calls.h was not found."), std::string::npos) << without.remark;
}

TEST(Grade, ThreadsAreAllowedUpToALimitThatIsNamed) {
  const std::string begin = "#include <future>\n#include <memory>\n#include <thread>\n#include \"tiny.h\"\n";
  const std::string many =
      "double twice(double x) {\n  std::vector<std::future<double>> all;\n  std::promise<void> go;\n"
      "  const std::shared_future<void> gone = go.get_future().share();\n  for (int i = 0; i < N; ++i)\n"
      "    all.push_back(std::async(std::launch::async, [x, gone] { gone.wait(); return x; }));\n"
      "  go.set_value();\n  double sum = 0;\n  for (auto& one : all) sum += one.get();\n"
      "  std::unique_ptr<double[]> mine;\n  std::thread t([&] { mine.reset(new double[50 << 20]); });\n  t.join();\n"
      "  return sum * 2 / N + (std::thread::hardware_concurrency() > 8);\n}\n";
  for (const char* name : {"bwrap", "uid"}) {
    std::unique_ptr<Sandbox> sandbox;
    try {
      sandbox = choose_sandbox(name, false);
    } catch (const std::runtime_error&) {
      continue;
    }
    for (const bool too_many : {false, true}) {
      const std::string count = std::to_string(Limits{}.threads + (too_many ? 0 : -2));
      const Submission submission =
          submission_of(tiny(), {{"twice.cpp", begin + "const int N = " + count + ";\n" + many}});
      const Result result = grade(tiny(), submission, *sandbox, options_for(tiny(), 7));
      EXPECT_EQ(earned_by(result, "twice"), too_many ? 0 : 50) << name << ": " << text_of(result, common_texts());
      if (too_many) {
        EXPECT_NE(result.tests[0].said.find("it may have " + std::to_string(Limits{}.threads) + " at once"),
                  std::string::npos)
            << name << ": " << result.tests[0].said;
      }
    }
  }
}

/// Code that is eight hundred times as slow as the official solution, but far below every limit.
const char* const slow_sums =
    "#include \"tiny.h\"\n"
    "std::vector<double> sums(const std::vector<double>& n) {\n"
    "  std::vector<double> all;\n  double sum = 0;\n  volatile double burnt = 0;\n"
    "  for (int i = 0; i < 100000000; ++i) burnt = burnt + i;\n"
    "  for (double x : n) all.push_back(sum += x);\n  return all;\n}\n";

TEST(Grade, SlowCodeHasTheSamePointsIdleAndUnderALoadOfEight) {
  const Result idle = graded({{"sums.cpp", slow_sums}});
  std::atomic<bool> stop = false;
  std::vector<std::thread> busy;
  for (int i = 0; i < 8; ++i)
    busy.emplace_back([&] {
      while (!stop) {
      }
    });
  const Result loaded = graded({{"sums.cpp", slow_sums}});
  stop = true;
  for (std::thread& each : busy) each.join();
  EXPECT_EQ(idle.earned(), 100) << text_of(idle, common_texts());
  EXPECT_EQ(loaded.earned(), 100) << text_of(loaded, common_texts());
}

TEST(Grade, ALoopWithoutEndIsNotGradedAndNotRunAgain) {
  EXPECT_EQ(GradeOptions().least_cpu, 30);  // the READMEs promise 30 s, which is too long for a test
  const Result result =
      graded({{"twice.cpp", "double twice(double x) { for (volatile int i = 0;;) i = 1; return x; }"}}, 7, 2);
  EXPECT_EQ(earned_by(result, "twice"), 0);
  EXPECT_EQ(earned_by(result, "sums"), 50);
  EXPECT_EQ(result.ungraded(), 50);
  double seconds = 0;
  for (const TestResult& test : result.tests) {
    EXPECT_EQ(test.ungraded, test.part == "twice") << test.id;
    EXPECT_EQ(test.cause, "");
    seconds += test.seconds;
  }
  const std::string& said = result.tests[0].said;
  EXPECT_NE(said.find("Not graded: your code was too slow. It was stopped after 2 s of CPU time; the official "
                      "solution needs 0."),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("The last function called is twice; this was call number 1."), std::string::npos) << said;
  EXPECT_EQ(result.tests.back().part == "twice" ? result.tests.back().said : result.tests[3].said,
            "Not graded: it makes the same calls as test " + result.tests[0].id + ", which was not graded.");
  const std::string text = text_of(result, common_texts());
  EXPECT_NE(text.find("Total: 50 of 50 points\n50 more points are undecided"), std::string::npos) << text;
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

// A cause is reported if an experiment proves it, but not if the answers merely resemble its effect.
TEST(Grade, CausesAreFoundByExperiment) {
  const std::pair<const char*, Remark> table[] = {
      {"const float single = static_cast<float>(x); return 2 * single;", {"suspect.float", {}}},
      {"const float third = 1.0f / 3;\nreturn 6 * x * third;", {"suspect.float_line", {"twice.cpp", "3"}}},
      {"const float third = 1.0f / 4;\nreturn 6 * x * third;", {"no_cause", {}}},
      {"static const double kept = x; return 2 * kept;", {"suspect.state", {}}},
      {"return 2 * x * 1.000001;", {"no_cause", {}}},
      {"return 2 * x + 100;", {"no_cause", {}}},
      {"return 4 * x *\n(1 / 2);", {"suspect.integer", {"twice.cpp", "4"}}},
      {"return 5 * x * (1 / 2);", {"no_cause", {}}},
      {"volatile double right = 90; return 2 * x * std::sin(right);", {"suspect.degrees", {}}},
      {"volatile double right = 80; return 2 * x * std::sin(right);", {"no_cause", {}}},
  };
  for (const auto& [body, key] : table) {
    const Result result = graded(
        {{"twice.cpp", std::string("#include \"tiny.h\"\n#include <cmath>\ndouble twice(double x) { ") + body + " }"}});
    int wrong = 0;
    for (const TestResult& test : result.tests)
      if (test.part == "twice" && !passed(test) && !test.cause.empty()) {
        ++wrong;
        EXPECT_EQ(test.cause, said(common_texts(), key)) << body << " " << test.id;
      }
    EXPECT_GT(wrong, 0) << body;
  }
}

// Angles are in radians: code that converts them from degrees is right for inputs multiplied by 180 / pi.
TEST(Grade, AnAngleTakenInDegreesIsFoundByGivingItOtherwise) {
  const Assignment& cloth = find_assignment("a3-cloth");
  const auto sandbox = choose_sandbox("bare", true);
  const auto builder = builder_for(cloth, *sandbox, *sandbox);
  const auto air = std::find_if(cloth.tests.begin(), cloth.tests.end(), [](const auto& t) { return t.id == "4.2"; });
  const GradeOptions options = options_for(cloth, 7);
  const Submission nothing;
  const crosscheck::TemporaryFolder scratch("test");
  const std::string solution = content_of_file(cloth.folder() / "solution/wind.cpp");
  const std::pair<const char*, const char*> table[] = {{"+ wind.offset * pi / 180", "suspect.degrees"},
                                                       {"+ wind.offset * pi / 100", ""}};
  for (const auto& [to, key] : table) {
    const auto program = builder->ours("wind", with_mistake(solution, {"", "wind", "+ wind.offset", to, {}}));
    const std::vector<TestRun> asked = {
        {&*air, public_cases(cloth, *air), run_calls(*sandbox, program, public_cases(cloth, *air))}};
    EXPECT_EQ(suspected({*sandbox, *builder, nothing, options.own, program, scratch.path}, asked).key, key) << to;
  }
}

// A common cause is reported once, and independent hints do not contradict it.
TEST(Grade, TestsOfOnePartAgree) {
  const Texts common = common_texts();
  const std::string solution = content_of_file(tiny().folder() / "solution/sums.cpp");
  const Mistake known = mistakes_of(tiny()).at(3);
  ASSERT_GT(known.loses.size(), 1u);
  const Result named = graded({{"sums.cpp", with_mistake(solution, known)}});
  ASSERT_EQ(causes_of(named, common).size(), 1u);
  const std::string cause = named.tests[1].cause;
  EXPECT_EQ(causes_of(named, common)[0], "sums.cpp, tests 2.1, 2.2: " + cause);
  const std::string text = text_of(named, common), page = page_of(named, common, options_for(tiny(), 7).own);
  for (const std::string& all : {text, page}) {
    EXPECT_EQ(all.find("it " + cause), std::string::npos);
    const std::size_t first = all.find("tests 2.1, 2.2: Likely cause");
    EXPECT_NE(first, std::string::npos) << all;
    EXPECT_EQ(all.find("Likely cause", first + 30), std::string::npos) << all;
    EXPECT_NE(all.find("The cause is given at the top."), std::string::npos) << all;
  }
  const Result other =
      graded({{"sums.cpp", with_mistake(solution, {"other", "sums", "double sum = 0;", "double sum = 3;", {}})},
              {"twice.cpp", "double twice(double x) { return 2 * x + 100; }"}});
  EXPECT_NE(other.tests[0].said.find("Hint: Add it to itself."), std::string::npos) << other.tests[0].said;
  EXPECT_TRUE(causes_of(other, common).empty());
}

TEST(Grade, ResultIsThereAfterEveryTest) {
  const auto sandbox = choose_sandbox("bare", true);
  GradeOptions options = options_for(tiny(), 7);
  std::vector<double> earned;
  std::vector<std::string> said;
  options.on_progress = [&](const Result& result) {
    earned.push_back(result.earned());
    said.push_back(total_of(result, options.common));
  };
  grade(tiny(), submission_of(tiny()), *sandbox, options);
  EXPECT_EQ(earned, (std::vector<double>{0, 30, 50, 65, 85, 95, 100, 100}));
  EXPECT_NE(said[1].find("Public tests so far: 1 of 3 passed; 3 more tests run later."), std::string::npos) << said[1];
  EXPECT_NE(said[3].find("All public tests passed; 3 more tests run later."), std::string::npos) << said[3];
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
  // code that has memorised the public numbers earns nothing
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

namespace fs = std::filesystem;
using crosscheck::TemporaryFolder;
using crosscheck::write_file;

void hand_in_solution(const fs::path& folder) {
  for (const std::string& file : wanted_files(tiny()))
    write_file(folder / file, content_of_file(tiny().folder() / "solution" / file));
}

TEST(Class, IsGradedResumedAndPutIntoATable) {
  const TemporaryFolder here("test");
  const fs::path handed = here.path / "handed", out = here.path / "out";
  hand_in_solution(handed / "all right");
  hand_in_solution(handed / "-o");
  fs::remove(handed / "-o/sums.cpp");
  write_file(handed / "rubbish, \"really\".zip", "neither zip nor tar");
  write_file(handed / "x;=1+1;\"-2", "neither zip nor tar");
  write_file(handed / ".DS_Store", "x");
  const auto sandbox = choose_sandbox("bare", true);
  GradeOptions options = options_for(tiny(), 7);
  const std::vector<GradedSubmission> all = grade_class(tiny(), submissions_in(handed), *sandbox, options, out);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(class_csv(tiny(), all),
            "submission,id,late,points [1],twice [1],sums [1],remark\n"
            "\"'-o\",,,50,50,0,\"sums.cpp is missing, so its tests cannot run.\"\n"
            "all right,,,100,50,50,\n"
            "\"rubbish, \"\"really\"\".zip\",,,,,,\"not graded: The archive cannot be read (damaged, or of a "
            "kind that is not known). Hand in a folder or a .zip.\"\n"
            "\"x;'=1+1;\"\"'-2\",,,,,,\"not graded: The archive cannot be read (damaged, or of a kind that is not "
            "known). Hand "
            "in a folder or a .zip.\"\n");
  EXPECT_EQ(
      statistics_csv(all),
      "test,title,passed [1],failed [1],not graded [1],most frequent cause,times [1]\n"
      "1.1,Twice a number,2,0,0,,0\n2.1,Sums of the first numbers,1,1,0,,0\n2.2,What each number adds,1,1,0,,0\n");
  const std::string page = class_page(tiny(), all, options.common);
  std::vector<GradedSubmission> with_cause = all;
  with_cause[0].result.tests[0].cause = "Likely cause: behaves like another";
  EXPECT_EQ(class_page(tiny(), with_cause, options.common).find("Likely cause"), std::string::npos);
  EXPECT_NE(class_page(tiny(), with_cause, options.common).find("<td>behaves like another</td>"), std::string::npos);
  EXPECT_NE(page.find("4 submissions, 2 graded, 2 not graded"), std::string::npos) << page;
  EXPECT_NE(page.find("<html lang=\"en\">"), std::string::npos) << page;
  EXPECT_NE(page.find("The archive cannot be read"), std::string::npos) << page;
  EXPECT_NE(page.find("<tr><td>2.1 Sums of the first numbers</td><td>1</td><td>1</td><td>0</td><td></td></tr>"),
            std::string::npos)
      << page;
  for (const GradedSubmission& one : all) {
    const std::string base = (out / file_name_for(one.result.submission)).string();
    EXPECT_TRUE(result_from_json(content_of_file(base + ".json"), base).complete);
    EXPECT_NE(content_of_file(base + ".html").find("</html>"), std::string::npos);
  }
  // a second run reuses unchanged results, and grades changed submissions again
  const auto written = [&](const char* name) { return fs::last_write_time(out / (file_name_for(name) + ".json")); };
  const auto right = written("all right"), other = written("-o");
  write_file(handed / "-o/sums.cpp", content_of_file(tiny().folder() / "solution/sums.cpp"));
  const std::vector<GradedSubmission> again = grade_class(tiny(), submissions_in(handed), *sandbox, options, out);
  EXPECT_EQ(again[0].result.earned(), 100);
  EXPECT_EQ(again[1].result.earned(), 100);
  EXPECT_EQ(written("all right"), right);
  EXPECT_NE(written("-o"), other);
  // another seed requires a new grading; an incomplete result does not count
  write_file(out / (file_name_for("-o") + ".json"),
             content_of_file(out / (file_name_for("-o") + ".json")).substr(0, 100));
  options.seed = 8;
  EXPECT_EQ(grade_class(tiny(), submissions_in(handed), *sandbox, options, out)[0].result.earned(), 100);
  EXPECT_NE(written("all right"), right);
}

TEST(Class, FilesOfTwoSubmissionsNeverMeet) {
  EXPECT_EQ(file_name_for("smith"), "smith");
  EXPECT_NE(file_name_for("a b"), file_name_for("a-b"));
  EXPECT_NE(file_name_for("王"), file_name_for("李"));
  EXPECT_EQ(file_name_for("../x").find('/'), std::string::npos);
  // the class's page and the manifest have reserved names
  EXPECT_NE(file_name_for("class"), "class");
  EXPECT_NE(file_name_for("crosscheck"), "crosscheck");
}

TEST(Page, CarriesWordsAndPlotsAndNothingOfTheStudentsUnescaped) {
  const auto sandbox = choose_sandbox("bare", true);
  const std::string throws =
      "#include \"tiny.h\"\n#include <stdexcept>\n"
      "double twice(double) { throw std::runtime_error(\"<script>alert(1)</script>\"); }\n";
  GradeOptions options = options_for(tiny(), 7);
  options.secret = true;
  Result result = grade(tiny(), submission_of(tiny(), {{"twice.cpp", throws}}), *sandbox, options);
  result.tests[0].said += "\x1b[2J";  // a forged answer may contain it
  const std::string page = page_of(result, options.common, options.own), text = text_of(result, options.common);
  EXPECT_EQ(page.find("<script>"), std::string::npos);
  EXPECT_NE(page.find("<html lang=\"en\">"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("http://") == std::string::npos,
            page.find("xmlns=\"http://www.w3.org/2000/svg\"") == std::string::npos);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  for (const std::string& said : {page, text}) {
    EXPECT_NE(said.find("Seed the lecturer"), std::string::npos);
    EXPECT_NE(said.find("Total: 50 of 100 points"), std::string::npos);
  }
}

TEST(Program, BadUseIsToldInOneLine) {
  const TemporaryFolder here("test");
  const std::string there = here.path.string();
  write_file(here.path / "empty-secret", "\n");
  for (const char* who : {"ada", "bo", "chen"}) write_file(here.path / "class" / who / "rk4.cpp", "");
  const std::pair<std::string, const char*> table[] = {
      {"grade a9 " + there, "unknown assignment 'a9'; `crosscheck list assignments` shows all"},
      {"grade a1-steppers " + there + "/nothing", "/nothing: expected a folder or an archive (zip, 7z, rar, tar)"},
      {"grade a1-steppers " + there + "/class",
       "/class: this looks like a class of 3 submissions (folders); add --all to grade each of them"},
      {"grade a1-steppers " + there + " --format pdf", "format 'pdf'"},
      {"grade a1-steppers " + there + " --lang fr", "--lang"},
      {"grade a1-steppers " + there + " --seed 1 --secret x", "--secret"},
      {"grade a1-steppers " + there + " --secret " + there + "/empty-secret", "expected a line of text"},
      {"grade a1-steppers", "SUBMISSION is required"},
      {"", "subcommand is required"},
  };
  for (const auto& [words, says] : table) {
    const Called called = call(words);
    EXPECT_EQ(called.status, 2) << words;
    EXPECT_NE(called.said.find(says), std::string::npos) << words << ": " << called.said;
  }
}

TEST(Program, ASeedThatIsAPipeIsRefusedAndNotWaitedFor) {
  const TemporaryFolder here("test");
  write_file(here.path / "class/ada.zip", "no archive");
  fs::create_directories(here.path / "out");
  ASSERT_EQ(mkfifo((here.path / "out/seed.txt").c_str(), 0600), 0);
  EXPECT_EQ(call("grade a1-steppers " + (here.path / "class").string() + " --all --no-sandbox --out " +
                 (here.path / "out").string())
                .status,
            2);
}

TEST(Program, ClassResultsLeaveTheUsersFilesAlone) {
  const TemporaryFolder here("test");
  write_file(here.path / "class/ada.zip", "no archive");
  const fs::path out = here.path / "out";
  const std::string words =
      "grade a1-steppers " + (here.path / "class").string() + " --all --no-sandbox --out " + out.string();
  write_file(out / "table.csv", "mine");
  const Called refused = call(words);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.said.find("holds files that crosscheck grade a1-steppers did not write (table.csv)"),
            std::string::npos)
      << refused.said;
  EXPECT_EQ(content_of_file(out / "table.csv"), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(out), fs::directory_iterator()), 1);
  fs::remove(out / "table.csv");
  EXPECT_EQ(call(words).status, 0) << "a submission that cannot be graded is a row of the result";
  const std::string seed = content_of_file(out / "seed.txt");
  write_file(out / "notes.txt", "mine");
  write_file(out / "table.csv", "mine");
  EXPECT_EQ(call(words).status, 0);
  EXPECT_EQ(content_of_file(out / "notes.txt"), "mine");
  EXPECT_EQ(content_of_file(out / "table.csv.yours"), "mine");
  EXPECT_EQ(content_of_file(out / "table.csv").substr(0, 11), "submission,");
  EXPECT_EQ(content_of_file(out / "seed.txt"), seed);
  fs::rename(here.path / "class/ada.zip", here.path / "class/bo.zip");
  EXPECT_EQ(call(words).status, 0);
  EXPECT_FALSE(fs::exists(out / "ada.json"));
}

TEST(Program, ChartsOfAPartEndWithItsTime) {
  const TemporaryFolder here("test");
  const std::string program = (here.path / "your-rk4.program").string(),
                    rest = " rk4 no-scene.json " + here.path.string();
  write_file(program + ".spent", "100.5\n150\n");
  EXPECT_EQ(call("engine " + program + rest).said.find("no more of it is run"), std::string::npos);
  write_file(program + ".spent", "100.5\n150\n50\n");
  const Called over = call("engine " + program + rest);
  EXPECT_NE(over.status, 0);
  EXPECT_NE(over.said.find("took more than 300 s in the charts; no more of it is run"), std::string::npos) << over.said;
}

TEST(Program, SolutionOfTheFirstAssignmentEarnsAHundred) {
  const TemporaryFolder here("test");
  const std::string solution = (folder_of_coursework() / "a1-steppers/solution").string();
  const Called called = call("grade a1-steppers " + solution + " --seed 3 --no-sandbox --report " +
                             (here.path / "page.html").string() + " --out " + (here.path / "result.txt").string());
  EXPECT_EQ(called.status, 0) << called.said;
  EXPECT_NE(called.said.find("Total: 100 of 100 points"), std::string::npos) << called.said;
  EXPECT_NE(content_of_file(here.path / "result.txt").find("Seed 3;"), std::string::npos);
  EXPECT_NE(content_of_file(here.path / "page.html").find("<svg"), std::string::npos);
  const Called empty = call("grade a1-steppers " + here.path.string() + " --no-sandbox --lang zh");
  EXPECT_EQ(empty.status, 0) << empty.said;
  EXPECT_NE(
      empty.said.find(
          "未评分：其中没有所要求的文件（euler.cpp, trapezoidal.cpp, rk4.cpp; euler.py, trapezoidal.py, rk4.py）"),
      std::string::npos)
      << empty.said;
}

}  // namespace
}  // namespace coursework
