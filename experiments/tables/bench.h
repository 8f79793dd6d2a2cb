// The table of `bench`.
#pragma once

#include "experiments/tables/typed.h"
#include "mysim/simd/instruction_sets.h"

namespace crosscheck {

template <>
struct EnumRange<simd::InstructionSet> {
  static constexpr simd::InstructionSet first = simd::InstructionSet::baseline, last = simd::InstructionSet::avx512;
};

/// One comparison: times of a peer and of mysim for the same work, and their ratio.
struct BenchRow {
  std::string work, scene, peer, variant, build;
  std::optional<double> step, tolerance;
  Verdict verdict = Verdict::ok;
  std::optional<double> error, truth_bar, apart;
  std::optional<long> evaluations;
  std::string mysim;
  simd::InstructionSet instructions = simd::InstructionSet::baseline;
  std::optional<double> step_of_mysim, error_of_mysim;
  std::string unit;
  std::optional<double> peer_time, peer_low, peer_high, time, low, high, ratio, ratio_low, ratio_high, share;
  std::string remark;

  static constexpr std::string_view table = "bench-cost", about = "Times of peers and of mysim for the same work.";
  static constexpr auto columns = [](auto&& column) {
    column("work", "1", &BenchRow::work, "kind of work"), column("scene", "1", &BenchRow::scene, "scene"),
        column("peer", "1", &BenchRow::peer, "loop, method or library that mysim is compared with"),
        column("variant", "1", &BenchRow::variant, "model, force or rate of this comparison"),
        column("build", "1", &BenchRow::build, "who compiled the peer's code"),
        column("step", "s", &BenchRow::step, "time step of the peer"),
        column("tolerance", "1", &BenchRow::tolerance, "relative tolerance of a peer that controls its error"),
        column("verdict", "1", &BenchRow::verdict, "how the peer's run ended"),
        column("error", "m", &BenchRow::error, "RMS position error of the peer at the end"),
        column("truth bar", "m", &BenchRow::truth_bar, "error bar of the truth"),
        column("farthest particle", "m", &BenchRow::apart, "largest distance of a particle between both solutions"),
        column("evaluations", "1", &BenchRow::evaluations, "evaluations of the right-hand side by the peer, or steps"),
        column("mysim", "1", &BenchRow::mysim, "kernel or method of mysim"),
        column("instructions", "1", &BenchRow::instructions, "instruction set of mysim"),
        column("step of mysim", "s", &BenchRow::step_of_mysim, "time step of mysim"),
        column("error of mysim", "m", &BenchRow::error_of_mysim, "RMS position error of mysim at the end"),
        column("unit of work", "1", &BenchRow::unit, "what each time is of"),
        column("time of peer", "s", &BenchRow::peer_time, "CPU time of the peer, median; of threads wall time"),
        column("low of peer", "s", &BenchRow::peer_low, "lower end of its 90 % interval"),
        column("high of peer", "s", &BenchRow::peer_high, "upper end of its 90 % interval"),
        column("time of mysim", "s", &BenchRow::time, "the same of mysim"),
        column("low of mysim", "s", &BenchRow::low, "lower end of its 90 % interval"),
        column("high of mysim", "s", &BenchRow::high, "upper end of its 90 % interval"),
        column("ratio", "1", &BenchRow::ratio, "time of the peer over mysim's, median of rounds"),
        column("ratio low", "1", &BenchRow::ratio_low, "lower end of the ratio's 90 % interval"),
        column("ratio high", "1", &BenchRow::ratio_high, "upper end of the ratio's 90 % interval"),
        column("share", "1", &BenchRow::share, "part of the peak rate of the instructions, or of two cores' time"),
        column("remark", "1", &BenchRow::remark, "why there is no ratio");
  };
};

}  // namespace crosscheck
