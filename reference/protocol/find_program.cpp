// Which file is meant, and what of the name are options.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>

#include "mysim/errors.h"
#include "reference/protocol/exec_engine.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::optional<fs::path> file_named(const std::string& name) {
  if (name.empty()) return std::nullopt;
  const bool path_given = name.find('/') != std::string::npos;
  if (is_file(name) || (path_given && fs::is_directory(fs::path(name)))) return fs::absolute(name);
  if (path_given) return std::nullopt;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty() && is_file(fs::path(folder) / name)) return fs::absolute(fs::path(folder) / name);
  return std::nullopt;
}

double seconds_of(const std::string& text, const std::string& value) {
  char* end = nullptr;
  const double seconds = std::strtod(value.c_str(), &end);
  if (value.empty() || *end != '\0' || !std::isfinite(seconds) || !(seconds > 0))
    throw InputError(fmt::format("method exec:{}: timeout: expected seconds above zero, got '{}'", text, value));
  return std::min(seconds, 1e8);
}

}  // namespace

Program find_program(const std::string& text) {
  Program program;
  // the longest part of it that is a file: names may hold pluses, and values of options may hold slashes
  size_t end = text.size();
  std::optional<fs::path> found = file_named(text);
  while (!found && end > 0 && (end = text.rfind('+', end - 1)) != std::string::npos)
    found = file_named(text.substr(0, end));
  if (!found)
    throw InputError(
        fmt::format("method exec:{}: no such file; expected the path of a program, or a program in PATH", text));
  program.path = *found;
  if (fs::is_directory(program.path))
    throw InputError(fmt::format("method exec:{}: {} is a folder; expected a program", text, program.path.string()));
  if (access(program.path.c_str(), X_OK) != 0)
    throw InputError(fmt::format("method exec:{}: {} is not executable; expected a program (chmod +x makes it one)",
                                 text, program.path.string()));
  if (end == text.size()) return program;
  std::istringstream options(text.substr(end + 1));
  for (std::string option; std::getline(options, option, '+');) {
    if (option.starts_with("timeout="))
      program.timeout = seconds_of(text, option.substr(8));
    else
      program.options.push_back(option);
  }
  return program;
}

}  // namespace crosscheck
