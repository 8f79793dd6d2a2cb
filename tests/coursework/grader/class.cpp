// Grades side by side, goes on where it was stopped, counts.
#include "tests/coursework/grader/class.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <set>

#include "mysim/base/csv.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "mysim/base/progress.h"
#include "mysim/base/text.h"
#include "tests/coursework/check/plot.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/parallel.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

/// What results depend on beside the submission: this program, the assignment, the sandbox, the seed and the language.
std::string surroundings_of(const Assignment& assignment, const Sandbox& sandbox, const GradeOptions& options) {
  std::vector<fs::path> files = {fs::read_symlink("/proc/self/exe")};
  for (const fs::path& folder : {assignment.folder(), folder_of_coursework() / "check"})
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin() + 1, files.end());
  std::string all =
      fmt::format("{} {} {} {}\n", options.seed, options.secret, options.common.of("total"), sandbox.name());
  for (const fs::path& file : files)
    all += fmt::format("{} {:016x}\n", file.filename().string(), crosscheck::Fnv1a::of(content_of_file(file)));
  return all;
}

std::string fingerprint_of(const Submission& submission, const std::string& surroundings) {
  std::string all = surroundings;
  for (const auto& [name, content] : submission.files) all += fmt::format("{} {}\n{}", name, content.size(), content);
  for (const auto& [name, why] : submission.missing) all += fmt::format("{} {}\n", name, why.key);
  for (const Remark& remark : submission.remarks)
    all += fmt::format("{} {}\n", remark.key, fmt::join(remark.with, " "));
  for (const auto& [role, name] : submission.choice.classes) all += fmt::format("{} {}\n", role, name);
  return fmt::format("{:016x}", crosscheck::Fnv1a::of(all));
}

/// True when the file holds the whole result of the same grading.
bool finished(const fs::path& file, const std::string& assignment, const std::string& fingerprint, Result& result) {
  if (!fs::exists(file)) return false;
  try {
    std::string of_then;
    result = result_from_json(content_of_file(file), file.string(), &of_then);
    return result.complete && result.assignment == assignment && of_then == fingerprint;
  } catch (const std::exception&) {
    return false;  // a file of something else: graded anew
  }
}

void write_result(const fs::path& file, const Result& result, const std::string& fingerprint) {
  crosscheck::write_file(file, to_json(result, fingerprint));
}

/// A field of CSV. Spreadsheets take what begins like this for a formula, in the field and, where they part fields at
/// semicolons or tabs, behind these.
std::string quoted(const std::string& text) {
  std::string safe;
  bool begins = true;
  for (const char c : text) {
    if (begins && std::string_view("=+-@").find(c) != std::string_view::npos) safe += '\'';
    safe += c;
    begins = c == ';' || c == '\t' || c == '\r' || c == '\n' || (begins && (c == ' ' || c == '"'));
  }
  return safe == text ? crosscheck::csv_field(text) : crosscheck::csv_quoted(safe);
}

std::string remark_of(const GradedSubmission& one) {
  if (!one.failure.empty()) return "not graded: " + printable(one.failure);
  for (const TestResult& test : one.result.tests)
    if (test.ungraded) return printable(fmt::format("{}: {}", test.id, test.said));
  return one.result.preflight.empty() ? "" : printable(one.result.preflight.front());
}

/// Points of the tests of a part, of all parts where it is empty; nothing where any of them could not be graded.
std::string points_in(const GradedSubmission& one, std::string_view part = "") {
  double sum = 0;
  for (const TestResult& test : one.result.tests) {
    if (!part.empty() && test.part != part) continue;
    if (test.ungraded) return "";
    sum += test.earned;
  }
  return one.failure.empty() ? points_text(sum) : "";
}

/// A cause without "Likely cause:", below a heading that says so.
std::string bare(const std::string& cause, const Texts& common) {
  const std::string& text = common.of("cause");
  const std::string begin = text.substr(0, text.find('{'));
  return cause.starts_with(begin) ? cause.substr(begin.size()) : cause;
}

/// How all did in one test: public and hidden together, a test is passed by who passed both.
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
      if (same.empty()) continue;  // counted with its twin
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

std::string row(const std::vector<std::string>& cells, const char* kind = "td") {
  std::string text = "<tr>";
  for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", kind, cell);
  return text + "</tr>\n";
}

/// Of words with commas between them.
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

std::string file_name_for(const std::string& submission) {
  const std::string plain = crosscheck::file_name_of(submission);
  // class.html and crosscheck.json are the class's own; '/' and '?' become the same dash
  if (plain == submission && plain != "class" && plain != "crosscheck") return plain;
  return fmt::format("{}-{:08x}", plain, crosscheck::Fnv1a::of(submission) & 0xffffffffu);
}

std::vector<GradedSubmission> grade_class(const Assignment& assignment, const fs::path& folder, const Sandbox& sandbox,
                                          const GradeOptions& options, const fs::path& out) {
  if (!fs::is_directory(folder))
    throw crosscheck::InputError(fmt::format("{}: expected a folder of submissions", folder.string()));
  const std::vector<Handed> entries = submissions_in(folder);
  std::vector<GradedSubmission> all(entries.size());
  const std::string surroundings = surroundings_of(assignment, sandbox, options);
  std::mutex speaking;
  std::size_t done = 0;
  int graded = 0;
  const auto begun = std::chrono::steady_clock::now();
  parallel_for(entries.size(), options.jobs, [&](std::size_t i) {
    GradedSubmission& one = all[i];
    one.result.submission = entries[i].name;
    const fs::path base = out / file_name_for(one.result.submission);
    bool known = false;
    try {
      const Submission submission = submission_of(entries[i], assignment);
      const std::string fingerprint = fingerprint_of(submission, surroundings);
      known = finished(base.string() + ".json", std::string(assignment.name), fingerprint, one.result) &&
              fs::exists(base.string() + ".html");
      if (!known) {
        GradeOptions mine = options;
        mine.jobs = 1;
        mine.on_progress = [&](const Result& result) { write_result(base.string() + ".json", result, fingerprint); };
        one.result = grade(assignment, submission, sandbox, mine);
        crosscheck::write_file(base.string() + ".html", page_of(one.result, options.common, options.own));
      }
      one.failure = one.result.not_graded;
    } catch (const std::exception& error) {
      one.failure = error.what();
    }
    const std::lock_guard<std::mutex> lock(speaking);
    ++done, graded += !known;
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    // those that were graded before cost nothing; of the others that are to come nobody knows
    const std::size_t left = entries.size() - done;
    fmt::print(
        stderr, "{} of {}: {}{}{}\n", done, entries.size(), printable(one.result.submission),
        known ? " (graded before)" : "",
        graded > 0 && left > 0
            ? fmt::format(", about {} left", crosscheck::format_duration(elapsed / graded * static_cast<double>(left)))
            : "");
  });
  return all;
}

std::string class_csv(const Assignment& assignment, const std::vector<GradedSubmission>& all) {
  std::string text = "submission,points [1]";
  for (const Part& part : assignment.parts) text += fmt::format(",{} [1]", part.name);
  text += ",remark\n";
  for (const GradedSubmission& one : all) {
    // no result is no zero: the cells stay empty
    text += quoted(one.result.submission) + "," + points_in(one);
    for (const Part& part : assignment.parts) text += "," + points_in(one, part.name);
    text += "," + quoted(remark_of(one)) + "\n";
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
    const auto cell = [&](std::string_view part) {
      const std::string points = points_in(one, part);
      return points.empty() ? "-" : points;
    };
    text += fmt::format("{:<{}} {:>7}", printable(one.result.submission), width, cell(""));
    for (const Part& part : assignment.parts) text += fmt::format(" {:>12}", cell(part.name));
    text += "  " + remark_of(one) + "\n";
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
    text += fmt::format("{},{},{},{},{},{},{}\n", test.id, quoted(test.title), test.passed, test.failed, test.ungraded,
                        quoted(cause), cause.empty() ? 0 : test.causes.at(cause));
  }
  return text;
}

std::string class_page(const Assignment& assignment, const std::vector<GradedSubmission>& all, const Texts& common) {
  std::size_t graded = 0;
  std::string open;
  std::map<std::string, std::vector<std::string>> whose;  // by cause
  for (const GradedSubmission& one : all) {
    const bool whole = one.failure.empty() && one.result.ungraded() == 0;
    graded += whole;
    if (!whole) open += row({link_to(one), escaped(remark_of(one))});
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
  if (!open.empty()) page += "<h2>" + escaped(common.of("class.ungraded")) + "</h2>\n<table>\n" + open + "</table>\n";
  return page + "</body></html>\n";
}

}  // namespace coursework
