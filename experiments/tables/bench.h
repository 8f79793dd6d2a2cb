#pragma once

#include "experiments/tables/typed.h"
#include "mysim/simd/instruction_sets.h"

namespace crosscheck {

template <>
inline constexpr std::pair range_of<simd::InstructionSet>{simd::InstructionSet::baseline, simd::InstructionSet::avx512};

struct BenchRow {
  TABLE("bench-cost");
  COLUMN(std::string, work, "work", "1", "kind of work");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, peer, "peer", "1", "loop, method or library that mysim is compared with");
  COLUMN(std::string, variant, "variant", "1", "model, force or rate of this comparison");
  COLUMN(std::string, build, "build", "1", "build that the peer's code comes from");
  COLUMN(OptionalNumber, step, "step", "s", "time step of the peer");
  COLUMN(OptionalNumber, tolerance, "tolerance", "1", "relative tolerance of a peer that controls its error");
  COLUMN(Verdict, verdict, "verdict", "1", "how the peer's run ended");
  COLUMN(OptionalNumber, error, "error", "m", "RMS position error of the peer at the end");
  COLUMN(OptionalNumber, truth_bar, "truth bar", "m", "error bar of the truth");
  COLUMN(OptionalNumber, apart, "farthest particle", "m", "largest distance of a particle between the two solutions");
  COLUMN(std::optional<long>, evaluations, "evaluations", "1",
         "evaluations of the right-hand side by the peer, or its steps");
  COLUMN(std::string, mysim, "mysim", "1", "kernel or method of mysim");
  COLUMN(simd::InstructionSet, instructions, "instructions", "1", "instruction set of mysim");
  COLUMN(OptionalNumber, step_of_mysim, "step of mysim", "s", "time step of mysim");
  COLUMN(OptionalNumber, error_of_mysim, "error of mysim", "m", "RMS position error of mysim at the end");
  COLUMN(std::string, unit, "unit of work", "1", "work that each time refers to");
  COLUMN(OptionalNumber, peer_time, "time of peer", "s", "median CPU time of the peer; wall time for threads");
  COLUMN(OptionalNumber, peer_low, "low of peer", "s", "lower end of its 90 % interval");
  COLUMN(OptionalNumber, peer_high, "high of peer", "s", "upper end of its 90 % interval");
  COLUMN(OptionalNumber, time, "time of mysim", "s", "median CPU time of mysim; wall time for threads");
  COLUMN(OptionalNumber, low, "low of mysim", "s", "lower end of its 90 % interval");
  COLUMN(OptionalNumber, high, "high of mysim", "s", "upper end of its 90 % interval");
  COLUMN(OptionalNumber, ratio, "ratio", "1", "time of the peer over mysim's, median of rounds");
  COLUMN(OptionalNumber, ratio_low, "ratio low", "1", "lower end of the ratio's 90 % interval");
  COLUMN(OptionalNumber, ratio_high, "ratio high", "1", "upper end of the ratio's 90 % interval");
  COLUMN(OptionalNumber, share, "share", "1",
         "share of the peak rate of the instruction set, or of the time of two cores");
  COLUMN(std::string, remark, "remark", "1", "why there is no ratio");
};

}  // namespace crosscheck
