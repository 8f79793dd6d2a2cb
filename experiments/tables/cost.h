// The tables of experiment `cost`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// CPU time of a step against the size of a cloth.
struct SizeCostRow {
  TABLE("size-cost");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(long, side, "side", "1", "particles along a side of the cloth");
  COLUMN(long, particles, "particles", "1", "particles");
  COLUMN(long, springs, "springs", "1", "springs");
  COLUMN(double, step, "step", "s", "time step");
  COLUMN(long, steps_timed, "steps timed", "1", "steps of each run that was timed");
  COLUMN(double, evaluations_per_step, "evaluations per step", "1", "force evaluations in a step");
  COLUMN(double, cpu, "cpu per step", "s", "CPU time of a step, median");
  COLUMN(double, cpu_low, "cpu low", "s", "lower end of its 90 % interval");
  COLUMN(double, cpu_high, "cpu high", "s", "upper end of its 90 % interval");
  COLUMN(double, cpu_per_particle, "cpu per step and particle", "s", "CPU time of a step over the particles");
  COLUMN(long, repetitions, "repetitions", "1", "runs that were timed");
  COLUMN(double, noise, "noise", "1", "relative difference of two measurements of the same");
  COLUMN(std::string, build, "build", "1", "who compiled the code that was timed");
};

/// CPU time of the phases of a step.
struct PhaseCostRow {
  TABLE("phases-cost");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(long, side, "side", "1", "particles along a side of the cloth");
  COLUMN(std::string, phase, "phase", "1", "part of the step");
  COLUMN(double, cpu, "cpu per step", "s", "CPU time in a step, median");
  COLUMN(double, cpu_low, "cpu low", "s", "lower end of its interval");
  COLUMN(double, cpu_high, "cpu high", "s", "upper end of its interval");
  COLUMN(double, share, "share", "1", "of the whole step");
  COLUMN(std::string, how, "how", "1", "how it was measured");
};

/// The machine's peaks and the spring kernel beside them.
struct RooflineRow {
  TABLE("roofline-cost");
  COLUMN(std::string, what, "what", "1", "loop that was timed");
  COLUMN(double, work, "work", "flop", "floating-point operations of one run");
  COLUMN(double, bytes, "bytes", "B", "bytes that one run moves, as the source asks for them");
  COLUMN(OptionalNumber, intensity, "intensity", "flop/B", "operations over bytes");
  COLUMN(double, cpu, "cpu", "s", "CPU time of one run, median");
  COLUMN(double, cpu_low, "cpu low", "s", "lower end of its 90 % interval");
  COLUMN(double, cpu_high, "cpu high", "s", "upper end of its 90 % interval");
  COLUMN(double, rate, "rate", "flop/s", "operations in a second");
  COLUMN(OptionalNumber, bandwidth, "bandwidth", "B/s", "bytes in a second");
};

}  // namespace crosscheck
