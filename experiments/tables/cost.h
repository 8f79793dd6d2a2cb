#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

struct SizeCostRow {
  TABLE("size-cost");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(long, side, "side", "1", "particles along a side of the cloth");
  COLUMN(long, particles, "particles", "1", "particles");
  COLUMN(long, springs, "springs", "1", "springs");
  COLUMN(double, step, "step", "s", "time step");
  COLUMN(long, steps_timed, "steps timed", "1", "steps of each run that was timed");
  COLUMN(double, evaluations_per_step, "evaluations per step", "1", "force evaluations in a step");
  COLUMN(double, cpu, "cpu per step", "s", "median CPU time of a step");
  COLUMN(double, cpu_low, "cpu low", "s", "lower end of its 90 % interval");
  COLUMN(double, cpu_high, "cpu high", "s", "upper end of its 90 % interval");
  COLUMN(double, cpu_per_particle, "cpu per step and particle", "s", "CPU time of a step over the number of particles");
  COLUMN(long, repetitions, "repetitions", "1", "runs that were timed");
  COLUMN(double, noise, "noise", "1", "relative difference of two measurements of the same run");
  COLUMN(std::string, build, "build", "1", "build that the timed code comes from");
};

struct PhaseCostRow {
  TABLE("phases-cost");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(long, side, "side", "1", "particles along a side of the cloth");
  COLUMN(std::string, phase, "phase", "1", "phase of the step");
  COLUMN(double, cpu, "cpu per step", "s", "median CPU time of the phase in a step");
  COLUMN(double, cpu_low, "cpu low", "s", "lower end of its 90 % interval");
  COLUMN(double, cpu_high, "cpu high", "s", "upper end of its 90 % interval");
  COLUMN(double, share, "share", "1", "fraction of the whole step");
  COLUMN(std::string, how, "how", "1", "method of measurement");
};

struct RooflineRow {
  TABLE("roofline-cost");
  COLUMN(std::string, what, "what", "1", "loop that was timed");
  COLUMN(double, work, "work", "flop", "floating-point operations of one run");
  COLUMN(double, bytes, "bytes", "B", "bytes that one run moves, counted from the source code");
  COLUMN(OptionalNumber, intensity, "intensity", "flop/B", "operations over bytes");
  COLUMN(double, cpu, "cpu", "s", "median CPU time of one run");
  COLUMN(double, cpu_low, "cpu low", "s", "lower end of its 90 % interval");
  COLUMN(double, cpu_high, "cpu high", "s", "upper end of its 90 % interval");
  COLUMN(double, rate, "rate", "flop/s", "operations per second");
  COLUMN(OptionalNumber, bandwidth, "bandwidth", "B/s", "bytes per second");
};

}  // namespace crosscheck
