// Changes of speed: blessed speeds, measurements compared with them, measurements that confirm a change.
#pragma once

#include <string_view>

#include "experiments/regress/regress.h"
#include "experiments/regress/speed.h"
#include "experiments/timing/timing.h"

namespace crosscheck {

// Blessed speeds: the cost of each method over that of the plain loop at the last blessing. One file.

/// The kind of machine and program that a speed belongs to: on another kind it says nothing, for what a method takes
/// relative to the plain loop depends on the processor's units and caches and on the compiler.
struct Machine {
  std::string cpu,
      compiler;  // processor_kind() (experiments/timing/machine.h), empty where that is not known; with its flags
  std::string reference_loop;  // which plain loop
  bool operator==(const Machine&) const = default;
};

struct BlessedSpeed {
  std::string scene, hash, method;  // hash: of the scene
  double ratio = 0;                 // CPU time over the plain loop's: the middle of some measurements apart in time
  double spread = 0;                // relative: how far the second farthest of these is from the middle
  Machine machine;
  int blessing = 1;  // its number in the file, from 1
};

struct SpeedFile {
  std::vector<Blessing> blessings;
  std::vector<BlessedSpeed> speeds;  // for several kinds of machine
};

/// The case's speed on that kind of machine, or null; no kind is like one that is not known.
const BlessedSpeed* find_speed(const SpeedFile& file, const SpeedCase& test_case, const Machine& machine);

/// speed-cost.csv in the folder.
std::filesystem::path speed_file_in(const std::filesystem::path& folder);
std::string text_of(const SpeedFile& file);
/// Throws InputError "FILE:LINE: expected ..."; nothing where there is no file.
std::optional<SpeedFile> read_speed_file(const std::filesystem::path& folder);

// Changes: beyond the noise, and seen again.

enum class SpeedStatus {
  slower,
  gone,  // blessed, and the run is now refused or fails
  faster,
  same,
  added,      // not blessed yet
  elsewhere,  // blessed on another kind of machine, by another compiler or of another scene: not compared
};
std::string_view name_of(SpeedStatus state);
/// True for a status that fails the regression run.
inline bool failed(SpeedStatus state) { return state <= SpeedStatus::gone; }

struct SpeedComparison {
  std::string scene, method;
  std::optional<double> was;  // CPU time over the plain loop's; with --against the other method's
  double is = 0;              // 0 where it is gone
  Timing change;              // is/was of the rounds, with its interval; all 0 where there is no `was`
  double noise = 0;           // relative: a smaller change does not count
  SpeedStatus state = SpeedStatus::same;
  int seen = 1;          // how many measurements `is` and `change` come from
  std::string sentence;  // the change, and that of the error, in words; empty where nothing changed
  std::string note;      // why it is not compared
};

struct Speeds {
  std::vector<SpeedComparison> rows;  // in the order of the cases
  std::vector<std::string> notes;     // comparisons that were left out and why, one line each
  std::vector<FailedPoint> failures;
  bool passed() const;  // nothing slower or gone, no failures
};

/// The changes that count: 10 %, or twice the spread of the measurements at bless, or of the rounds now, where that is
/// more. Measured on a loaded machine, 32 cases forty times: 99 in 100 lie within 4 % of their case's median, and
/// with any seven of them blessed one in a thousand of the others lies outside this noise, where an alarm takes five in
/// a row. The same code at eight other places in the program differs by up to 5 %, which is why it is not 5 %.
double noise_of(double spread);

/// One measurement of all cases, compared with blessed speeds, or with the other method of the case. A change beyond
/// the noise is measured again, four times and with more rounds: it is the same where one of these shows no change
/// beyond the noise in that direction, and else the figures left are the middle ones of these four. Cases that never
/// had a speed are left out.
Speeds compared_speeds(const std::vector<SpeedCase>& cases, const SpeedFile* blessed, const Machine& machine,
                       const MeasureSpeeds& measure);

/// Sets the sentence of every change: "1.4 times faster; error against truth was 0.001, is 0.0023 m".
void add_sentences(std::vector<SpeedComparison>& speeds, std::span<const Comparison> quantities);

/// The speeds of all cases as they are to be blessed, by seven measurements.
std::vector<BlessedSpeed> speeds_to_bless(const std::vector<SpeedCase>& cases, const Machine& machine,
                                          const MeasureSpeeds& measure);
/// Puts speeds into the file that differ from it by more than the noise, and returns these.
std::vector<BlessedSpeed> merge_into(SpeedFile& file, const std::vector<BlessedSpeed>& speeds,
                                     const Blessing& blessing);

/// Measures in processes of their own, alone on this machine and pinned to one core, so that an engine that crashes
/// takes nothing else with it; each of them laid out otherwise in memory, and begun a second after the one before, or
/// later. Throws std::runtime_error where the process died.
MeasureSpeeds measurements_in(const std::filesystem::path& out, const LockPatience& patience, Progress& progress);

/// The speed part of a regression run. A file of blessed speeds that cannot be read is a failure; a missing one is
/// noted.
Speeds compared_speeds(const Regression& regression, const Machine& machine, Progress& progress);

/// Measures and writes what has changed, is new or is of another scene; the rest keeps its blessing, and so do speeds
/// of other kinds of machine. Returns what is written. Throws InputError where the file cannot be read.
std::vector<BlessedSpeed> bless_speeds(const Regression& regression, const Machine& machine, const Blessing& blessing,
                                       Progress& progress);

}  // namespace crosscheck
