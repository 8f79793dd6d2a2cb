// Syntax check by the compiler, for tests of code that must not compile. For the files that include this header, CMake
// defines CROSSCHECK_CXX and CROSSCHECK_INCLUDES.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "mysim/base/process.h"

namespace crosscheck::testing_tools {

/// Checks the syntax of a file. `options` come before the include folders.
inline ProgramResult check_syntax(const std::filesystem::path& file, const std::vector<std::string>& options) {
  std::vector<std::string> command = {CROSSCHECK_CXX, "-std=c++20", "-fsyntax-only"};
  command.insert(command.end(), options.begin(), options.end());
  std::istringstream folders(CROSSCHECK_INCLUDES);
  // skips /usr/include, which the compiler searches last by default; naming it would move it forward, so that cmath
  // would no longer find math.h
  for (std::string folder; std::getline(folders, folder, '|');)
    if (folder != "/usr/include") command.insert(command.end(), {"-isystem", folder});
  command.insert(command.end(), {"-I", CROSSCHECK_SOURCE, file.string()});
  return run_program(command, ".", {});
}

}  // namespace crosscheck::testing_tools
