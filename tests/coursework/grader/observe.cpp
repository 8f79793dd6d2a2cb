#include "tests/coursework/grader/observe.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "tests/coursework/check/judge.h"
#include "tests/coursework/check/seen.h"
#include "tests/coursework/check/words.h"
#include "tests/coursework/grader/changes.h"
#include "tests/coursework/grader/grade.h"
#include "tests/coursework/grader/run.h"

namespace coursework {
namespace {

constexpr std::size_t most_alike = 3;       // alternatives that may be reported together
constexpr std::size_t most_numbers = 4000;  // limit on the numbers of a case, because a case is run a hundred times

bool usable(const Case& what, const Answer& answer) {
  return answer.how == How::answered && answer.got.size() == what.expected.size() &&
         std::all_of(answer.got.begin(), answer.got.end(), [](double v) { return std::isfinite(v); });
}

bool all_zero(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double v) { return v == 0; });
}

Case with_numbers(const Case& what, Numbers in) {
  Case other = what;
  other.in = std::move(in);
  return other;
}

/// The case, with `right` as its expected answer.
Case expecting(const Case& what, const Answer& right) {
  Case other = what;
  other.expected = right.got;
  return other;
}

class Observer {
 public:
  Observer(const Observing& with, const std::vector<std::pair<Case, Answer>>& asked) : with_(with), asked_(asked) {
    for (const auto& [what, answer] : asked) {
      if (judge(what, answer).right) continue;
      if (!usable(what, answer) || !answer.of.empty()) {
        subject_ = nullptr;
        return;
      }
      if (!subject_ || what.in.size() < subject_->in.size()) subject_ = &what, got_ = &answer;
    }
    if (subject_ && subject_->in.size() > most_numbers) subject_ = nullptr;
  }

  std::string text() const {
    if (!subject_) return "";
    // a tolerance far above round-off would accept too many explanations
    double largest = 0;
    for (const double value : subject_->expected) largest = std::max(largest, std::abs(value));
    if (subject_->tolerance > 1e-4 * largest && largest > 0) return "";
    if (const std::string right = right_with(); !right.empty()) return right;
    const std::string where = parted(), rest = without();
    return where + (where.empty() || rest.empty() ? "" : " ") + rest;
  }

 private:
  std::vector<Answer> asked_with(const Ask& program, const std::vector<Change>& changes,
                                 std::vector<std::size_t>& made) const {
    std::vector<Case> cases;
    for (std::size_t i = 0; i < changes.size(); ++i)
      if (auto in = changed(with_.own, *subject_, changes[i]);
          in && *in != subject_->in && std::all_of(in->begin(), in->end(), [](double v) { return std::isfinite(v); }))
        cases.push_back(with_numbers(*subject_, *in)), made.push_back(i);
    return program(cases);
  }

  bool explains_all(const Change& change) const {
    std::vector<Case> cases;
    for (const auto& [what, answer] : asked_)
      cases.push_back(with_numbers(what, changed(with_.own, what, change).value_or(what.in)));
    const std::vector<Answer> answers = with_.reference(cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (!usable(asked_[i].first, asked_[i].second) || !agree(asked_[i].first, asked_[i].second, answers[i]))
        return false;
    return true;
  }

  /// True if a small increase of the modified number changes the answer. Otherwise this number is beyond some limit,
  /// and any larger number would match too.
  bool is_sharp(const Change& change) const {
    if (change.kind < Change::one || change.kind > Change::over) return true;
    const std::optional<Numbers> in = changed(with_.own, *subject_, change);
    if (!in) return false;
    std::vector<Case> cases;
    for (std::size_t i = 0; i < in->size(); ++i) {
      if ((*in)[i] == subject_->in[i]) continue;
      Numbers more = *in;
      more[i] *= 1.01;
      cases.push_back(with_numbers(*subject_, more));
    }
    const std::vector<Answer> answers = with_.reference(cases);
    return std::any_of(answers.begin(), answers.end(),
                       [&](const Answer& answer) { return !agree(*subject_, *got_, answer); });
  }

  std::string right_with() const {
    // if all calls return the same single number, there are too many possible causes
    const auto same = [&](const auto& one) { return one.second.got.size() == 1 && one.second.got == got_->got; };
    if (asked_.size() > 1 && std::all_of(asked_.begin(), asked_.end(), same)) return "";
    const std::vector<Change> changes = changes_of(with_.own, *subject_);
    std::vector<std::size_t> made;
    const std::vector<Answer> answers = asked_with(with_.reference, changes, made);
    std::vector<Change> found;
    for (std::size_t i = 0; i < made.size(); ++i)
      if (usable(*subject_, answers[i]) && agree(*subject_, *got_, answers[i]) && explains_all(changes[made[i]]) &&
          is_sharp(changes[made[i]]))
        found.push_back(changes[made[i]]);
    for (const int tier : {1, 2}) {
      std::string list;
      std::size_t count = 0;
      for (const Change& change : found)
        if (change.tier() == tier) {
          const std::string one = change_text(with_.common, change);
          list = list.empty() ? one : with_.common.fill("seen.or", list, one);
          ++count;
        }
      if (count > most_alike) return "";
      if (count > 0) return with_.common.fill("seen.right_with", list);
    }
    return "";
  }

  std::string without() const {
    const std::vector<Change> changes = removals_of(with_.own, *subject_);
    std::vector<std::size_t> made, again;
    const std::vector<Answer> right = asked_with(with_.reference, changes, made),
                              theirs = asked_with(with_.student, changes, again);
    std::string text;
    std::size_t count = 0;
    std::set<Numbers> told;  // a quantity may have several names
    for (std::size_t i = 0; i < made.size(); ++i) {
      if (right[i].how != How::answered || right[i].got.size() != subject_->expected.size()) continue;
      const Case less = expecting(*subject_, right[i]);
      if (!usable(less, theirs[i]) || !judge(less, theirs[i]).right || !says_something(right[i].got)) continue;
      if (hands_through(right[i].got) || !told.insert(right[i].got).second) continue;
      if (!is_right_everywhere(changes[made[i]])) continue;
      if (++count > 2) return "";
      const std::string name = change_text(with_.common, changes[made[i]]);
      text += (text.empty() ? "" : " ") + with_.common.fill("seen.without", name);
      const std::string added = instead_of_what_is_added(changes[made[i]], right[i].got, theirs[i].got);
      if (!added.empty()) text += " " + with_.common.fill("seen.adds", added);
    }
    return text;
  }

  /// True if there are wrong cases with generic numbers, and the change makes all of them right. Special numbers (a
  /// radius of 1, equal masses) can make wrong formulas right by accident.
  bool is_right_everywhere(const Change& change) const {
    constexpr std::size_t enough = 8;
    std::vector<Case> cases;
    for (const auto& [what, answer] : asked_)
      if (const auto in = changed(with_.own, what, change); cases.size() < enough && what.in.size() <= most_numbers &&
                                                            is_general(what) && !judge(what, answer).right && in)
        cases.push_back(with_numbers(what, *in));
    const std::vector<Answer> right = with_.reference(cases), theirs = with_.student(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (!usable(cases[i], right[i])) return false;
      const Case less = expecting(cases[i], right[i]);
      if (!usable(less, theirs[i]) || !judge(less, theirs[i]).right) return false;
    }
    return !cases.empty();
  }

  /// True if most non-zero numbers of the case have more than three decimals, as random numbers do.
  bool is_general(const Case& what) const {
    std::size_t all = 0, long_ones = 0;
    for (const Param& p : params_of(CallLayout::of(with_.own, what)))
      for (const std::size_t at : p.at) {
        const double thousands = what.in[at] * 1000;
        if (p.whole || what.in[at] == 0) continue;
        ++all, long_ones += thousands != std::round(thousands);
      }
    return 2 * long_ones > all;
  }

  /// The input of the case with this name; nullopt if there is no such input, or if it has several numbers.
  std::optional<double> number_of(const Case& what, const std::string& name) const {
    for (const Param& p : params_of(CallLayout::of(with_.own, what)))
      if (p.name == name && p.scalar()) return what.in[p.at[0]];
    return {};
  }

  /// Text on a number that separates right and wrong cases: it has the same simple value (0, or a count of 1) in all
  /// cases of one group, and in no case of the other group.
  std::string parted() const {
    constexpr std::size_t least = 2;  // cases in each group, because a single case is not a rule
    std::string text;
    std::size_t count = 0;
    for (const Param& p : params_of(CallLayout::of(with_.own, *subject_))) {
      if (!p.scalar()) continue;
      std::vector<double> of[2];  // index 0: wrong, 1: right
      for (const auto& [what, answer] : asked_)
        if (const auto value = number_of(what, p.name)) of[judge(what, answer).right].push_back(*value);
      if (of[0].size() < least || of[1].size() < least || of[0].size() + of[1].size() != asked_.size()) continue;
      for (const bool right : {true, false}) {
        const std::vector<double>&same = of[right], &others = of[!right];
        const double value = same.front();
        if (value != 0 && !(p.whole && value == 1)) continue;
        if (std::count(same.begin(), same.end(), value) != static_cast<std::ptrdiff_t>(same.size())) continue;
        if (std::count(others.begin(), others.end(), value) > 0) continue;
        if (++count > 2) return "";
        text +=
            (text.empty() ? "" : " ") + with_.common.fill(right ? "seen.right_where" : "seen.wrong_where", p.name,
                                                          std::to_string(static_cast<int>(value)),
                                                          std::to_string(same.size()), std::to_string(others.size()));
      }
    }
    return text;
  }

  /// True if the answer without the term has a nonzero entry at which the student's answer is wrong.
  bool says_something(const Numbers& without) const {
    for (std::size_t i = 0; i < without.size(); ++i)
      if (without[i] != 0 && !(std::abs(got_->got[i] - subject_->expected[i]) <= subject_->tolerance)) return true;
    return false;
  }

  /// True if the answer without the term only repeats inputs, which means that nothing is computed without it.
  bool hands_through(const Numbers& answer) const {
    for (const Param& param : params_of(CallLayout::of(with_.own, *subject_)))
      for (std::size_t from = 0; from + answer.size() <= param.at.size(); from += answer.size()) {
        bool same = answer.size() > 1;
        for (std::size_t k = 0; k < answer.size(); ++k) same = same && answer[k] == subject_->in[param.at[from + k]];
        if (same) return true;
      }
    return false;
  }

  /// Returns the expected contribution of a term as a case, and the student's contribution as its answer. Both are
  /// differences of the answers with and without the term.
  static std::pair<Case, Answer> added(const Case& what, const Answer& answer, const Numbers& right,
                                       const Numbers& theirs) {
    std::pair<Case, Answer> of{what, answer};
    for (std::size_t i = 0; i < answer.got.size(); ++i) of.first.expected[i] -= right[i], of.second.got[i] -= theirs[i];
    of.first.tolerance *= 3;  // each number is a difference of two
    return of;
  }

  /// The contributions of the term to some of the other wrong cases, which can confirm the contribution to the first.
  Answered added_to_others(const Change& change) const {
    constexpr std::size_t enough = 4;
    std::vector<std::size_t> of;
    std::vector<Case> cases;
    for (std::size_t i = 0; i < asked_.size() && of.size() < enough; ++i) {
      const auto& [what, answer] = asked_[i];
      if (what.in == subject_->in || what.in.size() > most_numbers || !usable(what, answer)) continue;
      if (judge(what, answer).right) continue;
      if (auto in = changed(with_.own, what, change)) cases.push_back(with_numbers(what, *in)), of.push_back(i);
    }
    Answered others;
    const std::vector<Answer> right = with_.reference(cases), theirs = with_.student(cases);
    for (std::size_t i = 0; i < of.size(); ++i)
      if (usable(cases[i], right[i]) && usable(cases[i], theirs[i]))
        others.push_back(added(asked_[of[i]].first, asked_[of[i]].second, right[i].got, theirs[i].got));
    return others;
  }

  std::string instead_of_what_is_added(const Change& change, const Numbers& right, const Numbers& theirs) const {
    const auto [what, answer] = added(*subject_, *got_, right, theirs);
    return all_zero(what.expected) ? "" : instead_text(with_.common, with_.own, what, answer, added_to_others(change));
  }

  const Observing& with_;
  const std::vector<std::pair<Case, Answer>>& asked_;
  const Case* subject_ = nullptr;  // the smallest wrong case
  const Answer* got_ = nullptr;
};

}  // namespace

Ask asking(const Sandbox& sandbox, const std::filesystem::path& program) {
  return [&sandbox, program](const std::vector<Case>& cases) {
    Limits limits = limits_for(0);
    limits.cpu = 5, limits.wall = 60;
    return run_calls(sandbox, program, cases, limits);
  };
}

std::vector<std::string> seen_at(const Observing& with, const Assignment& assignment, const std::string& part,
                                 const std::vector<TestRun>& runs, const std::vector<bool>& told_at) {
  std::vector<std::string> seen(runs.size());
  const auto say = [&](std::size_t i, const std::string& text) {
    if (!text.empty()) seen[i] += (seen[i].empty() ? "" : "\n") + text;
  };
  bool looked = !assignment.look;
  std::set<std::string> told;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!told_at[i]) continue;
    if (!looked) {
      const Looked found = assignment.look(with.common, part, with.student);
      say(i, found.text), looked = true;
      if (found.explains) return seen;
    }
    const Test& test = *runs[i].test;
    if (test.reduce) continue;
    const std::vector<Case> small = small_cases(assignment, test);
    const std::vector<Answer> to_small = small.empty() ? std::vector<Answer>() : with.student(small);
    std::set<std::string> calls;  // calls that fail in this test or its small cases
    for (std::size_t k = 0; k < runs[i].cases.size(); ++k)
      if (!judge(runs[i].cases[k], runs[i].answers[k]).right) calls.insert(runs[i].cases[k].call);
    for (std::size_t k = 0; k < small.size(); ++k)
      if (!judge(small[k], to_small[k]).right) calls.insert(small[k].call);
    for (const std::string& call : calls) {
      const std::string function = function_of(with.own, part, Case{call});
      if (told.count(function)) continue;
      std::vector<std::pair<Case, Answer>> asked;
      for (const TestRun& other : runs)
        for (std::size_t k = 0; k < other.cases.size() && !other.test->reduce; ++k)
          if (other.cases[k].call == call) asked.emplace_back(other.cases[k], other.answers[k]);
      for (std::size_t k = 0; k < small.size(); ++k)
        if (small[k].call == call) asked.emplace_back(small[k], to_small[k]);
      const std::string text = Observer(with, asked).text();
      say(i, text);
      if (!text.empty()) told.insert(function);  // other calls of the function would have the same result
    }
  }
  return seen;
}

}  // namespace coursework
