// The compiler's verdict on a source, for tests of what must not compile. CMake names the compiler (CROSSCHECK_CXX) and
// the folders of headers (CROSSCHECK_INCLUDES) to the files that include this.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "mysim/base/process.h"

namespace crosscheck::testing_tools {

/// Checks the syntax of `file`; `options` come before the folders of headers.
inline ProgramResult check_syntax(const std::filesystem::path& file, const std::vector<std::string>& options) {
  std::vector<std::string> command = {CROSSCHECK_CXX, "-std=c++20", "-fsyntax-only"};
  command.insert(command.end(), options.begin(), options.end());
  std::istringstream folders(CROSSCHECK_INCLUDES);
  // the compiler's own folder is searched last, where it stands: named, its math.h is not found from cmath any more
  for (std::string folder; std::getline(folders, folder, '|');)
    if (folder != "/usr/include") command.insert(command.end(), {"-isystem", folder});
  command.insert(command.end(), {"-I", CROSSCHECK_SOURCE, file.string()});
  return run_program(command, ".", {});
}

}  // namespace crosscheck::testing_tools
