// regress --prove: each small wrong change to mysim, one after the other, against the baselines; all must be caught.
#include <fmt/format.h>

#include "experiments/regress/mutations.h"
#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/json.h"
#include "mysim/nearest.h"
#include "mysim/output_folder.h"
#include "report/commands/commands.h"
#include "report/run_program.h"

namespace crosscheck {
namespace {

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
  proof.caught = !verdict["passed"].truth();
  proof.failures = verdict["failures"].size() + verdict["without_answer"].size();
  proof.cause = verdict["cause"].text();
  proof.wrongly_named = proof.caught && !may_be_named(proof.cause, mutation);
  return proof;
}

}  // namespace

int prove_command(const RegressOptions& asked) {
  RegressOptions options = asked;
  const std::filesystem::path program = std::filesystem::path(CROSSCHECK_BINARY_DIR) / "crosscheck-mutants";
  if (!std::filesystem::exists(program))
    throw InputError(
        fmt::format("{}: expected the program of mutants; build the target crosscheck_mutants", program.string()));
  if (options.baselines.empty()) options.baselines = CROSSCHECK_BASELINES;
  OutputFolder folder(options.out, "regress");
  options.out = folder.path();
  int escaped = 0, wrongly_named = 0, named = 0, count = 0;
  for (const Mutation& mutation : read_mutations(CROSSCHECK_MUTATIONS)) {
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
    for (const Mutation& mutation : read_mutations(CROSSCHECK_MUTATIONS)) names.push_back(mutation.name);
    throw InputError(fmt::format("--mutant {}: no such mutation; expected one of those in {}{}", options.mutant,
                                 CROSSCHECK_MUTATIONS, did_you_mean(options.mutant, names)));
  }
  // that nothing is caught where nothing is wrong
  const Proof unchanged = proof_of({"none", "", {}, "", ""}, program, options);
  fmt::print("{:<8} {:<32} {:>6} failures\n", unchanged.caught ? "CAUGHT" : "passed", "(mysim as it is)",
             unchanged.failures);
  folder.finish();
  fmt::print("\n{} of {} wrong changes caught; the cause named for {}, wrongly for {}\n", count - escaped, count, named,
             wrongly_named);
  return escaped == 0 && wrongly_named == 0 && !unchanged.caught ? 0 : 1;
}

}  // namespace crosscheck
