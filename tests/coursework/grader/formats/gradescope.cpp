// Gradescope's results.json (Autograder Specifications, "Output format").
#include <cmath>

#include "mysim/json.h"
#include "tests/coursework/grader/formats/feedback.h"
#include "tests/coursework/grader/formats/formats.h"

namespace coursework {
namespace {

using crosscheck::Json;

std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    unsigned three = 0;
    for (size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (int k = 0; k < 4; ++k) out += digits[three >> (18 - 6 * k) & 63];
  }
  for (size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k) out[out.size() - 1 - k] = '=';
  return out;
}

std::string html(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const std::string_view as = c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : "";
    as.empty() ? out.push_back(c) : void(out += as);
  }
  return out;
}

/// With a plot the text is HTML; the plot is an image of its own there, which can neither run nor restyle anything.
void put_output(Json& to, const TestResult& test, const std::string& text) {
  to["output"] = test.plot.empty() ? text
                                   : "<pre>" + html(text) + "</pre><img alt=\"your numbers and the right ones\" " +
                                         "src=\"data:image/svg+xml;base64," + base64(test.plot) + "\">";
  to["output_format"] = test.plot.empty() ? "text" : "html";
}

Json test_of(const Result& result, const TestResult& test, const Texts& common) {
  Json out{{"score", test.earned},
           {"max_score", test.points},
           {"status", passed(test) ? "passed" : "failed"},
           {"name", clean(test.title + (test.hidden ? " (" + common.of("hidden") + ")" : ""))},
           {"name_format", "text"},
           {"number", test.id}};
  put_output(out, test, feedback_on(result, test, common));
  out["tags"] = test.concepts;
  out["visibility"] = test.hidden ? "after_published" : "visible";
  out["extra_data"] = {{"part", test.part}, {"hidden", test.hidden}, {"seconds", test.seconds}};
  return out;
}

}  // namespace

std::string gradescope(const Result& result, const Texts& common) {
  double earned = 0, seconds = 0, shown = 0;
  Json tests = Json::list();
  for (const TestResult& test : result.tests) {
    tests.push(test_of(result, test, common));
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
      // the harness's own output; nothing of the student's program is in it, and it may name hidden tests
      {"stdout_visibility", "hidden"},
      {"extra_data",
       {{"assignment", result.assignment},
        {"seed", result.secret ? "secret" : std::to_string(result.seed)},
        {"lane", result.lane},
        {"complete", result.complete}}},
      {"tests", std::move(tests)},
      // public points alone: a leaderboard is seen before the grades are
      {"leaderboard", Json::list(Json{{"name", "Public points"}, {"value", shown}, {"order", "desc"}})},
  };
  return out.dump(2) + "\n";
}

}  // namespace coursework
