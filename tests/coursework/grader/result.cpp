// Sums, and JSON.
#include "tests/coursework/grader/result.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "mysim/errors.h"

namespace coursework {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TestResult, id, part, title, heading, hidden, points, earned, concepts, said, cause,
                                   read, plot, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Result, assignment, submission, lane, seed, secret, preflight, tests, complete)

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

bool passed(const TestResult& test) { return test.said.empty() && test.earned == test.points; }

std::string to_json(const Result& result) {
  // a student's text may hold bytes that are no UTF-8
  return nlohmann::json(result).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Result result_from_json(const std::string& text, const std::string& file) {
  try {
    return nlohmann::json::parse(text).get<Result>();
  } catch (const nlohmann::json::exception& error) {
    throw crosscheck::InputError(fmt::format("{}: no result of the grader: {}", file, error.what()));
  }
}

}  // namespace coursework
