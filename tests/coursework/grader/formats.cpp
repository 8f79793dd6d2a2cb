#include "tests/coursework/grader/formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mysim/base/json.h"
#include "mysim/base/text.h"
#include "tests/coursework/check/plot.h"
#include "tests/coursework/grader/result.h"

namespace coursework {
std::string clean(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size();) {
    // U+FFFE and U+FFFF are not characters
    const bool never = text.compare(i, 3, "\xef\xbf\xbe") == 0 || text.compare(i, 3, "\xef\xbf\xbf") == 0;
    const size_t length = never ? 0 : crosscheck::utf8_length(text, i);
    const unsigned char c = static_cast<unsigned char>(text[i]);
    if (length == 0 || (c < 0x20 && c != '\t' && c != '\n') || c == 0x7f)
      out += "\xef\xbf\xbd";
    else
      out.append(text, i, length);
    i += std::max<size_t>(length, 1);
  }
  return out;
}

std::string defused(const std::string& text) {
  // spreadsheets ignore leading blanks, leading quotes and text up to a separator; some read full-width signs as ASCII
  static constexpr std::string_view signs[] = {"=", "+", "-", "@", "\t", "\r", "＝", "＋", "－", "＠"};
  std::string safe;
  bool begins = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const std::string_view rest = std::string_view(text).substr(i);
    if (begins && std::ranges::any_of(signs, [&](std::string_view sign) { return rest.starts_with(sign); }))
      safe += '\'';
    safe += c;
    begins = c == ';' || c == '\t' || c == '\r' || c == '\n' || (begins && (c == ' ' || c == '"'));
  }
  return safe;
}

std::string feedback_on(const Result& result, const TestResult& test, const Texts& common, bool alone) {
  std::string out;
  for (const std::string& line : lines_on(result, test, common, alone)) out += (out.empty() ? "" : "\n") + line;
  return clean(out);
}

std::string summary_of(const Result& result, const Texts& common) {
  if (!result.not_graded.empty()) return clean(total_of(result, common));
  int tests = 0, good = 0, hidden = 0;
  double points = 0, earned = 0;
  for (const TestResult& test : result.tests) {
    if (test.hidden) {
      ++hidden;
      continue;
    }
    ++tests, good += passed(test);
    points += test.points, earned += test.earned;
  }
  std::string out;
  for (const std::string& line : result.preflight) out += line + "\n";
  out += common.fill("total", points_text(earned), points_text(points)) + "\n";
  const std::string later = std::to_string(hidden);
  out += good == tests ? common.fill("public_done", later)
                       : common.fill("public_now", std::to_string(good), std::to_string(tests), later);
  for (const std::string& line : causes_of(result, common)) out += "\n" + line;
  if (!result.complete) out += "\n" + common.of("page.not_done");
  return clean(out);
}

namespace {

using crosscheck::Json;

/// With a plot, the output is HTML: the plot is an embedded image, which can neither run scripts nor restyle the page.
void put_output(Json& to, const TestResult& test, const std::string& text) {
  to["output"] = test.plot.empty() ? text
                                   : "<pre>" + escaped(text) + "</pre><img alt=\"your numbers and the right ones\" " +
                                         "src=\"data:image/svg+xml;base64," + crosscheck::base64(test.plot) + "\">";
  to["output_format"] = test.plot.empty() ? "text" : "html";
}

Json gradescope_test(const Result& result, const TestResult& test, const Texts& common) {
  Json out;
  if (!test.ungraded) out = {{"score", test.earned}};
  out["max_score"] = test.points;
  if (!test.ungraded) out["status"] = std::string(status_of(test));
  out.update({{"name", clean(test.title + (test.hidden ? " (" + common.of("hidden") + ")" : ""))},
              {"name_format", "text"},
              {"number", test.id}});
  put_output(out, test, feedback_on(result, test, common));
  out["tags"] = test.concepts;
  out["visibility"] = test.hidden ? "after_published" : "visible";
  out["extra_data"] = {{"part", test.part}, {"hidden", test.hidden}, {"seconds", test.seconds}};
  return out;
}

}  // namespace

std::string gradescope(const Result& result, const Texts& common) {
  double earned = 0, seconds = 0, shown = 0;
  Json tests = Json::array();
  for (const TestResult& test : result.tests) {
    tests.push_back(gradescope_test(result, test, common));
    earned += test.earned;
    seconds += test.seconds;
    if (!test.hidden) shown += test.earned;
  }
  const Json out{
      {"score", earned},
      {"execution_time", static_cast<long>(std::ceil(seconds))},
      {"output", summary_of(result, common)},
      {"output_format", "text"},
      {"test_output_format", "text"},
      {"test_name_format", "text"},
      {"visibility", "visible"},
      // the harness's own output, which contains nothing of the student's program and may name hidden tests
      {"stdout_visibility", "hidden"},
      {"extra_data",
       {{"assignment", result.assignment},
        {"seed", result.secret ? "secret" : std::to_string(result.seed)},
        {"lane", result.sandbox},
        {"complete", result.complete}}},
      {"tests", std::move(tests)},
      // only public points, because a leaderboard is visible before the grades
      {"leaderboard", Json::array({Json{{"name", "Public points"}, {"value", shown}, {"order", "desc"}}})},
  };
  return crosscheck::dump(out, 2) + "\n";
}

namespace {

std::string xml(const std::string& text) {
  std::string out;
  for (const char c : escaped(clean(text))) c == '\n' ? out += "&#10;" : out += c;  // kept in attributes, unlike \n
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

void add_test(Suite& suite, const Result& result, const TestResult& test, const Texts& common) {
  ++suite.tests;
  std::string inside;
  if (test.hidden) {
    ++suite.skipped;
    inside = fmt::format("<skipped message=\"{}\"/>", xml(common.of("hidden_later")));
  } else if (test.ungraded) {
    ++suite.skipped;
    inside = fmt::format("<skipped message=\"{}\"/>", xml(feedback_on(result, test, common)));
  } else if (!passed(test)) {
    ++suite.failures;
    inside = fmt::format("<failure type=\"wrong\" message=\"{}\">{}</failure>", xml(first_line(test.said)),
                         xml(feedback_on(result, test, common, true)));
  }
  // the time of a hidden test could reveal its verdict
  const double seconds = test.hidden ? 0 : test.seconds;
  suite.seconds += seconds;
  suite.cases += fmt::format("    <testcase classname=\"{}.{}\" name=\"{} {}{}\" time=\"{:.3f}\">{}</testcase>\n",
                             xml(result.assignment), xml(test.part), xml(test.id), xml(test.title),
                             test.hidden ? " (" + xml(common.of("hidden")) + ")" : "", seconds, inside);
}

/// Files and compilation as a suite of one test.
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
    add_test(*suite, result, test, common);
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

std::string autolab(const Result& result, const Texts& common) {
  std::string text = summary_of(result, common) + "\n";
  std::vector<std::pair<std::string, double>> problems;
  double shown = 0, hidden = 0;
  for (const TestResult& test : result.tests) {
    if (test.hidden) {
      hidden += test.earned;
      continue;
    }
    shown += test.earned;
    auto problem = std::find_if(problems.begin(), problems.end(), [&](const auto& p) { return p.first == test.part; });
    if (problem == problems.end()) problem = problems.insert(problem, {test.part, 0});
    problem->second += test.earned;
    text += fmt::format("\n{} {}: {}\n", test.id, clean(test.title), points_of(test, common));
    if (!passed(test)) text += feedback_on(result, test, common) + "\n";
  }
  Json scores;
  for (const auto& [problem, points] : problems) scores[problem] = points;
  scores["hidden"] = hidden;
  const Json line{{"scores", std::move(scores)}, {"scoreboard", Json::array({shown})}};
  return text + "\n" + crosscheck::dump(line) + "\n";
}

std::span<const Format> formats() {
  static constexpr Format table[] = {
      {"text", "result.txt", text_of},
      {"gradescope", "results.json", gradescope},
      {"junit", "junit.xml", junit},
      {"autolab", "autolab.txt", autolab},
  };
  return table;
}

const Format& find_format(const std::string& name) {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (format.name == name) return format;
    names.emplace_back(format.name);
  }
  throw std::invalid_argument(fmt::format("unknown format '{}'; expected one of: {}{}", name, fmt::join(names, ", "),
                                          crosscheck::did_you_mean(name, names)));
}

}  // namespace coursework
