// Mutants of every official solution must lose points at a test of the changed part; test/mutants/equivalent.txt
// justifies those that cannot lose points. MUTANTS sets the number of mutants (default 40; 0 for all), MUTANTS_SEED
// (default 1) selects them, and MUTANTS_SURVIVORS names a file to which all survivors are written.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <mutex>

#include "tests/coursework/check/judge.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/parallel.h"
#include "tests/coursework/grader/run.h"
#include "tests/coursework/test/helpers.h"
#include "tests/coursework/test/mutants/mutants.h"

namespace coursework {
namespace {
namespace fs = std::filesystem;

/// Maximum number of mutants per rule and file. All four thousand mutants would take hours.
constexpr std::size_t most_of_a_rule = 2;

struct Tried {
  const Assignment* assignment = nullptr;
  const Builder* builder = nullptr;
  std::string file, part;           // the part with the change
  std::vector<std::string> beside;  // all parts that share this file
  Mutant mutant;
  enum class Became { not_compiled, lost, lost_elsewhere, survived } became = Became::survived;
  std::string at;  // the first lost test

  std::string name() const {
    return fmt::format("{} {}:{} ({}): {} => {}", assignment->name, file, mutant.line, mutant.rule, mutant.right,
                       mutant.wrong);
  }
};

/// Part that contains the line. If a file has several parts, each part is a function that begins in column one, in the
/// order of the parts.
std::string part_at(const std::string& source, int line, const std::vector<std::string>& parts) {
  std::size_t functions = 0, at = 0;
  for (int i = 1; i <= line && at < source.size(); ++i) {
    const std::size_t end = std::min(source.size(), source.find('\n', at));
    functions += end > at && source[at] != ' ' && source[end - 1] == '{';
    at = end + 1;
  }
  return parts[std::min(parts.size(), std::max<std::size_t>(1, functions)) - 1];
}

/// The first test that loses points, public or hidden, or an empty string.
std::string first_loss(const Tried& one, const std::string& part, const fs::path& program, const Sandbox& sandbox) {
  for (const coursework::Test& test : one.assignment->tests) {
    if (test.part != part) continue;
    for (const bool hidden : {false, true}) {
      Random random(hidden_seed(1, test));
      const std::vector<Case> cases = hidden ? test.cases(random) : public_cases(*one.assignment, test);
      const std::vector<Answer> answers = run_calls(sandbox, program, cases);
      for (std::size_t i = 0; i < cases.size(); ++i)
        if (!judge(cases[i], reduced(test, cases[i], answers[i])).right) return std::string(test.id);
    }
  }
  return "";
}

void try_one(Tried& one, const Sandbox& sandbox) {
  for (const std::string& part : one.beside) {
    fs::path program;
    try {
      program = one.builder->ours(part, one.mutant.source);
    } catch (const std::runtime_error&) {
      one.became = Tried::Became::not_compiled;
      return;
    }
    const std::string at = first_loss(one, part, program, sandbox);
    if (at.empty()) continue;
    const bool right_place = part == one.part;
    if (one.became != Tried::Became::lost_elsewhere)
      one.became = right_place ? Tried::Became::lost : Tried::Became::lost_elsewhere;
    if (one.at.empty() || right_place) one.at = at;
  }
}

class Mutants : public testing::Test {
 protected:
  Mutants() : sandbox_(choose_sandbox("bare", true)) {
    for (const Assignment& assignment : assignments()) {
      builders_.push_back(builder_for(assignment, *sandbox_, *sandbox_));
      std::map<std::string, std::vector<std::string>> parts_of;
      for (const Part& part : assignment.parts)
        parts_of[builders_.back()->file_of(std::string(part.name))].push_back(std::string(part.name));
      for (const auto& [file, parts] : parts_of) {
        const std::string source = content_of_file(assignment.folder() / "solution" / file);
        for (Mutant& mutant : mutants_of(source, most_of_a_rule)) {
          const std::string part = part_at(source, mutant.line, parts);
          all_.push_back({&assignment, builders_.back().get(), file, part, parts, std::move(mutant)});
        }
      }
    }
    equivalent_ = read_equivalents(folder_of_coursework() / "test/mutants/equivalent.txt");
  }

  bool argued(const Tried& one) const {
    return std::any_of(equivalent_.begin(), equivalent_.end(), [&](const Equivalent& e) {
      return e.where == fmt::format("{} {}", one.assignment->name, one.file) && e.right == one.mutant.right &&
             e.wrong == one.mutant.wrong;
    });
  }

  std::unique_ptr<Sandbox> sandbox_;
  std::vector<std::unique_ptr<Builder>> builders_;
  std::vector<Tried> all_;
  std::vector<Equivalent> equivalent_;
};

std::uint64_t number_from(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST_F(Mutants, ThereAreEnoughOfEveryRule) {
  EXPECT_GE(all_.size(), 300u);
  std::map<std::string, int> of_rule;
  for (const Tried& one : all_) ++of_rule[one.mutant.rule];
  for (const char* rule :
       {"operator", "sign", "constant", "index", "swapped name", "term left out", "left out", "order", "float",
        "integer", "integer division", "static", "alias", "count", "few", "half moved", "asked again"})
    EXPECT_GE(of_rule[rule], 3) << rule;
}

// An entry of equivalent.txt is obsolete if no mutation produces its line any more.
TEST_F(Mutants, EveryArgumentIsOnAMutant) {
  for (const Equivalent& e : equivalent_)
    EXPECT_TRUE(std::any_of(all_.begin(), all_.end(),
                            [&](const Tried& one) {
                              return e.where == fmt::format("{} {}", one.assignment->name, one.file) &&
                                     e.right == one.mutant.right && e.wrong == one.mutant.wrong;
                            }))
        << e.where << ": " << e.right << " => " << e.wrong;
}

TEST_F(Mutants, LosePointsAtTheirPart) {
  const std::uint64_t count = number_from("MUTANTS", 40);
  std::vector<Tried> chosen;
  for (Tried& one : all_)
    if (!argued(one) || count == 0) chosen.push_back(std::move(one));
  if (count != 0) {
    Random random(number_from("MUTANTS_SEED", 1));
    for (std::size_t i = chosen.size(); i > 1; --i)
      std::swap(chosen[i - 1], chosen[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
    // prepares more mutants than needed, because some do not compile
    chosen.resize(std::min<std::size_t>(chosen.size(), 2 * count));
  }
  std::ofstream survivors;
  if (const char* file = std::getenv("MUTANTS_SURVIVORS")) survivors.open(file);
  std::mutex counting;
  std::map<Tried::Became, std::vector<const Tried*>> all;
  std::uint64_t compiled = 0;
  parallel_for(chosen.size(), 2, [&](std::size_t i) {
    {
      const std::lock_guard<std::mutex> lock(counting);
      if (count != 0 && compiled >= count) return;
    }
    try_one(chosen[i], *sandbox_);
    const std::lock_guard<std::mutex> lock(counting);
    all[chosen[i].became].push_back(&chosen[i]);
    compiled += chosen[i].became != Tried::Became::not_compiled;
    if (chosen[i].became == Tried::Became::survived && !argued(chosen[i]))
      survivors << fmt::format("[{} {}]\n- {}\n+ {}\n", chosen[i].assignment->name, chosen[i].file,
                               chosen[i].mutant.right, chosen[i].mutant.wrong)
                << std::flush;
  });
  for (const Tried* one : all[Tried::Became::survived]) {
    if (!argued(*one)) ADD_FAILURE() << "survives: " << one->name();
  }
  for (const Tried* one : all[Tried::Became::lost_elsewhere])
    ADD_FAILURE() << "loses at " << one->at << ", of another part: " << one->name();
  for (const Tried* one : all[Tried::Became::lost])
    EXPECT_FALSE(argued(*one)) << "loses at " << one->at << ", and is argued to be equivalent: " << one->name();
  fmt::print("{} mutants: {} lose points at their part, {} elsewhere, {} survive; {} more do not compile\n", compiled,
             all[Tried::Became::lost].size(), all[Tried::Became::lost_elsewhere].size(),
             all[Tried::Became::survived].size(), all[Tried::Became::not_compiled].size());
  EXPECT_GE(compiled, count);
}

}  // namespace
}  // namespace coursework
