#include "tests/coursework/grader/commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <random>
#include <thread>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "mysim/base/json.h"
#include "mysim/base/names.h"
#include "mysim/base/output_folder.h"
#include "mysim/base/progress.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/class.h"
#include "tests/coursework/grader/formats.h"
#include "tests/coursework/grader/grade.h"
#include "tests/coursework/grader/gradebook.h"
#include "tests/coursework/grader/handout.h"
#include "tests/coursework/grader/pack.h"
#include "tests/coursework/grader/python.h"
#include "tests/coursework/grader/result.h"
#include "tests/coursework/grader/rubric.h"

namespace coursework {
namespace fs = std::filesystem;
using crosscheck::InputError;
namespace {

std::uint64_t fresh_seed() { return std::random_device()() % 1000000000; }

constexpr auto seed_file = "seed.txt";

/// Sets the seed of the hidden tests: the given seed, otherwise one derived from the lecturer's secret, otherwise a
/// fresh one, which is printed.
void choose_seed(const GradeCommand& command, GradeOptions& options) {
  std::string secret;
  if (const char* named = std::getenv("CROSSCHECK_SECRET")) secret = named;
  if (!command.secret_file.empty()) secret = secret_in(command.secret_file);
  if (command.seed) {
    options.seed = *command.seed;
  } else if (!secret.empty()) {
    options.seed = crosscheck::Fnv1a::of(secret);
    options.secret = true;
  } else if (command.all) {
    // the seed is kept in a file, so that all submissions of a class and a resumed run use the same one
    const fs::path kept = crosscheck::path_inside(command.out, seed_file);
    options.seed = fs::exists(kept) ? std::strtoull(content_of_file(kept).c_str(), nullptr, 10) : fresh_seed();
  } else {
    options.seed = fresh_seed();
  }
}

Texts texts_of(const fs::path& folder, const std::string& name, const std::string& language) {
  const fs::path file = folder / fmt::format("{}.{}.txt", name, language);
  if (!fs::exists(file)) throw InputError(fmt::format("--lang {}: there is no {}", language, file.string()));
  return Texts::read(file.string());
}

/// Verifies that the sandbox hides the secrets. A sandbox that shares the file system hides only private folders.
void require_hidden(const Assignment& assignment, const GradeCommand& command, const Sandbox& sandbox) {
  if (sandbox.name() == "bare") return;
  std::vector<std::pair<fs::path, fs::path>> secrets;  // a protected path, and the folder that would have to be private
  for (const char* secret : {"tests.cpp", "solution", "mistakes.txt"})
    secrets.emplace_back(assignment.folder() / secret, folder_of_coursework());
  if (!command.secret_file.empty())
    secrets.emplace_back(command.secret_file, fs::absolute(command.secret_file).parent_path());
  // other students' work
  if (command.all) secrets.emplace_back(command.submission, command.submission);
  for (const auto& [secret, folder] : secrets)
    if (sees(sandbox, secret))
      throw InputError(fmt::format("lane {}: a submission could read {}; make the folder private first: chmod 0700 {}",
                                   sandbox.name(), secret.string(), folder.string()));
}

/// Reports progress: the compilers, the tests one by one, and the search for causes.
void tell(std::unique_ptr<crosscheck::Progress>& progress, const Result& result) {
  if (result.complete) return;
  const char* next = progress ? "testing the submission" : "compiling the submission";
  if (!progress) progress = std::make_unique<crosscheck::Progress>(static_cast<int>(result.tests.size()) + 1);
  progress->begin(next);
}

void grade_all(const Assignment& assignment, const GradeCommand& command, const Sandbox& sandbox,
               const GradeOptions& options, const std::vector<Handed>& submissions, const Rubric& rubric) {
  const std::set<std::string> only = tests_named(assignment, command.only);
  std::optional<Gradebook> gradebook;
  if (!command.gradebook.empty())
    gradebook.emplace(command.gradebook, command.roster, command.column, assignment, points_of(assignment, rubric));
  const fs::path out = command.out;
  crosscheck::ResumableOutput folder(out, "grade " + std::string(assignment.name));
  std::vector<std::string> files{"table.csv", "table.txt", "statistics.csv", "class.html"};
  if (gradebook) files.emplace_back("gradebook.csv");
  for (const Handed& entry : submissions)
    for (const char* ending : {".json", ".html"}) files.push_back(file_name_for(entry.name) + ending);
  const bool keeps_seed = !command.seed && !options.secret;
  if (keeps_seed) files.emplace_back(seed_file);
  folder.announce(files);
  if (keeps_seed) crosscheck::write_file(out / seed_file, fmt::format("{}\n", options.seed));
  const std::vector<GradedSubmission> all = grade_class(assignment, submissions, sandbox, options, out, rubric, only);
  crosscheck::write_file(out / "table.csv", class_csv(assignment, all));
  crosscheck::write_file(out / "table.txt", class_text(assignment, all));
  crosscheck::write_file(out / "statistics.csv", statistics_csv(all));
  crosscheck::write_file(out / "class.html", class_page(assignment, all, options.common));
  std::vector<std::string> unmatched;
  if (gradebook) {
    unmatched = gradebook->fill(assignment, submissions, all, options.common);
    crosscheck::write_file(out / "gradebook.csv", gradebook->text());
  }
  folder.finish();
  if (only.empty()) fmt::print("{}", class_text(assignment, all));
  for (const GradedSubmission& one : all)
    for (const std::string& test : one.moved) fmt::print("{}: {}\n", one.result.submission, test);
  if (!only.empty())
    fmt::print("points changed in {} of {} submissions\n",
               std::ranges::count_if(all, [](const auto& one) { return !one.moved.empty(); }), all.size());
  for (const std::string& line : unmatched) fmt::print(stderr, "crosscheck: gradebook: {}\n", line);
}

/// File names by which the folder of a class is recognised; empty for whole programs.
std::vector<std::string> class_files(const Assignment& assignment) {
  std::vector<std::string> files = wanted_files(assignment);
  if (has_python(assignment))
    for (std::string& file : python_files(assignment)) files.push_back(std::move(file));
  return files;
}

/// The submissions of a class; prints which other entries of the folder are skipped.
std::vector<Handed> class_in(const std::string& folder) {
  std::vector<std::string> skipped;
  std::vector<Handed> submissions = submissions_in(folder, &skipped);
  if (!skipped.empty())
    fmt::print(stderr, "crosscheck: {}: skipped, left by an operating system or Git: {}\n", folder,
               fmt::join(skipped, ", "));
  if (submissions.empty()) fmt::print(stderr, "crosscheck: {}: no submissions found; nothing was graded\n", folder);
  return submissions;
}

}  // namespace

std::string secret_in(const std::string& file) {
  std::string line = content_of_file(file);
  line.erase(std::min(line.find('\n'), line.size()));
  line.erase(line.find_last_not_of(" \t\r") + 1);
  if (line.empty()) throw InputError(fmt::format("--secret {}: expected a line of text", file));
  return line;
}

int grade_command(const GradeCommand& given) {
  GradeCommand command = given;
  const auto is_assignment = [](const std::string& word) {
    return std::ranges::any_of(assignments(), [&](const Assignment& one) { return one.name == word; });
  };
  if (!is_assignment(command.assignment) && is_assignment(command.submission))
    throw InputError(fmt::format("grade: '{0}' is no assignment; did you mean `crosscheck grade {1} {0}`?",
                                 command.assignment.substr(0, 60), command.submission));
  const Assignment& assignment = find_assignment(command.assignment);
  if (command.all && command.out.empty()) command.out = "out/grade/" + command.assignment;
  GradeOptions options;
  options.common = texts_of(folder_of_coursework() / "check", "common", command.language);
  options.own = texts_of(assignment.folder(), "texts", command.language);
  options.engines = command.engines;
  options.jobs = std::max(1u, std::thread::hardware_concurrency());
  const Format& format = find_format(command.format);
  if (const std::string layout = command.all ? "" : class_layout(command.submission, class_files(assignment));
      !layout.empty())
    throw InputError(
        fmt::format("{}: this looks like a class of {} submissions ({}); add --all to grade each of them, or name the "
                    "folder of one",
                    command.submission, submissions_in(command.submission).size(), layout));
  const Submission submission = command.all ? Submission() : submission_at(command.submission, assignment);
  const std::vector<Handed> handed =
      command.all ? class_in(command.submission)
                  : std::vector<Handed>{{submission.name, {}, "", {{without_archive_ending(submission.name)}}}};
  if (handed.empty()) return 1;
  const Rubric rubric =
      command.rubric.empty() ? Rubric() : read_rubric(command.rubric, assignment, handed, command.all);
  choose_seed(command, options);
  const std::unique_ptr<Sandbox> sandbox = choose_sandbox(command.sandbox, command.no_sandbox);
  fmt::print(stderr, "lane {}: {}\n", sandbox->name(), sandbox->says());
  require_hidden(assignment, command, *sandbox);
  umask(077);  // results are written while submissions run, and must not be readable by others
  if (command.all) {
    grade_all(assignment, command, *sandbox, options, handed, rubric);
    return 0;
  }

  std::unique_ptr<crosscheck::Progress> progress;
  options.on_progress = [&](Result result) {
    tell(progress, result);
    rubric.apply(result);
    if (!command.out.empty()) crosscheck::write_file(command.out, format.write(result, options.common));
    if (!command.report.empty())
      crosscheck::write_file(command.report, page_of(result, options.common, options.own,
                                                     fs::exists(command.engines) ? command.charts : ""));
  };
  Result result = grade(assignment, submission, *sandbox, options);
  rubric.apply(result);
  progress.reset();
  if (command.out.empty())
    fmt::print("{}", format.write(result, options.common));
  else
    fmt::print("{}\n", total_of(result, options.common));
  return 0;
}

int list_command(bool json) {
  auto list = crosscheck::Json::array();
  for (const Assignment& assignment : assignments()) {
    if (json)
      list.push_back({{"name", assignment.name}, {"what", assignment.title}});
    else
      fmt::print("{:<38} {}\n", assignment.name, assignment.title);
  }
  if (json) fmt::print("{}\n", crosscheck::dump(list, 2));
  return 0;
}

namespace {

std::string secret_of(const AssignmentCommand& command) {
  if (!command.secret_file.empty()) return secret_in(command.secret_file);
  std::random_device device;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", device(), device(), device(), device());
}

}  // namespace

int assignment_command(const AssignmentCommand& command) {
  const Assignment& assignment = find_assignment(command.assignment);
  if (!command.check.empty()) return rehearse(assignment, command.check) ? 0 : 1;
  if (command.out.empty()) throw crosscheck::InputError("assignment: expected --out FOLDER, or --check FILE.zip");
  if (command.pack.empty()) {
    crosscheck::OutputFolder folder(command.out, "assignment " + std::string(assignment.name));
    (command.language == "python" ? write_python_handout : write_handout)(assignment, folder.path());
    folder.finish();
  } else {
    write_package(assignment, secret_of(command), command.out);
  }
  fmt::print("{}: {}\n", command.out, assignment.title);
  return 0;
}

}  // namespace coursework
