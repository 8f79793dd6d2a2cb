// A program that is fed through its stdin while it runs.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "report/run_program.h"

namespace crosscheck {

class FedProgram {
 public:
  /// Starts argv[0] (looked up in PATH); what it says on stdout is lost. Throws std::runtime_error if that is not
  /// possible.
  explicit FedProgram(const std::vector<std::string>& argv);
  /// Ends it, where it was not told that this was all.
  ~FedProgram();
  FedProgram(const FedProgram&) = delete;
  FedProgram& operator=(const FedProgram&) = delete;

  /// False where it takes no more, as it has ended.
  bool feed(const void* data, size_t bytes);
  /// Says that this was all, waits, and hands back its exit status and its stderr.
  ProgramResult finish();

 private:
  pid_t child_ = 0;
  int feed_ = -1, err_ = -1;
};

}  // namespace crosscheck
