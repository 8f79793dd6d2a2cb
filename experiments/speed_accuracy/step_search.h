// Search for the cheapest run of a scene that meets an accuracy. The recommendations of the report and of `advise` are
// based on this search.
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
  std::string model = {};  // name of the reduced model; empty for the full scene
  std::string method;
  Setting setting = {};
  Verdict verdict = Verdict::ok;
  std::optional<double> error = {};  // m, largest RMS distance from the truth; empty if the run failed
  double cost = 0;                   // force evaluations times the number of springs
  bool is_within(double bound) const { return verdict == Verdict::ok && error && *error <= bound; }
};

/// Outcome of a run with the next longer step (or looser tolerance): it blew up, missed the bound, or failed in another
/// way. `none`: there is no longer step.
enum class StepBound { stability, accuracy, failure, none };
/// "stability", "accuracy", "failure" or "sampling".
std::string_view name_of(StepBound bound);

struct Recommendation {
  size_t run;                         // index of a run
  std::vector<size_t> tied = {};      // cheapest runs of other methods, if their cost is equal
  std::optional<size_t> second = {};  // cheapest run of another method
  StepBound bound = StepBound::none;
};

/// Costs within this factor of each other count as equal; also the resolution of the search for steps.
inline constexpr double step_resolution = 1.05;

/// The cheapest run with an error of at most `bound` (m) that is not accidental: there are finer runs of the same
/// method and model, and all of them are within the bound. Among runs of equal cost (step_resolution), the most
/// accurate one. Returns nullopt if there is no such run. Does not depend on timings.
std::optional<Recommendation> recommend(const std::vector<TriedRun>& runs, double bound);

/// True for methods of the engine under test (except demonstrations) and for the user's programs.
bool is_candidate(const std::string& method);
/// The candidates' runs on a scene, from the rows of table `speed-accuracy`. Costs are numbers of evaluations, without
/// the factor for the scene's number of springs.
std::vector<TriedRun> tried_runs(const std::vector<SpeedAccuracyRow>& rows, const std::string& scene);
/// All methods of the engine under test; on scenes with contact, also with event location if supported.
std::vector<Method> candidates(const Scene& scene);

/// Searches steps and tolerances on one model. In each turn, runs the method whose next run is the cheapest. Halves a
/// method's step (starting with the longest step of the ladder of `speed-accuracy`; tolerances are divided by 100)
/// until two consecutive runs are within the bound. Then bisects between the last run that misses the bound and the
/// first run that meets it, down to step_resolution. Does not repeat existing runs. Abandons a method if all runs that
/// it can still find cost at least `given_up` times as much as the best one.
class StepSearch {
 public:
  /// Returns nullopt if the run is not affordable, which ends the method's search.
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
    double reach = 0;            // smallest possible cost of the final run of the method's search
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
