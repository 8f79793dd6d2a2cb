// Autolab: whatever text, and on the last line the scores of each problem.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tests/coursework/grader/formats/feedback.h"
#include "tests/coursework/grader/formats/formats.h"
#include "tests/coursework/grader/text_format.h"

namespace coursework {

std::string autolab(const Result& result, const Texts& common) {
  std::string text = summary_of(result, common) + "\n";
  nlohmann::ordered_json scores = nlohmann::ordered_json::object();
  double shown = 0, hidden = 0;
  for (const TestResult& test : result.tests) {
    if (test.hidden) {
      hidden += test.earned;
      continue;
    }
    shown += test.earned;
    double& problem = *scores.emplace(test.part, 0.0).first->get_ptr<double*>();
    problem += test.earned;
    text += fmt::format("\n{} {}: {}\n", test.id, clean(test.title),
                        common.fill("points", points_text(test.earned), points_text(test.points)));
    if (!passed(test)) text += feedback_on(result, test, common) + "\n";
  }
  scores["hidden"] = hidden;
  const nlohmann::ordered_json line = {{"scores", scores}, {"scoreboard", {shown}}};
  return text + "\n" + line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace coursework
