// The subcommands.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crosscheck {

// validate: what scenes are, without running them.

/// Checks every scene and prints what it is: particles, springs by family, pins, the fastest vibration, the critical
/// time step of each explicit rule, what its default run will take. Faults are told one line each on standard error; 2
/// where there was one, 0 otherwise.
int validate_command(const std::vector<std::string>& scenes, bool json);

// The subcommands. Each returns the exit status: 0 done, 1 the answer is no; bad input throws InputError (exit 2).

struct BenchSuite;
class OutputFolder;

int doctor_command();

int list_command(const std::string& what, bool json);

/// Becomes the grader, found beside this program, with these arguments; where a page of one submission is asked for,
/// starts it, and sets the student's steppers beside other engines in a report next to the page. Throws
/// std::runtime_error where the grader is not built.
int grader_command(const std::vector<std::string>& words);

struct RunOptions {
  std::string scene, method;
  double step = 0, tolerance = 0, duration = 0;  // 0: the scene's own
  std::filesystem::path out = "out/run";
  std::string command_line;
};
int run_command(const RunOptions& options);

struct CompareOptions {
  std::string scene, methods;
  double step = 0;
  std::filesystem::path trajectory;  // may be empty
  std::filesystem::path out = "out/compare";
  std::string command_line;
};
int compare_command(const CompareOptions& options);

struct EngineOptions {
  std::string what;
  std::filesystem::path prefix, program;
};
int engine_command(const EngineOptions& options);

struct ExperimentOptions {
  std::vector<std::string> names;  // of experiments, then of scenes
  std::string methods;
  bool full = false, resume = false;
  std::string shard;  // I/N, or empty: all
  int jobs = 0;       // processes at a time; 0: one per core
  std::filesystem::path out = "out/experiment";
  std::string command_line;
};
int experiment_command(const ExperimentOptions& options);

struct MergeOptions {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path out;
};
int merge_command(const MergeOptions& options);

struct ReportOptions {
  std::vector<std::string> scenes;
  std::string methods;
  bool full = false;
  std::vector<std::string> experiments = {};  // whose chapters there are; empty: all
  std::filesystem::path against = {};         // an earlier report, or empty
  std::filesystem::path out = "out/report";
  std::string command_line;
};
int report_command(const ReportOptions& options);
/// The same into a folder that is held already, whatever the options say.
int report_command(const ReportOptions& options, OutputFolder& folder);

struct FiguresOptions {
  std::vector<std::string> names;   // of experiments; empty: all
  std::vector<std::string> scenes;  // empty: those that stand for the others
  std::string set = "paper", width;
  bool full = false;
  std::filesystem::path out = "out/figures";
  std::string command_line;
};
int figures_command(const FiguresOptions& options);

/// Whether all findings of a report follow from its data.
int verify_command(const std::filesystem::path& folder);

struct AdviseOptions {
  std::string scene, methods;
  double tolerance = 0;  // m; 0: only parameters are fitted
  std::filesystem::path out = "out/advise";
  std::string command_line;
};
int advise_command(const AdviseOptions& options);

struct RegressOptions {
  std::string filter, methods, against, reason;
  std::filesystem::path baselines;  // empty: the shipped ones
  bool full = false, bless = false, bisect = false, prove = false, prove_builds = false;
  std::vector<std::string> scenes;       // names or files; empty: all shipped ones
  int figures = 6;                       // of so many failed questions
  std::string mutant;                    // with `prove`, one of the wrong changes; empty: all
  std::string build;                     // with `prove_builds`, one of the builds; empty: all
  bool no_speed = false, speed = false;  // speed is measured too, when bisecting only where it is asked for
  bool prove_speed = false;
  int repetitions = 200;  // of `prove_speed`
  std::filesystem::path out = "out/regress";
  std::string command_line;
};
/// 0 all the same; 1 something moved; with `bisect` 125 where nothing can be said.
int regress_command(const RegressOptions& options);
/// Runs the mutants against the baselines and says which were caught. 1 where one escaped, where a cause was named
/// wrongly, or where mysim as it is was caught.
int prove_command(const RegressOptions& options);
/// Measures the speeds of this program beside its own, again and again. 1 where any of them raised an alarm.
int prove_speed_command(const RegressOptions& options);
/// Builds Crosscheck in other ways and runs each against the baselines: none of them has anything to say. 1 where one
/// has, or could not be built; InputError where there is no such build.
int prove_builds_command(const RegressOptions& options);

struct BenchOptions {
  bool full = false;
  std::filesystem::path out = "out/bench";
  std::string command_line;
};
int bench_command(const BenchOptions& options);
/// The same with a plan of one's own, in place of the short or the long one.
int bench_command(const BenchOptions& options, const BenchSuite& plan);

struct RenderOptions {
  std::string scene, methods, mode = "shaded", size = "1280x720";
  std::string quality;  // empty: still, of clips fast
  double at = -1;       // s; negative: the end
  std::filesystem::path file;
};
int render_command(const RenderOptions& options);

}  // namespace crosscheck
