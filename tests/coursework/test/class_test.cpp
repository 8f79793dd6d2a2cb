// A class, and the program as lecturers call it.
#include "tests/coursework/grader/class.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "mysim/files.h"
#include "mysim/temporary_folder.h"
#include "tests/coursework/grader/text_format.h"
#include "tests/coursework/test/helpers.h"
#include "tests/coursework/test/tiny/tiny_assignment.h"

namespace coursework {
namespace {
namespace fs = std::filesystem;
using crosscheck::TemporaryFolder;
using crosscheck::write_file;

void hand_in_solution(const fs::path& folder) {
  for (const std::string& file : files_asked_for(tiny()))
    write_file(folder / file, content_of_file(tiny().folder() / "solution" / file));
}

TEST(Class, IsGradedResumedAndPutIntoATable) {
  const TemporaryFolder here("test");
  const fs::path handed = here.path / "handed", out = here.path / "out";
  hand_in_solution(handed / "all right");
  hand_in_solution(handed / "-o");
  fs::remove(handed / "-o/sums.cpp");
  write_file(handed / "rubbish, \"really\".zip", "neither zip nor tar");
  write_file(handed / ".DS_Store", "x");
  const auto lane = choose_lane("bare", true);
  GradeOptions options = options_for(tiny(), 7);
  const std::vector<Graded> all = grade_class(tiny(), handed, *lane, options, out);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(class_csv(tiny(), all),
            "submission,points [1],twice [1],sums [1],remark\n"
            "\"'-o\",50,50,0,\"sums.cpp is missing. Looked in the top folder, in src/ and one folder below.\"\n"
            "all right,100,50,50,\n"
            "\"rubbish, \"\"really\"\".zip\",0,0,0,\"The archive cannot be read (neither zip nor tar). Hand in "
            "a folder, a .zip or a .tar.gz.\"\n");
  for (const Graded& one : all) {
    const std::string base = (out / file_name_for(one.result.submission)).string();
    EXPECT_TRUE(result_from_json(content_of_file(base + ".json"), base).complete);
    EXPECT_NE(content_of_file(base + ".html").find("</html>"), std::string::npos);
  }
  // again: what is unchanged is read, what changed is graded anew
  const auto written = [&](const char* name) { return fs::last_write_time(out / (file_name_for(name) + ".json")); };
  const auto right = written("all right"), other = written("-o");
  write_file(handed / "-o/sums.cpp", content_of_file(tiny().folder() / "solution/sums.cpp"));
  const std::vector<Graded> again = grade_class(tiny(), handed, *lane, options, out);
  EXPECT_EQ(again[0].result.earned(), 100);
  EXPECT_EQ(again[1].result.earned(), 100);
  EXPECT_EQ(written("all right"), right);
  EXPECT_NE(written("-o"), other);
  // another seed is another grading; half a result counts for none
  write_file(out / (file_name_for("-o") + ".json"),
             content_of_file(out / (file_name_for("-o") + ".json")).substr(0, 100));
  options.seed = 8;
  EXPECT_EQ(grade_class(tiny(), handed, *lane, options, out)[0].result.earned(), 100);
  EXPECT_NE(written("all right"), right);
}

TEST(Class, FilesOfTwoSubmissionsNeverMeet) {
  EXPECT_EQ(file_name_for("smith"), "smith");
  EXPECT_NE(file_name_for("a b"), file_name_for("a-b"));
  EXPECT_NE(file_name_for("王"), file_name_for("李"));
  EXPECT_EQ(file_name_for("../x").find('/'), std::string::npos);
}

TEST(Page, CarriesWordsAndPlotsAndNothingOfTheStudentsUnescaped) {
  const auto lane = choose_lane("bare", true);
  const std::string throws =
      "#include \"tiny.h\"\n#include <stdexcept>\n"
      "double twice(double) { throw std::runtime_error(\"<script>alert(1)</script>\\x1b[2J\"); }\n";
  GradeOptions options = options_for(tiny(), 7);
  options.secret = true;
  const Result result = grade(tiny(), submission_of(tiny(), {{"twice.cpp", throws}}), *lane, options);
  const std::string page = page_of(result, options.common, options.own), text = text_of(result, options.common);
  EXPECT_EQ(page.find("<script>"), std::string::npos);
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

struct Called {
  int status;
  std::string said;
};

Called call(const std::string& words) {
  FILE* pipe = popen((std::string(CROSSCHECK_GRADER) + " " + words + " 2>&1").c_str(), "r");
  Called result{-1, {}};
  std::array<char, 4096> block;
  for (std::size_t got; (got = fread(block.data(), 1, block.size(), pipe)) > 0;) result.said.append(block.data(), got);
  result.status = WEXITSTATUS(pclose(pipe));
  return result;
}

TEST(Program, BadUseIsToldInOneLine) {
  const TemporaryFolder here("test");
  const std::string there = here.path.string();
  write_file(here.path / "empty-secret", "\n");
  const std::pair<std::string, const char*> table[] = {
      {"grade a9 " + there, "unknown assignment 'a9'; expected one of: a1-steppers"},
      {"grade a1-steppers " + there + "/nothing", "/nothing: expected a folder, a zip or a tar archive"},
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
  EXPECT_NE(empty.said.find("缺少 rk4.cpp"), std::string::npos) << empty.said;
  EXPECT_NE(empty.said.find("总分：0 分（满分 100 分）"), std::string::npos) << empty.said;
}

}  // namespace
}  // namespace coursework
