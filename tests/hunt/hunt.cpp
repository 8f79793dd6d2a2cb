#include "tests/hunt/hunt.h"

#include <algorithm>

namespace crosscheck {
namespace {

/// True if `answer` fails in the same way as `first`, or breaks the relation by at least twice the tolerance (or as
/// much as `first`, if that is less), so that the smallest scene is not a borderline case.
bool same_break(const Answer& answer, const Answer& first) {
  if (answer.mark != RelationMark::broken || answer.failure != first.failure) return false;
  return answer.finding.what.empty() || answer.finding.ratio() >= std::min(2.0, first.finding.ratio());
}

}  // namespace

std::vector<Break> breaks_of(const Hunt& hunt, long index, int& answers) {
  const SceneDraft drawn = draw(hunt.seed, index);
  const Scene scene = drawn.scene();
  std::vector<Break> breaks;
  const auto settle = [&](const Answer& first, const std::function<Answer(const Scene&)>& ask_again) {
    answers += first.mark != RelationMark::not_applicable;
    if (first.mark != RelationMark::broken) return;
    Answer last = first;
    Shrunk smallest = shrink(
        drawn,
        [&](const Scene& smaller) {
          Answer answer = ask_again(smaller);
          if (!same_break(answer, first)) return false;
          last = std::move(answer);
          return true;
        },
        hunt.most_trials);
    breaks.push_back({std::move(last), std::move(smallest)});
  };
  std::vector<Subject> subjects(hunt.methods.begin(), hunt.methods.end());
  for (Subject& subject : subjects)
    for (const Relation& relation : relations()) {
      if (!relation.excluded(scene).empty()) continue;
      settle(ask(relation, subject, scene, hunt.seed_of(index), hunt.known), [&](const Scene& smaller) {
        Subject again(subject.method());
        if (!relation.excluded(smaller).empty())
          return Answer{subject.method().name, smaller.name, &relation, RelationMark::not_applicable, {}, "", ""};
        return ask(relation, again, smaller, hunt.seed_of(index), hunt.known);
      });
    }
  for (size_t i = 0; i < subjects.size(); ++i)
    for (size_t j = i + 1; j < subjects.size(); ++j)
      settle(ask_agreement(subjects[i], subjects[j], scene, hunt.known), [&](const Scene& smaller) {
        Subject a(subjects[i].method()), b(subjects[j].method());
        return ask_agreement(a, b, smaller, hunt.known);
      });
  return breaks;
}

}  // namespace crosscheck
