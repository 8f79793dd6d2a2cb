// regress --prove, --prove-builds, --prove-speed: tests of regress on mutants, on other builds, and against itself.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <thread>

#include "experiments/regress/cases.h"
#include "experiments/regress/mutations.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/installation.h"
#include "mysim/base/json.h"
#include "mysim/base/output_folder.h"
#include "mysim/base/process.h"
#include "mysim/base/text.h"
#include "report/base/provenance.h"
#include "report/commands/regress.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

/// A build of Crosscheck that differs in rounding alone: every case must pass.
struct BuildVariant {
  std::string name;
  std::string compiler, package;  // Debian's package; both empty: the program as it is, in another environment
  std::string type, flags;        // as CMake has them
  std::string environment;        // NAME=value, or empty
  std::string filter = {};        // cases that it runs by default; empty: all
  bool fused = false;             // needs a processor with AVX2 and fused multiply-adds
  bool compiled() const { return !compiler.empty(); }
};

/// The C library as it is from 2.33 on, with variants of sin, exp and pow that can be chosen from outside.
bool library_obeys() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
  return true;
#else
  return false;
#endif
}

bool fused_here() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

const std::vector<BuildVariant>& builds() {
  // without optimisation everything takes up to 350 times as long: all scenes would be an hour
  constexpr auto small = "!(cloth*|flag*|jelly*)";
  static const std::vector<BuildVariant> table = {
      {"gcc-O3", "g++", "g++", "Release", "-O3 -DNDEBUG", ""},
      {"gcc-O2", "g++", "g++", "Release", "-O2 -DNDEBUG", ""},
      {"gcc-assert", "g++", "g++", "Debug", "-O2", ""},
      {"gcc-debug", "g++", "g++", "Debug", "-g", "", small},
      {"clang-O3", "clang++", "clang", "Release", "-O3 -DNDEBUG", ""},
      {"clang-O2", "clang++", "clang", "Release", "-O2 -DNDEBUG", ""},
      {"clang-debug", "clang++", "clang", "Debug", "-g", "", small},
      // Eigen's products and sums in fours, fused: written so in its source, whatever -ffp-contract says
      {"gcc-O3-avx2", "g++", "g++", "Release", "-O3 -DNDEBUG -march=x86-64-v3", "", "", true},
      // this program with the C library's other variants of sin, exp and pow, which round twice where these fuse
      {"no-fma", "", "", "", "", "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F", "", true},
  };
  return table;
}

/// "clang++ (package clang)"; empty where nothing is missing.
std::string missing_for(const BuildVariant& build) {
  if (build.compiled() && !on_path(build.compiler))
    return fmt::format("{} (package {})", build.compiler, build.package);
  if (build.fused && !fused_here()) return "a processor with AVX2 and fused multiply-adds";
  if (!build.compiled() && !library_obeys()) return "the GNU C library from 2.33 on";
  return "";
}

struct Built {
  std::filesystem::path program;
  std::string said;  // the last lines of a build that failed; empty where it went well
};

/// Throws InputError where there is none: what is installed cannot be built with other sources.
fs::path source_tree() {
  if (!fs::exists(data_folder() / "CMakeLists.txt"))
    throw InputError(
        "regress --prove and --prove-builds build mysim anew; expected a source tree, not an installation");
  return data_folder();
}

/// Configures and builds the program, and the engine that it starts, in build/builds/NAME of the source tree.
Built built(const BuildVariant& build) {
  const fs::path source = source_tree(), folder = source / "build/builds" / build.name;
  std::string type = build.type;
  std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return std::toupper(c); });
  const auto jobs = std::to_string(std::max(1u, std::thread::hardware_concurrency()));
  const std::vector<std::vector<std::string>> commands = {
      {"cmake", "-S", source.string(), "-B", folder.string(), "-G", "Ninja", "-DCMAKE_CXX_COMPILER=" + build.compiler,
       "-DCMAKE_BUILD_TYPE=" + build.type, fmt::format("-DCMAKE_CXX_FLAGS_{}={}", type, build.flags)},
      {"cmake", "--build", folder.string(), "--parallel", jobs, "--target", "crosscheck", "bullet32_engine"}};
  for (const auto& command : commands) {
    const ProgramResult result = run_program(command, source);
    if (result.status != 0) return {folder / "crosscheck", last_lines(result.out + result.err, 30)};
  }
  return {folder / "crosscheck", ""};
}

struct Proof {
  bool caught = false, wrongly_named = false;
  size_t failures = 0;
  std::string cause;
};

/// "drag under the rule mysim/xpbd" names drag.
bool may_be_named(const std::string& cause, const Mutation& mutation) {
  if (cause == "not attributed") return true;
  for (const std::string& right : mutation.causes)
    if (cause == right || cause.starts_with(right + " under ")) return true;
  return false;
}

Proof proof_of(const Mutation& mutation, const std::filesystem::path& program, const RegressOptions& options) {
  const std::filesystem::path out = options.out / mutation.name;
  std::vector<std::string> words{program.string(), "regress",     "--no-speed",
                                 "--figures",      "0",           "--out",
                                 out.string(),     "--baselines", options.baselines.string()};
  if (!options.filter.empty()) words.insert(words.end(), {"--filter", options.filter});
  std::filesystem::remove(out / "regress.json");
  const auto ended = run_program(words, std::filesystem::current_path(), {"CROSSCHECK_MUTANT=" + mutation.name});
  if (!std::filesystem::exists(out / "regress.json"))
    throw std::runtime_error(fmt::format("{}: {}: no verdict: {}", program.string(), mutation.name, ended.err));
  const JsonField verdict = JsonField::parse_file((out / "regress.json").string());
  Proof proof;
  proof.caught = !verdict["passed"].boolean();
  proof.failures = verdict["failures"].size() + verdict["without_answer"].size();
  proof.cause = verdict["cause"].text();
  proof.wrongly_named = proof.caught && !may_be_named(proof.cause, mutation);
  return proof;
}

}  // namespace

int prove_command(const RegressOptions& given) {
  RegressOptions options = given;
  const fs::path mutations = source_tree() / "tests/mutants/mutations.txt";
  const fs::path program = programs_folder() / "crosscheck-mutants";
  if (!std::filesystem::exists(program))
    throw InputError(
        fmt::format("{}: expected the program of mutants; build the target crosscheck_mutants", program.string()));
  if (options.baselines.empty()) options.baselines = shipped_baselines();
  OutputFolder folder(options.out, "regress");
  options.out = folder.path();
  int escaped = 0, wrongly_named = 0, named = 0, count = 0;
  for (const Mutation& mutation : read_mutations(mutations)) {
    if (!options.mutant.empty() && options.mutant != mutation.name) continue;
    const Proof proof = proof_of(mutation, program, options);
    ++count;
    escaped += !proof.caught;
    wrongly_named += proof.wrongly_named;
    named += proof.caught && proof.cause != "not attributed" && !proof.wrongly_named;
    fmt::print("{:<8} {:<32} {:>6} failures  {}{}\n", proof.caught ? "caught" : "ESCAPED", mutation.name,
               proof.failures, proof.caught ? proof.cause : "", proof.wrongly_named ? "  WRONGLY NAMED" : "");
    std::fflush(stdout);
  }
  if (count == 0) {
    std::vector<std::string> names;
    for (const Mutation& mutation : read_mutations(mutations)) names.push_back(mutation.name);
    throw InputError(fmt::format("--mutant {}: no such mutation; expected one of those in {}{}", options.mutant,
                                 mutations.string(), did_you_mean(options.mutant, names)));
  }
  // the unchanged program must pass
  const Proof unchanged = proof_of({"none", "", {}, "", ""}, program, options);
  fmt::print("{:<8} {:<32} {:>6} failures\n", unchanged.caught ? "CAUGHT" : "passed", "(mysim as it is)",
             unchanged.failures);
  folder.finish();
  fmt::print("\n{} of {} wrong changes caught; the cause named for {}, wrongly for {}\n", count - escaped, count, named,
             wrongly_named);
  return escaped == 0 && wrongly_named == 0 && !unchanged.caught ? 0 : 1;
}

namespace {

struct BuildFinding {
  std::string state;  // as printed
  long quantities = 0, identical = 0, differing = 0, failures = 0;
  std::optional<double> off;  // largest deviation, in tolerances
  std::string furthest;       // the quantity with that deviation
  std::string note;           // why there is no verdict
};

constexpr auto passed = "passed", alarm = "FALSE ALARM", not_here = "not here", not_built = "NOT BUILT",
               no_verdict = "NO VERDICT";

std::string in_words(const JsonField& row) {
  const auto text = [&](const char* key) { return row[key].text(); };
  const std::string without = text("without");
  return fmt::format("{}, {}{}: {}", text("scene"), text("method"), without.empty() ? "" : " without " + without,
                     text("quantity"));
}

BuildFinding finding_of(const JsonField& verdict) {
  BuildFinding finding{verdict["passed"].boolean() ? passed : alarm};
  finding.quantities = verdict["quantities"].whole();
  finding.identical = verdict["identical"].whole();
  finding.differing = verdict["differing"].whole();
  finding.failures = static_cast<long>(verdict["failures"].size() + verdict["without_answer"].size());
  if (const auto row = verdict.find("furthest")) {
    const auto off = row->find("tolerances_off");
    finding.off = off && off->is_number() ? off->number() : INFINITY;  // of a word or a count
    finding.furthest = in_words(*row);
  }
  return finding;
}

const std::string& filter_of(const BuildVariant& build, const RegressOptions& options) {
  return options.filter.empty() ? build.filter : options.filter;
}

/// Runs the build's program over the baselines.
BuildFinding regressed(const fs::path& program, const BuildVariant& build, const RegressOptions& options) {
  const fs::path out = options.out / build.name;
  std::vector<std::string> words{program.string(), "regress",     "--no-speed",
                                 "--figures",      "0",           "--out",
                                 out.string(),     "--baselines", options.baselines.string()};
  if (const std::string& filter = filter_of(build, options); !filter.empty())
    words.insert(words.end(), {"--filter", filter});
  if (!options.methods.empty()) words.insert(words.end(), {"--method", options.methods});
  if (options.full) words.push_back("--full");
  std::vector<std::string> environment;
  if (!build.environment.empty()) environment.push_back(build.environment);
  fs::remove(out / "regress.json");
  const ProgramResult ended = run_program(words, fs::current_path(), environment);
  const fs::path verdict = out / "regress.json";
  if (!fs::exists(verdict)) return {.state = no_verdict, .note = last_lines(ended.out + ended.err, 5)};
  return finding_of(JsonField::parse_file(verdict.string()));
}

BuildFinding found(const BuildVariant& build, const RegressOptions& options) {
  if (const std::string missing = missing_for(build); !missing.empty()) return {.state = not_here, .note = missing};
  fs::path program = programs_folder() / "crosscheck";
  if (build.compiled()) {
    fmt::print(stderr, "crosscheck: building {}: {} {}\n", build.name, build.compiler, build.flags);
    const Built done = built(build);
    if (!done.said.empty()) return {.state = not_built, .note = done.said};
    program = done.program;
  }
  fmt::print(stderr, "crosscheck: asking {}\n", build.name);
  return regressed(program, build, options);
}

void print_finding(const BuildVariant& build, const RegressOptions& options, const BuildFinding& f) {
  fmt::print("{:<12} {:<12} ", f.state, build.name);
  if (f.state == not_here)
    fmt::print("{}\n", f.note);
  else if (f.state == not_built || f.state == no_verdict)
    fmt::print("\n{}\n", f.note);
  else
    fmt::print("{:>6} quantities{}: {} failed, {} identical, {} differ{}\n", f.quantities,
               options.filter.empty() && !build.filter.empty() ? " of " + build.filter : "", f.failures, f.identical,
               f.differing,
               f.off ? fmt::format(", by {:.2g} tolerances at most ({})", *f.off, f.furthest) : std::string());
  std::fflush(stdout);
}

Table empty_table() {
  return {"builds",
          {{"build", "1"},
           {"compiler", "1"},
           {"type", "1"},
           {"flags", "1"},
           {"environment", "1"},
           {"filter", "1"},
           {"state", "1"},
           {"quantities", "1"},
           {"failures", "1"},
           {"identical", "1"},
           {"differing", "1"},
           {"tolerances off at most", "1"},
           {"furthest", "1"},
           {"note", "1"}},
          {}};
}

void add_row(Table& table, const BuildVariant& build, const RegressOptions& options, const BuildFinding& f) {
  const auto count = [&](long n) { return f.state == passed || f.state == alarm ? Cell(n) : Cell(); };
  table.add({build.name, build.compiler, build.type, build.flags, build.environment, filter_of(build, options), f.state,
             count(f.quantities), count(f.failures), count(f.identical), count(f.differing), cell_of(f.off), f.furthest,
             f.note});
}

void require_known(const std::string& name) {
  std::vector<std::string> names;
  for (const BuildVariant& build : builds()) {
    if (name.empty() || name == build.name) return;
    names.push_back(build.name);
  }
  throw InputError(fmt::format("--build {}: no such build; expected one of: {}{}", name, fmt::join(names, ", "),
                               did_you_mean(name, names)));
}

}  // namespace

int prove_builds_command(const RegressOptions& given) {
  RegressOptions options = given;
  require_known(options.build);
  Selection selection{options.scenes, options.full, options.filter, {}};
  if (!options.methods.empty()) selection.methods = find_methods(options.methods);
  cases(selection);  // throws InputError for a selection that no build could run
  if (options.baselines.empty()) options.baselines = shipped_baselines();
  OutputFolder folder(options.out, "regress");
  options.out = folder.path();
  Table table = empty_table();
  std::map<std::string, int> count;
  for (const BuildVariant& build : builds()) {
    if (!options.build.empty() && options.build != build.name) continue;
    const BuildFinding finding = found(build, options);
    print_finding(build, options, finding);
    add_row(table, build, options, finding);
    ++count[finding.state];
  }
  write_csv(table, provenance(options.command_line), options.out);
  folder.finish();
  const int wrong = count[not_built] + count[no_verdict];
  fmt::print("\n{} builds passed, {} with a false alarm, {} without a verdict, {} not here\n", count[passed],
             count[alarm], wrong, count[not_here]);
  if (count[alarm] > 1 && count[passed] == 0)
    fmt::print("all of them say so: then something did move; `crosscheck regress` says what\n");
  fmt::print("{}\n", (given.out / "builds.csv").string());
  return count[passed] > 0 && count[alarm] == 0 && wrong == 0 ? 0 : 1;
}

namespace {

struct Tally {
  int suspicions = 0, alarms = 0;
  double farthest = 1;  // of the changes seen
  std::string where;
};

void look(const std::vector<SpeedCase>& cases, const SpeedFile& blessed, const Machine& machine,
          const MeasureSpeeds& measure, Tally& tally) {
  int measurements = 0;
  const MeasureSpeeds counted = [&](const std::vector<SpeedCase>& measured, const SpeedOptions& plan) {
    // all that are measured again after the first look are under suspicion
    if (++measurements == 2) tally.suspicions += static_cast<int>(measured.size());
    return measure(measured, plan);
  };
  for (const SpeedComparison& row : compared_speeds(cases, &blessed, machine, counted).rows) {
    const double change = std::max(row.change.median, 1 / row.change.median);
    if (change > tally.farthest) tally.farthest = change, tally.where = row.scene + " under " + row.method;
    if (row.state == SpeedStatus::same) continue;
    ++tally.alarms;
    fmt::print("{:<10} {}, {}: {:.4g} times the plain loop, was {:.4g}; noise {:.0f} %\n", name_of(row.state),
               row.scene, row.method, row.is, row.was.value_or(0), 100 * row.noise);
    std::fflush(stdout);
  }
}

}  // namespace

int prove_speed_command(const RegressOptions& options) {
  OutputFolder folder(options.out, "regress");
  Selection selection;
  selection.filter = options.filter;
  if (!options.methods.empty()) selection.methods = find_methods(options.methods);
  const std::vector<SpeedCase> cases = speed_cases(selection, {});
  if (cases.empty()) throw InputError("--prove-speed: no speed is asked of what the filter leaves");
  Machine machine = machine_of(provenance(options.command_line));
  if (machine.cpu.empty()) machine.cpu = "this one";  // the name is not stored
  Progress progress(0);
  const MeasureSpeeds measure = SpeedMeasurement(folder.path(), LockPatience(), progress);
  SpeedFile blessed;
  merge_into(blessed, speeds_to_bless(cases, machine, measure), {});
  Tally tally;
  for (int i = 0; i < options.repetitions; ++i) look(cases, blessed, machine, measure, tally);
  progress.done();
  folder.finish();
  fmt::print("{} repetitions of {} speeds: {} suspicions, {} alarms; the farthest off was {} by {:.3g}\n",
             options.repetitions, blessed.speeds.size(), tally.suspicions, tally.alarms, tally.where, tally.farthest);
  return tally.alarms == 0 ? 0 : 1;
}

}  // namespace crosscheck
