// Starting a program without a shell, and its end.
#pragma once

#include <spawn.h>

#include <string>
#include <vector>

namespace crosscheck {

/// What a program finds as its files when it starts.
struct FileActions {
  posix_spawn_file_actions_t list;
  FileActions() { posix_spawn_file_actions_init(&list); }
  ~FileActions() { posix_spawn_file_actions_destroy(&list); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
};

/// Starts argv[0] (looked up in PATH) in the environment of program_environment(extra_env). Throws std::runtime_error
/// that names it.
pid_t spawn(const std::vector<std::string>& argv, const FileActions& actions,
            const std::vector<std::string>& extra_env = {});

/// Waits for it: its exit code, or 128 + signal number if a signal ended it.
int end_of(pid_t child);

}  // namespace crosscheck
