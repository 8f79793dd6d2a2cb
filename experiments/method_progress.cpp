// Runs as steps of work.
#include "experiments/method_progress.h"

#include <fmt/format.h>

#include "experiments/estimate.h"
#include "mysim/observers/pairs.h"

namespace crosscheck {
namespace {

/// Tells a run's progress at its samples and hands everything on, pairs of states too where the other looks at pairs.
class ToldObserver : public PairsObserver {
 public:
  ToldObserver(Observer& inner, double duration, Progress& progress)
      : inner_(inner), pairs_(dynamic_cast<PairsObserver*>(&inner)), duration_(duration), progress_(progress) {}
  bool every_step() const override { return inner_.every_step(); }
  Verdict observe(const State& state, bool sample) override {
    if (sample) progress_.part(state.t / duration_);
    return inner_.observe(state, sample);
  }
  void contact(double lost) override { inner_.contact(lost); }
  bool closely() const override { return pairs_ && pairs_->closely(); }
  void earlier(const State& state) override {
    if (pairs_) pairs_->earlier(state);
  }
  Verdict later(const State& state) override { return pairs_ ? pairs_->later(state) : Verdict::ok; }

 private:
  Observer& inner_;
  PairsObserver* pairs_;  // the same, where it is one
  double duration_;
  Progress& progress_;
};

}  // namespace

Method with_progress(const Method& method, Progress& progress) {
  Method told = method;
  told.engine = [method, &progress](const Scene& scene, const Run& run, Observer& observer) {
    const double steps = run.duration / run.step;
    progress.begin(fmt::format("{} by {}{}", scene.name, method.name,
                               method.adaptive ? "" : fmt::format(", {:.0f} steps of {:.3g} s", steps, run.step)),
                   estimated_seconds(method, scene, run));
    ToldObserver observed(observer, run.duration, progress);
    return method.engine(scene, run, observed);
  };
  return told;
}

}  // namespace crosscheck
