// Compares each format with a schema written from its documentation, for gradings with awkward content.
#include <gtest/gtest.h>

#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/formats.h"
#include "tests/coursework/test/format_readers.h"

namespace coursework {
namespace {

using namespace testing_tools;
using crosscheck::JsonField;

const std::vector<std::string> visibilities = {"hidden", "after_due_date", "after_published", "visible"};
const std::vector<std::string> styles = {"text", "html", "simple_format", "md", "ansi"};
const std::vector<Field> gradescope_top = {
    {"score", Field::number},
    {"execution_time", Field::number},
    {"output", Field::text},
    {"output_format", Field::text, true, styles},
    {"test_output_format", Field::text, true, styles},
    {"test_name_format", Field::text, true, styles},
    {"visibility", Field::text, true, visibilities},
    {"stdout_visibility", Field::text, true, visibilities},
    {"extra_data", Field::object},
    {"tests", Field::list},
    {"leaderboard", Field::list},
};
const std::vector<Field> gradescope_test = {
    {"score", Field::number},
    {"max_score", Field::number},
    {"status", Field::text, true, {"passed", "failed"}},
    {"name", Field::text},
    {"name_format", Field::text, true, styles},
    {"number", Field::text},
    {"output", Field::text},
    {"output_format", Field::text, true, styles},
    {"tags", Field::list},
    {"visibility", Field::text, true, visibilities},
    {"extra_data", Field::object},
};
const std::vector<Field> gradescope_leader = {
    {"name", Field::text}, {"value", Field::any}, {"order", Field::text, false, {"asc", "desc"}}};

const Texts& common() {
  static const Texts texts = Texts::read((folder_of_coursework() / "check/common.en.txt").string());
  return texts;
}

TestResult test(const std::string& id, const std::string& part, double points, double earned, bool hidden = false) {
  TestResult t;
  t.id = id, t.part = part, t.title = "Title of " + id, t.hidden = hidden, t.points = points, t.earned = earned;
  t.concepts = {"order", "purity"};
  t.seconds = 0.25;
  if (earned < points) {
    t.said = "row 2: expected 1 < x & \"y\", got\n  nan \x01\xff]]>" + std::string(hidden ? "SECRET" : "");
    t.cause = "behaves like an evalF that ignores its argument";
    t.read = "Why <small> steps";
    t.plot = "<svg xmlns=\"http://www.w3.org/2000/svg\"/>";
  }
  return t;
}

Result awkward() {
  Result r;
  r.assignment = "a5-stiff", r.sandbox = "bwrap", r.seed = 18446744073709551615ull;
  r.preflight = {"limits.cpp does not compile: expected ';' before '}' \x80"};
  r.tests = {test("1.1", "linear", 3, 3),       test("1.2", "linear", 4, 0),       test("2.1", "limits", 5, 5),
             test("1.1", "linear", 3, 3, true), test("1.2", "linear", 4, 0, true), test("2.1", "limits", 6, 6, true)};
  r.complete = true;
  return r;
}

Result nothing_ran() {
  Result r = awkward();
  r.tests.clear();
  r.complete = false;
  return r;
}

TEST(Formats, TableIsFoundByName) {
  for (const Format& format : formats()) EXPECT_EQ(find_format(std::string(format.name)).file, format.file);
  try {
    find_format("csv");
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "unknown format 'csv'; expected one of: text, gradescope, junit, autolab");
  }
}

TEST(Schema, SeesEachKindOfViolation) {
  const std::vector<Field> fields = {{"a", Field::number}, {"b", Field::text, false, {"x"}}};
  EXPECT_EQ(violations(JsonField::parse(R"({"a": 1, "b": "x"})", "t"), fields, "t"), "");
  EXPECT_EQ(violations(JsonField::parse(R"({"b": "x"})", "t"), fields, "t"), "t.a is missing\n");
  EXPECT_EQ(violations(JsonField::parse(R"({"a": "1"})", "t"), fields, "t"), "t.a has the wrong type\n");
  EXPECT_EQ(violations(JsonField::parse(R"({"a": 1, "b": "y"})", "t"), fields, "t"), "t.b is \"y\"\n");
  EXPECT_EQ(violations(JsonField::parse(R"({"a": 1, "c": 0})", "t"), fields, "t"), "t.c is not documented\n");
  for (const std::string bad : {"<a>", "<a></b>", "<a x=\"<\"/>", "<a>\x01</a>", "<a>&no;</a>", "<a/><b/>"})
    EXPECT_THROW(XmlReader(bad).document(), std::runtime_error) << bad;
}

TEST(Gradescope, FollowsItsDocumentation) {
  for (const Result& r : {awkward(), nothing_ran()}) {
    const JsonField out = JsonField::parse(gradescope(r, common()), "results.json");
    EXPECT_EQ(violations(out, gradescope_top, "top"), "");
    for (const JsonField& each : out["tests"].elements()) {
      EXPECT_EQ(violations(each, gradescope_test, "test"), "");
      for (const JsonField& tag : each["tags"].elements()) EXPECT_TRUE(tag.is_text());
      EXPECT_LE(each["score"].number(), each["max_score"].number());
      EXPECT_EQ(each["status"].text() == "passed", each["score"].number() == each["max_score"].number());
    }
    for (const JsonField& each : out["leaderboard"].elements())
      EXPECT_EQ(violations(each, gradescope_leader, "leader"), "");
    EXPECT_EQ(out["tests"].size(), r.tests.size());
  }
}

TEST(Gradescope, ScoresAndHidesWhatItShould) {
  const JsonField out = JsonField::parse(gradescope(awkward(), common()), "results.json");
  EXPECT_EQ(out["score"].number(), 17);
  EXPECT_EQ(out["leaderboard"][0]["value"].number(), 8);
  for (size_t i = 0; i < 6; ++i)
    EXPECT_EQ(out["tests"][i]["visibility"].text(), i < 3 ? "visible" : "after_published") << i;
  // text of a student's program cannot break out of JSON or HTML
  const std::string shown = out["tests"][1]["output"].text();
  EXPECT_EQ(out["tests"][1]["output_format"].text(), "html");
  EXPECT_NE(shown.find("1 &lt; x &amp;"), std::string::npos);
  EXPECT_EQ(out["tests"][0]["output_format"].text(), "text");
  EXPECT_EQ(JsonField::parse(gradescope(nothing_ran(), common()), "results.json")["score"].number(), 0);
}

/// The schema of the Jenkins plug-in: allowed children and required attributes.
struct Rule {
  std::vector<std::string> required, optional, children;
};
const std::map<std::string, Rule> junit_rules = {
    {"testsuites", {{}, {"name", "time", "tests", "failures", "errors", "skipped"}, {"testsuite"}}},
    {"testsuite", {{"name", "tests"}, {"failures", "errors", "skipped", "time"}, {"testcase"}}},
    {"testcase", {{"name", "classname"}, {"time"}, {"skipped", "error", "failure"}}},
    {"failure", {{}, {"type", "message"}, {}}},
    {"error", {{}, {"type", "message"}, {}}},
    {"skipped", {{}, {"message"}, {}}},
};
bool holds(const std::vector<std::string>& list, const std::string& what) {
  return std::find(list.begin(), list.end(), what) != list.end();
}
void expect_valid(const Element& e) {
  const auto rule = junit_rules.find(e.name);
  ASSERT_NE(rule, junit_rules.end()) << e.name;
  for (const std::string& need : rule->second.required) EXPECT_TRUE(e.attributes.count(need)) << e.name << " " << need;
  for (const auto& [key, value] : e.attributes) {
    EXPECT_TRUE(holds(rule->second.required, key) || holds(rule->second.optional, key)) << e.name << " " << key;
    if (holds({"time", "tests", "failures", "errors", "skipped"}, key)) {
      size_t read = 0;
      EXPECT_GE(std::stod(value, &read), 0);
      EXPECT_EQ(read, value.size());
    }
  }
  for (const Element& child : e.children) {
    EXPECT_TRUE(holds(rule->second.children, child.name)) << child.name << " in " << e.name;
    expect_valid(child);
  }
}
int count(const Element& e, const std::string& name) {
  int n = e.name == name;
  for (const Element& child : e.children) n += count(child, name);
  return n;
}

TEST(Junit, FollowsTheSchemaAndCountsRight) {
  for (const Result& r : {awkward(), nothing_ran()}) {
    const std::string text = junit(r, common());
    const Element root = XmlReader(text).document();
    expect_valid(root);
    EXPECT_EQ(count(root, "testcase"), static_cast<int>(r.tests.size()) + 1);
    for (const Element* suite : {&root, &root.children[0], &root.children.back()})
      for (const auto& [attribute, element] : std::map<std::string, std::string>{
               {"tests", "testcase"}, {"failures", "failure"}, {"errors", "error"}, {"skipped", "skipped"}})
        EXPECT_EQ(std::stoi(suite->attributes.at(attribute)), count(*suite, element)) << attribute;
  }
  const std::string text = junit(awkward(), common());
  const Element root = XmlReader(text).document();
  ASSERT_EQ(root.children.size(), 3u);  // preflight and two parts, which contain their hidden tests
  const Element& wrong = root.children[1].children[1].children.at(0);
  EXPECT_EQ(wrong.name, "failure");
  EXPECT_EQ(wrong.attributes.at("message"), "row 2: expected 1 < x & \"y\", got");
  EXPECT_NE(wrong.text.find("ignores its argument"), std::string::npos);
  EXPECT_NE(wrong.text.find("Why <small> steps"), std::string::npos);
}

TEST(Autolab, LastLineHasTheScores) {
  for (const Result& r : {awkward(), nothing_ran()}) {
    const std::string text = autolab(r, common());
    ASSERT_TRUE(text.ends_with("\n"));
    const size_t begin = text.rfind('\n', text.size() - 2) + 1;
    const JsonField line = JsonField::parse(text.substr(begin), "autolab.txt");
    EXPECT_EQ(violations(line, {{"scores", Field::object}, {"scoreboard", Field::list}}, "line"), "");
    for (const auto& [problem, points] : line["scores"].items()) EXPECT_TRUE(points.is_number()) << problem;
    EXPECT_EQ(line["scoreboard"].size(), 1u);
  }
  const std::string text = autolab(awkward(), common());
  EXPECT_TRUE(text.ends_with(R"({"scores":{"linear":3.0,"limits":5.0,"hidden":9.0},"scoreboard":[8.0]})"
                             "\n"));
}

TEST(Formats, HiddenNumbersStayOutOfWhatStudentsReadAtOnce) {
  Result all_right = awkward();
  for (TestResult& t : all_right.tests)
    if (t.hidden) t.earned = t.points, t.said.clear(), t.seconds = 7;
  // the verdicts of hidden tests do not influence these outputs
  EXPECT_EQ(junit(awkward(), common()), junit(all_right, common()));
  EXPECT_EQ(summary_of(awkward(), common()), summary_of(all_right, common()));
  EXPECT_EQ(junit(awkward(), common()).find("SECRET"), std::string::npos);
  EXPECT_EQ(autolab(awkward(), common()).find("SECRET"), std::string::npos);
  const std::string summary = summary_of(awkward(), common());
  EXPECT_NE(summary.find("Public tests so far: 2 of 3 passed; 3 more tests run later."), std::string::npos) << summary;
  EXPECT_NE(summary_of(nothing_ran(), common()).find("not finished"), std::string::npos);
}

TEST(Clean, KeepsTextAndReplacesTheRest) {
  for (const std::string good : {"plain\n\ttext", "h\xc3\xa9", "\xe5\xbc\xb9\xe7\xb0\xa7", "\xf0\x9f\x98\x80"})
    EXPECT_EQ(clean(good), good);
  const std::string mark = "\xef\xbf\xbd";
  EXPECT_EQ(clean(std::string("a\0b", 3)), "a" + mark + "b");
  EXPECT_EQ(clean("\x1b[31m"), mark + "[31m");
  EXPECT_EQ(clean("\xc0\xaf"), mark + mark);                        // overlong
  EXPECT_EQ(clean("\xed\xa0\x80"), mark + mark + mark);             // surrogate
  EXPECT_EQ(clean("\xe5\xbc"), mark + mark);                        // cut short
  EXPECT_EQ(clean("\xf5\x80\x80\x80"), mark + mark + mark + mark);  // beyond Unicode
}

}  // namespace
}  // namespace coursework
