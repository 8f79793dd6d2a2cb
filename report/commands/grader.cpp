// Starts the grader, a separate program. Charts of a student's code are made here, because the grader links no other
// engine.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "mysim/base/installation.h"
#include "mysim/base/output_folder.h"
#include "mysim/base/process.h"
#include "mysim/base/text.h"
#include "report/commands/commands.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

fs::path grader() {
  const fs::path program = programs_folder() / "crosscheck-grade";
  if (access(program.c_str(), X_OK) != 0)
    throw std::runtime_error(fmt::format("{} cannot be started; build the target crosscheck_grader", program.string()));
  return program;
}

/// Value of an option, given as the next word or after =; empty if missing.
std::string option_value(const std::vector<std::string>& words, const std::string& option) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == option && i + 1 < words.size()) return words[i + 1];
    if (words[i].starts_with(option + "=")) return words[i].substr(option.size() + 1);
  }
  return "";
}

int grade_with_charts(std::vector<std::string> words, const fs::path& page) {
  const fs::path charts = page.parent_path() / (page.stem().string() + "-charts");
  OutputFolder folder(charts, "report");
  const fs::path engines = folder.path() / "steppers";
  const std::vector<std::string> more = {"--engines", engines.string(), "--charts",
                                         charts.filename().string() + "/index.html"};
  words.insert(words.end(), more.begin(), more.end());
  std::vector<std::string> command{grader().string()};
  command.insert(command.end(), words.begin(), words.end());
  std::fflush(nullptr);
  if (const int status = run_in_terminal(command); status != 0 || !fs::exists(engines)) return status;
  ReportOptions options;
  options.scenes = {"spring", "pendulum"};
  options.experiments = {"engines", "speed-accuracy", "stability", "relations"};
  options.methods = "explicit-euler,trapezoidal,rk4,symplectic-euler,bullet/deformable-explicit";
  std::vector<std::string> yours;
  for (const auto& entry : fs::directory_iterator(engines))
    if (entry.path().extension() != ".program") yours.push_back(entry.path().filename().string());
  std::sort(yours.begin(), yours.end());
  for (const std::string& part : yours) options.methods += ",exec:steppers/" + part;
  options.command_line = "crosscheck " + shell_join({words.data(), words.size() - more.size()});
  options.out = fs::absolute(charts);
  fs::current_path(folder.path());  // so that the names of methods are short relative paths
  fmt::print("charts of {}, compared with mysim and Bullet\n", fmt::join(yours, ", "));
  return report_command(options, folder);
}

}  // namespace

std::string grader_table() { return run_program({grader().string(), "manual"}, fs::current_path()).out; }

int grader_command(const std::vector<std::string>& words) {
  const bool of_class = std::find(words.begin(), words.end(), "--all") != words.end();
  if (const std::string page = option_value(words, "--report"); words[0] == "grade" && !page.empty() && !of_class)
    return grade_with_charts(words, page);
  std::vector<std::string> all = words;
  const fs::path program = grader();
  all.insert(all.begin(), program.string());
  std::vector<std::string> environment = program_environment();
  std::fflush(nullptr);
  execve(program.c_str(), c_strings(all).data(), c_strings(environment).data());
  throw std::runtime_error(fmt::format("{}: {}", program.string(), std::strerror(errno)));
}

void add_grader(CLI::App& app, Invocation&) {
  app.add_subcommand("grade", "grades a coursework submission, or a whole class with --all");
  app.add_subcommand("assignment", "writes the handout of an assignment, or its package for a grading service");
}

}  // namespace crosscheck
