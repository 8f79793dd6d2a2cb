#include "tests/hunt/agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "experiments/check/compare.h"
#include "reference/truth/exact/exact.h"
#include "reference/truth/truth.h"

namespace crosscheck {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

std::vector<Scene> no_scenes() { return {}; }
std::string says_nothing(const Scene&) { return "it is asked of two methods"; }
RelationResult of_two(Subject&, const Scene&, unsigned) { throw CannotBeAsked("it is asked of two methods"); }

constexpr Relation of_pairs{
    "agreement",
    "two methods converge to one limit as their steps go to 0",
    "for each, 3 / (2^order - 1) of the change at a quarter of the step, and twice the rounding",
    no_scenes,
    says_nothing,
    of_two};

/// The law that a method follows instead of the scene's, or an empty string. Other solvers for springs or dashpots do
/// not count, because their effect vanishes with the step.
std::string other_law(const Outcome& out) {
  for (const std::string& law : out.different_law)
    if (!law.starts_with("springs:") && !law.starts_with("dashpots:")) return law.substr(0, law.find(':'));
  return "";
}

std::optional<SpringLaw> law_of(const Method& method, const Scene& scene) {
  const auto* springs = scene.model.find<Springs>();
  if (!springs) return std::nullopt;
  return method.spring_law != SpringLaw::hooke ? method.spring_law : springs->law;
}

LimitEstimate limit_of_truth(const Scene& scene) {
  const Run run = run_for_relations(scene);
  // without the cache for converged truths, because the scene is needed only once
  const auto truth = exact_solution(scene)      ? truth_of(scene, run)
                     : has_contact(scene.model) ? std::nullopt
                                                : converged_truth(scene, run);
  if (!truth) throw CannotBeAsked("no truth is known of the scene");
  LimitEstimate limit{truth->trajectory, truth->error_bars};
  const size_t frames = static_cast<size_t>(limit.path.frames());
  if (limit.bar.empty()) limit.bar.assign(frames, truth->error_bar);
  for (double& bar : limit.bar) bar *= std::sqrt(static_cast<double>(scene.model.particles.size()));
  return limit;
}

}  // namespace

const Relation& agreement() { return of_pairs; }

LimitEstimate limit_of(Subject& subject, const Scene& scene) {
  const Method& method = subject.method();
  if (method.family().role == Role::truth) return limit_of_truth(scene);
  if (const std::string law = other_law(subject.run(scene).outcome); !law.empty())
    throw CannotBeAsked(fmt::format("{} follows another law of {}", method.name, law));
  // with contact, adaptive rules also use the run's step, because contact acts on whole steps
  const bool contact = has_contact(scene.model);
  if (method.adaptive && !contact) {
    Run finer = run_for_relations(scene);
    finer.tolerance /= 10;
    const Trajectory& path = subject.run(scene, finer).path;
    return {path, sum_of(distances(subject.run(scene).path, path), subject.noise(scene).x)};
  }
  const int order = contact ? 1 : order_of(method);
  const Trajectory& quarter = halved(subject, scene, 2);
  const std::vector<double> first = distances(halved(subject, scene, 0), halved(subject, scene, 1)),
                            second = distances(halved(subject, scene, 1), quarter), noise = noise_at(subject, scene, 2);
  LimitEstimate limit{quarter, {}};
  bool shrinks = true;
  for (size_t i = 0; i < noise.size(); ++i) {
    shrinks = shrinks && second[i] <= std::exp2(0.5 - order) * first[i] + 2 * noise[i];
    limit.bar.push_back(shrinks ? 3 * second[i] / (std::exp2(order) - 1) + 2 * noise[i] : unknown);
  }
  return limit;
}

Answer ask_agreement(Subject& a, Subject& b, const Scene& scene, const std::vector<KnownBreak>& known) {
  Answer answer{
      a.method().name + " & " + b.method().name, scene.name, &of_pairs, RelationMark::holds, {}, "", hash_of(scene)};
  try {
    if (law_of(a.method(), scene) != law_of(b.method(), scene))
      throw CannotBeAsked("their springs follow different laws");
    const LimitEstimate one = limit_of(a, scene), other = limit_of(b, scene);
    const std::vector<double> bar = sum_of(one.bar, other.bar);
    if (bar.at(1) == unknown) throw CannotBeAsked("their halved steps do not show the order of the rule");
    answer.finding = farthest("the limits that the two come to as their steps go to 0", one.path, other.path, bar,
                              lengths_in(scene, one.path));
    if (!answer.finding.holds()) answer.mark = RelationMark::broken;
  } catch (const CannotBeAsked& why) {
    answer.mark = RelationMark::not_applicable, answer.reason = why.what();
  } catch (const RunFailed& how) {
    answer.mark = RelationMark::not_applicable, answer.reason = how.what();
  }
  mark_known(answer, known);
  return answer;
}

}  // namespace crosscheck
