// Which cases a test has: seeds, and what the hand-out shows.
#include "mysim/base/hash.h"
#include "tests/coursework/check/words.h"
#include "tests/coursework/grader/grade.h"

namespace coursework {
namespace {

/// One step of SplitMix64 on both: seeds that differ in one bit give unrelated ones.
std::uint64_t mixed(std::uint64_t a, std::uint64_t b) { return Random(Random(a).next() ^ b).next(); }

}  // namespace

std::uint64_t public_seed(const Assignment& assignment, const Test& test) {
  return mixed(crosscheck::Fnv1a::of(assignment.name), crosscheck::Fnv1a::of(test.id));
}

std::vector<Case> public_cases(const Assignment& assignment, const Test& test) {
  constexpr std::size_t small = 40;  // numbers of a case that fits on a sheet of paper
  Random random(public_seed(assignment, test));
  std::vector<Case> usual = test.cases(random), all;
  const Texts own = Texts::read((assignment.folder() / "texts.en.txt").string());
  // where an answer is reduced first, or nobody is told what was given, there is nothing to work out
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
