// The tables of `bench`.
#pragma once

#include "experiments/tables/speed_accuracy.h"
#include "mysim/simd/instruction_sets.h"

namespace crosscheck {

template <>
struct EnumRange<simd::InstructionSet> {
  static constexpr simd::InstructionSet first = simd::InstructionSet::baseline, last = simd::InstructionSet::avx512;
};

/// Whether a peer converges to the scene's springs or to something else.
enum class PeerModel { same, other };
inline std::string_view name_of(PeerModel model) { return model == PeerModel::same ? "same" : "other model"; }
template <>
struct EnumRange<PeerModel> {
  static constexpr PeerModel first = PeerModel::same, last = PeerModel::other;
};

struct KernelRow {
  long side = 0, springs = 0;
  std::string kernel;
  simd::InstructionSet instructions = simd::InstructionSet::baseline;
  std::string precision;
  double time = 0, low = 0, high = 0, ratio = 0, ratio_low = 0, ratio_high = 0, rate = 0, share_of_peak = 0;

  static constexpr std::string_view table = "bench-kernels-cost", about = "What a spring costs, kernel by kernel.";
  static constexpr auto columns = [](auto&& column) {
    column("particles a side", "1", &KernelRow::side, "particles along a side of the cloth"),
        column("springs", "1", &KernelRow::springs, "springs"),
        column("kernel", "1", &KernelRow::kernel, "loop that was timed"),
        column("instructions", "1", &KernelRow::instructions, "instruction set"),
        column("precision", "1", &KernelRow::precision, "double or single"),
        column("time per spring", "ns", &KernelRow::time, "CPU time per spring and step, median"),
        column("low", "ns", &KernelRow::low, "lower end of its 90 % interval"),
        column("high", "ns", &KernelRow::high, "upper end of its 90 % interval"),
        column("times the naive loop", "1", &KernelRow::ratio, "time of the naive loop over its own, median of rounds"),
        column("ratio low", "1", &KernelRow::ratio_low, "lower end of the ratio's 90 % interval"),
        column("ratio high", "1", &KernelRow::ratio_high, "upper end of the ratio's 90 % interval"),
        column("rate", "GFLOP/s", &KernelRow::rate, "floating-point operations in a second"),
        column("share of peak", "1", &KernelRow::share_of_peak, "rate over the most of the same instructions");
  };
};

struct SceneKernelRow {
  std::string scene;
  long particles = 0, springs = 0;
  std::string kernel;
  simd::InstructionSet instructions = simd::InstructionSet::baseline;
  double time = 0, low = 0, high = 0, naive = 0, ratio = 0, ratio_low = 0, ratio_high = 0;

  static constexpr std::string_view table = "bench-scenes-cost",
                                    about = "What the springs' forces of each shipped scene cost.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &SceneKernelRow::scene, "scene"),
        column("particles", "1", &SceneKernelRow::particles, "particles"),
        column("springs", "1", &SceneKernelRow::springs, "springs"),
        column("kernel", "1", &SceneKernelRow::kernel, "loop that was timed"),
        column("instructions", "1", &SceneKernelRow::instructions, "instruction set"),
        column("time", "ns", &SceneKernelRow::time, "CPU time of an evaluation, median"),
        column("low", "ns", &SceneKernelRow::low, "lower end of its 90 % interval"),
        column("high", "ns", &SceneKernelRow::high, "upper end of its 90 % interval"),
        column("naive loop", "ns", &SceneKernelRow::naive, "the same of the naive loop"),
        column("times the naive loop", "1", &SceneKernelRow::ratio,
               "time of the naive loop over its own, median of rounds"),
        column("ratio low", "1", &SceneKernelRow::ratio_low, "lower end of the ratio's 90 % interval"),
        column("ratio high", "1", &SceneKernelRow::ratio_high, "upper end of the ratio's 90 % interval");
  };
};

/// Each run of a peer twice, once for each path of mysim.
struct EqualErrorRow {
  std::string scene, peer;
  PeerModel model = PeerModel::same;
  SettingKind setting = SettingKind::step;
  double requested = 0;
  Verdict verdict = Verdict::ok;
  std::optional<double> error;
  double truth_bar = 0;
  long evaluations = 0;
  std::optional<double> cpu, cpu_low, cpu_high, part_timed;
  double cpu_of_whole_run = 0;
  std::string build, path;
  simd::InstructionSet instructions = simd::InstructionSet::baseline;
  std::optional<std::string> mysim;
  std::optional<double> mysim_step, mysim_error, mysim_cpu, ratio, ratio_low, ratio_high;
  std::optional<std::string> remark;

  static constexpr std::string_view table = "bench-equal-error-cost",
                                    about = "Runs of peers beside mysim's cheapest run that errs no more.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &EqualErrorRow::scene, "scene"),
        column("peer", "1", &EqualErrorRow::peer, "method of the peer"),
        column("model", "1", &EqualErrorRow::model, "whether the peer converges to the scene's springs"),
        column("setting", "1", &EqualErrorRow::setting, "what was set, and its unit"),
        column("asked", "see setting", &EqualErrorRow::requested, "step or tolerance that was asked for"),
        column("verdict", "1", &EqualErrorRow::verdict, "how the run ended"),
        column("error", "m", &EqualErrorRow::error, "RMS position error at the end"),
        column("truth bar", "m", &EqualErrorRow::truth_bar, "error bar of the truth"),
        column("evaluations", "1", &EqualErrorRow::evaluations, "evaluations of the right-hand side; Bullet's steps"),
        column("cpu", "s", &EqualErrorRow::cpu, "CPU time of the whole run, from the part that was timed in turns"),
        column("cpu low", "s", &EqualErrorRow::cpu_low, "lower end of its 90 % interval"),
        column("cpu high", "s", &EqualErrorRow::cpu_high, "upper end of its 90 % interval"),
        column("part timed", "1", &EqualErrorRow::part_timed, "part of the run that was timed; the rest is scaled"),
        column("cpu of the one whole run", "s", &EqualErrorRow::cpu_of_whole_run,
               "CPU time of the run that its error is of"),
        column("build", "1", &EqualErrorRow::build, "who compiled the peer's code"),
        column("path of mysim", "1", &EqualErrorRow::path,
               "best: the machine's best instructions; baseline: those that every machine has"),
        column("instructions", "1", &EqualErrorRow::instructions, "instruction set of mysim"),
        column("mysim", "1", &EqualErrorRow::mysim, "mysim's method"),
        column("step of mysim", "s", &EqualErrorRow::mysim_step, "time step of mysim"),
        column("error of mysim", "m", &EqualErrorRow::mysim_error, "RMS position error of mysim at the end"),
        column("cpu of mysim", "s", &EqualErrorRow::mysim_cpu, "CPU time of mysim's whole run"),
        column("ratio", "1", &EqualErrorRow::ratio, "CPU time of the peer over mysim's, median of rounds"),
        column("ratio low", "1", &EqualErrorRow::ratio_low, "lower end of the ratio's 90 % interval"),
        column("ratio high", "1", &EqualErrorRow::ratio_high, "upper end of the ratio's 90 % interval"),
        column("remark", "1", &EqualErrorRow::remark, "why there is no ratio");
  };
};

struct OwnRunRow {
  std::string scene, method;
  double step = 0;
  Verdict verdict = Verdict::ok;
  std::optional<double> error;
  double truth_bar = 0;
  long evaluations = 0;
  std::string path;
  simd::InstructionSet instructions = simd::InstructionSet::baseline;
  std::optional<double> cpu, cpu_low, cpu_high;

  static constexpr std::string_view table = "bench-own-runs-cost", about = "Runs of mysim that peers stand beside.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &OwnRunRow::scene, "scene"), column("method", "1", &OwnRunRow::method, "method"),
        column("step", "s", &OwnRunRow::step, "time step"),
        column("verdict", "1", &OwnRunRow::verdict, "how the run ended"),
        column("error", "m", &OwnRunRow::error, "RMS position error at the end"),
        column("truth bar", "m", &OwnRunRow::truth_bar, "error bar of the truth"),
        column("evaluations", "1", &OwnRunRow::evaluations, "force evaluations"),
        column("path of mysim", "1", &OwnRunRow::path,
               "best: the machine's best instructions; baseline: those that every machine has"),
        column("instructions", "1", &OwnRunRow::instructions, "instruction set"),
        column("cpu", "s", &OwnRunRow::cpu, "CPU time of the whole run, median"),
        column("cpu low", "s", &OwnRunRow::cpu_low, "lower end of its 90 % interval"),
        column("cpu high", "s", &OwnRunRow::cpu_high, "upper end of its 90 % interval");
  };
};

struct SameStepRow {
  std::string scene, force;
  double step = 0;
  long steps = 0;
  double apart = 0, bullet_cpu = 0, bullet_low = 0, bullet_high = 0;
  std::string build, path;
  simd::InstructionSet instructions = simd::InstructionSet::baseline;
  std::string mysim;
  double cpu = 0, low = 0, high = 0, ratio = 0, ratio_low = 0, ratio_high = 0;

  static constexpr std::string_view table = "bench-same-step-cost",
                                    about = "A step of Bullet's explicit world beside the same step of mysim.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &SameStepRow::scene, "scene"),
        column("force of Bullet", "1", &SameStepRow::force, "who computes the springs' forces in Bullet"),
        column("step", "s", &SameStepRow::step, "time step"),
        column("steps", "1", &SameStepRow::steps, "time steps taken"),
        column("farthest particle", "m", &SameStepRow::apart, "largest distance of a particle between both engines"),
        column("cpu per step of Bullet", "s", &SameStepRow::bullet_cpu, "CPU time of a step of Bullet, median"),
        column("low of Bullet", "s", &SameStepRow::bullet_low, "lower end of its 90 % interval"),
        column("high of Bullet", "s", &SameStepRow::bullet_high, "upper end of its 90 % interval"),
        column("build", "1", &SameStepRow::build, "who compiled Bullet's code"),
        column("path of mysim", "1", &SameStepRow::path,
               "best: the machine's best instructions; baseline: those that every machine has"),
        column("instructions", "1", &SameStepRow::instructions, "instruction set of mysim"),
        column("mysim", "1", &SameStepRow::mysim, "mysim's method"),
        column("cpu per step of mysim", "s", &SameStepRow::cpu, "CPU time of a step of mysim, median"),
        column("low of mysim", "s", &SameStepRow::low, "lower end of its 90 % interval"),
        column("high of mysim", "s", &SameStepRow::high, "upper end of its 90 % interval"),
        column("ratio", "1", &SameStepRow::ratio, "CPU time of Bullet over mysim's, median of rounds"),
        column("ratio low", "1", &SameStepRow::ratio_low, "lower end of the ratio's 90 % interval"),
        column("ratio high", "1", &SameStepRow::ratio_high, "upper end of the ratio's 90 % interval");
  };
};

struct ImplicitStepRow {
  std::string scene;
  long particles = 0;
  double rate = 0, apart = 0, largest_move = 0, eigen_cpu = 0, eigen_low = 0, eigen_high = 0;
  std::string path;
  simd::InstructionSet instructions = simd::InstructionSet::baseline;
  long iterations = 0;
  double cpu = 0, low = 0, high = 0, ratio = 0, ratio_low = 0, ratio_high = 0;

  static constexpr std::string_view table = "bench-implicit-step-cost",
                                    about = "A linear implicit Euler step of mysim beside a factorisation by Eigen.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &ImplicitStepRow::scene, "scene"),
        column("particles", "1", &ImplicitStepRow::particles, "particles"),
        column("rate", "1/s", &ImplicitStepRow::rate, "steps in a second of simulated time"),
        column("farthest particle", "m", &ImplicitStepRow::apart,
               "largest distance of a particle between both solutions"),
        column("largest move", "m", &ImplicitStepRow::largest_move, "largest move of a particle in the step"),
        column("cpu per step of Eigen", "s", &ImplicitStepRow::eigen_cpu, "CPU time of a step by Eigen, median"),
        column("low of Eigen", "s", &ImplicitStepRow::eigen_low, "lower end of its 90 % interval"),
        column("high of Eigen", "s", &ImplicitStepRow::eigen_high, "upper end of its 90 % interval"),
        column("path of mysim", "1", &ImplicitStepRow::path,
               "best: the machine's best instructions; baseline: those that every machine has"),
        column("instructions", "1", &ImplicitStepRow::instructions, "instruction set of mysim"),
        column("iterations", "1", &ImplicitStepRow::iterations, "iterations of conjugate gradients"),
        column("cpu per step of mysim", "s", &ImplicitStepRow::cpu, "CPU time of a step of mysim, median"),
        column("low of mysim", "s", &ImplicitStepRow::low, "lower end of its 90 % interval"),
        column("high of mysim", "s", &ImplicitStepRow::high, "upper end of its 90 % interval"),
        column("ratio", "1", &ImplicitStepRow::ratio, "CPU time of Eigen over mysim's, median of rounds"),
        column("ratio low", "1", &ImplicitStepRow::ratio_low, "lower end of the ratio's 90 % interval"),
        column("ratio high", "1", &ImplicitStepRow::ratio_high, "upper end of the ratio's 90 % interval");
  };
};

struct ThreadsRow {
  std::string scene, method;
  simd::InstructionSet instructions = simd::InstructionSet::baseline;
  long threads = 0, steps = 0;
  double one = 0, one_low = 0, one_high = 0, two = 0, two_low = 0, two_high = 0, share = 0, ratio = 0, ratio_low = 0,
         ratio_high = 0;

  static constexpr std::string_view table = "bench-threads-cost", about = "A step with two threads beside one.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &ThreadsRow::scene, "scene"), column("method", "1", &ThreadsRow::method, "method"),
        column("instructions", "1", &ThreadsRow::instructions, "instruction set"),
        column("threads at work", "1", &ThreadsRow::threads, "threads that the method used of two"),
        column("steps timed", "1", &ThreadsRow::steps, "steps of each run that was timed"),
        column("wall per step of one", "s", &ThreadsRow::one, "wall time of a step with one thread, median"),
        column("low of one", "s", &ThreadsRow::one_low, "lower end of its 90 % interval"),
        column("high of one", "s", &ThreadsRow::one_high, "upper end of its 90 % interval"),
        column("wall per step of two", "s", &ThreadsRow::two, "wall time of a step with two threads, median"),
        column("low of two", "s", &ThreadsRow::two_low, "lower end of its 90 % interval"),
        column("high of two", "s", &ThreadsRow::two_high, "upper end of its 90 % interval"),
        column("share of the cores", "1", &ThreadsRow::share,
               "CPU time of the threads over the wall time of as many cores"),
        column("ratio", "1", &ThreadsRow::ratio, "wall time of one over that of two, median of rounds"),
        column("ratio low", "1", &ThreadsRow::ratio_low, "lower end of the ratio's 90 % interval"),
        column("ratio high", "1", &ThreadsRow::ratio_high, "upper end of the ratio's 90 % interval");
  };
};

}  // namespace crosscheck
