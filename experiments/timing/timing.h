// Timing of runs in turns: medians with intervals, and the noise level.
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

/// CPU time of one run, s.
struct Timing {
  double median = 0, low = 0, high = 0;  // 90 % interval of the median, see timing_of()
  long repetitions = 0;
  Timing times(double factor) const { return {median * factor, low * factor, high * factor, repetitions}; }
};

/// Median and interval of repeated times. The interval extends from the k-th smallest to the k-th largest time. k is
/// the largest number for which the interval contains the true median with a probability of at least 0.9 for any
/// distribution (the number of times below the median is binomial; H. A. David and H. N. Nagaraja, Order Statistics,
/// 7.1). Fewer than five times cannot guarantee that; the interval then contains all of them. Throws
/// std::invalid_argument if there are no times.
Timing timing_of(std::vector<double> seconds);

/// Mean time (s) of a run that returns its own time. Repeats the run until the total is at least `resolution`.
double mean_time(const std::function<double()>& run, double resolution);

/// Number of repetitions that take about `seconds`, found by trial. seconds_of(n) returns the time of n repetitions.
long repetitions_in(double seconds, const std::function<double(long)>& seconds_of);

struct TimingOptions {
  int least = 5, most = 11;    // repetitions of each run
  double enough = 0.2;         // s: after `least` repetitions, a run stops when its total time reaches this
  double resolution = 100e-6;  // s: shorter runs are repeated within a repetition until their total reaches this time
  double warm = 0.5;           // s: a shorter first run is only a warm-up; a longer one counts as a repetition
};

/// Times of every repetition of every run. Each run does its work once and returns its CPU time, s. After one warm-up
/// of each, all runs are executed one after the other, round by round, so that a slow spell of the machine affects all
/// of them. A run that returns 0 has no time (a program without a clock, or a method that refused). It is not repeated:
/// its only time is 0.
std::vector<std::vector<double>> time_round_robin(std::span<const std::function<double()>> runs,
                                                  const TimingOptions& plan);

/// Times of `rounds` rounds, each with one repetition of each run, after a warm-up of each run.
std::vector<std::vector<double>> time_rounds(std::span<const std::function<double()>> runs, int rounds);

/// Median of the ratios of the times of two runs, taken round by round over their common rounds.
Timing ratio_of_rounds(const std::vector<double>& a, const std::vector<double>& b);

double median_of(std::vector<double> values);

/// Relative difference of two measurements of the same run on this machine. It is the 90 % quantile, taken over the
/// runs, of the difference between the medians of their even and odd repetitions; at least 1 %.
double noise_floor(std::span<const std::vector<double>> times);

/// True if the intervals are disjoint, and the medians differ by more than the noise.
bool differ(const Timing& a, const Timing& b, double noise);

/// `instructions` restricts mysim's fast paths to one instruction set.
struct TimedRun {
  Method method;
  std::shared_ptr<const Scene> scene;
  Run run;
  std::optional<simd::InstructionSet> instructions = {};
};

struct EvaluationTimes {
  std::vector<double> per_evaluation;  // s, one per round
  double share = 1;                    // timed fraction of the run
};

struct TimedRunOptions {
  int rounds = 11;
  double seconds = 0.02;  // duration of each run in each round
};

/// CPU time of each run divided by its number of evaluations, without observers. Without contact each evaluation costs
/// the same, so that the first part of a run suffices. A run that reports no time, or fails immediately, has no times.
std::vector<EvaluationTimes> time_round_robin(const std::vector<TimedRun>& turns, const TimedRunOptions& plan,
                                              const LockPatience& patience);

}  // namespace crosscheck
