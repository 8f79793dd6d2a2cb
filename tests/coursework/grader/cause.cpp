// Runs the known mistakes on what the student was asked, and stops at the first answer that differs.
#include "tests/coursework/grader/cause.h"

#include <algorithm>
#include <cmath>

#include "tests/coursework/check/judge.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/parallel.h"
#include "tests/coursework/grader/run.h"

namespace coursework {
namespace {

double largest(const Numbers& numbers) {
  double size = 0;
  for (const double value : numbers)
    if (std::isfinite(value)) size = std::max(size, std::abs(value));
  return size;
}

bool all_right(const Asked& one) {
  for (std::size_t i = 0; i < one.cases.size(); ++i)
    if (!judge(one.cases[i], one.answers[i]).right) return false;
  return true;
}

bool answers_alike(const Asked& one, const std::filesystem::path& program, const Lane& trusted) {
  const std::vector<Answer> answers = run_calls(trusted, program, one.cases);
  for (std::size_t i = 0; i < one.cases.size(); ++i)
    if (!agree(one.cases[i], one.answers[i], reduced(*one.test, one.cases[i], answers[i]))) return false;
  return true;
}

}  // namespace

Answer reduced(const Test& test, const Case& what, Answer raw) {
  if (test.reduce && raw.how == How::answered) raw.got = test.reduce(what, raw.got);
  return raw;
}

bool agree(const Case& what, const Answer& student, const Answer& mistake) {
  if (student.how != mistake.how) return false;
  if (student.how != How::answered) return true;
  if (student.got.size() != mistake.got.size()) return false;
  if (judge(what, student).right != judge(what, mistake).right) return false;
  const double right = largest(what.expected), wrong = largest(mistake.got);
  const double tolerance = what.tolerance * (right > 0 ? std::max(1.0, wrong / right) : 1.0);
  for (std::size_t i = 0; i < student.got.size(); ++i) {
    const bool finite = std::isfinite(student.got[i]);
    if (finite != std::isfinite(mistake.got[i])) return false;
    if (finite && !(std::abs(student.got[i] - mistake.got[i]) <= tolerance)) return false;
  }
  return true;
}

std::string likely_cause(const Assignment& assignment, const std::string& part, const std::vector<Asked>& asked,
                         const std::vector<Mistake>& known, const Builder& builder, const Lane& trusted,
                         unsigned jobs) {
  // what went wrong tells mistakes apart best: it is asked first
  std::vector<const Asked*> order;
  for (const Asked& one : asked) order.push_back(&one);
  std::stable_partition(order.begin(), order.end(), [](const Asked* one) { return !all_right(*one); });
  std::vector<const Mistake*> candidates;
  for (const Mistake& mistake : known)
    if (mistake.part == part) candidates.push_back(&mistake);
  const std::string solution = content_of_file(solution_of(assignment, builder, part));
  std::vector<char> fits(candidates.size(), 0);
  in_parallel(candidates.size(), jobs, [&](std::size_t i) {
    const std::filesystem::path program = builder.ours(part, with_mistake(solution, *candidates[i]));
    fits[i] = std::all_of(order.begin(), order.end(),
                          [&](const Asked* one) { return answers_alike(*one, program, trusted); });
  });
  if (std::count(fits.begin(), fits.end(), 1) != 1) return "";
  return candidates[static_cast<std::size_t>(std::find(fits.begin(), fits.end(), 1) - fits.begin())]->name;
}

}  // namespace coursework
