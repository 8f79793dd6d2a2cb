// Sums, and JSON.
#include "tests/coursework/grader/result.h"

#include <fmt/format.h>

#include "mysim/errors.h"
#include "mysim/json.h"

namespace coursework {

using crosscheck::Json;
using crosscheck::JsonField;

namespace {

// in the order of the alphabet, as files of earlier gradings have it
Json json_of(const TestResult& t) {
  return {
      {"cause", t.cause}, {"concepts", t.concepts}, {"earned", t.earned}, {"heading", t.heading}, {"hidden", t.hidden},
      {"id", t.id},       {"part", t.part},         {"plot", t.plot},     {"points", t.points},   {"read", t.read},
      {"said", t.said},   {"seconds", t.seconds},   {"title", t.title}};
}

TestResult test_of(const JsonField& f) {
  return {.id = f["id"].text(),
          .part = f["part"].text(),
          .title = f["title"].text(),
          .heading = f["heading"].text(),
          .hidden = f["hidden"].truth(),
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

bool passed(const TestResult& test) { return test.said.empty() && test.earned == test.points; }

std::string to_json(const Result& result, const std::string& fingerprint) {
  Json json{{"assignment", result.assignment}, {"complete", result.complete}};
  if (!fingerprint.empty()) json["fingerprint"] = fingerprint;
  json.update({{"lane", result.lane},
               {"preflight", result.preflight},
               {"secret", result.secret},
               {"seed", result.seed},
               {"submission", result.submission},
               {"tests", Json::list()}});
  for (const TestResult& test : result.tests) json["tests"].push(json_of(test));
  return json.dump(1) + "\n";  // bytes of a student's text that are no UTF-8 are replaced
}

Result result_from_json(const std::string& text, const std::string& file, std::string* fingerprint) {
  try {
    const JsonField f = JsonField::parse(text, file);
    Result result{.assignment = f["assignment"].text(),
                  .submission = f["submission"].text(),
                  .lane = f["lane"].text(),
                  .seed = f["seed"].natural(),
                  .secret = f["secret"].truth(),
                  .preflight = f["preflight"].texts(),
                  .tests = {},
                  .complete = f["complete"].truth()};
    for (const JsonField& test : f["tests"].elements()) result.tests.push_back(test_of(test));
    if (const auto found = f.find("fingerprint"); found && fingerprint) *fingerprint = found->text();
    return result;
  } catch (const crosscheck::InputError& error) {
    throw crosscheck::InputError(fmt::format("no result of the grader: {}", error.what()));
  }
}

}  // namespace coursework
