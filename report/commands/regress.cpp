// regress: answers beside baselines or beside another method's; --bless writes baselines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "experiments/regress/cause.h"
#include "experiments/regress/regress.h"
#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/output_folder.h"
#include "report/commands/commands.h"
#include "report/commands/regress_speed.h"
#include "report/provenance.h"
#include "report/regress/verdict_files.h"
#include "report/regress/verdict_page.h"

namespace crosscheck {
namespace {

void print_row(const Compared& row) {
  std::string where = row.scene;
  if (!row.method.empty()) where += ", " + row.method;
  if (!row.without.empty()) where += " without " + row.without;
  fmt::print("{:<10} {}: {}", name_of(row.state), where, row.quantity);
  if (!row.note.empty()) {
    fmt::print(": {}\n", row.note);
    return;
  }
  fmt::print(": {}\n", change_in_words(row));
}

long count_of(const std::vector<Compared>& rows, Standing state) {
  return std::count_if(rows.begin(), rows.end(), [&](const Compared& row) { return row.state == state; });
}

int told(const Regressed& result, const std::string& cause, const std::filesystem::path& out) {
  const std::vector<Compared> worst = worst_of_each(result.rows);
  for (const Compared& row : worst) print_row(row);
  for (const FailedPoint& f : result.failures) fmt::print("no answer  {}: {}\n", f.name, f.why);
  const long fresh = count_of(result.rows, Standing::fresh), same = count_of(result.rows, Standing::same);
  long wrong = 0;
  for (const Compared& row : result.rows) wrong += failed(row.state);
  fmt::print("\n{} quantities: {} the same, {} failed{}{}\n", result.rows.size(), same, wrong,
             fresh > 0 ? fmt::format(", {} new (not blessed yet)", fresh) : "",
             result.failures.empty() ? "" : fmt::format("; {} questions without an answer", result.failures.size()));
  if (count_of(result.rows, Standing::moved) > 0) fmt::print("cause: {}\n", cause.empty() ? "not attributed" : cause);
  for (const char* name : {"index.html", "regress.csv"})
    if (std::filesystem::exists(out / name)) fmt::print("{}\n", (out / name).string());
  return result.passed() ? 0 : 1;
}

using Figures = std::vector<std::pair<std::filesystem::path, std::filesystem::path>>;  // drawn as, kept as

/// A page of what changes, and of each scene in which something moved the curve that goes beside its baseline.
Figures before_and_after(const Regression& regression, const RegressOptions& options, const Blessed& result,
                         const Provenance& lines) {
  Regressed changes;
  std::copy_if(result.changed.begin(), result.changed.end(), std::back_inserter(changes.rows),
               [](const Compared& row) { return row.state == Standing::moved; });
  if (changes.rows.empty()) return {};  // what is new has no before
  const Speeds none;
  VerdictPage page{changes, none};
  page.blessed = options.reason, page.beside = "what was blessed before";
  page.lines = lines;
  write_verdict_page(page, questions(regression.asked), regression,
                     std::max(options.figures, static_cast<int>(result.numbers.size())));
  Figures figures;
  std::set<std::string> scenes;
  for (const FailurePart& part : page.parts)
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
  if (regression.against) throw InputError("--bless: expected no --against: baselines are what is blessed");
  Progress progress(0);
  const Blessing blessing{value_of(lines, "date").substr(0, 10), value_of(lines, "commit"), value_of(lines, "compiler"),
                          options.reason};
  const Blessed result = bless(regression, blessing, progress);
  progress.done();
  for (const Compared& row : result.changed) print_row(row);
  // before the files are written: pictures need the old shapes
  const auto drawn = options.figures > 0 ? before_and_after(regression, options, result, lines) : Figures{};
  for (const auto& [file, text] : result.files) write_file(file, text);
  for (const auto& [from, to] : drawn)
    std::filesystem::copy_file(from, to, std::filesystem::copy_options::overwrite_existing);
  fmt::print("\n{} quantities blessed: {}\n", result.changed.size(), options.reason);
  for (const auto& file : result.files) fmt::print("{}\n", file.first.string());
  for (const auto& figure : drawn) fmt::print("{}\n", figure.second.string());
  if (speed_is_asked(options)) bless_and_print_speeds(regression, blessing, lines);
  return 0;
}

int regressed(const RegressOptions& options) {
  Regression regression;
  regression.asked.full = options.full;
  regression.asked.filter = options.filter;
  regression.asked.scenes = options.scenes;
  if (!options.methods.empty()) regression.asked.methods = find_methods(options.methods);
  if (!options.against.empty()) {
    if (regression.asked.methods.size() != 1)
      throw InputError("--against: expected one --method, which is set beside that one");
    regression.against = find_method(options.against);
  }
  regression.baselines = options.baselines.empty() ? std::filesystem::path(CROSSCHECK_BASELINES) : options.baselines;
  OutputFolder folder(options.out, "regress");
  regression.out = folder.path();
  const Provenance lines = provenance(options.command_line);
  if (options.bless) {
    const int status = blessed(regression, options, lines);
    folder.finish();
    return status;
  }
  if (!options.reason.empty()) throw InputError("--reason: expected --bless beside it");

  Progress progress(0);
  const Regressed result = regress(regression, progress);
  Speeds speeds;
  if (speed_is_asked(options)) speeds = speeds_beside(regression, lines, result.rows, progress);
  progress.done();
  const std::vector<Question> asked = questions(regression.asked);
  const std::string cause = cause_of(asked, result.rows);
  write_verdict(result, speeds, cause, lines, regression.out);
  if (options.figures > 0 && !options.bisect) {
    VerdictPage page{result, speeds, cause};
    page.beside = regression.against ? regression.against->name : "the baselines in " + regression.baselines.string();
    page.lines = lines;
    write_verdict_page(page, asked, regression, options.figures);
  }
  folder.finish();
  const int status = told(result, cause, options.out);
  print_speeds(speeds);
  return speeds.passed() ? status : 1;
}

}  // namespace

int regress_command(const RegressOptions& options) {
  try {
    return regressed(options);
  } catch (const std::exception& error) {
    if (!options.bisect) throw;
    // what `git bisect run` takes for "this one cannot be tested"
    fmt::print(stderr, "crosscheck: cannot be tested: {}\n", error.what());
    return 125;
  }
}

}  // namespace crosscheck
