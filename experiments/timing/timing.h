// Timing: runs and methods measured in turns, medians with intervals, and what is within the noise.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "experiments/timing/instruction_sets.h"
#include "experiments/timing/machine.h"
#include "reference/method.h"

namespace crosscheck {

// Honest timing: runs measured in turns, a median with an interval, and what is within the noise.

/// CPU time of one run, s.
struct Timing {
  double median = 0, low = 0, high = 0;  // low to high: 90 % interval of the median, see timing_of()
  long repetitions = 0;
  /// The same, each time multiplied.
  Timing times(double factor) const { return {median * factor, low * factor, high * factor, repetitions}; }
};

/// Median and interval of repeated times. The interval lies between the k-th smallest and the k-th largest time, with
/// the largest k for which it holds the true median with probability 0.9 or more whatever the distribution is (the
/// number of times below the median is binomial; H. A. David and H. N. Nagaraja, Order Statistics, 7.1). Fewer than
/// five times cannot guarantee that: there it is smallest to largest. Throws std::invalid_argument without times.
Timing timing_of(std::vector<double> seconds);

/// The mean time of a run that says what time it took, s, and is repeated until all have taken `resolution`.
double mean_time(const std::function<double()>& run, double resolution);

/// The number of repetitions that take `seconds` by trial; seconds_of(n) returns the time of n.
long repetitions_in(double seconds, const std::function<double(long)>& seconds_of);

struct TimingOptions {
  int least = 5, most = 11;    // repetitions of each run
  double enough = 0.2;         // s: a run that has taken as much is repeated `least` times only
  double resolution = 100e-6;  // s: shorter runs are repeated within a repetition until they have taken as much
  double warm = 0.5;           // s: a run that takes as much the first time has warmed up by itself: that time counts
};

/// Times of every repetition of every run. A run does its work once and says what CPU time it took, s; first each is
/// run once to warm up, then one after the other, round by round, so that a slow spell of the machine falls on all.
/// A run that returns 0 has no time (a program that keeps no clock, a method that refused): it is not repeated, and
/// its only time is 0.
std::vector<std::vector<double>> time_round_robin(std::span<const std::function<double()>> runs,
                                                  const TimingOptions& plan);

/// Times of so many rounds of one repetition each, after one run of each to warm up.
std::vector<std::vector<double>> time_rounds(std::span<const std::function<double()>> runs, int rounds);

/// Quotient of the times of two runs, round by round, over the rounds that both have: its median with its interval.
Timing ratio_of_rounds(const std::vector<double>& a, const std::vector<double>& b);

double median_of(std::vector<double> values);

/// The relative difference of two measurements of the same thing here: the 90 % quantile over the runs of the
/// difference between the medians of their even and their odd repetitions; at least 1 %.
double noise_floor(std::span<const std::vector<double>> times);

/// Whether two timings show different costs: their intervals are apart, and their medians by more than the noise.
bool differ(const Timing& a, const Timing& b, double noise);

// Methods timed in turns, over as much of a run as the clock needs.

/// One run of a method on a scene; mysim's fast paths keep to an instruction set where one is named.
struct TimedRun {
  Method method;
  std::shared_ptr<const Scene> scene;
  Run run;
  std::optional<simd::InstructionSet> instructions = {};
};

struct EvaluationTimes {
  std::vector<double> per_evaluation;  // s, one for each round
  double share = 1;                    // of the run that is timed
};

struct TimedRunOptions {
  int rounds = 11;
  double seconds = 0.02;  // of each run in each round
};

/// CPU time of each run over its evaluations, without observers: without contact each evaluation costs the same, so
/// that the first part of a run gives the time of the whole. A round runs all. A run that reports no time
/// or fails at once has no times.
std::vector<EvaluationTimes> time_round_robin(const std::vector<TimedRun>& turns, const TimedRunOptions& plan,
                                              const LockPatience& patience);

}  // namespace crosscheck
