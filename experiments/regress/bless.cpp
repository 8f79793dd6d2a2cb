#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/regress/asking.h"
#include "experiments/regress/regress.h"
#include "experiments/regress/shape.h"
#include "mysim/errors.h"

namespace crosscheck {
namespace {

using QuestionKey = std::pair<std::string, std::string>;  // method, without

/// One scene's baseline on its way to a new one.
class Change {
 public:
  /// Throws InputError where the file cannot be read, and where only a part of a stale one is asked for.
  Change(const Question& question, const Regression& regression, const Blessing& blessing) {
    auto old = read_baseline(regression.baselines, question.scene.name);
    const Asked& asked = regression.asked;
    const bool part = !asked.filter.empty() && asked.filter != question.scene.name;
    if (old && old->hash != question.hash) {
      if (part || !asked.methods.empty() || !asked.full)
        throw InputError(
            fmt::format("{}: expected the whole scene to be blessed (--full --filter {}), as the scene has changed",
                        file_of(regression.baselines, question.scene.name).string(), question.scene.name));
      old->expected.clear();
    }
    if (old) baseline_ = *old;
    baseline_.scene = question.scene.name, baseline_.hash = question.hash;
    baseline_.blessings.push_back(blessing);
  }

  /// What is the same keeps its row and its blessing. Throws InputError where a number is not finite.
  void answered(const Question& q, const std::vector<Toleranced>& now) {
    asked_.emplace(q.method.name, q.without);
    const std::vector<Expected> before = expected_of(baseline_, q);
    std::vector<Expected> after;
    for (const Compared& row : compared(q, quantities_in(now), before)) {
      if (row.state == Standing::not_finite)
        throw InputError(fmt::format("nothing is blessed: {}: {} is not finite", q.in_words(), row.quantity));
      if (row.state != Standing::same) changed_.push_back(row);
      if (row.state == Standing::gone) continue;
      if (row.state == Standing::same)
        after.push_back(*std::find_if(before.begin(), before.end(),
                                      [&](const Expected& e) { return e.what.quantity.name == row.quantity; }));
      else
        after.push_back(
            {q.method.name, q.without, q.dear, *find(now, row.quantity), static_cast<int>(baseline_.blessings.size())});
    }
    std::erase_if(baseline_.expected,
                  [&](const Expected& e) { return e.method == q.method.name && e.without == q.without; });
    baseline_.expected.insert(baseline_.expected.end(), after.begin(), after.end());
  }

  /// Takes out what was blessed and is asked no more.
  void drop_what_nobody_asks() {
    std::erase_if(baseline_.expected, [&](const Expected& e) {
      if (!asked_by_itself(e.method) || asked_.contains({e.method, e.without})) return false;
      Compared row;
      row.scene = baseline_.scene, row.method = e.method, row.without = e.without;
      row.quantity = e.what.quantity.name, row.unit = e.what.quantity.unit, row.state = Standing::gone;
      changed_.push_back(row);
      return true;
    });
  }

  const std::vector<Compared>& changed() const { return changed_; }

  int blessing() const { return static_cast<int>(baseline_.blessings.size()); }

  std::string text() {
    std::stable_sort(baseline_.expected.begin(), baseline_.expected.end(), [](const Expected& a, const Expected& b) {
      return std::tie(a.method, a.without) < std::tie(b.method, b.without);
    });
    return text_of(baseline_);
  }

 private:
  Baseline baseline_;
  std::set<QuestionKey> asked_;
  std::vector<Compared> changed_;
};

/// Of the scene's own method, for pictures; empty where it has none.
std::string shape_of(const Question& q) {
  const Answered answered = as_compared(answer_to(q));
  if (answered.trajectory.frames() == 0) return "";
  return shape_text(q.scene.name, q.method.name, answered.trajectory.t.back(), answered.trajectory.x.back());
}

}  // namespace

Blessed bless(const Regression& regression, const Blessing& blessing, Progress& progress) {
  const std::vector<Question> all = questions(regression.asked);
  std::vector<Asking> askings;
  for (const Question& q : all) askings.push_back({q, q.in_words(), true});
  const AskedAnswers asked = ask(askings, regression.out, regression.jobs, progress);
  for (const FailedPoint& f : asked.failures)
    throw InputError(fmt::format("nothing is blessed: {}: {}", f.name, f.why));

  std::map<std::string, Change> changes;
  for (const Question& q : all)
    changes.try_emplace(q.scene.name, q, regression, blessing)
        .first->second.answered(q, asked.answers.at(q.in_words()));
  Blessed blessed;
  for (auto& [scene, change] : changes) {
    if (whole(regression.asked) && regression.asked.full) change.drop_what_nobody_asks();
    if (change.changed().empty()) continue;
    blessed.files.emplace_back(file_of(regression.baselines, scene), change.text());
    blessed.numbers[scene] = change.blessing();
    blessed.changed.insert(blessed.changed.end(), change.changed().begin(), change.changed().end());
    for (const Question& q : all)
      if (q.scene.name == scene && q.without.empty() && q.method.name == find_method(q.scene.method).name)
        if (const std::string shape = shape_of(q); !shape.empty())
          blessed.files.emplace_back(shape_file(regression.baselines, scene), shape);
  }
  return blessed;
}

}  // namespace crosscheck
