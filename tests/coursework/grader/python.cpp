#include "tests/coursework/grader/python.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <future>
#include <regex>
#include <set>

#include "mysim/base/files.h"
#include "mysim/base/text.h"
#include "tests/coursework/grader/parallel.h"
#include "tests/coursework/grader/spawn.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

std::string interpreter() {
  const char* named = std::getenv("CROSSCHECK_PYTHON");
  return named && *named ? named : "/usr/bin/python3";
}

/// Closes our copies of a program's pipe ends when the program has ended. Otherwise the program at the other ends of
/// the pipes would not notice.
struct AtEnd {
  Descriptor &from, &to;
  ~AtEnd() { from.reset(), to.reset(); }
};

std::string file_in_python(const Part& part) { return std::string(part.name) + ".py"; }

class PythonBuilder final : public Builder {
 public:
  PythonBuilder(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox)
      : assignment_(assignment), sandbox_(sandbox), cpp_(builder_for(assignment, trusted, sandbox)) {}

  fs::path ours(const std::string& part, const std::string& source) const override { return cpp_->ours(part, source); }

  std::map<std::string, Built> theirs(const Submission& submission, const fs::path& folder,
                                      unsigned jobs) const override {
    // the sandbox shows this folder, so it must not contain the programs
    const fs::path seen = folder / "python";
    for (const char* file : {"loader.py", "drawing_stubs.py"})
      crosscheck::write_file(seen / file, content_of_file(folder_of_coursework() / "python" / file));
    for (const auto& [name, content] : submission.files) try {
        crosscheck::write_file(seen / "own" / place(submission, name), content);
      } catch (const std::exception&) {
        // an archive may contain a file and a folder of the same name
      }
    std::vector<Built> built(assignment_.parts.size());
    parallel_for(built.size(), jobs, [&](std::size_t i) { built[i] = imported(i, submission, folder, seen); });
    std::map<std::string, Built> all;
    for (std::size_t i = 0; i < built.size(); ++i) all[std::string(assignment_.parts[i].name)] = built[i];
    return all;
  }

  Built checked(const Submission&, const std::string&, const fs::path&) const override { return {}; }
  std::string handed_in(const std::string& part) const override { return part + ".py"; }

 private:
  /// Path of a file among the student's modules. A part has its official name, even if the student's file has another.
  static fs::path place(const Submission& submission, const std::string& name) {
    const auto found = submission.places.find(name);
    return found == submission.places.end() ? fs::path(name) : fs::path(found->second).parent_path() / name;
  }

  static std::string folder_of(const fs::path& seen, const Submission& submission, const Part& part) {
    return (seen / "own" / place(submission, file_in_python(part))).parent_path().string();
  }

  Built imported(std::size_t i, const Submission& submission, const fs::path& folder, const fs::path& seen) const {
    const Part& part = assignment_.parts[i];
    const std::string file = file_in_python(part);
    if (const auto missing = submission.missing.find(file); missing != submission.missing.end())
      return {{}, missing->second, true};
    std::vector<std::string> folders = {folder_of(seen, submission, part)};
    std::string official;
    for (const Part& other : assignment_.parts) {
      if (&other < &part) official += fmt::format("{}={};", other.name, other.functions);
      const std::string at = folder_of(seen, submission, other);
      if (submission.places.count(file_in_python(other)) && std::ranges::count(folders, at) == 0) folders.push_back(at);
    }
    const std::string loader = (seen / "loader.py").string(), name(part.name), functions(part.functions);
    std::vector<std::string> command = {interpreter(), "-I", "-B", loader, "import", name, functions, official};
    command.insert(command.end(), folders.begin(), folders.end());
    const End end =
        sandbox_.run({.command = command, .readable = {seen}, .limits = {.cpu = import_cpu, .wall = 60 * import_cpu}});
    if (end.how == End::How::cpu || end.how == End::How::wall || end.how == End::How::idle)
      return {{}, {"python.time", {file}}};
    const std::string said = end.answers.substr(0, end.answers.find('\n'));
    const std::size_t blank = std::min(said.find(' '), said.size());
    const std::string kind = said.substr(0, blank), what = said.substr(std::min(blank + 1, said.size())).substr(0, 200);
    if (kind == "module" || kind == "undefined" || kind == "import") return {{}, {"python." + kind, {file, what}}};
    if (kind != "good") return {{}, {"python.ended", {file}}};
    command[4] = "serve";
    const std::string source = content_of_file(assignment_.folder() / "python.cpp");
    const fs::path program = cpp_->ours(name, fmt::format("#define PART {}\n{}", i, source)),
                   made = folder / (name + ".python");
    crosscheck::write_file(made,
                           fmt::format("{}\n{}\n{}\n", program.string(), seen.string(), fmt::join(command, "\n")));
    return {made};
  }

  const Assignment& assignment_;
  const Sandbox& sandbox_;
  std::unique_ptr<Builder> cpp_;
};

}  // namespace

bool has_python(const Assignment& assignment) { return !assignment.parts.front().functions.empty(); }

std::vector<std::string> python_files(const Assignment& assignment) {
  std::vector<std::string> files;
  for (const Part& part : assignment.parts) files.push_back(file_in_python(part));
  return files;
}

std::string missing_python_package() {
  const std::string python = interpreter();
  if (access(python.c_str(), X_OK) != 0) return "python3";
  const auto trusted = choose_sandbox("bare", true);
  const End end = trusted->run(
      {.command = {python, "-I", "-B", "-c", "import numpy"}, .limits = {.cpu = import_cpu, .wall = 60 * import_cpu}});
  return end.how == End::How::exited && end.code == 0 ? "" : "python3-numpy";
}

std::unique_ptr<Builder> python_builder(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox) {
  return std::make_unique<PythonBuilder>(assignment, trusted, sandbox);
}

bool is_python_program(const fs::path& program) { return program.extension() == ".python"; }

End run_python(const Sandbox& sandbox, const fs::path& program, const Job& job) {
  std::vector<std::string> command = crosscheck::split(content_of_file(program), '\n');
  command.pop_back();  // the empty string after the last line feed
  Job calls = job, asked{.limits = job.limits};
  calls.command = {command[0]}, calls.readable = {};
  calls.limits.idle = calls.limits.wall;  // the program waits for the interpreter
  asked.readable = {command[1]}, asked.command.assign(command.begin() + 2, command.end());
  asked.limits.cpu += import_cpu;
  Pipe to, from;
  calls.passed = {from.from.get(), to.to.get()};
  asked.passed = {to.from.get(), from.to.get()};
  std::future<End> answering = std::async(std::launch::async, [&] {
    const AtEnd closes{to.from, from.to};
    return sandbox.run(asked);
  });
  End end;
  {
    const AtEnd closes{from.from, to.to};
    end = choose_sandbox("bare", true)->run(calls);
  }
  End other = answering.get();
  const double cpu = end.cpu + other.cpu;
  if (end.how == End::How::cpu && end.cpu < calls.limits.cpu) {  // the interpreter ended first: returns how it ended
    other.answers = std::move(end.answers);
    end = std::move(other);
    const std::size_t last = end.answers.rfind('\n', end.answers.size() - 2) + 1;
    if (end.how != End::How::cpu && end.answers.compare(last, 4, "slow") == 0) end.answers.erase(last);
  } else {
    end.captured_output = std::move(other.captured_output);
  }
  end.cpu = cpu;
  return end;
}

std::string shown_python_exception(const std::string& text, const std::map<std::string, std::string>& files,
                                   bool hidden) {
  if (!hidden) return text;
  static const std::set<std::string> types = {
      "AssertionError", "AttributeError",    "IndexError",     "KeyError",         "MemoryError", "ModuleNotFoundError",
      "NameError",      "OSError",           "RecursionError", "RuntimeError",     "SystemExit",  "TypeError",
      "UFuncTypeError", "UnboundLocalError", "ValueError",     "ZeroDivisionError"};
  static const std::regex form("([^,]{1,60}), line ([0-9]{1,6}): ([A-Za-z]{1,30})(:.*)?");
  std::smatch found;
  if (!std::regex_match(text, found, form)) return "";
  const bool own = std::ranges::any_of(files, [&](const auto& file) { return base_name(file.first) == found[1]; });
  if (!own) return "";
  const std::string place = fmt::format("{}, line {}", found[1].str(), found[2].str());
  return types.count(found[3]) ? place + ": " + found[3].str() : place;
}

}  // namespace coursework
