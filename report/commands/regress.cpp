// Compares results with baselines or with another method; --bless writes baselines.

#include <cstdlib>
#include <set>

#include "experiments/regress/regress.h"
#include "mysim/base/installation.h"
#include "report/commands/command_line.h"
#include "report/commands/regress_verdict.h"

namespace crosscheck {
namespace {

struct RegressOptions {
  std::string filter, methods, against, reason;
  std::filesystem::path baselines;  // empty: the shipped ones
  bool full = false, bless = false, bisect = false;
  std::vector<std::string> scenes;  // names or files; empty: all shipped scenes
  int figures = 6;
  std::filesystem::path out = "out/regress";
  std::string command_line;
};

constexpr auto nothing_measured =
    "nothing was measured: each case is unsupported or too slow (--full selects slower ones)";

void print_row(const Comparison& row) {
  fmt::print("{:<10} {}: {}: {}\n", name_of(row.state), case_of(row), row.quantity, describe_change(row));
}

int print_result(const RegressionResult& result, const std::filesystem::path& out) {
  for (const Comparison& row : worst_comparisons(result.rows)) print_row(row);
  for (const FailedPoint& f : result.failures) fmt::print("no answer  {}: {}\n", f.name, f.why);
  for (const NewMethod& m : new_methods(result.rows)) fmt::print("{:<10} {}\n", name_of(Status::added), describe(m));
  const auto added = std::ranges::count(result.rows, Status::added, &Comparison::state);
  const auto same = std::ranges::count(result.rows, Status::same, &Comparison::state);
  const auto wrong = std::ranges::count_if(result.rows, [](const auto& row) { return failed(row.state); });
  fmt::print("\n{} quantities: {} the same, {} failed{}{}\n", result.rows.size(), same, wrong,
             added > 0 ? fmt::format(", {} new (not blessed yet)", added) : "",
             result.failures.empty() ? "" : fmt::format("; {} runs without a result", result.failures.size()));
  if (!result.measured() && wrong == 0) fmt::print("{}\n", nothing_measured);
  for (const char* name : {"index.html", "regress.csv"})
    if (std::filesystem::exists(out / name)) fmt::print("{}\n", (out / name).string());
  return result.passed() ? 0 : 1;
}

using Figures = std::vector<std::pair<std::filesystem::path, std::filesystem::path>>;  // (drawing, file to keep)

/// Returns, for each changed scene, the figure to store next to its baseline.
Figures before_and_after(const Regression& regression, const RegressOptions& options, const BlessResult& result,
                         const Provenance& lines) {
  RegressionResult changes;
  std::copy_if(result.changed.begin(), result.changed.end(), std::back_inserter(changes.rows),
               [](const Comparison& row) { return row.state == Status::moved; });
  if (changes.rows.empty()) return {};  // new quantities have no earlier curve
  Figures figures;
  std::set<std::string> scenes;
  for (const FailurePart& part :
       write_verdict_page({changes, "the previous baselines", options.reason, lines}, regression,
                          std::max(options.figures, static_cast<int>(result.numbers.size()))))
    if (!part.images.empty() && scenes.insert(part.scene).second)
      figures.emplace_back(part.images[0].file,
                           regression.baselines / fmt::format("{}-blessing-{}.svg", file_name_of(part.scene),
                                                              result.numbers.at(part.scene)));
  return figures;
}

int blessed(const Regression& regression, const RegressOptions& options, const Provenance& lines) {
  if (options.reason.find_first_not_of(" \n\t") == std::string::npos)
    throw InputError("--bless: expected --reason TEXT: why the new values are right");
  if (options.reason.find('|') != std::string::npos) throw InputError("--reason: expected a text without '|'");
  if (const char* ci = std::getenv("CI"); ci && *ci) throw InputError("--bless: CI never blesses (CI is set)");
  if (regression.against) throw InputError("--bless: expected no --against: only baselines can be blessed");
  Progress progress(0);
  const Blessing blessing{value_of(lines, "date").substr(0, 10), value_of(lines, "commit"), value_of(lines, "compiler"),
                          options.reason};
  const BlessResult result = bless(regression, blessing, progress);
  progress.done();
  if (!result.measured) {
    fmt::print("{}\n", nothing_measured);
    return 1;
  }
  for (const Comparison& row : result.changed) print_row(row);
  // draw before the files are written, because the figures need the old shapes
  const auto drawn = options.figures > 0 ? before_and_after(regression, options, result, lines) : Figures{};
  for (const auto& [file, text] : result.files) write_file(file, text);
  for (const auto& [from, to] : drawn)
    std::filesystem::copy_file(from, to, std::filesystem::copy_options::overwrite_existing);
  fmt::print("\n{} quantities blessed: {}\n", result.changed.size(), options.reason);
  for (const auto& file : result.files) fmt::print("{}\n", file.first.string());
  for (const auto& figure : drawn) fmt::print("{}\n", figure.second.string());
  return 0;
}

int regressed(const RegressOptions& options) {
  Regression regression;
  regression.selection.full = options.full;
  regression.selection.filter = options.filter;
  regression.selection.scenes = options.scenes;
  if (!options.methods.empty()) regression.selection.methods = find_methods(options.methods);
  if (!options.against.empty()) {
    if (regression.selection.methods.size() != 1)
      throw InputError("--against: expected one --method to compare with it");
    regression.against = find_method(options.against);
  }
  regression.baselines = options.baselines.empty() ? data_folder() / "reference" / "baselines" : options.baselines;
  OutputFolder folder(options.out, "regress");
  regression.out = folder.path();
  const Provenance lines = provenance(options.command_line);
  if (options.bless) {
    const int status = blessed(regression, options, lines);
    folder.finish();
    return status;
  }
  Progress progress(0);
  const RegressionResult result = regress(regression, progress);
  progress.done();
  write_verdict(result, lines, regression.out);
  if (options.figures > 0 && !options.bisect)
    write_verdict_page(
        {result, regression.against ? regression.against->name : "the baselines in " + regression.baselines.string(),
         "", lines},
        regression, options.figures);
  folder.finish();
  return print_result(result, options.out);
}

/// Returns 0 if every case passes, otherwise 1; with `bisect`, 125 if the build cannot be judged.
int regress_command(const RegressOptions& options) {
  try {
    return regressed(options);
  } catch (const std::exception& error) {
    if (!options.bisect) throw;
    fmt::print(stderr, "crosscheck: cannot be tested: {}\n", error.what());
    return 125;
  }
}

}  // namespace

void add_regress(CLI::App& app, Invocation& call) {
  auto [regress, options] =
      add_command(app, call, "regress", "compares the results of this build with stored baselines", regress_command);
  regress.add_option("scenes", options.scenes, "scenes or TOML files (default: all that come with Crosscheck)");
  regress.add_option("--filter", options.filter, "GLOB: only cases whose SCENE or SCENE/METHOD matches");
  regress.add_option("--method", options.methods, "methods to run: A,B,... (default: all of mysim and Bullet)");
  regress.add_option("--against", options.against, "a method with which --method is compared, instead of baselines");
  regress.add_option("--baselines", options.baselines,
                     "folder of baselines (default: those that come with Crosscheck)");
  auto* bless = regress.add_flag("--bless", options.bless, "stores the results of this run as baselines");
  regress.add_option("--reason", options.reason, "with --bless: why these results are right")->needs(bless);
  regress
      .add_option("--figures", options.figures, "number of failed cases that are drawn (default: 6); 0 writes no page")
      ->check(CLI::Range(0, 100));
  regress.add_flag("--bisect", options.bisect,
                   "exits with 125 if a build cannot be judged, as `git bisect run` expects");
  regress.add_flag("--no-speed")->group("");  // accepted for scripts of earlier versions
  regress.add_option("--out", options.out, "folder (out/regress)");
  add_quick_and_full(regress, options.full);
}

}  // namespace crosscheck
