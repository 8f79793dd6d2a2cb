// The tables of experiment `cost`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

struct SizeCostRow {
  std::string method;
  long side = 0, particles = 0, springs = 0;
  double step = 0;
  long steps_timed = 0;
  double evaluations_per_step = 0, cpu = 0, cpu_low = 0, cpu_high = 0, cpu_per_particle = 0;
  long repetitions = 0;
  double noise = 0;
  std::string build;

  static constexpr std::string_view table = "size-cost", about = "CPU time of a step against the size of a cloth.";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &SizeCostRow::method, "method"),
        column("side", "1", &SizeCostRow::side, "particles along a side of the cloth"),
        column("particles", "1", &SizeCostRow::particles, "particles"),
        column("springs", "1", &SizeCostRow::springs, "springs"), column("step", "s", &SizeCostRow::step, "time step"),
        column("steps timed", "1", &SizeCostRow::steps_timed, "steps of each run that was timed"),
        column("evaluations per step", "1", &SizeCostRow::evaluations_per_step, "force evaluations in a step"),
        column("cpu per step", "s", &SizeCostRow::cpu, "CPU time of a step, median"),
        column("cpu low", "s", &SizeCostRow::cpu_low, "lower end of its 90 % interval"),
        column("cpu high", "s", &SizeCostRow::cpu_high, "upper end of its 90 % interval"),
        column("cpu per step and particle", "s", &SizeCostRow::cpu_per_particle,
               "CPU time of a step over the particles"),
        column("repetitions", "1", &SizeCostRow::repetitions, "runs that were timed"),
        column("noise", "1", &SizeCostRow::noise, "relative difference of two measurements of the same"),
        column("build", "1", &SizeCostRow::build, "who compiled the code that was timed");
  };
};

struct PhaseCostRow {
  std::string method;
  long side = 0;
  std::string phase;
  double cpu = 0, cpu_low = 0, cpu_high = 0, share = 0;
  std::string how;

  static constexpr std::string_view table = "phases-cost", about = "CPU time of the phases of a step.";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &PhaseCostRow::method, "method"),
        column("side", "1", &PhaseCostRow::side, "particles along a side of the cloth"),
        column("phase", "1", &PhaseCostRow::phase, "part of the step"),
        column("cpu per step", "s", &PhaseCostRow::cpu, "CPU time in a step, median"),
        column("cpu low", "s", &PhaseCostRow::cpu_low, "lower end of its interval"),
        column("cpu high", "s", &PhaseCostRow::cpu_high, "upper end of its interval"),
        column("share", "1", &PhaseCostRow::share, "of the whole step"),
        column("how", "1", &PhaseCostRow::how, "how it was measured");
  };
};

struct RooflineRow {
  std::string what;
  double work = 0, bytes = 0;
  std::optional<double> intensity;
  double cpu = 0, cpu_low = 0, cpu_high = 0, rate = 0;
  std::optional<double> bandwidth;

  static constexpr std::string_view table = "roofline-cost",
                                    about = "The machine's peaks and the spring kernel beside them.";
  static constexpr auto columns = [](auto&& column) {
    column("what", "1", &RooflineRow::what, "loop that was timed"),
        column("work", "flop", &RooflineRow::work, "floating-point operations of one run"),
        column("bytes", "B", &RooflineRow::bytes, "bytes that one run moves, as the source asks for them"),
        column("intensity", "flop/B", &RooflineRow::intensity, "operations over bytes"),
        column("cpu", "s", &RooflineRow::cpu, "CPU time of one run, median"),
        column("cpu low", "s", &RooflineRow::cpu_low, "lower end of its 90 % interval"),
        column("cpu high", "s", &RooflineRow::cpu_high, "upper end of its 90 % interval"),
        column("rate", "flop/s", &RooflineRow::rate, "operations in a second"),
        column("bandwidth", "B/s", &RooflineRow::bandwidth, "bytes in a second");
  };
};

}  // namespace crosscheck
