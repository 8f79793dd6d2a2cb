// The cheapest run of a scene within an accuracy, on which the recommendations of the report and `advise` are based.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/speed_accuracy/speed_accuracy.h"
#include "mysim/run/run.h"
#include "reference/method.h"

namespace crosscheck {

struct TriedRun {
  std::string model = {};  // empty: the full scene
  std::string method;
  Setting setting = {};
  Verdict verdict = Verdict::ok;
  std::optional<double> error = {};  // m, largest RMS distance from the truth; for runs that are ok
  double cost = 0;                   // force evaluations times springs
  bool is_within(double bound) const { return verdict == Verdict::ok && error && *error <= bound; }
};

/// Outcome of the next longer step (or looser tolerance): it blew up, missed the bound, or failed in another way; none:
/// there is no longer step.
enum class StepBound { stability, accuracy, failure, none };
/// "stability", "accuracy", "failure" or "sampling".
std::string_view name_of(StepBound bound);

struct Recommendation {
  size_t run;                         // index of a run
  std::vector<size_t> tied = {};      // cheapest runs of other methods with the same cost
  std::optional<size_t> second = {};  // cheapest run of another method
  StepBound bound = StepBound::none;
};

/// Costs within this factor count as equal: the resolution of the search for steps.
inline constexpr double step_resolution = 1.05;

/// The cheapest run with an error of at most `bound` (m) that is not accidental: there are finer runs of its method and
/// model, and all of them are within the bound. Among runs of equal cost (step_resolution) the most accurate one.
/// Nothing if there is none. Does not depend on timings.
std::optional<Recommendation> recommend(const std::vector<TriedRun>& runs, double bound);

/// True for the methods of the engine under test (except demonstrations) and for the user's programs.
bool is_candidate(const std::string& method);
/// The candidates' runs on a scene in table `speed-accuracy`. Their cost is in evaluations, without the factor of the
/// scene's springs.
std::vector<TriedRun> tried_runs(const std::vector<SpeedAccuracyRow>& rows, const std::string& scene);
/// All methods of the engine under test; on scenes with contact, also with event location if supported.
std::vector<Method> candidates(const Scene& scene);

/// Searches steps and tolerances on one model, always with the cheapest next run. Halves a method's step (starting with
/// the longest of the ladder of `speed-accuracy`; tolerances are divided by 100) until two consecutive runs are within
/// the bound. Then bisects between the last run outside and the first within, down to step_resolution. Does not repeat
/// existing runs. Abandons a method if everything that it can reach costs at least `given_up` times the best.
class StepSearch {
 public:
  /// Nothing if the run is not affordable, which ends the method's search.
  using Trial = std::function<std::optional<TriedRun>(const Method&, const Setting&)>;

  /// `base` has the scene's own step, duration and samples. New runs are appended to `runs`, under the name `model`.
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
  using Runs = std::vector<const TriedRun*>;  // one method's runs, from coarse to fine
  struct Step {
    double value = 0, cost = 0;  // setting of the next run, and its smallest possible cost
    double reach = 0;            // the smallest cost at which the method's search can end
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
