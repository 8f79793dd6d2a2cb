// The cheapest run of a scene within an accuracy: the search for it, and the choice among the runs that were tried.
// The report and `advise` recommend by both.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/speed_accuracy/speed_accuracy.h"
#include "mysim/run/run.h"
#include "reference/method.h"

namespace crosscheck {

/// A run that was tried.
struct TriedRun {
  std::string model = {};  // empty: the whole scene
  std::string method;
  Setting setting = {};
  Verdict verdict = Verdict::ok;
  std::optional<double> error = {};  // m, largest RMS distance from the truth; of runs that are ok
  double cost = 0;                   // force evaluations times springs
  bool is_within(double bound) const { return verdict == Verdict::ok && error && *error <= bound; }
};

/// The outcome of the next longer step (looser tolerance) that was tried: it blew up, missed the bound, or failed
/// otherwise; none: no longer one can be tried.
enum class StepBound { stability, accuracy, failure, none };
/// "stability", "accuracy", "failure" or "sampling".
std::string_view name_of(StepBound bound);

struct Recommendation {
  size_t run;                         // index of a run
  std::vector<size_t> tied = {};      // other methods' cheapest runs of the same cost
  std::optional<size_t> second = {};  // cheapest run of another method
  StepBound bound = StepBound::none;
};

/// Costs that differ by less are equal: steps are found to this factor.
inline constexpr double step_resolution = 1.05;

/// The cheapest run with an error of at most `bound` (m) that is no accident: all finer runs of its method and model,
/// of which there is one at least, are within the bound, too. Among runs of equal cost (step_resolution) the most
/// accurate one. Nothing where there is none. Independent of any clock.
std::optional<Recommendation> recommend(const std::vector<TriedRun>& runs, double bound);

/// True if the method can be recommended: it is the subject's, or a program of the reader's, and no demonstration.
bool is_candidate(const std::string& method);
/// The runs of candidates on a scene that table `speed-accuracy` has; the scene's springs are left out of their cost.
std::vector<TriedRun> tried_runs(const std::vector<SpeedAccuracyRow>& rows, const std::string& scene);
/// All methods of the subject; on scenes with spheres those that locate events also with that option.
std::vector<Method> candidates(const Scene& scene);

/// Searches steps and tolerances on one model, the cheapest next run first: halves a method's step (beginning with the
/// longest of the ladder of `speed-accuracy`; tolerances are divided by 100) until two runs in a row are within the
/// bound, then bisects between the last run that is not and the first that is, down to step_resolution. Runs that are
/// there already are not repeated. A method is given up where all that it can reach costs `given_up` times the best.
class StepSearch {
 public:
  /// Runs a method at a setting; nothing where that is not affordable, which ends the method's search.
  using Trial = std::function<std::optional<TriedRun>(const Method&, const Setting&)>;

  /// `base` has the scene's own step, duration and samples. New runs are appended to `runs`; `model` names theirs.
  StepSearch(const Scene& scene, const Run& base, double bound, Trial trial, std::vector<TriedRun>& runs,
             double given_up = step_resolution, std::string model = {})
      : scene_(scene),
        base_(base),
        bound_(bound),
        trial_(std::move(trial)),
        runs_(runs),
        given_up_(given_up),
        model_(std::move(model)) {}

  void search(std::vector<Method> methods);

 private:
  using Runs = std::vector<const TriedRun*>;  // one method's, from coarse to fine
  struct Step {
    double value = 0, cost = 0;  // next run, and the least that it costs
    double reach = 0;            // the least cost that the method's search can end at
  };
  Runs known(const Method& method) const;
  std::optional<Step> next_step(const Method& method, double best) const;
  std::optional<Step> finer(const Method& method, const Runs& runs) const;
  double least_cost(const Method& method, long steps) const;
  long steps_of(double step) const;

  const Scene& scene_;
  Run base_;
  double bound_;
  Trial trial_;
  std::vector<TriedRun>& runs_;
  double given_up_;
  std::string model_;
};

}  // namespace crosscheck
