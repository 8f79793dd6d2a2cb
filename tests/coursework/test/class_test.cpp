// Whole classes: rubric and regrading on real programs, and the program's output and exit status.
#include <gtest/gtest.h>

#include <fstream>

#include "mysim/base/files.h"
#include "tests/coursework/grader/class.h"
#include "tests/coursework/test/helpers.h"
#include "tests/coursework/test/program.h"
#include "tests/coursework/test/tiny/tiny_assignment.h"

namespace coursework {
namespace {

namespace fs = std::filesystem;
using crosscheck::TemporaryFolder;
using crosscheck::write_file;

/// Points of each test in the result file: the public tests, then the hidden ones, each group in order of test number.
std::vector<double> earned_in(const fs::path& json) {
  std::vector<double> earned;
  for (const TestResult& test : result_from_json(content_of_file(json), json.string()).tests)
    earned.push_back(test.earned);
  return earned;
}

class TinyClass : public testing::Test {
 protected:
  TinyClass() {
    for (const char* who : {"ada", "class"})
      for (const std::string& file : wanted_files(tiny()))
        write_file(handed / who / file, content_of_file(tiny().folder() / "solution" / file));
    write_file(handed / "class/sums.cpp", "");
  }
  std::vector<GradedSubmission> grade(const Rubric& rubric = {}, const std::set<std::string>& only = {}) {
    return grade_class(tiny(), submissions_in(handed), *sandbox, options, out, rubric, only);
  }
  /// Replaces an earlier result by one in which no test has earned anything.
  void forget_points(const char* who) {
    const fs::path file = out / (file_name_for(who) + ".json");
    std::string fingerprint;
    Result result = result_from_json(content_of_file(file), file.string(), &fingerprint);
    for (TestResult& test : result.tests) test.earned = 0, test.said = "Wrong then.";
    write_file(file, to_json(result, fingerprint));
  }

  const TemporaryFolder here{"test"};
  const fs::path handed = here.path / "handed", out = here.path / "out";
  const std::unique_ptr<Sandbox> sandbox = choose_sandbox("bare", true);
  GradeOptions options = options_for(tiny(), 7);
};

TEST_F(TinyClass, RegradesTheTestsThatAreNamedAndKeepsTheRest) {
  grade();
  forget_points("ada");
  const std::vector<GradedSubmission> all = grade({}, {"2.1"});
  EXPECT_EQ(all[0].moved, std::vector<std::string>{"2.1 0 -> 30"});
  EXPECT_EQ(all[1].moved, std::vector<std::string>());
  EXPECT_EQ(earned_in(out / "ada.json"), (std::vector<double>{0, 20, 0, 0, 10, 0}));
  EXPECT_EQ(all[0].result.tests[0].said, "Wrong then.");
  EXPECT_NE(content_of_file(out / "ada.html").find("Total: 30 of 100 points"), std::string::npos);
  // nothing runs again, because program and assignment have not changed since the result was stored
  EXPECT_EQ(grade()[0].result.earned(), 30);
}

TEST_F(TinyClass, RegradesOverAChangedGraderButGradesChangedFilesWhole) {
  grade();
  forget_points("ada");
  forget_points("class");
  for (const char* who : {"ada", "class"}) {  // makes results look like those of another version of the grader
    const fs::path file = out / (file_name_for(who) + ".json");
    std::string fingerprint;
    const Result result = result_from_json(content_of_file(file), file.string(), &fingerprint);
    fingerprint[0] = fingerprint[0] == '0' ? '1' : '0';
    write_file(file, to_json(result, fingerprint));
  }
  write_file(handed / "class/sums.cpp", content_of_file(tiny().folder() / "solution/sums.cpp"));
  write_file(handed / "new/twice.cpp", content_of_file(tiny().folder() / "solution/twice.cpp"));
  const std::vector<GradedSubmission> all = grade({}, {"1.1"});
  EXPECT_EQ(all[0].moved, std::vector<std::string>{"1.1 0 -> 50"});
  EXPECT_EQ(all[0].result.earned(), 50) << "ada: the second part is the earlier one";
  EXPECT_EQ(all[1].result.earned(), 100) << "class: other files than before";
  EXPECT_TRUE(all[1].moved.empty());
  EXPECT_EQ(all[2].result.earned(), 50) << "new: none before";
  // a later run regrades submissions whose stored result came from another version of the grader or assignment
  EXPECT_EQ(grade()[0].result.earned(), 100);
}

TEST_F(TinyClass, RubricChangesPagesAndTablesAndNotWhatWasMeasured) {
  grade();
  const auto written = fs::last_write_time(out / "ada.json");
  write_file(
      here.path / "r.toml",
      "[points]\n\"1.1\" = 5\n[[override]]\nstudent = \"class\"\ntest = \"2.1\"\npoints = 12\nreason = \"Oral\"\n");
  const Rubric rubric = read_rubric(here.path / "r.toml", tiny(), submissions_in(handed), true);
  const std::vector<GradedSubmission> all = grade(rubric);
  EXPECT_EQ(fs::last_write_time(out / "ada.json"), written);
  EXPECT_NE(class_csv(tiny(), all).find("\nada,,,55,5,50,\nclass,,,17,5,12,"), std::string::npos)
      << class_csv(tiny(), all);
  const std::string page = content_of_file(out / (file_name_for("class") + ".html"));
  EXPECT_NE(page.find("Total: 17 of 55 points"), std::string::npos);
  EXPECT_NE(page.find("Points set by your lecturer: Oral"), std::string::npos);
  EXPECT_EQ(grade()[1].result.earned(), 50);
  forget_points("ada");
  EXPECT_EQ(grade(rubric, {"1.1"})[0].moved, std::vector<std::string>{"1.1 0 -> 5"});
}

TEST_F(TinyClass, PageLinksEverySubmissionAndItsPageIsThere) {
  write_file(handed / "王小明.zip", "no archive");
  std::ofstream(handed / "\xcd\xf5.zip") << "no archive";
  std::vector<GradedSubmission> all = grade();
  all[0].id = "=17", all[0].late = true;
  const std::string page = class_page(tiny(), all, options.common);
  EXPECT_NE(page.find("<th>id</th><th>late</th><th>points</th><th>twice</th><th>sums</th><th>remark</th>"),
            std::string::npos)
      << page;
  EXPECT_NE(page.find("<td>=17</td><td>&#10003;</td><td>100</td><td>50</td><td>50</td><td></td></tr>"),
            std::string::npos);
  EXPECT_NE(class_csv(tiny(), all).find("ada,\"'=17\",late,100,50,50,\n"), std::string::npos);
  EXPECT_NE(class_text(tiny(), all).find("late; \n"), std::string::npos);
  for (const GradedSubmission& one : all) {
    const std::string file = file_name_for(one.result.submission) + ".html";
    EXPECT_TRUE(fs::exists(out / file)) << file;
    EXPECT_NE(page.find("<a href=\"" + file + "\">"), std::string::npos) << file;
    EXPECT_EQ(content_of_file(out / file).find('\xcd'), std::string::npos);
  }
  EXPECT_TRUE(fs::exists(out / "王小明.zip.html"));
  for (const std::string& text : {page, class_csv(tiny(), all), class_text(tiny(), all)})
    EXPECT_EQ(text.find('\xcd'), std::string::npos);
}

TEST(Program, EmptyClassIsANegativeAnswer) {
  const TemporaryFolder here("test");
  write_file(here.path / "class/.DS_Store", "x");
  write_file(here.path / "class/._ada.zip", "x");
  const Called called = call("grade a1-steppers " + (here.path / "class").string() + " --all --no-sandbox");
  EXPECT_EQ(called.status, 1);
  EXPECT_NE(called.said.find("skipped, left by an operating system or Git: .DS_Store, ._ada.zip\n"), std::string::npos)
      << called.said;
  EXPECT_NE(called.said.find("no submissions found; nothing was graded"), std::string::npos) << called.said;
}

TEST(Program, FillsAGradebookAndReportsWhoHasNoRow) {
  const TemporaryFolder here("test");
  write_file(here.path / "class/ada_LATE_901_11_a1.zip", "no archive");
  write_file(here.path / "class/bo_902_12_a1.zip", "no archive");
  write_file(here.path / "roster.csv", "Student,ID,Section,a1-steppers (5)\r\nAda,901,L,7\r\n");
  const fs::path out = here.path / "out";
  const std::string words = "grade a1-steppers " + (here.path / "class").string() + " --all --no-sandbox --out " +
                            out.string() + " --gradebook canvas --roster " + (here.path / "roster.csv").string();
  const Called called = call(words);
  EXPECT_EQ(called.status, 0) << called.said;
  EXPECT_NE(called.said.find("gradebook: bo_902: fits no row of "), std::string::npos) << called.said;
  EXPECT_EQ(called.said.find("ada_901: fits"), std::string::npos) << called.said;
  EXPECT_EQ(content_of_file(out / "gradebook.csv"), content_of_file(here.path / "roster.csv")) << "nothing was graded";
  EXPECT_NE(content_of_file(out / "table.csv").find("\nada_901,901,late,,"), std::string::npos);
  EXPECT_NE(call(words + " --only rk4").said.find("points changed in 0 of 2 submissions"), std::string::npos);
}

TEST(Program, BadUseOfOptionsForClassesIsToldInOneLine) {
  const TemporaryFolder here("test");
  const std::string there = here.path.string(), all = "grade a1-steppers " + there + "/class --all --no-sandbox ";
  write_file(here.path / "class/ada.zip", "no archive");
  write_file(here.path / "r.csv", "name,points\n");
  write_file(here.path / "r.toml", "[points]\n\"9.9\" = 1\n");
  const std::pair<std::string, const char*> table[] = {
      {all + "--gradebook canvas", "--roster"},
      {all + "--roster " + there + "/r.csv", "--gradebook"},
      {all + "--gradebook excel --roster " + there + "/r.csv", "--gradebook"},
      {all + "--gradebook canvas --roster " + there + "/r.csv", "r.csv: expected the columns of Canvas's"},
      {all + "--gradebook csv --roster " + there + "/r.csv --column pints",
       "no column 'pints'; did you mean 'points'?"},
      {all + "--rubric " + there + "/r.toml", "r.toml:2: points.9.9: unknown key"},
      {all + "--rubric " + there + "/none.toml", "none.toml"},
      {all + "--only rk5", "--only rk5: no test or part of a1-steppers has this name; did you mean 'rk4'?"},
      {"grade a1-steppers " + there + "/class/ada.zip --only rk4", "--all"},
      {"grade a1-steppers " + there + "/class/ada.zip --rubric " + there + "/r.toml", "r.toml:2: points.9.9"},
  };
  for (const auto& [words, says] : table) {
    const Called called = call(words);
    EXPECT_EQ(called.status, 2) << words << called.said;
    EXPECT_NE(called.said.find(says), std::string::npos) << words << ": " << called.said;
  }
  EXPECT_FALSE(fs::exists("out/grade")) << "nothing is written before the options are read";
}

}  // namespace
}  // namespace coursework
