// One case of the hunter, and findings grouped.
#include "experiments/check/hunt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/tables/typed.h"

namespace crosscheck {
namespace {

/// Whether an answer is the same break as another: measured, or by a run that failed in the same way. Twice the
/// tolerance, where the first was as much, so that the smallest scene is no border case.
bool same_break(const Answer& answer, const Answer& first) {
  if (answer.mark != RelationMark::broken || answer.failure != first.failure) return false;
  return answer.finding.what.empty() || answer.finding.ratio() >= std::min(2.0, first.finding.ratio());
}

HuntFindingRow row_of(const DrawnCase& drawn, const Answer& answer, const Shrunk& smallest) {
  HuntFindingRow row;
  row.index = drawn.index;
  row.methods = answer.method, row.relation = std::string(answer.relation->name), row.kind = smallest.draft.kind();
  row.mark = answer.mark, row.sentence = answer.sentence();
  row.since = answer.finding.since;
  if (!answer.finding.what.empty()) {
    row.compared = answer.finding.what, row.unit = answer.finding.unit;
    if (std::isfinite(answer.finding.measured)) row.measured = answer.finding.measured;
    row.tolerance = answer.finding.tolerance;
  }
  row.particles_drawn = drawn.draft.size(), row.particles = smallest.draft.size();
  row.springs = static_cast<int>(smallest.draft.springs.size()), row.trials = smallest.trials;
  row.scene = smallest.draft.text();
  return row;
}

}  // namespace

void compute_case(const Hunt& hunt, const DrawnCase& drawn, TableSet& tables) {
  const Scene scene = drawn.draft.scene();
  HuntCaseRow counts;
  counts.index = drawn.index, counts.kind = drawn.draft.kind();
  counts.particles = drawn.draft.size(), counts.springs = static_cast<int>(drawn.draft.springs.size());
  Table findings = table_of<HuntFindingRow>(), cases = table_of<HuntCaseRow>();
  const auto settle = [&](const Answer& first, const std::function<Answer(const Scene&)>& ask_again) {
    counts.holds += first.mark == RelationMark::holds, counts.broken += first.mark == RelationMark::broken;
    counts.known += first.mark == RelationMark::known, counts.not_asked += first.mark == RelationMark::not_asked;
    if (first.mark == RelationMark::known) add(findings, row_of(drawn, first, {drawn.draft, 0}));
    if (first.mark != RelationMark::broken) return;
    Answer last = first;
    const Shrunk smallest = shrink(
        drawn.draft,
        [&](const Scene& smaller) {
          Answer answer = ask_again(smaller);
          if (!same_break(answer, first)) return false;
          last = std::move(answer);
          return true;
        },
        hunt.most_trials);
    add(findings, row_of(drawn, last, smallest));
  };
  std::vector<Subject> subjects(hunt.methods.begin(), hunt.methods.end());
  for (Subject& subject : subjects)
    for (const Relation& relation : relations()) {
      if (!relation.excluded(scene).empty()) continue;
      settle(ask(relation, subject, scene, hunt.seed_of(drawn.index), hunt.known), [&](const Scene& smaller) {
        Subject again(subject.method());
        if (!relation.excluded(smaller).empty())
          return Answer{subject.method().name, smaller.name, &relation, RelationMark::not_asked, {}, "", ""};
        return ask(relation, again, smaller, hunt.seed_of(drawn.index), hunt.known);
      });
    }
  for (size_t i = 0; i < subjects.size(); ++i)
    for (size_t j = i + 1; j < subjects.size(); ++j)
      settle(ask_agreement(subjects[i], subjects[j], scene, hunt.known), [&](const Scene& smaller) {
        Subject a(subjects[i].method()), b(subjects[j].method());
        return ask_agreement(a, b, smaller, hunt.known);
      });
  add(cases, counts);
  tables.add(findings), tables.add(cases);
}

Point point_of(const Hunt& hunt, long index) {
  std::string content = fmt::format("hunt seed={} case={} trials={}", hunt.seed, index, hunt.most_trials);
  for (const Method& method : hunt.methods) content += fmt::format(" {}{}", method.name, method.fingerprint);
  for (const KnownBreak& one : hunt.known)
    content += fmt::format("\n{} {} {} {}", one.method, one.relation, one.scene, one.times ? *one.times : 0);
  return {fmt::format("case {}", index), std::move(content),
          [&hunt, index](TableSet& tables) { compute_case(hunt, draw(hunt.seed, index), tables); }};
}

std::vector<FindingGroup> grouped(std::span<const HuntFindingRow> rows) {
  std::vector<FindingGroup> groups;
  for (const HuntFindingRow& row : rows) {
    const auto same = std::ranges::find_if(groups, [&](const FindingGroup& group) {
      const HuntFindingRow& g = group.smallest;
      return g.methods == row.methods && g.relation == row.relation && g.mark == row.mark &&
             (row.mark == RelationMark::known || g.kind == row.kind);
    });
    if (same == groups.end()) {
      groups.push_back({row, 1});
      continue;
    }
    ++same->cases;
    const auto size = [](const HuntFindingRow& r) { return std::pair(r.particles, r.scene.size()); };
    if (size(row) < size(same->smallest)) same->smallest = row;
  }
  std::ranges::stable_partition(groups, [](const FindingGroup& g) { return g.smallest.mark != RelationMark::known; });
  return groups;
}

}  // namespace crosscheck
