// Two parts with one test each, which use all features of a test.
#include "tests/coursework/test/tiny/tiny_assignment.h"

namespace coursework {
namespace {

std::vector<Case> twice_cases(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 3; ++i) {
    const double x = random.uniform(1, 2);
    cases.push_back({"twice", {x}, {x + x}, 1, 1e-12, "number", "double"});
  }
  return cases;
}

std::vector<Case> sums_cases(Random& random) {
  Case one{"sums", {}, {}, 1, 1e-12, "number", "sum", -1, 0};
  for (int i = 0; i < 10; ++i) one.in.push_back(random.uniform(1, 2));
  double sum = 0;
  for (const double x : one.in) one.expected.push_back(sum += x);
  return {one};
}

Found differences(const Case&, const Numbers& raw) {
  Numbers steps;
  for (std::size_t i = 1; i < raw.size(); ++i) steps.push_back(raw[i] - raw[i - 1]);
  return steps;
}

/// Cases that compare only the differences of successive sums; the first sum may have any value.
std::vector<Case> steps_cases(Random& random) {
  Case one{"sums", {}, {}, 1, 1e-12, "number", "step", -1, 0};
  for (int i = 0; i < 10; ++i) one.in.push_back(random.uniform(1, 2));
  one.expected.assign(one.in.begin() + 1, one.in.end());
  return {one};
}

constexpr Part parts[] = {{"twice", "twice.title"}, {"sums", "sums.title"}};

}  // namespace

const Assignment& tiny() {
  static const Test tests[] = {
      {"1.1", "twice", 30, 20, {"products"}, "Doubling", twice_cases},
      {"2.1", "sums", 20, 10, {"loops"}, "Sums", sums_cases},
      {"2.2", "sums", 15, 5, {"loops"}, "Sums", steps_cases, differences},
  };
  static const Assignment one{"test/tiny", "The smallest assignment", parts, tests};
  return one;
}

}  // namespace coursework
