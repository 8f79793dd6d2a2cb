// Whether a speed has changed: measured, compared with what is blessed, measured again; or blessed.
#pragma once

#include <chrono>
#include <string_view>

#include "experiments/regress/speed.h"
#include "experiments/sweep/sweep.h"
#include "experiments/timing/timing.h"

namespace crosscheck {

// Whether a speed has changed: beyond the noise, and seen again.

enum class SpeedStatus {
  slower,
  gone,  // blessed, and the run is now refused or fails
  faster,
  same,
  added,      // not blessed yet
  elsewhere,  // blessed on another kind of machine, by another compiler or of another scene: not compared
};
std::string_view name_of(SpeedStatus state);
/// Whether the status fails the regression run.
inline bool failed(SpeedStatus state) { return state <= SpeedStatus::gone; }

struct SpeedComparison {
  std::string scene, method;
  std::optional<double> was;  // CPU time over the plain loop's; with --against the other method's
  double is = 0;              // 0 where it is gone
  Timing change;              // is/was of the rounds, with its interval; all 0 where there is no `was`
  double noise = 0;           // relative: what is not beyond it is no change
  SpeedStatus state = SpeedStatus::same;
  int seen = 1;          // how many measurements `is` and `change` come from
  std::string sentence;  // what it was bought with or paid for (attribution.h); empty where nothing changed
  std::string note;      // why it is not compared
};

/// The changes that count: 10 %, or twice the spread of the measurements at bless, or of the rounds now, where that is
/// more. Measured on a loaded machine, 32 cases forty times: 99 in 100 lie within 4 % of their case's median, and
/// with any seven of them blessed one in a thousand of the others lies outside this noise, where an alarm takes five in
/// a row. The same code at eight other places in the program differs by up to 5 %, which is why it is not 5 %.
double noise_of(double spread);

/// The second largest departure from the median, relative: one odd process is not the noise of a scene for ever.
double spread_of(const std::vector<double>& middles);

/// 1 where the whole interval is above 1 + noise (slower), -1 where it is below 1 / (1 + noise) (faster), else 0.
int direction_of(const Timing& change, double noise);

/// One measurement of all cases, compared with blessed speeds, or with the other method of the case where that is
/// null: `slower` and `faster` are suspicions still. What never had a speed is left out.
std::vector<SpeedComparison> first_measurement(const std::vector<SpeedCase>& cases, const SpeedFile* blessed,
                                               const Machine& machine, const MeasureSpeeds& measure);

/// Measures what is suspected again, four times and with more rounds: where one of them does not show a change beyond
/// the noise in the same direction, it is the same. The figures left are the middle ones of these four.
void confirm(std::vector<SpeedComparison>& rows, const std::vector<SpeedCase>& cases, const MeasureSpeeds& measure);

/// The speeds of all cases as they are to be blessed, by seven measurements.
std::vector<BlessedSpeed> speeds_to_bless(const std::vector<SpeedCase>& cases, const Machine& machine,
                                          const MeasureSpeeds& measure);

// The speed part of a regression run: measures, compares with blessed speeds, measures suspects again; or blesses.

struct SpeedRun {
  Selection selection;
  std::optional<Method> against;    // instead of blessed speeds
  std::filesystem::path baselines;  // folder
  std::filesystem::path out;        // folder, for what is measured
  Machine machine;                  // this one
  LockPatience patience;
};

struct Speeds {
  std::vector<SpeedComparison> rows;  // in the order of the cases
  std::vector<std::string> notes;     // what was not compared and why, one line each
  std::vector<FailedPoint> failures;
  std::vector<std::string> explanations = {};  // what each change was bought with, one sentence each (attribution.h)
  bool passed() const;                         // nothing slower or gone, no failures
};

/// Measures in processes of their own, alone on this machine and pinned to one core, so that an engine that crashes
/// takes nothing else with it; each of them laid out otherwise in memory, and begun a second after the one before, or
/// later.
class SpeedMeasurement {
 public:
  SpeedMeasurement(std::filesystem::path out, const LockPatience& patience, Progress& progress)
      : out_(std::move(out)), patience_(patience), progress_(progress) {}
  /// Throws std::runtime_error where the process died.
  std::vector<Ratios> operator()(const std::vector<SpeedCase>& cases, const SpeedOptions& options);

 private:
  std::filesystem::path out_;
  LockPatience patience_;
  Progress& progress_;
  int count_ = 0;
  std::chrono::steady_clock::time_point begun_ = {};
};

/// A file of blessed speeds that cannot be read is a failure; one that is not there is said.
Speeds compared_speeds(const SpeedRun& run, Progress& progress);

/// The figures of one measurement compared with those of a file, and of those that confirm it.
Speeds compared_speeds(const std::vector<SpeedCase>& cases, const SpeedFile* blessed, const Machine& machine,
                       const MeasureSpeeds& measure);

/// Measures and writes what has changed, is new or is of another scene; the rest keeps its blessing, and so do speeds
/// of other kinds of machine. Returns what is written. Throws InputError where the file cannot be read.
std::vector<BlessedSpeed> bless_speeds(const SpeedRun& run, const Blessing& blessing, Progress& progress);

/// `file` with these speeds in it, where they differ by more than the noise; those that did are returned.
std::vector<BlessedSpeed> merge_into(SpeedFile& file, const std::vector<BlessedSpeed>& speeds,
                                     const Blessing& blessing);

}  // namespace crosscheck
