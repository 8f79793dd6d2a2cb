#include "experiments/regress/regress.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/regress/asking.h"
#include "mysim/errors.h"

namespace crosscheck {
namespace {

Question by(const Method& method, Question question) {
  question.method = method;
  return question;
}

std::string name_of_old(const Question& q) { return q.in_words() + " (against)"; }

/// The scenes' baselines; what is wrong with a file is a row.
class Shelf {
 public:
  Shelf(const std::filesystem::path& folder, std::vector<Compared>& rows) : folder_(folder), rows_(rows) {}

  /// Null where there is none that can be used.
  const Baseline* of(const Question& question) {
    const std::string& scene = question.scene.name;
    if (const auto known = shelf_.find(scene); known != shelf_.end()) return known->second ? &*known->second : nullptr;
    auto& place = shelf_[scene];
    Compared row;
    row.scene = scene, row.quantity = "baseline", row.unit = "word";
    try {
      place = read_baseline(folder_, scene);
      if (!place) {
        row.state = Standing::missing, row.note = fmt::format("{}: no such file", file_of(folder_, scene).string());
        rows_.push_back(row);
      } else if (const std::string now = question.hash; place->hash != now) {
        row.state = Standing::stale, row.was_word = place->hash, row.is_word = now;
        row.note = "the scene is another one than the one that these are answers to";
        rows_.push_back(row);
        place.reset();
      }
    } catch (const InputError& error) {
      row.state = Standing::unreadable, row.note = error.what();
      rows_.push_back(row);
    }
    return place ? &*place : nullptr;
  }

 private:
  std::filesystem::path folder_;
  std::vector<Compared>& rows_;
  std::map<std::string, std::optional<Baseline>> shelf_;
};

/// What the old engine answered, as an expectation. What only one of two engines is asked for is no difference between
/// them; their verdicts both have.
std::vector<Expected> expected_from(const std::vector<Toleranced>& old, const std::vector<Toleranced>& now,
                                    const Question& q) {
  std::vector<Expected> expected;
  for (const Toleranced& t : old)
    if (find(now, t.quantity.name)) expected.push_back({q.method.name, q.without, false, t});
  return expected;
}

/// Blessed, and nobody asks for it any more: a method, an ingredient or a scene's question was taken away.
std::vector<Compared> asked_no_more(const Baseline& baseline, const std::vector<Question>& all, bool full) {
  std::set<std::pair<std::string, std::string>> asked;
  for (const Question& q : all)
    if (q.scene.name == baseline.scene) asked.emplace(q.method.name, q.without);
  std::vector<Compared> rows;
  for (const Expected& e : baseline.expected) {
    if ((e.dear && !full) || !asked_by_itself(e.method) || !asked.emplace(e.method, e.without).second) continue;
    Compared row;
    row.scene = baseline.scene, row.method = e.method, row.without = e.without;
    row.quantity = "all", row.unit = "word", row.state = Standing::gone;
    row.note = "nobody asks for it any more";
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

bool Regressed::passed() const {
  return failures.empty() &&
         std::none_of(rows.begin(), rows.end(), [](const Compared& row) { return failed(row.state); });
}

Regressed regress(const Regression& regression, Progress& progress) {
  const std::vector<Question> all = questions(regression.asked);
  std::vector<Asking> askings;
  for (const Question& q : all) {
    askings.push_back({q, q.in_words()});
    if (regression.against) askings.push_back({by(*regression.against, q), name_of_old(q), true});
  }
  AskedAnswers asked = ask(askings, regression.out, regression.jobs, progress);
  Regressed result;
  result.failures = std::move(asked.failures);
  std::vector<Compared> rows;
  Shelf shelf(regression.baselines, result.rows);
  std::set<std::string> whole_scenes;
  for (const Question& q : all) {
    const auto is = asked.answers.find(q.in_words());
    if (is == asked.answers.end()) continue;
    std::vector<Expected> expected;
    if (regression.against) {
      const auto was = asked.answers.find(name_of_old(q));
      if (was == asked.answers.end()) continue;
      expected = expected_from(was->second, is->second, q);
    } else if (const Baseline* baseline = shelf.of(q)) {
      expected = expected_of(*baseline, q);
      if (whole(regression.asked) && whole_scenes.insert(q.scene.name).second) {
        const auto gone = asked_no_more(*baseline, all, regression.asked.full);
        rows.insert(rows.end(), gone.begin(), gone.end());
      }
    } else {
      continue;  // said once for the scene
    }
    const std::vector<Compared> more = compared(q, quantities_in(is->second), expected);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  result.rows.insert(result.rows.end(), rows.begin(), rows.end());
  return result;
}

}  // namespace crosscheck
