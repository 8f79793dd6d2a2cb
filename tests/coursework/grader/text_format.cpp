// Words for the terminal.
#include "tests/coursework/grader/text_format.h"

#include <fmt/format.h>

#include <sstream>

namespace coursework {
namespace {

const TestResult* public_twin(const Result& result, const TestResult& test) {
  for (const TestResult& other : result.tests)
    if (test.hidden && !other.hidden && other.id == test.id) return &other;
  return nullptr;
}

}  // namespace

std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
  return text;
}

std::string points_text(double points) { return fmt::format("{:g}", points); }

std::vector<std::string> lines_on(const Result& result, const TestResult& test, const Texts& common) {
  std::vector<std::string> lines;
  if (passed(test)) return lines;
  const TestResult* twin = public_twin(result, test);
  const bool same = twin && !passed(*twin) && twin->said != common.of("shown_only") && twin->cause == test.cause;
  if (same) return {common.of("as_public")};
  std::istringstream said(test.said);
  for (std::string line; std::getline(said, line);) lines.push_back(printable(line));
  if (!test.cause.empty()) lines.push_back(test.cause);
  if (!test.read.empty()) lines.push_back(common.fill("read", test.read));
  return lines;
}

std::string total_of(const Result& result, const Texts& common) {
  int seen = 0, right = 0, later = 0;
  const std::string waiting = common.of("not_run");
  for (const TestResult& test : result.tests) {
    later += test.hidden && test.said == waiting;
    seen += !test.hidden;
    right += !test.hidden && passed(test);
  }
  const std::string total = common.fill("total", points_text(result.earned()), points_text(result.points()));
  if (later == 0) return total;
  return total + "\n" +
         (right == seen
              ? common.fill("public_done", std::to_string(later))
              : common.fill("public_now", std::to_string(right), std::to_string(seen), std::to_string(later)));
}

std::string text_of(const Result& result, const Texts& common) {
  std::string text =
      common.fill("page.title", result.assignment, printable(result.submission)) + "\n" +
      common.fill("page.lane", result.secret ? common.of("page.secret") : std::to_string(result.seed), result.lane) +
      "\n";
  for (const std::string& line : result.preflight) text += "! " + printable(line) + "\n";
  std::string part, shown;  // what was said last on the part is not said again test by test
  bool hidden = false;
  for (const TestResult& test : result.tests) {
    if (test.part != part || test.hidden != hidden) {
      part = test.part, hidden = test.hidden, shown.clear();
      text += fmt::format("\n{}{}\n", test.heading, hidden ? " (" + common.of("hidden") + ")" : "");
    }
    text += fmt::format("  {:<5} {:<8} {}  ({})\n", test.id, common.of(passed(test) ? "passed" : "failed"), test.title,
                        common.fill("points", points_text(test.earned), points_text(test.points)));
    const std::vector<std::string> lines = lines_on(result, test, common);
    for (const std::string& line : lines) {
      const bool again = line == shown;
      if (line == test.cause || lines.size() == 1) shown = line;
      if (!again) text += "        " + line + "\n";
    }
  }
  return text + "\n" + total_of(result, common) + "\n" + (result.complete ? "" : common.of("page.not_done") + "\n");
}

}  // namespace coursework
