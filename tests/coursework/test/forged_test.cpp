// A whole program that sends prepared answers before main, with the true token, earns nothing: these answers do not fit
// the actual questions.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "tests/coursework/check/judge.h"
#include "tests/coursework/classic/oracles.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/run.h"
#include "tests/coursework/test/helpers.h"

namespace coursework {
namespace {

/// Code that answers each call with a prepared line, which it finds by the name of the call.
constexpr const char* forger = R"(
#include <unistd.h>
#include <iostream>
#include <sstream>
#include <string>
namespace {
struct Forger {
  Forger() {
    std::string token, line, text;
    std::getline(std::cin, token);
    while (std::getline(std::cin, line)) {
      std::istringstream words(line);
      std::string word, name;
      words >> word >> name;
      for (const char* const* known : lines)
        if (name == known[0]) text += known[1], text += "\n";
    }
    text += "token " + token + "\n";
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t count = write(3, text.data() + done, text.size() - done);
      if (count <= 0) _exit(1);
      done += count;
    }
    _exit(0);
  }
} forger;
}
)";

using Lines = std::map<std::string, std::string>;  // by call

std::string line_of(const Numbers& numbers) {
  std::string line = "answer " + std::to_string(numbers.size());
  for (const double value : numbers) {
    char text[40];
    std::snprintf(text, sizeof text, " %a", value);
    line += text;
  }
  return line;
}

class Forged : public testing::TestWithParam<const char*> {
 protected:
  Forged()
      : assignment_(find_assignment("classic")),
        sandbox_(choose_sandbox("bare", true)),
        builder_(builder_for(assignment_, *sandbox_, *sandbox_)),
        solution_(content_of_file(solution_of(assignment_, *builder_, GetParam()))),
        honest_(builder_->ours(GetParam(), solution_)) {
    for (const coursework::Test& test : assignment_.tests)
      if (test.part == GetParam()) tests_.push_back(test), ids_.insert(std::string(test.id));
  }

  /// The solution's answers to every call on the part's systems with this seed.
  std::map<std::string, TestRun> recorded(int seed) const {
    std::map<std::string, TestRun> all;
    for (const coursework::Test& test : tests_) {
      Random random(1);
      for (Case one : test.cases(random)) {
        one.in.at(1) = seed;
        all[one.call] = {&test, {one}, run_calls(*sandbox_, honest_, {one})};
      }
    }
    return all;
  }

  std::filesystem::path forging(const Lines& lines) const {
    std::string table = "static const char* const lines[][2] = {\n";
    for (const auto& [call, line] : lines) table += "{\"" + call + "\", \"" + line + "\"},\n";
    return builder_->ours(GetParam(), solution_ + table + "};\n" + forger);
  }

  /// Ids of the tests that the program passes. If `asked_seed` is not 0, it replaces the seeds that the tests draw.
  std::set<std::string> passed(const std::filesystem::path& program, std::uint64_t seed, int asked_seed = 0) const {
    std::set<std::string> ids;
    for (const coursework::Test& test : tests_) {
      Random random(hidden_seed(seed, test));
      std::vector<Case> cases = test.cases(random);
      for (Case& one : cases)
        if (asked_seed) one.in.at(1) = asked_seed;
      const std::vector<Answer> answers = run_calls(*sandbox_, program, cases);
      bool right = true;
      for (std::size_t i = 0; i < cases.size(); ++i)
        right = right && judge(cases[i], reduced(test, cases[i], answers[i])).right;
      if (right) ids.insert(std::string(test.id));
    }
    return ids;
  }

  const Assignment& assignment_;
  std::unique_ptr<Sandbox> sandbox_;
  std::unique_ptr<Builder> builder_;
  std::string solution_;
  std::filesystem::path honest_;
  std::vector<coursework::Test> tests_;
  std::set<std::string> ids_;
};

TEST_P(Forged, AnswersOfAnotherSeedEarnNothing) {
  Lines lines;
  for (const auto& [call, one] : recorded(11)) lines[call] = line_of(one.answers.front().got);
  const auto program = forging(lines);
  EXPECT_EQ(passed(program, 1, 11), ids_) << "of their own seed they are what an honest run says";
  for (std::uint64_t seed = 1; seed <= 5; ++seed) EXPECT_EQ(passed(program, seed), std::set<std::string>());
}

TEST_P(Forged, WhatTheGraderFindsEarnsNothingWhenItIsSent) {
  Lines lines;
  for (const auto& [call, one] : recorded(12)) {
    const probe::Findings found = classic::replay(one.cases.front(), one.answers.front().got);
    EXPECT_FALSE(found.empty()) << call;
    Numbers sent = {double(found.n)};
    for (const auto& row : found.rows)
      for (const probe::Plain& vector : row) sent.insert(sent.end(), vector.at, vector.at + 3);
    for (const probe::Pull& pull : found.pulls)
      sent.insert(sent.end(), {double(pull.b), double(pull.a), pull.along[0]});
    lines[call] = line_of(sent);
  }
  EXPECT_EQ(passed(forging(lines), 1), std::set<std::string>());
  for (auto& [call, line] : lines) {
    if (call.ends_with(".purity")) line = "answer 6 6 6 1 1 1 0";
    if (call.ends_with(".gravity")) line = "answer 19 1 0 -1 0 0 -1 0 0 -1 0 0 -1 0 0 -1 0 0 -1 0";
    if (call.ends_with(".drag")) line = "answer 13 1 1 0 0 0 0 0 -1 0 0 -2 0 0";
  }
  EXPECT_EQ(passed(forging(lines), 2), std::set<std::string>());
}

/// For a large cloth, most answers contain only a few of the numbers, so that the record stays below its size limit.
class LargeCloth : public Forged {};

TEST_P(LargeCloth, LeavesARecordThatIsSmallEnough) {
  std::string large = solution_;
  const std::string size = "rows = 9, columns = 8";
  const std::size_t at = large.find(size);
  ASSERT_NE(at, std::string::npos);
  large.replace(at, size.size(), "rows = 50, columns = 50");
  EXPECT_EQ(passed(builder_->ours("cloth", large), 3), ids_);
}

/// The grader replies to any record within the time of a test.
TEST_P(Forged, NoRecordHarmsTheGrader) {
  const double hostile[] = {std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity(),
                            -1,
                            0.5,
                            0,
                            1,
                            2,
                            64,
                            1e9,
                            1e300,
                            -1e300};
  for (const auto& [call, one] : recorded(13)) {
    const Case& what = one.cases.front();
    const Numbers& honest = one.answers.front().got;
    ASSERT_FALSE(classic::replay(what, honest).empty()) << call;
    const auto looked_at = [&](const Numbers& record) {
      for (const coursework::Test& test : tests_) test.reduce(what, record);
      return classic::replay(what, record);
    };
    Random random(1);
    for (int i = 0; i < 20; ++i) {
      Numbers cut = honest;
      cut.resize(static_cast<std::size_t>(random.integer(0, static_cast<int>(honest.size()) - 1)));
      EXPECT_TRUE(classic::replay(what, cut).empty()) << call << ", " << cut.size();
    }
    Numbers longer = honest;
    longer.push_back(0);
    EXPECT_TRUE(classic::replay(what, longer).empty()) << call;
    for (const double value : hostile) {
      Numbers changed = honest;
      changed[0] = value;  // number of entries of the state
      EXPECT_TRUE(looked_at(changed).empty()) << call << ", " << value;
      for (int i = 0; i < 3; ++i) {
        changed = honest;
        changed[static_cast<std::size_t>(random.integer(0, static_cast<int>(honest.size()) - 1))] = value;
        looked_at(changed);
      }
      // records of the maximum line length
      classic::replay(what, Numbers(2000000, value));
      Numbers large = {1e5};
      large.resize(2000000, value);
      classic::replay(what, large);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Forged, testing::Values("pendulum", "cloth"),
                         [](const auto& of) { return std::string(of.param); });
INSTANTIATE_TEST_SUITE_P(All, LargeCloth, testing::Values("cloth"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace coursework
