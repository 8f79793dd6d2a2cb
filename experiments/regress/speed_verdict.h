// Whether a speed has changed: beyond the noise, and seen again.
#pragma once

#include <string_view>

#include "experiments/regress/speed_file.h"
#include "experiments/timing.h"

namespace crosscheck {

enum class Pace {
  slower,
  gone,  // blessed, and the run is now refused or fails
  faster,
  same,
  fresh,      // not blessed yet
  elsewhere,  // blessed on another kind of machine, by another compiler or of another scene: not compared
};
std::string_view name_of(Pace state);
/// What is held against somebody.
inline bool failed(Pace state) { return state <= Pace::gone; }

struct SpeedCompared {
  std::string scene, method;
  std::optional<double> was;  // CPU time over the plain loop's; with --against the other method's
  double is = 0;              // 0 where it is gone
  Timing change;              // is/was of the rounds, with its interval; all 0 where there is no `was`
  double noise = 0;           // relative: what is not beyond it is no change
  Pace state = Pace::same;
  int seen = 1;          // how many measurements `is` and `change` come from
  std::string sentence;  // what it was bought with or paid for (trade.h); empty where nothing changed
  std::string note;      // why it is not compared
};

/// The changes that count: 10 %, or twice the spread of the measurements at bless, or of the rounds now, where that is
/// more. Measured on a loaded machine, 32 questions forty times: 99 in 100 lie within 4 % of the middle of theirs, and
/// with any seven of them blessed one in a thousand of the others lies outside this noise, where an alarm takes five in
/// a row. The same code at eight other places in the program differs by up to 5 %, which is why it is not 5 %.
double noise_of(double spread);

/// The second largest departure from the median, relative: one odd process is not the noise of a scene for ever.
double spread_of(const std::vector<double>& middles);

/// 1 where the whole interval is above 1 + noise (slower), -1 where it is below 1 / (1 + noise) (faster), else 0.
int direction_of(const Timing& change, double noise);

/// One measurement of all questions, beside blessed speeds, or beside the other method of the question where that is
/// null: `slower` and `faster` are suspicions still. What never had a speed is left out.
std::vector<SpeedCompared> first_look(const std::vector<SpeedQuestion>& questions, const SpeedFile* blessed,
                                      const Machine& machine, const Measure& measure);

/// Measures what is suspected again, four times and with more rounds: where one of them does not show a change beyond
/// the noise in the same direction, it is the same. The figures left are the middle ones of these four.
void confirm(std::vector<SpeedCompared>& rows, const std::vector<SpeedQuestion>& questions, const Measure& measure);

/// The speeds of all questions as they are to be blessed, by seven measurements.
std::vector<BlessedSpeed> speeds_to_bless(const std::vector<SpeedQuestion>& questions, const Machine& machine,
                                          const Measure& measure);

}  // namespace crosscheck
