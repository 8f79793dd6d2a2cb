#include "report/regress/evidence.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/metrics.h"
#include "experiments/regress/shape.h"

namespace crosscheck {
namespace {

const Compared* row_named(const std::vector<Compared>& rows, const std::string& name) {
  const auto at = std::find_if(rows.begin(), rows.end(), [&](const Compared& row) { return row.quantity == name; });
  return at == rows.end() ? nullptr : &*at;
}

std::vector<double> times_of(const Question& question) {
  const Run run = run_over_window(question.scene);
  std::vector<double> times;
  for (int i = 1; i <= run.samples; ++i) times.push_back(run.duration * i / run.samples);
  return times;
}

Series offsets_of(const Trajectory& path) {
  Series series;
  for (int i = 0; i < path.frames(); ++i) series.emplace_back(path.t[i], rms_distance(path.x[i], path.x.front()));
  return series;
}

Answer answer_for_pictures(const Question& question, const Answered& answered, const std::string& who) {
  return {question.scene.name, who, answered.outcome, answered.trajectory};
}

bool owns(const Question& q) { return q.without.empty() && q.method.name == find_method(q.scene.method).name; }

/// From the numbers that a baseline holds: eight times or fewer.
void beside_baseline(Evidence& e, const Regression& regression) {
  for (const double t : times_of(e.question)) {
    const Compared *offset = row_named(e.rows, offset_at(t)), *places = row_named(e.rows, places_at(t));
    if (offset && offset->was) e.was.emplace_back(t, *offset->was);
    // places tell apart what moves alike on the whole
    if (!places || !places->was || !places->is || !std::isfinite(*places->is)) continue;
    e.apart.emplace_back(t, std::abs(*places->is - *places->was));
    e.tolerance.emplace_back(t, places->tolerance);
    if (!e.first_part && e.apart.back().second > places->tolerance) e.first_part = t;
  }
  if (!owns(e.question) || !e.new_answer) return;
  const auto shape = read_shape(regression.baselines, e.question.scene.name, e.question.scene.model.particles.size());
  if (!shape) return;
  e.old_answer = Answer{e.question.scene.name, "was: " + e.question.method.name, {}, {}};
  e.old_answer->trajectory.t = {shape->t};
  e.old_answer->trajectory.x = {shape->x};
}

/// From both runs, at every sample; tolerances at those of the quantities.
void beside_other(Evidence& e, const Method& against) {
  Question old = e.question;
  old.method = against;
  const Answered answered = as_compared(answer_to(old));
  e.was = offsets_of(answered.trajectory);
  e.was_at_samples = true;
  if (!answered.trajectory.x.empty()) e.old_answer = answer_for_pictures(old, answered, "was: " + against.name);
  for (const double t : times_of(e.question))
    if (const Compared* offset = row_named(e.rows, offset_at(t))) e.tolerance.emplace_back(t, offset->tolerance);
  if (!e.new_answer || e.tolerance.empty()) return;
  const Trajectory &now = e.new_answer->trajectory, &before = answered.trajectory;
  for (int i = 1; i < std::min(now.frames(), before.frames()); ++i) {
    const double distance = rms_distance(now.x[i], before.x[i]);
    // of the next time at which the tolerance is known
    const auto known = std::find_if(e.tolerance.begin(), e.tolerance.end(),
                                    [&](const auto& at) { return at.first >= now.t[i] * (1 - 1e-9); });
    if (!std::isfinite(distance) || known == e.tolerance.end()) break;
    e.apart.emplace_back(now.t[i], distance);
    if (!e.first_part && distance > known->second) e.first_part = now.t[i];
  }
}

}  // namespace

Evidence evidence_of(const Question& question, const std::vector<Compared>& rows, const Regression& regression) {
  Evidence e{question};
  for (const Compared& row : rows)
    if (row.scene == question.scene.name && row.method == question.method.name && row.without == question.without)
      e.rows.push_back(row);
  std::stable_sort(e.rows.begin(), e.rows.end(),
                   [](const Compared& a, const Compared& b) { return failed(a.state) && !failed(b.state); });
  const Answered answered = as_compared(answer_to(question));
  e.is = offsets_of(answered.trajectory);
  if (!answered.trajectory.x.empty())
    e.new_answer = answer_for_pictures(question, answered, "is: " + question.method.name);
  if (regression.against)
    beside_other(e, *regression.against);
  else
    beside_baseline(e, regression);
  return e;
}

std::vector<Question> worth_a_picture(const std::vector<Question>& all, const std::vector<Compared>& rows, int most) {
  struct Ranked {
    const Question* question;
    double off;
  };
  std::vector<Ranked> ranked;
  for (const Compared& row : worst_of_each(rows)) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const Question& q) {
      return q.scene.name == row.scene && q.method.name == row.method && q.without == row.without;
    });
    if (at == all.end() ||
        std::any_of(ranked.begin(), ranked.end(), [&](const Ranked& r) { return r.question == &*at; }))
      continue;
    ranked.push_back({&*at, row.rank()});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    if (a.question->without.empty() != b.question->without.empty()) return a.question->without.empty();
    if (owns(*a.question) != owns(*b.question)) return owns(*a.question);  // of these the old shape is kept
    return a.off > b.off;
  });
  std::vector<Question> first, others;
  std::set<std::string> scenes;
  for (const Ranked& r : ranked) (scenes.insert(r.question->scene.name).second ? first : others).push_back(*r.question);
  first.insert(first.end(), others.begin(), others.end());
  if (static_cast<int>(first.size()) > most) first.erase(first.begin() + most, first.end());
  return first;
}

}  // namespace crosscheck
