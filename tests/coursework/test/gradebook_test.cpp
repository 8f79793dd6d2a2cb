// Exports of Moodle, Canvas and others with points filled in; rubrics; names of submissions and of their files.
#include <gtest/gtest.h>

#include <fstream>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "tests/coursework/grader/formats.h"
#include "tests/coursework/grader/gradebook.h"
#include "tests/coursework/test/helpers.h"
#include "tests/coursework/test/tiny/tiny_assignment.h"

namespace coursework {
namespace {

namespace fs = std::filesystem;
using crosscheck::TemporaryFolder;
using crosscheck::write_file;

/// A submission that earns all points, or no points in the second part if `all` is false.
GradedSubmission graded(const std::string& name, bool all = true) {
  GradedSubmission one;
  one.result.submission = name;
  one.result.complete = true;
  for (const bool hidden : {false, true})
    for (const coursework::Test& test : tiny().tests) {
      TestResult result;
      result.id = test.id, result.part = test.part, result.hidden = hidden;
      result.points = hidden ? test.hidden : test.points;
      result.earned = all || result.part == "twice" ? result.points : 0;
      if (result.earned == 0) result.said = "First difference at number 1: expected 2, got 3.";
      one.result.tests.push_back(result);
    }
  return one;
}

GradedSubmission refused(const std::string& name) {
  GradedSubmission one;
  one.result.submission = name;
  one.failure = one.result.not_graded = "=rubbish";
  return one;
}

Handed moodle(const std::string& name, const std::string& id) { return {name + "_" + id, {}, "Moodle", {{name, id}}}; }

struct Filled {
  std::string text;
  std::vector<std::string> unmatched;
};

Filled filled(const std::string& layout, const std::string& roster, const std::vector<Handed>& handed,
              const std::vector<GradedSubmission>& graded, const std::string& column = "") {
  const TemporaryFolder here("test");
  write_file(here.path / "roster.csv", roster);
  Gradebook book(layout, here.path / "roster.csv", column, tiny(), 100);
  Filled out;
  out.unmatched = book.fill(tiny(), handed, graded, common_texts());
  out.text = book.text();
  for (std::string& line : out.unmatched)
    if (const std::size_t at = line.find(here.path.string()); at != std::string::npos)
      line.erase(at, here.path.string().size() + 1);
  return out;
}

TEST(Gradebook, MoodlesWorksheetIsFilledByParticipantNumber) {
  const std::string head =
      "\xef\xbb\xbfIdentifier,\"Full name\",\"Email address\",Status,Grade,\"Maximum Grade\",\"Grade can be changed\","
      "\"Last modified (submission)\",\"Last modified (grade)\",\"Feedback comments\"\r\n";
  const std::string rest = ",100.00,Yes,\"Friday, 27 November 2026, 11:02 PM\",-,";
  const Filled out =
      filled("moodle",
             head + "\"Participant 7\",\"王小明\",w@x.cn,\"Submitted for grading - \",," + rest.substr(1) + "\r\n" +
                 "\"Participant 17\",\"Ada \"\"A\"\" Lovelace\",a@x.uk,\"No submission\",-" + rest +
                 "\"old, kept\"\r\n" + "\"Participant 18\",=Bo,b@x.uk,,50" + rest,
             {moodle("Bo", "18"), moodle("王小明", "7")}, {graded("Bo_18"), graded("王小明_7", false)});
  EXPECT_EQ(out.unmatched, std::vector<std::string>());
  // blanks, quotes, line ends and other cells are unchanged
  EXPECT_EQ(out.text, head + "\"Participant 7\",\"王小明\",w@x.cn,\"Submitted for grading - \",50" + rest +
                          "Total: 50 of 100 points; twice: 50; sums: 0\r\n" +
                          "\"Participant 17\",\"Ada \"\"A\"\" Lovelace\",a@x.uk,\"No submission\",-" + rest +
                          "\"old, kept\"\r\n" + "\"Participant 18\",=Bo,b@x.uk,,100" + rest +
                          "Total: 100 of 100 points; twice: 50; sums: 50");
}

TEST(Gradebook, MoodlesCourseExportIsFilledByName) {
  const std::string head =
      "\"First name\",\"Last name\",\"ID number\",\"Email address\",\"Assignment: Test/Tiny (Real)\","
      "\"Assignment: Test/Tiny (Feedback)\",\"Last downloaded from this course\"\n";
  // 18 is a participant number, not another person's ID number
  const Filled out =
      filled("moodle", head + "Séan,O'Brien,2,s@x.ie,-,,1\nAda,Lovelace,18,a@x.uk,-,,1\n",
             {moodle("Séan OBrien", "18"), moodle("Lovelace Ada", "19")}, {graded("Séan"), graded("Ada", false)});
  EXPECT_EQ(out.unmatched, std::vector<std::string>());
  EXPECT_EQ(out.text, head + "Séan,O'Brien,2,s@x.ie,100,,1\nAda,Lovelace,18,a@x.uk,50,,1\n");
}

TEST(Gradebook, CanvasIsFilledByUserId) {
  const std::string head = "Student,ID,SIS User ID,SIS Login ID,Section,test/tiny (345),Other (346),Current Score\n";
  const std::string rows = ",,,,,Manual Posting,,\n    Points Possible,,,,,100.00,10.00,(read only)\n";
  const Filled out =
      filled("canvas", head + rows + "\"Lovelace, Ada\",901,s1,ada,L01,,7,\n\"Student, Test\",903,,x,L01,,,\n",
             {{"lovelaceada_901", {}, "Canvas", {{"lovelaceada", "901"}}, true}}, {graded("lovelaceada_901")});
  EXPECT_EQ(out.unmatched, std::vector<std::string>());
  EXPECT_EQ(out.text, head + rows + "\"Lovelace, Ada\",901,s1,ada,L01,100,7,\n\"Student, Test\",903,,x,L01,,,\n");
}

TEST(Gradebook, AnyTableIsFilledByIdOrName) {
  const std::string head = "学号,姓名,email,points,late,remark\r\n";
  std::vector<Handed> handed = {{"20231234_王小明.zip", {}, "", {{"20231234_王小明"}}},
                                {"liwei", {}, "", {{"liwei"}}, true},
                                {"作业-张三", {}, "", {{"作业-张三"}}},
                                {"Chen + Zhao (submission_7)", {}, "Gradescope", {{"Chen", "55"}, {"Zhao", "z@x.cn"}}}};
  std::vector<GradedSubmission> results = {graded("a"), graded("b", false), refused("c"), graded("d")};
  results[1].late = true;
  const Filled out =
      filled("csv",
             head +
                 "20231234,王小明,,,,\r\n20231235,王小明,,,,\r\n3,李伟,liwei@x.cn,,,\r\n4,张三,,,,\r\n55,陈,,,,\r\n"
                 "6,Zhao,Z@x.cn,,,\r\n7,,,,,\r\n",
             handed, results);
  EXPECT_EQ(out.unmatched, std::vector<std::string>());
  EXPECT_EQ(out.text, head +
                          "20231234,王小明,,100,,\r\n20231235,王小明,,,,\r\n3,李伟,liwei@x.cn,50,late,\r\n"
                          "4,张三,,,,not graded: =rubbish\r\n55,陈,,100,,\r\n6,Zhao,Z@x.cn,100,,\r\n7,,,,,\r\n");
}

TEST(Gradebook, DoubtfulRowsAreReportedAndLeftAlone) {
  const std::string roster = "id,name,points\n1,Ada,\n2,Bo,\n3,Bo,\n4,Chen,9\n";
  const Filled out = filled("csv", roster,
                            {{"nobody", {}, "", {{"nobody"}}},
                             {"Bo", {}, "", {{"Bo"}}},
                             {"chen.zip", {}, "", {{"chen"}}},
                             {"4", {}, "", {{"4"}}},
                             {"Ada (2)", {}, "", {{"Ada (2)"}}}},
                            std::vector<GradedSubmission>(5, graded("x")));
  EXPECT_EQ(out.text, roster);
  EXPECT_EQ(out.unmatched,
            (std::vector<std::string>{"nobody: fits no row of roster.csv", "Bo: fits several rows (2, 3) of roster.csv",
                                      "Ada (2): fits several rows (2, 1) of roster.csv",
                                      "chen.zip: fits row 4 of roster.csv, as another one does",
                                      "4: fits row 4 of roster.csv, as another one does"}));
}

TEST(Gradebook, TextOfOursIsDefused) {
  EXPECT_EQ(filled("csv", "name,remark,points\nAda,,\n", {{"Ada", {}, "", {{"Ada"}}}}, {[] {
                     GradedSubmission one = graded("Ada");
                     one.result.remark = "=1+1, \"x\"";
                     return one;
                   }()})
                .text,
            "name,remark,points\nAda,\"'=1+1, \"\"x\"\"\",100\n");
}

TEST(Gradebook, EachErrorNamesTheFileAndWhatIsExpected) {
  const TemporaryFolder here("test");
  const struct {
    const char *layout, *roster, *column, *says;
  } table[] = {
      {"canvas", "Student,ID,Section,test/tiny (1)\n    Points Possible,,,20.00\n", "",
       "the maximum of 'test/tiny (1)' is 20, and the assignment has 100 points; change it there, or the points by "
       "--rubric"},
      {"moodle", "Identifier,Grade,Maximum Grade\nParticipant 1,,\"50,00\"\n", "", "the maximum of 'Grade' is 50"},
      {"canvas", "Name,Points\n", "", "expected the columns of Canvas's gradebook export (Student, ID, Section)"},
      {"moodle", "Student,ID,Section\n", "", "expected the columns of Moodle's grading worksheet"},
      {"csv", "a,b\n", "", "expected the columns of a table of students (id, name or email); the first is 'a'"},
      {"canvas", "Student,ID,Section,Homework (1)\n", "",
       "expected one column named after test/tiny, found none; choose with --column NAME"},
      {"canvas", "Student,ID,Section,test/tiny (1),test/tiny late (2)\n", "",
       "found 'test/tiny (1)', 'test/tiny late (2)'"},
      {"canvas", "Student,ID,Section,Homework (1)\n", "Homwork (1)",
       "no column 'Homwork (1)'; did you mean 'Homework (1)'?"},
      {"csv", "name;points\nAda;1\n", "", "expected commas between the columns"},
      {"csv", "name,points\n\"Ada,1\n", "", "record 2: a quote is not closed"},
      {"csv", "name,points\nA\"d\"a,1\n", "", "not valid CSV (RFC 4180)"},
      {"csv", "name,points\n\xcd\xf5,1\n", "", "expected UTF-8"},
      {"csv", "", "", "it is empty"},
  };
  for (const auto& [layout, roster, column, says] : table) {
    write_file(here.path / "r.csv", roster);
    try {
      Gradebook(layout, here.path / "r.csv", column, tiny(), 100);
      ADD_FAILURE() << roster;
    } catch (const crosscheck::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("r.csv: "), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(Gradebook("csv", here.path / "none.csv", "", tiny(), 100), crosscheck::InputError);
}

const std::vector<Handed> two = {{"ada.zip", {}, "", {{"ada"}}}, {"bo_12", {}, "Canvas", {{"bo", "12"}}}};

Rubric rubric_of(const std::string& text, bool whole_class = true) {
  const TemporaryFolder here("test");
  write_file(here.path / "rubric.toml", text);
  return read_rubric(here.path / "rubric.toml", tiny(), two, whole_class);
}

TEST(Rubric, PointsSumAndMaximumFollow) {
  const Rubric rubric = rubric_of("[points]\n\"1.1\" = 10\n\"2.1\" = 0\n");
  EXPECT_EQ(points_of(tiny(), rubric), 30);
  GradedSubmission one = graded("ada.zip", false);
  EXPECT_EQ(rubric.apply(one.result), "");
  EXPECT_EQ(one.result.points(), 30);
  EXPECT_EQ(one.result.earned(), 10);
  EXPECT_EQ(one.result.tests[0].points, 6) << "30 of 50, public";
  EXPECT_EQ(one.result.tests[3].earned, 4) << "20 of 50, hidden";
  EXPECT_EQ(total_of(one.result, common_texts()), "Total: 10 of 30 points");
  EXPECT_EQ(one.result.tests[2].points, 15) << "not named";
}

TEST(Rubric, OverrideSetsPointsAndIsShownWithItsReason) {
  const Rubric rubric = rubric_of(
      "[[override]]\nstudent = \"12\"\ntest = \"2.1\"\npoints = 25\nreason = \"Right <idea>\"\n"
      "[[override]]\nstudent = \"ada\"\ntest = \"2.2\"\npoints = 20\nreason = \"Shown in class\"\n");
  GradedSubmission bo = graded("bo_12", false), ada = graded("ada.zip", false), other = graded("other", false);
  for (GradedSubmission* one : {&bo, &ada, &other}) EXPECT_EQ(rubric.apply(one->result), "");
  EXPECT_EQ(bo.result.earned(), 75);
  EXPECT_EQ(bo.result.tests[1].earned, 20);
  EXPECT_EQ(bo.result.tests[4].earned, 5);
  EXPECT_EQ(ada.result.earned(), 70);
  EXPECT_EQ(other.result.earned(), 50);
  EXPECT_TRUE(passed(ada.result.tests[2])) << "all points are given";
  EXPECT_FALSE(passed(bo.result.tests[4]));
  const Texts own = options_for(tiny(), 1).own;
  EXPECT_NE(page_of(bo.result, common_texts(), own).find("<p>Points set by your lecturer: Right &lt;idea&gt;</p>"),
            std::string::npos);
  EXPECT_NE(text_of(ada.result, common_texts("zh")).find("教师评定的分数：Shown in class"), std::string::npos);
  GradedSubmission none = refused("bo_12");
  EXPECT_EQ(rubric.apply(none.result), "; the rubric's points of test 2.1 are not used");
}

TEST(Rubric, OverrideGradesWhatWasNotGraded) {
  GradedSubmission one = graded("ada.zip", false);
  one.result.tests[1].ungraded = true;
  EXPECT_EQ(points_in(one), "");
  rubric_of("[[override]]\nstudent = \"ada.zip\"\ntest = \"2.1\"\npoints = 7.5\nreason = \"r\"\n").apply(one.result);
  EXPECT_EQ(points_in(one), "57.5");
}

TEST(Rubric, EachErrorNamesLineAndKey) {
  const std::string one = "[[override]]\nreason = \"r\"\npoints = 5\n";
  const std::pair<std::string, const char*> table[] = {
      {"[points]\n\"1.3\" = 4\n", "rubric.toml:2: points.1.3: unknown key; did you mean '1.1'? expected one of: "},
      {"[points]\n1.1 = 4\n", "rubric.toml:2: points.1: unknown key; did you mean '1.1'?"},
      {"[points]\n\"1.1\" = -4\n", "rubric.toml:2: points.1.1: expected a number not below zero, got -4"},
      {"[point]\n\"1.1\" = 4\n", "rubric.toml:1: point: unknown key; did you mean 'points'?"},
      {one + "student = \"ada\"\ntest = \"2.9\"\n",
       "rubric.toml:5: override[0].test: expected a test of test/tiny; did you mean '2.1'?, got \"2.9\""},
      {one + "student = \"adda\"\ntest = \"2.1\"\n",
       "rubric.toml:4: override[0].student: expected a submission, id or name of the class; did you mean 'ada'?, got "
       "\"adda\""},
      {one + "test = \"2.1\"\n", "rubric.toml:1: override[0].student: is missing; expected a text in quotes"},
      {"[[override]]\nstudent = \"ada\"\ntest = \"2.1\"\npoints = 5\n",
       "override[0].reason: is missing; expected a text in quotes"},
      {"[[override]]\nstudent = \"ada\"\ntest = \"2.1\"\nreason = \"r\"\npoints = 31\n",
       "rubric.toml:5: override[0].points: expected at most 30, the points of test 2.1, got 31"},
      {"points = 3\n", "rubric.toml:1: points: expected a table [points]"},
      {one + "student = \"ada\"\ntest = \"2.1\"\n" + one + "student = \"ada.zip\"\ntest = \"2.1\"\n",
       "override[1].test: expected one override of test 2.1 for ada.zip, got a second"},
  };
  for (const auto& [text, says] : table) try {
      rubric_of(text);
      ADD_FAILURE() << text;
    } catch (const crosscheck::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  // overrides of other students are skipped
  EXPECT_TRUE(rubric_of(one + "student = \"adda\"\ntest = \"2.1\"\n", false).overrides.empty());
}

TEST(Rubric, NameOfTwoSubmissionsIsRefused) {
  const TemporaryFolder here("test");
  write_file(here.path / "r.toml", "[[override]]\nstudent = \"bo\"\ntest = \"2.1\"\npoints = 1\nreason = \"r\"\n");
  const std::vector<Handed> handed = {{"bo_1", {}, "Canvas", {{"bo", "1"}}}, {"bo_2", {}, "Canvas", {{"bo", "2"}}}};
  try {
    read_rubric(here.path / "r.toml", tiny(), handed, true);
    FAIL();
  } catch (const crosscheck::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected the name of one submission; these fit: bo_1, bo_2"),
              std::string::npos)
        << error.what();
  }
}

TEST(Only, TestsAreNamedByNumberPartOrPattern) {
  using Names = std::set<std::string>;
  EXPECT_EQ(tests_named(tiny(), {}), Names());
  EXPECT_EQ(tests_named(tiny(), {"2.1"}), Names({"2.1"}));
  EXPECT_EQ(tests_named(tiny(), {"1.1", "2.*"}), Names({"1.1", "2.1", "2.2"}));
  EXPECT_EQ(tests_named(tiny(), {"sums"}), Names({"2.1", "2.2"}));
  try {
    tests_named(tiny(), {"2.1", "sum"});
    FAIL();
  } catch (const crosscheck::InputError& error) {
    EXPECT_STREQ(error.what(), "--only sum: no test or part of test/tiny has this name; did you mean 'sums'?");
  }
}

TEST(Spreadsheet, CellsThatCouldBeFormulasAreDefused) {
  for (const std::string bad : {"=1", "+1", "-1", "@x", "\tx", "\rx", "＝1", "＋1", "－1", "＠x"})
    EXPECT_EQ(defused(bad), "'" + bad);
  EXPECT_EQ(defused(" =1"), " '=1");
  EXPECT_EQ(defused("\"=1"), "\"'=1");
  EXPECT_EQ(defused("a\n＝1"), "a\n'＝1");
  for (const std::string good : {"a=1", "王小明", "", "1-2", "中＝"}) EXPECT_EQ(defused(good), good);
}

TEST(Layouts, NothingIsSkippedInSilence) {
  const TemporaryFolder here("test");
  for (const char* name : {"._ada.zip", ".DS_Store", "__MACOSX/x", "Thumbs.db", ".git/HEAD", ".hidden/rk4.cpp",
                           "ada.zip", "class.tar.gz", "王小明.zip"})
    write_file(here.path / name, "x");
  std::ofstream(here.path / "\xcd\xf5.zip") << "x";
  std::ofstream(here.path / "\xcd\xf6.zip") << "x";
  std::ofstream(here.path / "\xe2\x80\xae\tbidi") << "x";
  std::ofstream(here.path /
                "\xef\xbb\xbf"
                "ada.zip")
      << "x";  // this name looks like "ada.zip"
  std::vector<std::string> skipped, names, stems;
  for (const Handed& one : submissions_in(here.path, &skipped)) {
    names.push_back(one.name);
    stems.push_back(one.people.at(0).name);
  }
  EXPECT_EQ(skipped, (std::vector<std::string>{".DS_Store", "._ada.zip", ".git", "Thumbs.db", "__MACOSX"}));
  ASSERT_EQ(names.size(), 8u);
  EXPECT_EQ(names[0], ".hidden");
  EXPECT_EQ(stems[1], "ada");
  EXPECT_EQ(stems[2], "class");
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 8u);
  std::set<std::string> files;
  for (const std::string& name : names) {
    EXPECT_TRUE(crosscheck::is_printable(name)) << name;
    const std::string file = file_name_for(name);
    EXPECT_EQ(file.find_first_of("./"), file.find_first_of(".", 1)) << file;
    EXPECT_TRUE(files.insert(lower(file)).second) << file;
  }
  EXPECT_TRUE(files.contains("王小明.zip")) << "Unicode stays";
  for (const char* taken : {"class", "Class", "CLASS", "crosscheck"})
    EXPECT_NE(lower(file_name_for(taken)), lower(taken));
}

TEST(Layouts, IdsAndLateMarksAreKept) {
  const TemporaryFolder here("test");
  for (const char* file : {"ada_LATE_901_11_rk4.cpp", "ada_901_12_euler.cpp", "王小明_902_13_a.zip"})
    write_file(here.path / "canvas" / file, "x");
  write_file(here.path / "gradescope/submission_metadata.yml",
             "submission_71:\n  :submitters:\n  - :name: Ada\n    :sid: '17'\n    :email: a@x.uk\n  - :name: Bo\n"
             "    :sid: ''\n    :email: b@x.uk\n");
  write_file(here.path / "gradescope/submission_71/rk4.cpp", "x");
  const std::vector<Handed> canvas = submissions_in(here.path / "canvas");
  ASSERT_EQ(canvas.size(), 2u);
  EXPECT_TRUE(canvas[0].late);
  EXPECT_EQ(canvas[0].people[0].id, "901");
  EXPECT_FALSE(canvas[1].late);
  EXPECT_EQ(canvas[1].people[0].name, "王小明");
  const std::vector<Handed> gradescope = submissions_in(here.path / "gradescope");
  ASSERT_EQ(gradescope.at(0).people.size(), 2u);
  EXPECT_EQ(gradescope[0].people[0].id, "17");
  EXPECT_EQ(gradescope[0].people[1].id, "b@x.uk");
  EXPECT_THROW(submissions_in(here.path / "none"), crosscheck::InputError);
}

TEST(Printable, BytesOfOtherEncodingsBecomeMarks) {
  const std::string mark = "\xef\xbf\xbd";
  EXPECT_EQ(printable("a\xcd\xf5\tb"), "a" + mark + mark + " b");
  Result result;
  result.submission = "\xcd\xf5";
  result.preflight = {"\xcd\xf5.cpp"};
  const Texts own = options_for(tiny(), 1).own;
  EXPECT_EQ(page_of(result, common_texts(), own).find('\xcd'), std::string::npos);
  EXPECT_EQ(text_of(result, common_texts()).find('\xcd'), std::string::npos);
}

}  // namespace
}  // namespace coursework
