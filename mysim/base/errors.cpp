#include "mysim/base/errors.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <ios>
#include <iostream>
#include <new>
#include <stdexcept>
#include <system_error>

#include "mysim/base/text.h"
#include "mysim/base/this_process.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

/// Turns "filesystem error: cannot ...: No space ... [/a/b]" into "/a/b: No space left on device; expected ...".
std::string path_message(const fs::filesystem_error& error) {
  const std::string reason = error.code().message();
  std::string path = error.path1().string();
  const char* temporary = std::getenv("TMPDIR");
  // the standard library reports no path if TMPDIR is missing
  if (temporary && *temporary && (path.empty() || path == temporary))
    return fmt::format("TMPDIR {}: {}; expected a folder for temporary files that can be written to", temporary,
                       reason);
  if (!error.path2().empty()) path += " -> " + error.path2().string();
  const std::errc code = static_cast<std::errc>(error.code().value());
  // unfinished results are in hidden folders: the message names the visible folder above them, on the same disk
  if (code == std::errc::no_space_on_device) path = path.substr(0, path.find("/."));
  const char* expected = code == std::errc::no_space_on_device      ? "; expected more free space on the disk"
                         : code == std::errc::permission_denied     ? "; expected a path that you may read and write"
                         : code == std::errc::read_only_file_system ? "; expected a place that can be written to"
                         : code == std::errc::filename_too_long     ? "; expected a shorter name"
                         : code == std::errc::not_a_directory       ? "; expected a folder"
                         : code == std::errc::is_a_directory        ? "; expected a file"
                         : code == std::errc::no_such_file_or_directory ? "; expected an existing path"
                         : code == std::errc::too_many_symbolic_link_levels
                             ? "; expected a path without a loop of links"
                             : "";
  return fmt::format("{}: {}{}", path, reason, expected);
}

}  // namespace

std::string in_words(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const fs::filesystem_error& error) {
    return path_message(error);
  } catch (const std::bad_alloc&) {
    return fmt::format("not enough memory: {} are free; expected fewer particles, samples or methods at a time",
                       format_bytes(free_memory()));
  } catch (const std::length_error&) {
    return "more memory required than any machine has; expected fewer particles or samples";
  } catch (const std::ios_base::failure&) {
    return "a file cannot be read or written; expected a readable file (not a folder) and free space on the disk";
  } catch (const std::system_error& error) {
    return error.code().message();
  } catch (const std::exception& error) {
    // removes the prefix of the JSON library, "[json.exception.type_error.302] "
    std::string what = error.what();
    if (what.starts_with("[json.exception."))
      what = "a JSON file has unexpected content:" + what.substr(std::min(what.find(']') + 1, what.size()));
    return what;
  } catch (...) {
    return "unknown error";
  }
}

int run_reporting_errors(std::string_view program, const std::function<int()>& work) {
  try {
    const int status = work();
    errno = 0;
    std::cout.flush();  // CLI11 writes --help and --version there
    if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw std::system_error(errno != 0 ? errno : EIO, std::generic_category());
    return status;
  } catch (...) {
    fmt::print(stderr, "{}: {}{}\n", program, !std::cout || std::ferror(stdout) != 0 ? "standard output: " : "",
               in_words(std::current_exception()));
    return 2;
  }
}

}  // namespace crosscheck
