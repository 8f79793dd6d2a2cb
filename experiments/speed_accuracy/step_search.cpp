#include "experiments/speed_accuracy/step_search.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "experiments/scenes/ingredients.h"
#include "mysim/run/contacts.h"

namespace crosscheck {
namespace {

constexpr double loosest = 1e-1, tightest = 1e-13;  // relative tolerances
constexpr long most_steps = 1L << 22;               // between two samples
constexpr double most_cost = 1e9;                   // a run with this cost takes some seconds

bool same_search(const TriedRun& a, const TriedRun& b) { return a.method == b.method && a.model == b.model; }

bool is_finer(const TriedRun& a, const TriedRun& b) {
  return same_search(a, b) && a.setting.value < b.setting.value * (1 - 1e-9);
}

bool is_confirmed(const std::vector<TriedRun>& runs, const TriedRun& run, double bound) {
  if (!run.is_within(bound)) return false;
  bool confirmed = false;
  for (const TriedRun& other : runs)
    if (is_finer(other, run)) {
      if (!other.is_within(bound)) return false;
      confirmed = true;
    }
  return confirmed;
}

StepBound bound_of(const std::vector<TriedRun>& runs, const TriedRun& run) {
  const TriedRun* longer = nullptr;
  for (const TriedRun& other : runs)
    if (is_finer(run, other) && (!longer || is_finer(other, *longer))) longer = &other;
  if (!longer) return StepBound::none;
  switch (longer->verdict) {
    case Verdict::ok:
      return StepBound::accuracy;
    case Verdict::energy:
    case Verdict::nan:
    case Verdict::stretch:
      return StepBound::stability;
    default:
      return StepBound::failure;
  }
}

}  // namespace

std::string_view name_of(StepBound bound) {
  static constexpr std::string_view names[] = {"stability", "accuracy", "failure", "sampling"};
  return names[static_cast<size_t>(bound)];
}

std::optional<Recommendation> recommend(const std::vector<TriedRun>& runs, double bound) {
  std::vector<size_t> best;
  for (size_t i = 0; i < runs.size(); ++i) {
    if (!(runs[i].cost > 0) || !is_confirmed(runs, runs[i], bound)) continue;
    const auto own = std::ranges::find_if(best, [&](size_t j) { return same_search(runs[i], runs[j]); });
    if (own == best.end())
      best.push_back(i);
    else if (runs[i].cost < runs[*own].cost)
      *own = i;
  }
  if (best.empty()) return std::nullopt;
  std::ranges::stable_sort(best, {}, [&](size_t i) { return runs[i].cost; });
  const double most = step_resolution * runs[best[0]].cost;
  const auto end = std::ranges::find_if(best, [&](size_t i) { return runs[i].cost > most; });
  const auto chosen =
      std::min_element(best.begin(), end, [&](size_t a, size_t b) { return *runs[a].error < *runs[b].error; });
  Recommendation out{*chosen};
  out.bound = bound_of(runs, runs[out.run]);
  for (auto i = best.begin(); i != best.end(); ++i) {
    if (runs[*i].method == runs[out.run].method) continue;
    if (i < end) out.tied.push_back(*i);
    if (!out.second) out.second = *i;
  }
  return out;
}

bool is_candidate(const std::string& method) {
  const MethodFamily& family = family_of(method);
  return method != sticky_method() && (family.is_subject() || family.role == Role::outside);
}

std::vector<TriedRun> tried_runs(const std::vector<SpeedAccuracyRow>& rows, const std::string& scene) {
  std::vector<TriedRun> runs;
  for (const SpeedAccuracyRow& row : rows)
    if (row.scene == scene && is_candidate(row.method))
      runs.push_back({.method = row.method,
                      .setting = {row.setting == SettingKind::tolerance, row.requested},
                      .verdict = row.verdict,
                      .error = row.error,
                      .cost = static_cast<double>(row.evaluations)});
  return runs;
}

std::vector<Method> candidates(const Scene& scene) {
  std::vector<Method> methods;
  for (Method& m : all_methods()) {
    if (!m.family().is_subject()) continue;
    if (has_contact(scene.model) && m.stepper && locates_events(*m.stepper))
      methods.push_back(find_method(m.name + "+events"));
    methods.push_back(std::move(m));
  }
  return methods;
}

void StepSearch::search(std::vector<Method> methods) {
  while (true) {
    const auto recommended = recommend(runs_, bound_);
    const double best = recommended ? runs_[recommended->run].cost : INFINITY;
    const Method* cheapest = nullptr;
    Step next;
    for (const Method& method : methods)
      if (const auto step = next_step(method, best);
          step && step->reach <= given_up_ * best && step->cost <= most_cost && (!cheapest || step->cost < next.cost))
        cheapest = &method, next = *step;
    if (!cheapest) return;
    const Setting setting{cheapest->adaptive, next.value};
    if (auto run = trial_(*cheapest, setting)) {
      run->model = model_, run->method = cheapest->name, run->setting = setting;
      runs_.push_back(std::move(*run));
    } else {
      methods.erase(methods.begin() + (cheapest - methods.data()));
    }
  }
}

StepSearch::Runs StepSearch::known(const Method& method) const {
  Runs own;
  for (const TriedRun& run : runs_)
    if (run.method == method.name && run.model == model_) own.push_back(&run);
  std::ranges::stable_sort(own, std::greater{}, [](const TriedRun* run) { return run->setting.value; });
  return own;
}

long StepSearch::steps_of(double step) const { return std::lround(base_.duration / base_.samples / step); }

double StepSearch::least_cost(const Method& method, long steps) const {
  const int evaluations = method.stepper ? std::max(1, method.stepper->evaluations) : 1;
  return static_cast<double>(steps) * base_.samples * evaluations * static_cast<double>(springs_of(scene_.model));
}

/// The next finer setting of the ladder, used if the finest run misses the bound or is the only one that meets it.
std::optional<StepSearch::Step> StepSearch::finer(const Method& method, const Runs& runs) const {
  const TriedRun* fails = runs.empty() ? nullptr : runs.back();
  if (fails && fails->is_within(bound_)) fails = runs.size() > 1 ? runs[runs.size() - 2] : nullptr;
  if (method.adaptive) {
    const double value = runs.empty() ? 1e-2 : runs.back()->setting.value / 100;
    if (value < tightest) return std::nullopt;
    return Step{value, runs.empty() ? 0 : runs.back()->cost, fails ? fails->cost : 0};
  }
  const double limit = stability_limit(method, scene_);
  const long steps = runs.empty() ? 0 : steps_of(runs.back()->setting.value);
  for (int halving = longest_halving;; --halving) {
    const TimeGrid grid = time_grid({base_.step * std::pow(2, halving), base_.duration, base_.samples});
    if (grid.steps_per_sample > most_steps) return std::nullopt;
    if (grid.steps_per_sample > steps && !is_beyond(limit, halving, grid.h))
      return Step{grid.h, least_cost(method, grid.steps_per_sample),
                  fails ? least_cost(method, steps_of(fails->setting.value)) : 0};
  }
}

/// The next setting to try, given the method's runs and the lowest cost of all methods; nullopt if the search is
/// complete.
std::optional<StepSearch::Step> StepSearch::next_step(const Method& method, double best) const {
  const Runs runs = known(method);
  if (!runs.empty() && runs.back()->verdict == Verdict::unsupported) return std::nullopt;
  // finds the coarsest run such that this run and all finer ones are within the bound
  size_t first = runs.size();
  while (first > 0 && runs[first - 1]->is_within(bound_)) --first;
  if (first + 1 >= runs.size()) return finer(method, runs);  // no run is within, or only the finest, maybe by accident
  const TriedRun& meets = *runs[first];
  const TriedRun* fails = first > 0 ? runs[first - 1] : nullptr;
  if (method.adaptive) {
    if (!fails) {
      if (meets.setting.value >= loosest) return std::nullopt;
      return Step{std::min(loosest, 10 * meets.setting.value), meets.cost, 0};
    }
    // the cost of a rule of fifth order scales as the inverse fifth root of its tolerance
    const double ratio = fails->setting.value / meets.setting.value, cheaper = std::pow(ratio, 0.2);
    if (cheaper <= step_resolution || meets.cost / cheaper > step_resolution * best) return std::nullopt;
    return Step{meets.setting.value * std::sqrt(ratio), meets.cost / std::sqrt(cheaper), meets.cost / cheaper};
  }
  const double interval = base_.duration / base_.samples;
  const long m = steps_of(meets.setting.value), f = fails ? steps_of(fails->setting.value) : 0;
  if (!fails) {
    if (m <= 1) return std::nullopt;
    return Step{interval / static_cast<double>(m / 2), meets.cost / 2, 0};
  }
  const double ratio = static_cast<double>(m) / static_cast<double>(f);
  if (m <= f + 1 || ratio <= step_resolution || meets.cost / ratio > step_resolution * best) return std::nullopt;
  const long middle = std::clamp(std::lround(std::sqrt(static_cast<double>(m) * static_cast<double>(f))), f + 1, m - 1);
  return Step{interval / static_cast<double>(middle), meets.cost / std::sqrt(ratio), meets.cost / ratio};
}

}  // namespace crosscheck
