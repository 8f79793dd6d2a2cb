// Recovers a stepper's coefficients from its calls of f and its result: for each call, its time and the weights of the
// earlier slopes in its state; for the result, the weights of all slopes.
#include <cmath>

#include "tests/coursework/a1-steppers/systems.h"
#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/fit.h"

namespace coursework::a1 {
namespace {

constexpr double tolerance = 1e-9;  // sums of a dozen numbers below 10 have rounding errors of about 1e-14

struct Tableau {
  std::vector<double> times;           // one per call of f, in units of h after the start
  std::vector<std::vector<double>> a;  // weights of the earlier slopes, one row per state
  std::vector<double> b;               // weights of the result
};

Tableau right_tableau(const std::string& part) {
  if (part == "euler") return {{0}, {{}}, {1}};
  if (part == "trapezoidal") return {{0, 1}, {{}, {1}}, {1. / 2, 1. / 2}};
  return {{0, 1. / 2, 1. / 2, 1}, {{}, {1. / 2}, {0, 1. / 2}, {0, 0, 1}}, {1. / 6, 1. / 3, 1. / 3, 1. / 6}};
}

/// Data recorded in several steps. Each vector holds the numbers of all steps, one step after the other.
struct Steps {
  std::size_t calls = 0;
  Numbers start, result, t, h;
  std::vector<Numbers> times, states, slopes;  // one per call
};

/// Returns false if the student's code did not answer, or if the number of calls of f differs between steps.
bool taken(const std::string& part, const Ask& student, Steps& steps) {
  constexpr int n = 5, count = 3;
  Random random(20);
  std::vector<Case> cases;
  for (int i = 0; i < count; ++i) {
    Case points{part + ".points", start(random, n, 1, random.uniform(0.2, 0.7)), {}, n + 1};
    add_linear(random, Depends::on_state_and_time, points.in);
    Case step = points;
    step.call = part + ".linear";
    cases.push_back(points), cases.push_back(step);
  }
  const std::vector<Answer> answers = student(cases);
  for (std::size_t i = 0; i < cases.size(); i += 2) {
    const Numbers &in = cases[i].in, &points = answers[i].got, &result = answers[i + 1].got;
    if (answers[i].how != How::answered || answers[i + 1].how != How::answered || result.size() != n) return false;
    const std::size_t calls = points.size() / (n + 1);
    if (i > 0 && calls != steps.calls) return false;
    steps.calls = calls;
    steps.times.resize(calls), steps.states.resize(calls), steps.slopes.resize(calls);
    const double* a = &in[4 + n];
    for (std::size_t call = 0; call < calls; ++call) {
      const double *point = &points[call * (n + 1)], *x = point + 1;
      steps.times[call].push_back(point[0]);
      for (std::size_t row = 0; row < n; ++row) {
        double slope = a[n * n + row] + a[n * n + n + row] * point[0];
        for (std::size_t k = 0; k < n; ++k) slope += a[row * n + k] * x[k];
        steps.states[call].push_back(x[row]);
        steps.slopes[call].push_back(in[3] * slope);
      }
    }
    steps.t.push_back(in[2]), steps.h.push_back(in[3]);
    steps.start.insert(steps.start.end(), in.begin() + 4, in.begin() + 4 + n);
    steps.result.insert(steps.result.end(), result.begin(), result.end());
  }
  return true;
}

/// Returns the weights of x and of the first `slopes` slopes in `sum`; empty if `sum` is no linear combination of them.
/// If several slopes are identical, only the sum of their weights can be determined. If this sum is right, the function
/// returns the right weights; otherwise it attributes the whole sum to the first of these slopes.
Numbers as_sum(const Steps& steps, std::size_t slopes, const Numbers& sum, const Numbers& right) {
  std::vector<Numbers> columns{steps.start};
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < slopes; ++k) {
    bool again = false;
    for (const std::size_t before : used) again = again || steps.slopes[before] == steps.slopes[k];
    if (!again) columns.push_back(steps.slopes[k]), used.push_back(k);
  }
  const Numbers found = coefficients(columns, sum, tolerance);
  if (found.empty()) return {};
  Numbers all(slopes + 1, 0.0);
  all[0] = found[0];
  for (std::size_t k = 0; k < used.size(); ++k) {
    double together = 0;
    for (std::size_t j = used[k]; j < slopes; ++j)
      if (steps.slopes[j] == steps.slopes[used[k]]) together += right[j + 1];
    const bool as_right = std::abs(together - found[k + 1]) < 1e-7;
    for (std::size_t j = used[k]; j < slopes; ++j)
      if (steps.slopes[j] == steps.slopes[used[k]])
        all[j + 1] = as_right ? right[j + 1] : j == used[k] ? found[k + 1] : 0;
  }
  return all;
}

std::vector<NamedTerm> terms(std::size_t slopes) {
  std::vector<NamedTerm> all{{"x"}};
  for (std::size_t k = 1; k <= slopes; ++k) all.push_back({"h k" + std::to_string(k)});
  return all;
}

bool same(const Numbers& a, const Numbers& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) < 1e-7)) return false;
  return a.size() == b.size();
}

}  // namespace

Looked tableau_text(const Texts& common, const std::string& part, const Ask& student) {
  const Tableau right = right_tableau(part);
  Steps steps;
  if (!taken(part, student, steps)) return {};
  if (steps.calls != right.a.size())
    return {common.fill("rule.calls", std::to_string(right.a.size()), std::to_string(steps.calls)), true};
  std::string text;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : " ") + more; };
  for (std::size_t call = 0; call < steps.calls; ++call) {
    const std::string number = std::to_string(call + 1);
    Numbers expected{1};
    expected.insert(expected.end(), right.a[call].begin(), right.a[call].end());
    const Numbers found = as_sum(steps, call, steps.states[call], expected);
    if (found.empty())
      add(common.fill("rule.no_sum", number, sum_text(terms(call), expected, 1e-8)));
    else if (!same(found, expected))
      add(common.fill("rule.state", number, sum_text(terms(call), found, 1e-8), sum_text(terms(call), expected, 1e-8)));
    const Numbers time = coefficients({steps.t, steps.h}, steps.times[call], tolerance), when{1, right.times[call]};
    if (!time.empty() && !same(time, when))
      add(common.fill("rule.time", number, sum_text({{"t"}, {"h"}}, time, 1e-8), sum_text({{"t"}, {"h"}}, when, 1e-8)));
  }
  Numbers expected{1};
  expected.insert(expected.end(), right.b.begin(), right.b.end());
  const Numbers found = as_sum(steps, steps.calls, steps.result, expected);
  // these weights belong to the slopes that f returned: a wrong state does not change them
  if (found.empty())
    add(common.fill("rule.no_result", sum_text(terms(steps.calls), expected, 1e-8)));
  else if (!same(found, expected))
    add(common.fill("rule.result", sum_text(terms(steps.calls), found, 1e-8),
                    sum_text(terms(steps.calls), expected, 1e-8)));
  return text.empty() ? Looked{common.of("rule.right"), false} : Looked{text, true};
}

}  // namespace coursework::a1
