// JUnit XML as Jenkins, GitHub and GitLab read it: testsuites, testsuite, testcase with failure, error or skipped.
#include <fmt/format.h>

#include <algorithm>

#include "tests/coursework/grader/formats/feedback.h"
#include "tests/coursework/grader/formats/formats.h"

namespace coursework {
namespace {

std::string xml(const std::string& text) {
  std::string out;
  for (const char c : clean(text)) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':  // kept in attributes too
        out += "&#10;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

struct Suite {
  std::string name, cases;
  int tests = 0, failures = 0, errors = 0, skipped = 0;
  double seconds = 0;
  std::string counts() const {
    return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\"", tests, failures,
                       errors, skipped, seconds);
  }
};

void add(Suite& suite, const Result& result, const TestResult& test, const Texts& common) {
  ++suite.tests;
  std::string inside;
  if (test.hidden) {
    ++suite.skipped;
    inside = fmt::format("<skipped message=\"{}\"/>", xml(common.of("hidden_later")));
  } else if (!passed(test)) {
    ++suite.failures;
    inside = fmt::format("<failure type=\"wrong\" message=\"{}\">{}</failure>", xml(first_line(test.said)),
                         xml(feedback_on(result, test, common)));
  }
  // the time of a hidden test may tell how it went
  const double seconds = test.hidden ? 0 : test.seconds;
  suite.seconds += seconds;
  suite.cases += fmt::format("    <testcase classname=\"{}.{}\" name=\"{} {}{}\" time=\"{:.3f}\">{}</testcase>\n",
                             xml(result.assignment), xml(test.part), xml(test.id), xml(test.title),
                             test.hidden ? " (" + xml(common.of("hidden")) + ")" : "", seconds, inside);
}

/// Files and compiler, as a suite of one test.
Suite preflight_of(const Result& result) {
  Suite suite{"preflight", ""};
  suite.tests = 1;
  std::string inside, lines;
  for (const std::string& line : result.preflight) lines += line + "\n";
  if (!lines.empty()) {
    suite.errors = 1;
    inside = fmt::format("<error type=\"preflight\" message=\"{}\">{}</error>", xml(first_line(lines)), xml(lines));
  }
  suite.cases =
      fmt::format("    <testcase classname=\"{}.preflight\" name=\"files and compiler\" time=\"0.000\">{}</testcase>\n",
                  xml(result.assignment), inside);
  return suite;
}

}  // namespace

std::string junit(const Result& result, const Texts& common) {
  std::vector<Suite> suites = {preflight_of(result)};
  for (const TestResult& test : result.tests) {
    auto suite = std::find_if(suites.begin() + 1, suites.end(), [&](const Suite& s) { return s.name == test.part; });
    if (suite == suites.end()) suite = suites.insert(suite, {test.part, ""});
    add(*suite, result, test, common);
  }
  Suite all;
  std::string body;
  for (const Suite& suite : suites) {
    all.tests += suite.tests, all.failures += suite.failures, all.errors += suite.errors;
    all.skipped += suite.skipped, all.seconds += suite.seconds;
    body +=
        fmt::format("  <testsuite name=\"{}\" {}>\n{}  </testsuite>\n", xml(suite.name), suite.counts(), suite.cases);
  }
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\" {}>\n{}</testsuites>\n",
                     xml(result.assignment), all.counts(), body);
}

}  // namespace coursework
