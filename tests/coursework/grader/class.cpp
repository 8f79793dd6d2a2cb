// Many submissions side by side, and their table.
#include "tests/coursework/grader/class.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>

#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/fnv.h"
#include "mysim/progress.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/parallel.h"
#include "tests/coursework/grader/text_format.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

/// What results depend on beside the submission: this program, the assignment, the lane, the seed and the language.
std::string surroundings_of(const Assignment& assignment, const Lane& lane, const GradeOptions& options) {
  std::vector<fs::path> files = {fs::read_symlink("/proc/self/exe")};
  for (const fs::path& folder : {assignment.folder(), folder_of_coursework() / "check"})
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin() + 1, files.end());
  std::string all = fmt::format("{} {} {} {}\n", options.seed, options.secret, options.common.of("total"), lane.name());
  for (const fs::path& file : files)
    all += fmt::format("{} {:016x}\n", file.filename().string(), crosscheck::Fnv1a::of(content_of_file(file)));
  return all;
}

std::string fingerprint_of(const Submission& submission, const std::string& surroundings) {
  std::string all = surroundings;
  for (const auto& [name, content] : submission.files) all += fmt::format("{} {}\n{}", name, content.size(), content);
  for (const auto& [name, why] : submission.missing) all += fmt::format("{} {}\n", name, why.key);
  for (const Remark& remark : submission.remarks) all += remark.key + "\n";
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

std::vector<std::pair<std::string, double>> by_part(const Assignment& assignment, const Result& result) {
  std::vector<std::pair<std::string, double>> sums;
  for (const Part& part : assignment.parts) {
    sums.emplace_back(part.name, 0);
    for (const TestResult& test : result.tests)
      if (test.part == part.name) sums.back().second += test.earned;
  }
  return sums;
}

std::string quoted(const std::string& text) {
  // spreadsheets take what begins like this for a formula
  const bool formula = !text.empty() && std::string("=+-@").find(text[0]) != std::string::npos;
  if (!formula && text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string safe = formula ? "\"'" : "\"";
  for (const char c : text) safe += c == '"' ? std::string("\"\"") : std::string(1, c);
  return safe + "\"";
}

std::string remark_of(const Graded& one) {
  if (!one.failure.empty()) return "not graded: " + printable(one.failure);
  return one.result.preflight.empty() ? "" : printable(one.result.preflight.front());
}

}  // namespace

std::string file_name_for(const std::string& submission) {
  const std::string plain = crosscheck::file_name_of(submission);
  // names in other scripts would all become the same dashes
  if (plain == submission) return plain;
  return fmt::format("{}-{:08x}", plain, crosscheck::Fnv1a::of(submission) & 0xffffffffu);
}

std::vector<Graded> grade_class(const Assignment& assignment, const fs::path& folder, const Lane& lane,
                                const GradeOptions& options, const fs::path& out) {
  if (!fs::is_directory(folder))
    throw crosscheck::InputError(fmt::format("{}: expected a folder of submissions", folder.string()));
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string()[0] != '.') entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  crosscheck::require_writable(out);
  std::vector<Graded> all(entries.size());
  const std::string surroundings = surroundings_of(assignment, lane, options);
  std::mutex speaking;
  std::size_t done = 0;
  int graded = 0;
  const auto begun = std::chrono::steady_clock::now();
  in_parallel(entries.size(), options.jobs, [&](std::size_t i) {
    Graded& one = all[i];
    one.result.submission = entries[i].filename().string();
    const fs::path base = out / file_name_for(one.result.submission);
    bool known = false;
    try {
      // in a folder that students share, a link would be graded as somebody's who did not write it
      if (fs::is_symlink(entries[i])) throw std::runtime_error("it is a link to something else");
      const Submission submission = read_submission(entries[i], files_asked_for(assignment));
      const std::string fingerprint = fingerprint_of(submission, surroundings);
      known = finished(base.string() + ".json", std::string(assignment.name), fingerprint, one.result) &&
              fs::exists(base.string() + ".html");
      if (!known) {
        GradeOptions mine = options;
        mine.jobs = 1;
        mine.so_far = [&](const Result& result) { write_result(base.string() + ".json", result, fingerprint); };
        one.result = grade(assignment, submission, lane, mine);
        crosscheck::write_file(base.string() + ".html", page_of(one.result, options.common, options.own));
      }
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
            ? fmt::format(", about {} left", crosscheck::rough_duration(elapsed / graded * static_cast<double>(left)))
            : "");
  });
  return all;
}

std::string class_csv(const Assignment& assignment, const std::vector<Graded>& all) {
  std::string text = "submission,points [1]";
  for (const Part& part : assignment.parts) text += fmt::format(",{} [1]", part.name);
  text += ",remark\n";
  for (const Graded& one : all) {
    // no result is no zero: the cells stay empty
    const bool graded = one.failure.empty();
    text += quoted(one.result.submission) + "," + (graded ? points_text(one.result.earned()) : "");
    for (const auto& [part, sum] : by_part(assignment, one.result)) text += "," + (graded ? points_text(sum) : "");
    text += "," + quoted(remark_of(one)) + "\n";
  }
  return text;
}

std::string class_text(const Assignment& assignment, const std::vector<Graded>& all) {
  std::size_t width = 10;
  for (const Graded& one : all) width = std::max(width, one.result.submission.size());
  std::string text = fmt::format("{:<{}} {:>7}", "submission", width, "points");
  for (const Part& part : assignment.parts) text += fmt::format(" {:>12}", part.name);
  text += "  remark\n";
  for (const Graded& one : all) {
    const bool graded = one.failure.empty();
    text += fmt::format("{:<{}} {:>7}", printable(one.result.submission), width,
                        graded ? points_text(one.result.earned()) : "-");
    for (const auto& [part, sum] : by_part(assignment, one.result))
      text += fmt::format(" {:>12}", graded ? points_text(sum) : "-");
    text += "  " + remark_of(one) + "\n";
  }
  return text;
}

}  // namespace coursework
