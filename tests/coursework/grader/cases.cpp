#include "mysim/base/hash.h"
#include "tests/coursework/check/words.h"
#include "tests/coursework/grader/grade.h"

namespace coursework {
namespace {

/// A hash of both numbers by SplitMix64: seeds that differ in one bit give unrelated results.
std::uint64_t mixed(std::uint64_t a, std::uint64_t b) { return Random(Random(a).next() ^ b).next(); }

}  // namespace

std::uint64_t public_seed(const Assignment& assignment, const Test& test) {
  return mixed(crosscheck::Fnv1a::of(assignment.name), crosscheck::Fnv1a::of(test.id));
}

std::vector<Case> public_cases(const Assignment& assignment, const Test& test) {
  constexpr std::size_t small = 40;  // inputs of a case that can still be computed by hand
  Random random(public_seed(assignment, test));
  std::vector<Case> usual = test.cases(random), all;
  const Texts own = Texts::read((assignment.folder() / "texts.en.txt").string());
  // no round numbers if the answer is reduced before it is compared, or if inputs are never shown
  if (!test.reduce && !usual.empty() && has_layout(own, usual.front())) {
    Random round(public_seed(assignment, test), true);
    all = test.cases(round);
    if (all.front().in.size() > small) all.clear();
  }
  all.insert(all.end(), usual.begin(), usual.end());
  return all;
}

std::vector<Case> small_cases(const Assignment& assignment, const Test& test) {
  if (!test.small) return {};
  Random round(public_seed(assignment, test), true), usual(public_seed(assignment, test));
  std::vector<Case> all = test.small(round);
  for (Case& one : test.small(usual)) all.push_back(std::move(one));
  return all;
}

std::uint64_t hidden_seed(std::uint64_t seed, const Test& test) {
  return mixed(seed + 1, crosscheck::Fnv1a::of(test.id));
}

}  // namespace coursework
