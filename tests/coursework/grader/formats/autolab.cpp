// Autolab: whatever text, and on the last line the scores of each problem.
#include <fmt/format.h>

#include <algorithm>

#include "mysim/json.h"
#include "tests/coursework/grader/formats/feedback.h"
#include "tests/coursework/grader/formats/formats.h"
#include "tests/coursework/grader/text_format.h"

namespace coursework {

using crosscheck::Json;

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
    text += fmt::format("\n{} {}: {}\n", test.id, clean(test.title),
                        common.fill("points", points_text(test.earned), points_text(test.points)));
    if (!passed(test)) text += feedback_on(result, test, common) + "\n";
  }
  Json scores;
  for (const auto& [problem, points] : problems) scores[problem] = points;
  scores["hidden"] = hidden;
  const Json line{{"scores", std::move(scores)}, {"scoreboard", Json::list(shown)}};
  return text + "\n" + line.dump() + "\n";
}

}  // namespace coursework
