// Grades every assignment's corpus with many seeds. Solution and styles earn all points; each known mistake loses
// exactly its tests and is named; other mistakes get no name. CORPUS_SEEDS and CORPUS_MISTAKES set the number of seeds,
// and of mistakes per assignment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "mysim/base/files.h"
#include "tests/coursework/check/judge.h"
#include "tests/coursework/check/words.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/run.h"
#include "tests/coursework/test/helpers.h"
#include "tests/coursework/test/recalling_sandbox.h"

namespace coursework {
namespace {
namespace fs = std::filesystem;

int number_from(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : otherwise;
}

class Corpus : public testing::TestWithParam<const Assignment*> {
 protected:
  Corpus()
      : assignment_(*GetParam()),
        sandbox_(std::make_unique<RecallingSandbox>(choose_sandbox("bare", true))),
        builder_(builder_for(assignment_, *sandbox_, *sandbox_)),
        known_(mistakes_of(assignment_)),
        count_(static_cast<std::size_t>(number_from("CORPUS_MISTAKES", 3))),
        seeds_(number_from("CORPUS_SEEDS", 2)) {}

  /// The first of a list of mistakes without a name; a third as many as CORPUS_MISTAKES suffice.
  template <class T>
  std::vector<T> first(std::vector<T> all) const {
    all.resize(std::min(all.size(), (count_ + 2) / 3));
    return all;
  }

  /// Runs each test of a part in a process of its own, as in grading, because a mistake may keep state between calls.
  std::vector<TestRun> ask(const std::string& part, const fs::path& program, int seed) const {
    std::vector<TestRun> asked;
    for (const coursework::Test& test : assignment_.tests) {
      if (test.part != part) continue;
      Random random(hidden_seed(static_cast<std::uint64_t>(seed), test));
      TestRun one{&test, seed == 0 ? public_cases(assignment_, test) : test.cases(random), {}};
      const std::vector<Answer> answers = run_calls(*sandbox_, program, one.cases);
      for (std::size_t i = 0; i < answers.size(); ++i) one.answers.push_back(reduced(test, one.cases[i], answers[i]));
      asked.push_back(std::move(one));
    }
    return asked;
  }

  static std::set<std::string> lost(const std::vector<TestRun>& asked) {
    std::set<std::string> ids;
    for (const TestRun& one : asked)
      for (std::size_t i = 0; i < one.cases.size(); ++i)
        if (!judge(one.cases[i], one.answers[i]).right) ids.insert(std::string(one.test->id));
    return ids;
  }

  std::string cause(const std::string& part, const std::vector<TestRun>& asked) const {
    std::string names;  // more than one name if the evidence is ambiguous
    for (const std::string& name : likely_causes(assignment_, part, asked, known_, *builder_, *sandbox_, 2))
      names += (names.empty() ? "" : " or ") + name;
    return names;
  }

  std::string solution(const std::string& part) const {
    return content_of_file(solution_of(assignment_, *builder_, part));
  }

  void expect_all_right(const std::string& part, const fs::path& program, const std::string& what) const {
    for (int seed = 0; seed < seeds_; ++seed)
      EXPECT_EQ(lost(ask(part, program, seed)), std::set<std::string>()) << what << ", seed " << seed;
  }

  /// Expects that the source is wrong, and that no known mistake is named as its cause.
  void expect_no_name(const std::string& part, const std::string& source, const std::string& what) const {
    const fs::path program = builder_->ours(part, source);
    for (int seed = 0; seed < seeds_; ++seed) {
      const std::vector<TestRun> asked = ask(part, program, seed);
      EXPECT_FALSE(lost(asked).empty()) << what << ", seed " << seed;
      EXPECT_EQ(cause(part, asked), "") << what << ", seed " << seed;
    }
  }

  const Assignment& assignment_;
  std::unique_ptr<RecallingSandbox> sandbox_;
  std::unique_ptr<Builder> builder_;
  std::vector<Mistake> known_;
  std::size_t count_;
  int seeds_;
};

TEST_P(Corpus, PointsSumToAHundred) {
  int sum = 0;
  for (const coursework::Test& test : assignment_.tests) sum += test.points + test.hidden;
  EXPECT_EQ(sum, 100);
}

TEST_P(Corpus, SolutionAndOtherStylesLoseNothing) {
  for (const Part& part : assignment_.parts)
    expect_all_right(std::string(part.name), builder_->ours(std::string(part.name), solution(std::string(part.name))),
                     "solution");
  int styles = 0;
  for (const auto& style : fs::directory_iterator(assignment_.folder() / "styles")) {
    ++styles;
    const crosscheck::TemporaryFolder scratch("style");
    // a file that a style lacks is taken from the solution
    Submission submission = read_submission(style.path(), wanted_files(assignment_));
    for (const auto& [file, why] : submission.missing)
      submission.files[file] = content_of_file(assignment_.folder() / "solution" / file);
    submission.missing.clear();
    for (const auto& [part, built] : builder_->theirs(submission, scratch.path, 2)) {
      ASSERT_FALSE(built.program.empty()) << style.path() << ", " << part << ": " << said(common_texts(), built.error);
      expect_all_right(part, built.program, style.path().string());
    }
  }
  EXPECT_GE(styles, 3);
}

// Small cases, which show a student where to begin, have right answers and show their inputs.
TEST_P(Corpus, SmallCasesAreRightAndSayWhatWasGiven) {
  const Texts own = Texts::read((assignment_.folder() / "texts.en.txt").string());
  for (const coursework::Test& test : assignment_.tests) {
    const std::vector<Case> small = small_cases(assignment_, test);
    if (small.empty()) continue;
    const fs::path program = builder_->ours(std::string(test.part), solution(std::string(test.part)));
    const std::vector<Answer> answers = run_calls(*sandbox_, program, small);
    for (std::size_t i = 0; i < small.size(); ++i) {
      const Judged judged = judge(small[i], answers[i]);
      EXPECT_TRUE(judged.right) << test.id << ", small case " << i << ": "
                                << words(common_texts(), own, small[i], answers[i], judged);
      EXPECT_NE(given_text(common_texts(), own, small[i], judged, 80), "") << test.id << ", small case " << i;
    }
  }
}

TEST_P(Corpus, KnownMistakesLoseExactlyTheirTestsAndAreNamed) {
  EXPECT_GE(known_.size(), 12u);
  const Texts texts = Texts::read((assignment_.folder() / "texts.en.txt").string());
  for (int seed = 0; seed < seeds_; ++seed) {
    sandbox_->forget();
    for (std::size_t i = 0; i < std::min(count_, known_.size()); ++i) {
      // takes a sample that is spread over the parts
      const Mistake& mistake = known_[count_ < known_.size() ? i * known_.size() / count_ : i];
      EXPECT_TRUE(texts.has("mistake." + mistake.name)) << mistake.name;
      const fs::path program = builder_->ours(mistake.part, with_mistake(solution(mistake.part), mistake));
      const std::vector<TestRun> asked = ask(mistake.part, program, seed);
      EXPECT_EQ(lost(asked), std::set<std::string>(mistake.loses.begin(), mistake.loses.end()))
          << mistake.name << ", seed " << seed;
      EXPECT_EQ(cause(mistake.part, asked), mistake.name) << "seed " << seed;
    }
  }
}

// Correct programs that differ from the solution, and wrong ones with a single error.
class UnusualPrograms : public Corpus {};

TEST_P(UnusualPrograms, LoseExactlyTheirTests) {
  for (const Mistake& one : read_mistakes(assignment_.folder() / "unusual.txt"))
    for (int seed = 0; seed < seeds_; ++seed)
      EXPECT_EQ(lost(ask(one.part, builder_->ours(one.part, with_mistake(solution(one.part), one)), seed)),
                std::set<std::string>(one.loses.begin(), one.loses.end()))
          << one.name << ", seed " << seed;
}

TEST_P(Corpus, NewMistakesAreGivenNoName) {
  for (const Mistake& mistake : first(read_mistakes(assignment_.folder() / "novel.txt")))
    expect_no_name(mistake.part, with_mistake(solution(mistake.part), mistake), mistake.name);
}

TEST_P(Corpus, TwoMistakesAtOnceAreGivenNoName) {
  auto find = [&](const std::string& name) {
    const auto at = std::find_if(known_.begin(), known_.end(), [&](const Mistake& m) { return m.name == name; });
    if (at == known_.end()) throw std::runtime_error("double.txt: no mistake " + name);
    return *at;
  };
  for (const auto& [a, b] : first(read_pairs(assignment_.folder() / "double.txt"))) {
    ASSERT_EQ(find(a).part, find(b).part);
    expect_no_name(find(a).part, with_mistake(with_mistake(solution(find(a).part), find(a)), find(b)), a + " and " + b);
  }
}

std::vector<const Assignment*> all_assignments() {
  std::vector<const Assignment*> all;
  for (const Assignment& assignment : assignments()) all.push_back(&assignment);
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, Corpus, testing::ValuesIn(all_assignments()),
                         [](const auto& of) { return name_of_test(of.param->name); });
INSTANTIATE_TEST_SUITE_P(All, UnusualPrograms, testing::Values(&find_assignment("classic")),
                         [](const auto& of) { return name_of_test(of.param->name); });

}  // namespace
}  // namespace coursework
