// regress --prove-builds: the same baselines in every build of the table in builds.cpp; nothing may have moved there.
#include <fmt/ranges.h>

#include <cmath>
#include <map>

#include "experiments/regress/questions.h"
#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/json.h"
#include "mysim/nearest.h"
#include "mysim/output_folder.h"
#include "report/commands/commands.h"
#include "report/provenance.h"
#include "report/regress/builds.h"
#include "report/run_program.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

struct BuildFinding {
  std::string state;  // as printed
  long quantities = 0, identical = 0, differing = 0, failures = 0;
  std::optional<double> off;  // tolerances, of what differs most
  std::string furthest;       // what that is
  std::string note;           // why there is nothing to be said
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
  BuildFinding finding{verdict["passed"].truth() ? passed : alarm};
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

const std::string& filter_of(const Build& build, const RegressOptions& options) {
  return options.filter.empty() ? build.filter : options.filter;
}

/// Runs the build's program over the baselines.
BuildFinding asked(const fs::path& program, const Build& build, const RegressOptions& options) {
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

BuildFinding found(const Build& build, const RegressOptions& options) {
  if (const std::string missing = missing_for(build); !missing.empty()) return {.state = not_here, .note = missing};
  fs::path program = fs::path(CROSSCHECK_BINARY_DIR) / "crosscheck";
  if (build.compiled()) {
    fmt::print(stderr, "crosscheck: building {}: {} {}\n", build.name, build.compiler, build.flags);
    const Built done = built(build);
    if (!done.said.empty()) return {.state = not_built, .note = done.said};
    program = done.program;
  }
  fmt::print(stderr, "crosscheck: asking {}\n", build.name);
  return asked(program, build, options);
}

void print_finding(const Build& build, const RegressOptions& options, const BuildFinding& f) {
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

void add_row(Table& table, const Build& build, const RegressOptions& options, const BuildFinding& f) {
  const auto count = [&](long n) { return f.state == passed || f.state == alarm ? Cell(n) : Cell(); };
  table.add({build.name, build.compiler, build.type, build.flags, build.environment, filter_of(build, options), f.state,
             count(f.quantities), count(f.failures), count(f.identical), count(f.differing), cell_of(f.off), f.furthest,
             f.note});
}

void require_known(const std::string& name) {
  std::vector<std::string> names;
  for (const Build& build : builds()) {
    if (name.empty() || name == build.name) return;
    names.push_back(build.name);
  }
  throw InputError(fmt::format("--build {}: no such build; expected one of: {}{}", name, fmt::join(names, ", "),
                               did_you_mean(name, names)));
}

}  // namespace

int prove_builds_command(const RegressOptions& asked_for) {
  RegressOptions options = asked_for;
  require_known(options.build);
  Asked asked{options.scenes, options.full, options.filter, {}};
  if (!options.methods.empty()) asked.methods = find_methods(options.methods);
  questions(asked);  // refuses what no build could answer
  if (options.baselines.empty()) options.baselines = CROSSCHECK_BASELINES;
  OutputFolder folder(options.out, "regress");
  options.out = folder.path();
  Table table = empty_table();
  std::map<std::string, int> count;
  for (const Build& build : builds()) {
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
  fmt::print("{}\n", (asked_for.out / "builds.csv").string());
  return count[passed] > 0 && count[alarm] == 0 && wrong == 0 ? 0 : 1;
}

}  // namespace crosscheck
