#include "tests/coursework/grader/class.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "mysim/base/csv.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "mysim/base/pattern.h"
#include "mysim/base/progress.h"
#include "mysim/base/text.h"
#include "tests/coursework/check/plot.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/formats.h"
#include "tests/coursework/grader/parallel.h"
#include "tests/coursework/grader/python.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

/// Fingerprint of this program and the assignment.
std::string fingerprint_of(const Assignment& assignment) {
  std::vector<fs::path> files = {fs::read_symlink("/proc/self/exe")};
  for (const fs::path& folder :
       {assignment.folder(), folder_of_coursework() / "check", folder_of_coursework() / "python"})
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin() + 1, files.end());
  std::string all;
  for (const fs::path& file : files)
    all += fmt::format("{} {:016x}\n", file.filename().string(), crosscheck::Fnv1a::of(content_of_file(file)));
  return fmt::format("{:016x}", crosscheck::Fnv1a::of(all));
}

/// Fingerprint of a submission, the seed, the language and the sandbox.
std::string fingerprint_of(const Submission& submission, const Sandbox& sandbox, const GradeOptions& options) {
  std::string all =
      fmt::format("{} {} {} {}\n", options.seed, options.secret, options.common.of("total"), sandbox.name());
  for (const auto& [name, content] : submission.files) all += fmt::format("{} {}\n{}", name, content.size(), content);
  for (const auto& [name, why] : submission.missing) all += fmt::format("{} {}\n", name, why.key);
  for (const Remark& remark : submission.remarks)
    all += fmt::format("{} {}\n", remark.key, fmt::join(remark.with, " "));
  for (const auto& [name, place] : submission.places) all += fmt::format("{} {}\n", name, place);
  for (const auto& [role, name] : submission.choice.classes) all += fmt::format("{} {}\n", role, name);
  // once a missing package is installed, the submission must be graded again
  if (submission.python) all += missing_python_package();
  return fmt::format("{:016x}", crosscheck::Fnv1a::of(all));
}

/// Complete result of an earlier grading, if its fingerprint ends with `ending`. Also returns that fingerprint.
std::optional<Result> earlier_result(const fs::path& file, const Assignment& assignment, const std::string& ending,
                                     std::string& fingerprint) {
  if (!fs::exists(file)) return {};
  try {
    Result result = result_from_json(content_of_file(file), file.string(), &fingerprint);
    if (result.complete && result.assignment == assignment.name && fingerprint.ends_with(ending)) return result;
  } catch (const std::exception&) {  // not a result file: the submission is graded again
  }
  return {};
}

std::string csv_of(const std::string& text) {
  const std::string safe = defused(text);
  return safe == text ? crosscheck::csv_field(text) : crosscheck::csv_quoted(safe);
}

/// Points of a test, the sum of public and hidden ones.
std::string points_at(const Result& result, const std::string& id) {
  double sum = 0;
  for (const TestResult& test : result.tests) {
    if (test.id == id && test.ungraded) return "not graded";
    if (test.id == id) sum += test.earned;
  }
  return points_text(sum);
}

/// Cells of a row of the table: name, id, late, total points and points per part, remark.
std::vector<std::string> cells_of(const Assignment& assignment, const GradedSubmission& one) {
  // cells of a submission that was not graded are empty instead of 0
  std::vector<std::string> cells = {one.result.submission, one.id, one.late ? "late" : "", points_in(one)};
  for (const Part& part : assignment.parts) cells.push_back(points_in(one, part.name));
  cells.push_back(remark_of(one));
  return cells;
}

/// The cause without the words "Likely cause:", for use below such a heading.
std::string bare(const std::string& cause, const Texts& common) {
  const std::string& text = common.of("cause");
  const std::string begin = text.substr(0, text.find('{'));
  return cause.starts_with(begin) ? cause.substr(begin.size()) : cause;
}

/// Counts of one test over the class. A test counts as passed if both its public and its hidden form are passed.
struct TestCount {
  std::string id, title;
  int passed = 0, failed = 0, ungraded = 0;
  std::map<std::string, int> causes;

  std::string most_frequent() const {
    const auto most = std::max_element(causes.begin(), causes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == causes.end() ? "" : most->first;
  }
  std::string frequent(const Texts* common = nullptr) const {
    const std::string cause = most_frequent();
    if (cause.empty()) return "";
    return fmt::format("{} x {}", causes.at(cause), common ? bare(cause, *common) : cause);
  }
};

std::vector<TestCount> counts_of(const std::vector<GradedSubmission>& all) {
  std::vector<TestCount> counts;
  for (const GradedSubmission& one : all) {
    std::map<std::string, std::vector<const TestResult*>> by_id;
    for (const TestResult& test : one.result.tests) by_id[test.id].push_back(&test);
    for (const TestResult& test : one.result.tests) {
      auto& same = by_id[test.id];
      if (same.empty()) continue;  // the test's other form has been counted together with this one
      auto count = std::find_if(counts.begin(), counts.end(), [&](const TestCount& c) { return c.id == test.id; });
      if (count == counts.end()) count = counts.insert(count, {.id = test.id, .title = test.title, .causes = {}});
      const auto any = [&](auto what) { return std::any_of(same.begin(), same.end(), what); };
      const bool open = any([](const TestResult* t) { return t->ungraded; });
      const bool bad = any([](const TestResult* t) { return !coursework::passed(*t); });
      ++(open ? count->ungraded : bad ? count->failed : count->passed);
      for (const TestResult* t : same)
        if (!t->cause.empty()) {
          ++count->causes[t->cause];
          break;
        }
      same.clear();
    }
  }
  return counts;
}

bool has_all_tests(const Result& result, const Assignment& assignment) {
  std::size_t tests = 0;
  for (const Test& test : assignment.tests) tests += (test.points > 0) + (test.hidden > 0);
  return result.tests.size() == tests;
}

/// The result with the regraded tests replaced.
Result with_tests(Result result, const Result& again, const std::set<std::string>& only) {
  result.preflight = again.preflight;
  for (TestResult& test : result.tests)
    for (const TestResult& other : again.tests)
      if (only.contains(test.id) && other.id == test.id && other.hidden == test.hidden) test = other;
  // the earlier remark may refer to a replaced test
  if (!again.remark.empty() || std::ranges::all_of(result.tests, passed)) result.remark = again.remark;
  return result;
}

std::string row(const std::vector<std::string>& cells, const char* kind = "td") {
  std::string text = "<tr>";
  for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", kind, cell);
  return text + "</tr>\n";
}

/// Header row of a table from comma-separated `words`.
std::string head(const std::string& words) {
  std::vector<std::string> cells;
  for (const std::string& word : crosscheck::split(words, ',')) cells.push_back(escaped(word.substr(word[0] == ' ')));
  return row(cells, "th");
}

std::string link_to(const GradedSubmission& one) {
  return fmt::format("<a href=\"{}.html\">{}</a>", escaped(file_name_for(one.result.submission)),
                     escaped(one.result.submission));
}

}  // namespace

std::string remark_of(const GradedSubmission& one) {
  if (!one.failure.empty()) return "not graded: " + printable(one.failure);
  for (const TestResult& test : one.result.tests)
    if (test.ungraded) return printable(fmt::format("{}: {}", test.id, test.said));
  return printable(one.result.remark);
}

std::string points_in(const GradedSubmission& one, std::string_view part) {
  double sum = 0;
  for (const TestResult& test : one.result.tests) {
    if (!part.empty() && test.part != part) continue;
    if (test.ungraded) return "";
    sum += test.earned;
  }
  return one.failure.empty() ? points_text(sum) : "";
}

std::string file_name_for(const std::string& submission) {
  std::string plain = crosscheck::file_name_of(submission);
  if (plain.starts_with('.')) plain[0] = '_';  // not a hidden file
  // class.html and crosscheck.json are reserved for the class (case is ignored, as on some disks); distinct names could
  // become equal when special characters are replaced, so changed names get a hash
  if (plain == submission && lower(plain) != "class" && lower(plain) != "crosscheck") return plain;
  return fmt::format("{}-{:08x}", plain, crosscheck::Fnv1a::of(submission) & 0xffffffffu);
}

std::set<std::string> tests_named(const Assignment& assignment, const std::vector<std::string>& patterns) {
  std::set<std::string> tests;
  for (const std::string& pattern : patterns) {
    bool any = false;
    std::vector<std::string> names;
    for (const Test& test : assignment.tests)
      for (const std::string& name : {std::string(test.id), std::string(test.part)}) {
        names.push_back(name);
        if (!crosscheck::glob_matches(pattern, name)) continue;
        tests.emplace(test.id);
        any = true;
      }
    if (!any)
      throw crosscheck::InputError(fmt::format("--only {}: no test or part of {} has this name{}", pattern,
                                               assignment.name, crosscheck::did_you_mean(pattern, names)));
  }
  return tests;
}

std::vector<GradedSubmission> grade_class(const Assignment& assignment, const std::vector<Handed>& submissions,
                                          const Sandbox& sandbox, const GradeOptions& options, const fs::path& out,
                                          const Rubric& rubric, const std::set<std::string>& only) {
  std::vector<GradedSubmission> all(submissions.size());
  std::vector<std::function<void()>> at_the_end(submissions.size());
  const std::string ours = fingerprint_of(assignment);
  GradeOptions mine = options, again = options;
  mine.jobs = again.jobs = 1;
  for (const Test& test : assignment.tests)
    if (only.contains(std::string(test.id))) again.parts.emplace(test.part);
  std::mutex speaking;
  std::size_t done = 0;
  int graded = 0;
  const auto begun = std::chrono::steady_clock::now();
  parallel_for(submissions.size(), options.jobs, [&](std::size_t i) {
    GradedSubmission& one = all[i];
    one.late = submissions[i].late;
    for (const Person& person : submissions[i].people)
      if (!person.id.empty()) one.id += (one.id.empty() ? "" : " + ") + person.id;
    const fs::path base = out / file_name_for(submissions[i].name);
    const auto write = [base](const Result& result, const std::string& fingerprint) {
      crosscheck::write_file(base.string() + ".json", to_json(result, fingerprint));
    };
    bool known = false;
    try {
      const Submission submission = submission_of(submissions[i], assignment);
      const std::string theirs = "-" + fingerprint_of(submission, sandbox, options);
      std::string fingerprint;
      std::optional<Result> earlier =
          earlier_result(base.string() + ".json", assignment, only.empty() ? ours + theirs : theirs, fingerprint);
      known = earlier && only.empty();
      if (known) {
        one.result = std::move(*earlier);
      } else if (earlier && has_all_tests(*earlier, assignment)) {
        one.result = with_tests(*earlier, grade(assignment, submission, sandbox, again), only);
        at_the_end[i] = [write, result = one.result, fingerprint] { write(result, fingerprint); };
        rubric.apply(*earlier);
      } else {
        earlier.reset();
        GradeOptions whole = mine;
        whole.on_progress = [&](const Result& result) { write(result, ours + theirs); };
        one.result = grade(assignment, submission, sandbox, whole);
      }
      one.failure = one.result.not_graded;
      if (const std::string unused = rubric.apply(one.result); !one.failure.empty()) one.failure += unused;
      for (const std::string& id : only)
        if (earlier && points_at(*earlier, id) != points_at(one.result, id))
          one.moved.push_back(fmt::format("{} {} -> {}", id, points_at(*earlier, id), points_at(one.result, id)));
    } catch (const std::exception& error) {
      one.failure = one.result.not_graded = error.what();
    }
    one.result.submission = submissions[i].name;
    const std::lock_guard<std::mutex> lock(speaking);
    ++done, graded += !known;
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    // the mean time per submission excludes submissions with an earlier result, which take no time
    const std::size_t left = submissions.size() - done;
    fmt::print(
        stderr, "{} of {}: {}{}{}\n", done, submissions.size(), submissions[i].name, known ? " (graded before)" : "",
        graded > 0 && left > 0
            ? fmt::format(", about {} left", crosscheck::format_duration(elapsed / graded * static_cast<double>(left)))
            : "");
  });
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (at_the_end[i]) at_the_end[i]();
    crosscheck::write_file(out / (file_name_for(submissions[i].name) + ".html"),
                           page_of(all[i].result, options.common, options.own));
  }
  return all;
}

std::string class_csv(const Assignment& assignment, const std::vector<GradedSubmission>& all) {
  std::string text = "submission,id,late,points [1]";
  for (const Part& part : assignment.parts) text += fmt::format(",{} [1]", part.name);
  text += ",remark\n";
  for (const GradedSubmission& one : all) {
    std::vector<std::string> cells = cells_of(assignment, one);
    for (std::string& cell : cells) cell = csv_of(cell);
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

std::string class_text(const Assignment& assignment, const std::vector<GradedSubmission>& all) {
  std::size_t width = 10;
  for (const GradedSubmission& one : all) width = std::max(width, one.result.submission.size());
  std::string text = fmt::format("{:<{}} {:>7}", "submission", width, "points");
  for (const Part& part : assignment.parts) text += fmt::format(" {:>12}", part.name);
  text += "  remark\n";
  for (const GradedSubmission& one : all) {
    const std::vector<std::string> cells = cells_of(assignment, one);
    text += fmt::format("{:<{}}", cells[0], width);
    for (std::size_t i = 3; i + 1 < cells.size(); ++i)
      text += fmt::format(" {:>{}}", cells[i].empty() ? "-" : cells[i], i == 3 ? 7 : 12);
    text += fmt::format("  {}{}\n", one.late ? "late; " : "", cells.back());
  }
  text += fmt::format("\n{:<6} {:>7} {:>7} {:>11}  most frequent cause\n", "test", "passed", "failed", "not graded");
  for (const TestCount& test : counts_of(all))
    text += fmt::format("{:<6} {:>7} {:>7} {:>11}  {}\n", test.id, test.passed, test.failed, test.ungraded,
                        test.frequent());
  return text;
}

std::string statistics_csv(const std::vector<GradedSubmission>& all) {
  std::string text = "test,title,passed [1],failed [1],not graded [1],most frequent cause,times [1]\n";
  for (const TestCount& test : counts_of(all)) {
    const std::string cause = test.most_frequent();
    text += fmt::format("{},{},{},{},{},{},{}\n", test.id, csv_of(test.title), test.passed, test.failed, test.ungraded,
                        csv_of(cause), cause.empty() ? 0 : test.causes.at(cause));
  }
  return text;
}

std::string class_page(const Assignment& assignment, const std::vector<GradedSubmission>& all, const Texts& common) {
  std::size_t graded = 0;
  std::map<std::string, std::vector<std::string>> whose;  // submissions by cause
  for (const GradedSubmission& one : all) {
    graded += one.failure.empty() && one.result.ungraded() == 0;
    std::set<std::string> causes;
    for (const TestResult& test : one.result.tests)
      if (!test.cause.empty() && test.cause != common.of("no_cause")) causes.insert(test.cause);
    for (const std::string& cause : causes) whose[cause].push_back(link_to(one));
  }
  std::vector<std::pair<std::string, std::vector<std::string>>> causes(whose.begin(), whose.end());
  std::stable_sort(causes.begin(), causes.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  const std::string title =
      escaped(common.fill("class.title", std::string(assignment.title), std::to_string(all.size()),
                          std::to_string(graded), std::to_string(all.size() - graded)));
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"{1}\"><head><meta charset=\"utf-8\"><title>{0}</title><style>body{{font:16px/1.5 "
      "system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem}}td,th{{text-align:left;padding:.2rem "
      ".8rem;vertical-align:top;border-bottom:1px solid #ddd}}</style></head><body>\n<h1>{0}</h1>\n",
      title, escaped(common.of("page.lang")));
  page += "<table>\n" + head(common.of("class.tests"));
  for (const TestCount& test : counts_of(all))
    page += row({escaped(test.id + " " + test.title), std::to_string(test.passed), std::to_string(test.failed),
                 std::to_string(test.ungraded), escaped(test.frequent(&common))});
  page += "</table>\n<p></p>\n<table>\n" + head(common.of("class.causes"));
  for (const auto& [cause, names] : causes)
    page +=
        row({escaped(bare(cause, common)), std::to_string(names.size()), fmt::format("{}", fmt::join(names, ", "))});
  page += "</table>\n";
  std::vector<std::string_view> parts;
  for (const Part& part : assignment.parts) parts.push_back(part.name);
  page += "<p></p>\n<table>\n" + head(common.fill("class.submissions", fmt::format("{}", fmt::join(parts, ", "))));
  for (const GradedSubmission& one : all) {
    std::vector<std::string> cells = cells_of(assignment, one);
    for (std::string& cell : cells) cell = escaped(cell);
    cells[0] = link_to(one);
    if (one.late) cells[2] = "&#10003;";
    page += row(cells);
  }
  return page + "</table>\n</body></html>\n";
}

}  // namespace coursework
