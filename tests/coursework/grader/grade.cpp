// Builds the parts, runs each test in its own process, judges answers, and searches for causes.
#include "tests/coursework/grader/grade.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "tests/coursework/check/plot.h"
#include "tests/coursework/check/seen.h"
#include "tests/coursework/check/words.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/crashes.h"
#include "tests/coursework/grader/engine.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/observe.h"
#include "tests/coursework/grader/python.h"
#include "tests/coursework/grader/result.h"
#include "tests/coursework/grader/run.h"
#include "tests/coursework/grader/suspects.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

std::string text_or(const Texts& texts, const std::string& key, const std::string& otherwise) {
  return texts.has(key) ? texts.of(key) : otherwise;
}

class Grading {
 public:
  Grading(const Assignment& assignment, const Submission& submission, const Sandbox& sandbox,
          const GradeOptions& options)
      : assignment_(assignment),
        submission_(submission),
        sandbox_(sandbox),
        options_(options),
        trusted_(choose_sandbox("bare", true)),
        builder_(submission.python ? python_builder(assignment, *trusted_, sandbox)
                                   : builder_for(assignment, *trusted_, sandbox)),
        scratch_("grade") {
    result_.assignment = assignment.name;
    result_.submission = submission.name;
    result_.sandbox = sandbox.name();
    result_.seed = options.secret ? 0 : options.seed;
    result_.secret = options.secret;
  }

  Result run() {
    const std::string package = submission_.python ? missing_python_package() : "";
    if (submission_.refused || !package.empty()) {
      result_.not_graded = submission_.refused ? said(options_.common, submission_.remarks.back())
                                               : options_.common.fill("python.package", package);
      result_.complete = true;
      options_.on_progress(result_);
      return result_;
    }
    list_tests();
    options_.on_progress(result_);
    build();
    for (std::size_t i = 0; i < result_.tests.size(); ++i) {
      run_test(i);
      options_.on_progress(result_);
    }
    for (const Part& part : assignment_.parts) tell_crashes(std::string(part.name));
    for (const Part& part : assignment_.parts) look_for_cause(std::string(part.name));
    require_unseen();
    tell_measured();
    result_.remark = most_helpful();
    keep_engines();
    result_.complete = true;
    options_.on_progress(result_);
    return result_;
  }

 private:
  void list_tests() {
    for (const bool hidden : {false, true})
      for (const Test& test : assignment_.tests) {
        if ((hidden ? test.hidden : test.points) == 0) continue;
        if (!options_.parts.empty() && !options_.parts.contains(test.part)) continue;
        TestResult one;
        one.id = test.id;
        one.part = test.part;
        one.title = text_or(options_.own, one.id + ".title", one.id);
        one.heading = assignment_.takes_whole_program() ? text_or(options_.own, one.part + ".title", one.part)
                                                        : builder_->handed_in(one.part);
        one.hidden = hidden;
        one.points = hidden ? test.hidden : test.points;
        one.concepts.assign(test.concepts.begin(), test.concepts.end());
        one.read = test.read;
        one.said = options_.common.of("not_run");
        result_.tests.push_back(one);
        test_runs_.push_back({&test, {}, {}});
      }
  }

  void build() {
    for (const Remark& remark : submission_.remarks) result_.preflight.push_back(said(options_.common, remark));
    const std::map<std::string, Built> built = builder_->theirs(submission_, scratch_.path, options_.jobs);
    for (const Part& each : assignment_.parts) {
      const std::string part(each.name);
      const Built& one = built.at(part);
      if (!one.program.empty()) {
        programs_[part] = one.program;
        continue;
      }
      const std::string why = said(options_.common, one.error);
      // a remark on a file with several parts is reported once
      auto& all = result_.preflight;
      if (std::find(all.begin(), all.end(), why) == all.end()) all.push_back(why);
      unusable_[part] = {one.missing ? How::missing : How::not_compiled, {}, one.missing ? one.error.with.at(0) : why};
    }
    // appends the remarks that do not prevent a part from running
    for (const auto& [part, one] : built)
      for (const Remark& note : one.notes) result_.preflight.push_back(said(options_.common, note));
  }

  void run_test(std::size_t i) {
    const auto begin = std::chrono::steady_clock::now();
    TestResult& one = result_.tests[i];
    TestRun& test_run = test_runs_[i];
    Random random(hidden_seed(options_.seed, *test_run.test));
    test_run.cases = one.hidden ? test_run.test->cases(random) : public_cases(assignment_, *test_run.test);
    const auto unusable = unusable_.find(one.part);
    if (unusable != unusable_.end())
      test_run.answers.assign(test_run.cases.size(), unusable->second);
    else if (const std::string before = ungraded_before(test_run.cases); !before.empty()) {
      one.ungraded = true;
      one.said = options_.common.fill("how.as_ungraded", before);
      return;
    } else
      test_run.answers = answers_to(one.part, test_run.cases);
    const std::vector<Answer> raw = test_run.answers;
    for (std::size_t k = 0; k < test_run.cases.size(); ++k)
      test_run.answers[k] = reduced(*test_run.test, test_run.cases[k], test_run.answers[k]);
    for (Answer& answer : test_run.answers)
      if (answer.how == How::threw) {
        answer.detail = submission_.python ? shown_python_exception(answer.detail, submission_.files, one.hidden)
                                           : shown_exception(answer.detail, submission_.files);
        if (answer.detail.empty()) answer.detail = options_.common.of("threw.unseen");
      }
    judge_test(test_run, raw, one);
    one.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  /// Id of an ungraded test that made one of these calls with other numbers, because the call would take as long again;
  /// empty if there is no such test.
  std::string ungraded_before(const std::vector<Case>& cases) const {
    for (const Case& each : cases)
      if (const auto found = ungraded_calls_.find(each.call); found != ungraded_calls_.end()) return found->second;
    return "";
  }

  /// Code may be twenty times as slow as the official solution, and may always use the minimum limit. Runs the official
  /// solution only if the minimum is exceeded.
  std::vector<Answer> answers_to(const std::string& part, const std::vector<Case>& cases) {
    const auto too_slow = [](const Answer& answer) { return answer.how == How::out_of_time; };
    const Limits least = limits_for(0, options_.least_cpu);
    std::vector<Answer> answers = run_calls(sandbox_, programs_.at(part), cases, least);
    if (std::none_of(answers.begin(), answers.end(), too_slow)) return answers;
    double reference = 0;
    run_calls(*trusted_, builder_->ours(part, content_of_file(solution_of(assignment_, *builder_, part))), cases,
              limits_for(0), &reference);
    if (const Limits longer = limits_for(reference, options_.least_cpu); longer.cpu > least.cpu)
      answers = run_calls(sandbox_, programs_.at(part), cases, longer);
    for (Answer& answer : answers) answer.reference = reference;
    return answers;
  }

  /// Gives feedback on the first wrong call. If all calls are right, the plot shows the first one.
  void judge_test(const TestRun& test_run, const std::vector<Answer>& raw, TestResult& one) {
    std::size_t shown = 0;
    one.said.clear();
    for (std::size_t k = 0; k < test_run.cases.size(); ++k) {
      const Judged judged = judge(test_run.cases[k], test_run.answers[k]);
      if (judged.right) continue;
      one.ungraded = ungraded(judged.how);
      if (one.ungraded && judged.how != How::undecided) ungraded_calls_.emplace(test_run.cases[k].call, one.id);
      one.said = words(options_.common, options_.own, test_run.cases[k], test_run.answers[k], judged);
      const bool ran = unusable_.count(one.part) == 0;
      if (ran && test_run.cases.size() > 1)
        one.said = options_.common.fill("which", std::to_string(k + 1), std::to_string(test_run.cases.size())) + " " +
                   one.said;
      // numbers of hidden tests are never shown
      if (const std::string given =
              one.hidden ? "" : given_text(options_.common, options_.own, test_run.cases[k], judged);
          !given.empty())
        one.said += "\n" + given;
      if (assignment_.shown && !one.hidden && judged.how == How::answered)
        if (const std::string came = assignment_.shown(options_.own, test_run.cases[k], raw[k].got); !came.empty())
          one.said += "\n" + came;
      if (const std::string smaller = one.hidden || judged.how != How::answered ? "" : smallest(*test_run.test);
          !smaller.empty() && small_told_.emplace(one.part, test_run.test->small).second)
        one.said += "\n" + smaller;
      else if (!one.hidden)
        for (const std::string& more : shown_beside(test_run, one, k))
          if (!more.empty()) one.said += "\n" + more;
      if (const std::string factors = one.hidden ? "" : factors_text(options_.common, test_run.cases, test_run.answers);
          !factors.empty())
        one.said += "\n" + factors;
      shown = k;
      break;
    }
    if (test_run.cases.empty()) throw std::runtime_error(fmt::format("test {}: it asks nothing", one.id));
    if (one.said.empty()) one.earned = one.points;
    const Case& what = test_run.cases[shown];
    if (test_run.answers[shown].how != How::answered || test_run.answers[shown].got.size() != what.expected.size())
      return;
    const std::string x = what.plot_x < 0 ? name_text(options_.own, "row.", what.row) + axis_unit(what)
                                          : column_text(options_.own, what, what.plot_x);
    one.plot = plot(what, test_run.answers[shown].got,
                    {options_.common.of("legend.right"), options_.common.of("legend.yours"), x,
                     column_text(options_.own, what, what.plot_y)});
  }

  /// The numbers of a case and the observations on them, for the first failing test of a function; otherwise empty.
  std::vector<std::string> shown_beside(const TestRun& test_run, const TestResult& one, std::size_t k) const {
    if (failed_already(test_run, one)) return {};
    const Case& what = test_run.cases[k];
    const Answer& answer = test_run.answers[k];
    return {table_text(options_.common, options_.own, what, answer),
            seen_text(options_.common, options_.own, what, answer, others_of(what, test_run.cases, test_run.answers))};
  }

  /// True if an earlier public test of the same function failed. Its feedback already shows the observations.
  bool failed_already(const TestRun& test_run, const TestResult& one) const {
    const std::string function = function_of(options_.own, one.part, test_run.cases[0]);
    for (std::size_t i = 0; &result_.tests[i] != &one; ++i)
      if (result_.tests[i].part == one.part && !passed(result_.tests[i]) &&
          function_of(options_.own, one.part, test_runs_[i].cases[0]) == function)
        return true;
    return false;
  }

  /// Runs the small cases of a failed test in a separate process, so that they cannot affect the verdict.
  std::string smallest(const Test& test) const {
    if (small_told_.count({std::string(test.part), test.small})) return "";
    const std::vector<Case> small = small_cases(assignment_, test);
    if (small.empty()) return "";
    Limits limits = limits_for(0);
    limits.cpu = 1, limits.wall = 10;
    const std::vector<Answer> answers = run_calls(sandbox_, programs_.at(std::string(test.part)), small, limits);
    return smaller_text(options_.common, options_.own, small, answers);
  }

  static std::string axis_unit(const Case& what) {
    return what.row_size == 1 ? "" : fmt::format(" x {:.3g}", what.row_size);
  }

  /// Rejects memorised answers: cancels the points of a public test if its hidden form fails, because the numbers and
  /// answers of public tests are known.
  void require_unseen() {
    for (TestResult& shown : result_.tests)
      for (const TestResult& other : result_.tests)
        if (!shown.hidden && other.hidden && other.id == shown.id && passed(shown) && !passed(other)) {
          shown.earned = 0;
          shown.ungraded = other.ungraded;
          shown.said = options_.common.of(other.ungraded ? "how.shown_ungraded" : "shown_only");
        }
  }

  /// The part's program that checks every index, built on first use; empty if it cannot be built.
  const fs::path& checked_program(const std::string& part) {
    const auto [at, added] = checked_.try_emplace(part);
    if (added) at->second = builder_->checked(submission_, part, scratch_.path / ("checked-" + part)).program;
    return at->second;
  }

  /// Adds the line of the crash, and the index, to each crashed test of the part.
  void tell_crashes(const std::string& part) {
    const std::string& guess = options_.common.of("crash.guess");
    for (std::size_t i = 0; i < test_runs_.size(); ++i) {
      std::string& said = result_.tests[i].said;
      const std::size_t at = result_.tests[i].part == part ? said.find(guess) : std::string::npos;
      if (at == std::string::npos || unusable_.count(part) || checked_program(part).empty()) continue;
      const std::vector<Answer>& answers = test_runs_[i].answers;
      const auto told =
          std::find_if(answers.begin(), answers.end(), [](const Answer& a) { return a.how == How::crashed; });
      if (const auto crash = crash_of(sandbox_, checked_program(part), test_runs_[i].cases))
        said.replace(at, guess.size(),
                     crash_text(options_.common, *crash, static_cast<std::size_t>(told - answers.begin())));
    }
  }

  /// The cause if the checked program finds an index out of range that does not end the unchecked program; otherwise
  /// "".
  std::string index_cause(const std::string& part, const std::vector<TestRun>& runs,
                          const std::vector<TestResult*>& tests) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (tests[i]->hidden || passed(*tests[i])) continue;
      if (checked_program(part).empty()) return "";
      const auto crash = crash_of(sandbox_, checked_program(part), runs[i].cases);
      return crash && crash->why != Crash::Why::other
                 ? options_.common.fill("suspect.index", crash_text(options_.common, *crash, crash->which))
                 : "";
    }
    return "";
  }

  /// Fills in the causes of a part's wrong answers. Skips crashes and loops, whose messages are sufficient.
  void look_for_cause(const std::string& part) {
    std::vector<TestRun> of_part;
    std::vector<TestResult*> wrong, tests;  // `tests` corresponds to `of_part`
    for (std::size_t i = 0; i < test_runs_.size(); ++i) {
      if (result_.tests[i].part != part) continue;
      bool answered = !result_.tests[i].ungraded;
      if (answered) of_part.push_back(test_runs_[i]), tests.push_back(&result_.tests[i]);
      for (const Answer& answer : test_runs_[i].answers) answered = answered && answer.how == How::answered;
      if (answered && !passed(result_.tests[i])) wrong.push_back(&result_.tests[i]);
    }
    if (wrong.empty() || unusable_.count(part)) return;
    const Remark suspect = suspected(
        {sandbox_, *builder_, submission_, options_.own, programs_.at(part), scratch_.path / ("suspects-" + part)},
        of_part);
    const std::vector<std::string> names =
        likely_causes(assignment_, part, of_part, mistakes_of(assignment_), *builder_, *trusted_, options_.jobs);
    // the evidence of an experiment is stronger than a similarity to a known mistake
    std::string cause =
        suspect.key.empty() ? cause_text(options_.common, options_.own, names) : said(options_.common, suspect);
    if (cause == options_.common.of("no_cause"))
      if (const std::string index = index_cause(part, of_part, tests); !index.empty()) cause = index;
    // The hint on a single test could contradict a known cause. Without a known cause, the hint on the function's first
    // failing test is the most informative.
    const bool known = cause != options_.common.of("no_cause"),
               seen = suspect.key.empty() && look_closer(part, of_part, tests, wrong);
    for (TestResult* test : wrong) {
      test->cause = known || !seen ? cause : "";  // an observation is more useful than "no known mistake"
      const std::string before = failed_before(*test, wrong);
      if (known || (seen && before.empty())) continue;
      if (const std::string hint = hint_text(options_.common, options_.own, test->id, before); !hint.empty())
        test->said += "\n" + hint;
    }
  }

  /// The first failing test for the same function as `test`, or "" if that is `test` itself.
  std::string failed_before(const TestResult& test, const std::vector<TestResult*>& wrong) const {
    const auto function = [&](const TestResult& one) {
      return function_of(options_.own, one.part,
                         test_runs_[static_cast<std::size_t>(&one - &result_.tests[0])].cases[0]);
    };
    for (const TestResult* other : wrong)
      if (function(*other) == function(test)) return other->id == test.id ? "" : other->id;
    return "";
  }

  /// Adds observations to public tests by repeating their calls with modified inputs. Returns false if there are none.
  bool look_closer(const std::string& part, const std::vector<TestRun>& runs, const std::vector<TestResult*>& tests,
                   const std::vector<TestResult*>& wrong) {
    std::vector<bool> told_at;
    for (TestResult* test : tests)
      told_at.push_back(!test->hidden && std::find(wrong.begin(), wrong.end(), test) != wrong.end());
    const std::vector<std::string> seen =
        seen_at({asking(sandbox_, programs_.at(part)),
                 asking(*trusted_, builder_->ours(part, content_of_file(solution_of(assignment_, *builder_, part)))),
                 options_.common, options_.own},
                assignment_, part, runs, told_at);
    bool any = false;
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (!seen[i].empty()) tests[i]->said += "\n" + seen[i], any = true;
    return any;
  }

  /// The sentence that explains the most lost points: a cause, or the first line of a test's feedback. If no points
  /// were lost, the first remark before the tests.
  std::string most_helpful() const {
    std::map<std::string, std::pair<bool, double>> lost;  // sentence -> (a file was handed in, points)
    std::string most = result_.preflight.empty() ? "" : result_.preflight.front();
    for (const TestResult& test : result_.tests) {
      if (passed(test) || test.said == options_.common.of("shown_only")) continue;
      const bool known = !test.cause.empty() && test.cause != options_.common.of("no_cause");
      const bool ran = unusable_.count(test.part) == 0;
      const std::string first = test.said.substr(0, test.said.find('\n'));
      const std::string sentence = known ? test.cause : ran ? test.id + ": " + first : first;
      std::pair<bool, double>& its = lost[sentence];
      its = {ran || unusable_.at(test.part).how != How::missing, its.second + test.points};
      if (its > lost[most]) most = sentence;
    }
    return most;
  }

  /// Adds remarks on measured quantities that no test judges.
  void tell_measured() {
    if (!assignment_.measured) return;
    for (const Part& part : assignment_.parts)
      if (const auto program = programs_.find(std::string(part.name)); program != programs_.end())
        if (std::string text = assignment_.measured(options_.common, program->first, asking(sandbox_, program->second));
            !text.empty())
          result_.preflight.push_back(std::move(text));
  }

  /// Keeps the programs of parts that answered every call. All other programs would crash or hang in every run of the
  /// charts.
  void keep_engines() const {
    if (options_.engines.empty() || !has_engine(assignment_) || submission_.python) return;
    for (const auto& [part, program] : programs_) {
      bool answered = true;
      for (const TestRun& test_run : test_runs_)
        if (test_run.test->part == part)
          for (const Answer& answer : test_run.answers) answered = answered && answer.how == How::answered;
      if (answered) keep_engine(program, part, sandbox_, options_.engines);
    }
  }

  const Assignment& assignment_;
  const Submission& submission_;
  const Sandbox& sandbox_;
  const GradeOptions& options_;
  std::unique_ptr<Sandbox> trusted_;
  std::unique_ptr<Builder> builder_;
  crosscheck::TemporaryFolder scratch_;
  std::map<std::string, fs::path> programs_;           // by part
  std::map<std::string, fs::path> checked_;            // part -> program that checks every index
  std::map<std::string, Answer> unusable_;             // part -> reason why it cannot run: missing, or does not compile
  std::map<std::string, std::string> ungraded_calls_;  // call that made a test ungraded -> this test
  std::vector<TestRun> test_runs_;                     // parallel to result_.tests
  std::set<std::pair<std::string, std::vector<Case> (*)(Random&)>> small_told_;  // small cases are shown once
  Result result_;
};

}  // namespace

std::string said(const Texts& common, const Remark& remark) {
  const auto& with = remark.with;
  auto word = [&](std::size_t i) { return i < with.size() ? name_text(common, "reason.", with[i]) : std::string(); };
  return common.fill(remark.key, word(0), word(1), word(2));
}

std::vector<std::string> wanted_files(const Assignment& assignment) {
  std::vector<std::string> files;
  if (assignment.takes_whole_program()) return files;
  for (const Part& part : assignment.parts) files.push_back(std::string(part.name) + ".cpp");
  return files;
}

Submission submission_of(const Handed& handed, const Assignment& assignment) {
  Submission cpp =
      read_submission(handed, wanted_files(assignment), {assignment.roles.begin(), assignment.roles.end()});
  if (!has_python(assignment)) return cpp;
  Submission python = read_submission(handed, python_files(assignment));
  python.python = true;
  const bool both = !cpp.places.empty() && !python.places.empty();
  Submission chosen = python.places.size() > cpp.places.size() ? std::move(python) : std::move(cpp);
  if (chosen.refused && chosen.remarks.back().key == "submission.empty")
    chosen.remarks.back().with.at(0) += fmt::format("; {}", fmt::join(python_files(assignment), ", "));
  if (both) chosen.remarks.push_back({chosen.python ? "python.chosen" : "python.left_out", {}});
  return chosen;
}

Submission submission_at(const fs::path& path, const Assignment& assignment) {
  return submission_of(handed_at(path), assignment);
}

Result grade(const Assignment& assignment, const Submission& submission, const Sandbox& sandbox,
             const GradeOptions& options) {
  return Grading(assignment, submission, sandbox, options).run();
}

}  // namespace coursework
