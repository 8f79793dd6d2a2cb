// The page escapes all text from the student.
#include "tests/coursework/grader/result.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <sstream>

#include "mysim/base/errors.h"
#include "mysim/base/json.h"
#include "tests/coursework/check/page.h"
#include "tests/coursework/check/plot.h"
#include "tests/coursework/grader/formats.h"

namespace coursework {

using crosscheck::Json;
using crosscheck::JsonField;

namespace {

// keys in alphabetical order, as in files of earlier gradings
Json json_of(const TestResult& t) {
  return {
      {"cause", t.cause}, {"concepts", t.concepts}, {"earned", t.earned}, {"heading", t.heading},  {"hidden", t.hidden},
      {"id", t.id},       {"part", t.part},         {"plot", t.plot},     {"points", t.points},    {"read", t.read},
      {"said", t.said},   {"seconds", t.seconds},   {"title", t.title},   {"ungraded", t.ungraded}};
}

TestResult test_of(const JsonField& f) {
  return {.id = f["id"].text(),
          .part = f["part"].text(),
          .title = f["title"].text(),
          .heading = f["heading"].text(),
          .hidden = f["hidden"].boolean(),
          .ungraded = f["ungraded"].boolean(),
          .points = f["points"].number(),
          .earned = f["earned"].number(),
          .concepts = f["concepts"].texts(),
          .said = f["said"].text(),
          .cause = f["cause"].text(),
          .read = f["read"].text(),
          .plot = f["plot"].text(),
          .seconds = f["seconds"].number()};
}

}  // namespace

double Result::earned() const {
  double sum = 0;
  for (const TestResult& test : tests) sum += test.earned;
  return sum;
}

double Result::points() const {
  double sum = 0;
  for (const TestResult& test : tests) sum += test.points;
  return sum;
}

double Result::ungraded() const {
  double sum = 0;
  for (const TestResult& test : tests) sum += test.ungraded ? test.points : 0;
  return sum;
}

std::string_view status_of(const TestResult& test) {
  return test.ungraded ? "ungraded" : passed(test) ? "passed" : "failed";
}

bool passed(const TestResult& test) {
  return test.earned == test.points && (test.said.empty() || !test.reason.empty());
}

std::string to_json(const Result& result, const std::string& fingerprint) {
  Json json{{"assignment", result.assignment}, {"complete", result.complete}};
  if (!fingerprint.empty()) json["fingerprint"] = fingerprint;
  json.update({{"lane", result.sandbox},
               {"not graded", result.not_graded},
               {"preflight", result.preflight},
               {"remark", result.remark},
               {"secret", result.secret},
               {"seed", result.seed},
               {"submission", result.submission},
               {"tests", Json::array()}});
  for (const TestResult& test : result.tests) json["tests"].push_back(json_of(test));
  return crosscheck::dump(json, 1) + "\n";  // invalid UTF-8 in a student's text is replaced
}

Result result_from_json(const std::string& text, const std::string& file, std::string* fingerprint) {
  try {
    const JsonField f = JsonField::parse(text, file);
    Result result{.assignment = f["assignment"].text(),
                  .submission = f["submission"].text(),
                  .sandbox = f["lane"].text(),
                  .seed = f["seed"].natural(),
                  .secret = f["secret"].boolean(),
                  .preflight = f["preflight"].texts(),
                  .tests = {},
                  .remark = f.find("remark") ? f["remark"].text() : "",
                  .not_graded = f["not graded"].text(),
                  .complete = f["complete"].boolean()};
    for (const JsonField& test : f["tests"].elements()) result.tests.push_back(test_of(test));
    if (const auto found = f.find("fingerprint"); found && fingerprint) *fingerprint = found->text();
    return result;
  } catch (const crosscheck::InputError& error) {
    throw crosscheck::InputError(fmt::format("no result of the grader: {}", error.what()));
  }
}

namespace {

const TestResult* public_twin(const Result& result, const TestResult& test) {
  for (const TestResult& other : result.tests)
    if (test.hidden && !other.hidden && other.id == test.id) return &other;
  return nullptr;
}

/// Failed public tests of the part with this cause. Hidden tests are omitted, because they must not reveal anything
/// yet.
std::vector<std::string> with_cause(const Result& result, const std::string& part, const std::string& cause) {
  std::vector<std::string> ids;
  for (const TestResult& test : result.tests)
    if (!test.hidden && test.part == part && test.cause == cause && !passed(test)) ids.push_back(test.id);
  return ids;
}

bool told_at_the_top(const Result& result, const TestResult& test, const Texts& common) {
  return !test.cause.empty() && test.cause != common.of("no_cause") &&
         with_cause(result, test.part, test.cause).size() > 1;
}

}  // namespace

std::vector<std::string> causes_of(const Result& result, const Texts& common) {
  std::vector<std::string> lines;
  for (const TestResult& test : result.tests) {
    if (test.hidden || passed(test) || !told_at_the_top(result, test, common)) continue;
    const std::vector<std::string> ids = with_cause(result, test.part, test.cause);
    if (ids.front() == test.id)
      lines.push_back(common.fill("cause.top", test.heading, fmt::format("{}", fmt::join(ids, ", ")), test.cause));
  }
  return lines;
}

std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
  return clean(text);
}

std::string points_text(double points) { return fmt::format("{:g}", points); }

std::vector<std::string> lines_on(const Result& result, const TestResult& test, const Texts& common, bool alone) {
  std::vector<std::string> lines;
  if (!test.reason.empty()) lines.push_back(common.fill("override", printable(test.reason)));
  if (passed(test)) return lines;
  const TestResult* twin = public_twin(result, test);
  const bool same = twin && !passed(*twin) && twin->said != common.of("shown_only") && twin->cause == test.cause;
  if (same) return lines.push_back(common.of("as_public")), lines;
  std::istringstream said(test.said);
  for (std::string line; std::getline(said, line);) lines.push_back(printable(line));
  if (!test.cause.empty())
    lines.push_back(!alone && told_at_the_top(result, test, common) ? common.of("cause.above") : test.cause);
  if (!test.read.empty()) lines.push_back(common.fill("read", test.read));
  return lines;
}

std::string total_of(const Result& result, const Texts& common) {
  if (!result.not_graded.empty()) return common.fill("not_graded", result.not_graded);
  int seen = 0, right = 0, later = 0;
  const std::string waiting = common.of("not_run");
  for (const TestResult& test : result.tests) {
    later += test.hidden && test.said == waiting;
    seen += !test.hidden;
    right += !test.hidden && passed(test);
  }
  const double graded = result.points() - result.ungraded();
  std::string total = common.fill("total", points_text(result.earned()), points_text(graded));
  if (result.ungraded() > 0) total += "\n" + common.fill("total.ungraded", points_text(result.ungraded()));
  if (later == 0) return total;
  return total + "\n" +
         (right == seen
              ? common.fill("public_done", std::to_string(later))
              : common.fill("public_now", std::to_string(right), std::to_string(seen), std::to_string(later)));
}

std::string points_of(const TestResult& test, const Texts& common) {
  return test.ungraded ? common.fill("points.ungraded", points_text(test.points))
                       : common.fill("points", points_text(test.earned), points_text(test.points));
}

std::string text_of(const Result& result, const Texts& common) {
  std::string text = common.fill("page.title", result.assignment, printable(result.submission)) + "\n" +
                     common.fill("page.sandbox", result.secret ? common.of("page.secret") : std::to_string(result.seed),
                                 result.sandbox) +
                     "\n";
  for (const std::string& line : result.preflight) text += "! " + printable(line) + "\n";
  for (const std::string& line : causes_of(result, common)) text += printable(line) + "\n";
  std::string part, shown;  // the last text on the part, in order not to repeat it for every test
  bool hidden = false;
  for (const TestResult& test : result.tests) {
    if (test.part != part || test.hidden != hidden) {
      part = test.part, hidden = test.hidden, shown.clear();
      text += fmt::format("\n{}{}\n", test.heading, hidden ? " (" + common.of("hidden") + ")" : "");
    }
    text += fmt::format("  {:<5} {:<8} {}  ({})\n", test.id, common.of(std::string(status_of(test))), test.title,
                        points_of(test, common));
    const std::vector<std::string> lines = lines_on(result, test, common);
    for (const std::string& line : lines) {
      const bool again = line == shown;
      if (line == test.cause || line == common.of("cause.above") || lines.size() == 1) shown = line;
      if (!again) text += "        " + line + "\n";
    }
  }
  return text + "\n" + total_of(result, common) + "\n" + (result.complete ? "" : common.of("page.not_done") + "\n");
}

namespace {

constexpr const char* style = R"(<style>
body{font:16px/1.5 system-ui,sans-serif;max-width:50rem;margin:2rem auto;padding:0 1rem;color:#222}
h1{font-size:1.4rem}h2{font-size:1.15rem;margin-top:2rem}
section{border-left:4px solid #d62728;padding:.2rem 1rem;margin:1rem 0;background:#fafafa}
section.passed{border-color:#2ca02c}section.ungraded{border-color:#777}section h3{font-size:1rem;margin:.3rem 0}
p{margin:.3rem 0}pre{overflow-x:auto;margin:.3rem 0}.points{float:right;font-weight:normal}.total{font-size:1.2rem;font-weight:bold;white-space:pre-line}
.cause{background:#e8f0fe;padding:.4rem .8rem}.remark{background:#fff3cd;padding:.4rem .8rem;white-space:pre-wrap}svg{max-width:100%;height:auto;background:#fff}
</style>)";

std::string section_of(const Result& result, const TestResult& test, const Texts& common) {
  std::string text =
      fmt::format("<section class=\"{}\">\n<h3>{} {} {} {}<span class=\"points\">{}</span></h3>\n", status_of(test),
                  passed(test)    ? "&#10003;"
                  : test.ungraded ? "&#8211;"
                                  : "&#10007;",
                  escaped(test.id), escaped(test.title), test.hidden ? "(" + escaped(common.of("hidden")) + ")" : "",
                  escaped(points_of(test, common)));
  return text + paragraphs(lines_on(result, test, common)) + test.plot + "</section>\n";
}

}  // namespace

std::string page_of(const Result& result, const Texts& common, const Texts& own, const std::string& charts) {
  const std::string title = escaped(
      common.fill("page.title", own.has("title") ? own.of("title") : result.assignment, clean(result.submission)));
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"{4}\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\">"
      "<title>{0}</title>\n{1}</head><body>\n<h1>{0}</h1>\n<p class=\"total\">{2}</p>\n<p>{3}</p>\n",
      title, style, escaped(total_of(result, common)),
      escaped(common.fill("page.sandbox", result.secret ? common.of("page.secret") : std::to_string(result.seed),
                          result.sandbox)),
      escaped(common.of("page.lang")));
  if (!result.complete) page += "<p class=\"remark\">" + escaped(common.of("page.not_done")) + "</p>\n";
  for (const std::string& line : result.preflight) page += "<p class=\"remark\">" + escaped(clean(line)) + "</p>\n";
  for (const std::string& line : causes_of(result, common)) page += "<p class=\"cause\">" + escaped(line) + "</p>\n";
  if (!charts.empty())
    page += fmt::format("<p><a href=\"{}\">{}</a></p>\n", escaped(charts), escaped(common.of("page.charts")));
  std::string part;
  bool hidden = false;
  for (const TestResult& test : result.tests) {
    if (test.part != part || test.hidden != hidden) {
      part = test.part, hidden = test.hidden;
      const std::string key = part + ".title";
      page += fmt::format("<h2>{}{}</h2>\n", escaped(own.has(key) ? own.of(key) : part),
                          hidden ? " (" + escaped(common.of("hidden")) + ")" : "");
    }
    page += section_of(result, test, common);
  }
  return page + "</body></html>\n";
}

}  // namespace coursework
