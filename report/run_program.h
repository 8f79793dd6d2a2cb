// Runs another program without a shell and hands back its exit status and all it wrote.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crosscheck {

struct ProgramResult {
  int status = 0;   // exit code; 128 + signal number if a signal ended it
  std::string err;  // all of stderr
  std::string out;  // all of stdout
};

/// Runs argv[0] (looked up in PATH) in the folder cwd with stdin empty, in the environment of
/// program_environment(extra_env). Throws std::runtime_error if the program cannot be started.
ProgramResult run_program(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
                          const std::vector<std::string>& extra_env = {});

/// Whether a program of this name is in PATH.
bool on_path(const std::string& program);

/// The end of what a program said.
std::string last_lines(const std::string& text, int count);

}  // namespace crosscheck
