// The speed part of a regression run: measures, sets beside what is blessed, looks again; or blesses.
#pragma once

#include <chrono>

#include "experiments/regress/speed_verdict.h"
#include "experiments/sweep/sweep.h"

namespace crosscheck {

struct SpeedRun {
  Asked asked;
  std::optional<Method> against;    // instead of blessed speeds
  std::filesystem::path baselines;  // folder
  std::filesystem::path out;        // folder, for what is measured
  Machine machine;                  // this one
};

struct Speeds {
  std::vector<SpeedCompared> rows;  // in the order of the questions
  std::vector<std::string> notes;   // what was not compared and why, one line each
  std::vector<FailedPoint> failures;
  std::vector<std::string> trades = {};  // what each change was bought with, one sentence each (trade.h)
  bool passed() const;                   // nothing slower or gone, no failures
};

/// Measures in processes of their own, alone on this machine and pinned to one core, so that an engine that crashes
/// takes nothing else with it; each of them laid out otherwise in memory, and begun a second after the one before, or
/// later.
class SpeedMeter {
 public:
  SpeedMeter(std::filesystem::path out, Progress& progress) : out_(std::move(out)), progress_(progress) {}
  /// Throws std::runtime_error where the process died.
  std::vector<Ratios> operator()(const std::vector<SpeedQuestion>& questions, const SpeedPlan& plan);

 private:
  std::filesystem::path out_;
  Progress& progress_;
  int count_ = 0;
  std::chrono::steady_clock::time_point begun_ = {};
};

/// A file of blessed speeds that cannot be read is a failure; one that is not there is said.
Speeds compared_speeds(const SpeedRun& run, Progress& progress);

/// The figures of one measurement beside those of a file, and of those that confirm it.
Speeds compared_speeds(const std::vector<SpeedQuestion>& questions, const SpeedFile* blessed, const Machine& machine,
                       const Measure& measure);

/// Measures and writes what has changed, is new or is of another scene; the rest keeps its blessing, and so do speeds
/// of other kinds of machine. Returns what is written. Throws InputError where the file cannot be read.
std::vector<BlessedSpeed> bless_speeds(const SpeedRun& run, const Blessing& blessing, Progress& progress);

/// `file` with these speeds in it, where they differ by more than the noise; those that did are returned.
std::vector<BlessedSpeed> put_into(SpeedFile& file, const std::vector<BlessedSpeed>& speeds, const Blessing& blessing);

}  // namespace crosscheck
