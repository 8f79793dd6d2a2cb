// Recovers the formula of a stepper in a whole program from one step of a linear system: only the resulting state is
// visible, in single precision.
#include <cmath>

#include "tests/coursework/check/random.h"
#include "tests/coursework/check/words.h"
#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/fit.h"

namespace coursework::classic {
namespace {

using Terms = std::vector<Numbers>;

/// h times the slope of a linear system: nine numbers of A, q, which is 0, and c (probe/own.h).
Numbers times(const Numbers& a, const Numbers& x, double h) {
  Numbers out;
  for (std::size_t i = 0; i < x.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      out.push_back(h * (a[3 * k] * x[i] + a[3 * k + 1] * x[i + 1] + a[3 * k + 2] * x[i + 2] +
                         a[10] * x[(i + 3 + k) % x.size()]));
  return out;
}

}  // namespace

Looked step_text(const Texts& common, const std::string& part, const Ask& student) {
  Random random(31);
  // three step sizes: terms differ in their order, and h^2 is no linear combination of h and 1
  std::vector<Case> cases;
  Terms columns(5);
  Numbers a;
  for (int i = 0; i < 9; ++i) a.push_back(static_cast<float>(random.uniform(-1.5, 1.5)));
  a.insert(a.end(), {0, 0.75});
  for (const double h : {0.25, 0.5, 0.875}) {
    Case c{part + ".path", {h, 1}, {}, 3};
    c.in.insert(c.in.end(), a.begin(), a.end());
    Numbers x;
    for (int i = 0; i < 12; ++i) x.push_back(static_cast<float>(random.uniform(-1.5, 1.5)));
    c.in.insert(c.in.end(), x.begin(), x.end());
    const Numbers once = times(a, x, h), twice = times(a, once, h);
    const Numbers bare = times(a, x, 1), squared = times(a, x, h * h);  // a forgotten h, and a surplus one
    const Numbers* all[] = {&x, &once, &twice, &bare, &squared};
    for (std::size_t k = 0; k < 5; ++k) columns[k].insert(columns[k].end(), all[k]->begin(), all[k]->end());
    cases.push_back(c);
  }
  cases.push_back(cases.front());
  cases.back().call = part + ".calls";
  std::vector<Answer> answers = student(cases);
  const Answer calls = answers.back();
  answers.pop_back();
  Numbers result;
  for (const Answer& answer : answers) {
    if (answer.how != How::answered || answer.got.size() != 12) return {};
    result.insert(result.end(), answer.got.begin(), answer.got.end());
  }
  const Numbers right{1, 1, part == "trapezoidal" ? 0.5 : 0, 0, 0}, asked{part == "trapezoidal" ? 2.0 : 1.0};
  std::string often;
  if (calls.how == How::answered && calls.got.size() == 1 && calls.got != asked)
    often = common.fill("rule.calls", with_digits(asked[0], 3), with_digits(calls.got[0], 3));
  const std::vector<NamedTerm> terms{{"x"}, {"h f(x)"}, {"h^2 f(f(x))"}, {"f(x)"}, {"h^2 f(x)"}};
  // a step is about twenty roundings of 6e-8 of numbers below 10
  constexpr double rounding = 3e-5, known = 1e-3;
  Numbers found = coefficients(columns, result, rounding);
  if (found.empty()) return {often, !often.empty()};
  for (double& value : found)
    if (std::abs(value) < known) value = 0;
  bool same = true;
  for (std::size_t k = 0; k < 5; ++k) same = same && std::abs(found[k] - right[k]) < known;
  if (same) return {common.of("rule.right_linear"), false};
  const std::string rule = common.fill("rule.linear", sum_text(terms, found, known), sum_text(terms, right, known));
  return {often.empty() ? rule : rule + " " + often, true};
}

}  // namespace coursework::classic
