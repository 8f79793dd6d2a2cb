// Finds the compiler and the cache.
#include "tests/coursework/grader/compiler.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/fnv.h"
#include "mysim/temporary_folder.h"

namespace coursework {
namespace fs = std::filesystem;
using crosscheck::InputError;
namespace {

fs::path find_compiler() {
  if (const char* named = std::getenv("CXX"); named && named[0] == '/') return named;
  std::istringstream path(std::getenv("PATH") ? std::getenv("PATH") : "/usr/bin");
  std::vector<fs::path> folders;
  for (std::string folder; std::getline(path, folder, ':');) folders.push_back(folder);
  for (const char* name : {"g++", "clang++", "c++"})
    for (const fs::path& folder : folders) {
      // a wrapper of this user's is none that a lane can see
      if (folder.string().find("ccache") != std::string::npos || access((folder / name).c_str(), X_OK) != 0) continue;
      const fs::path real = fs::canonical(folder / name);  // lanes show /usr, not /etc/alternatives
      return real.filename().string().find("++") != std::string::npos ? real : folder / name;
    }
  throw InputError("no C++ compiler found; expected g++ or clang++ on the PATH");
}

fs::path cache_folder() {
  if (const char* named = std::getenv("CROSSCHECK_CACHE"); named && *named) return fs::absolute(named) / "coursework";
  if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache/crosscheck/coursework";
  return fs::temp_directory_path() / fmt::format("crosscheck-coursework-{}", getuid());
}

}  // namespace

std::string key_of(const std::string& content) {
  // twice 64 bits: contents are ours, so nobody looks for two that collide
  return fmt::format("{:016x}{:016x}", crosscheck::Fnv1a::of(content), crosscheck::Fnv1a::of(content + "/"));
}

Compiler::Compiler() : cache_(cache_folder()) {
  const fs::path program = find_compiler();
  // lanes set LANG to C, so that messages are in English; no fused multiply-add: the same numbers on every machine
  command_ = {program.string(), "-w", "-ffp-contract=off", "-fno-diagnostics-show-caret", "-fdiagnostics-color=never"};
  fingerprint_ = fmt::format("{} {}", fmt::join(command_, " "), fs::file_size(program));
  crosscheck::require_writable(cache_);
  // what is in it is run: it must be nobody else's
  struct stat info {};
  if (stat(cache_.c_str(), &info) != 0 || info.st_uid != geteuid())
    throw InputError(
        fmt::format("{}: belongs to another user; name another folder in CROSSCHECK_CACHE", cache_.string()));
  fs::permissions(cache_, fs::perms(0700));
}

fs::path Compiler::cached(const std::string& key, const std::string& ending,
                          const std::function<void(const fs::path&)>& make) const {
  const fs::path file = cache_ / (key + ending);
  if (fs::exists(file)) return file;
  const crosscheck::TemporaryFolder scratch("build");
  const fs::path made = scratch.path / ("made" + ending);
  make(made);
  // under another name first
  const fs::path temporary = cache_ / (scratch.path.filename().string() + ending);
  fs::copy_file(made, temporary);
  fs::rename(temporary, file);
  return file;
}

void compile_ours(const Lane& trusted, const std::vector<std::string>& command, const fs::path& writable,
                  const std::string& what) {
  const End end = trusted.run({.command = command, .writable = writable, .limits = compile_limits});
  if (end.how == End::How::cpu || end.how == End::How::wall)
    throw std::runtime_error(fmt::format("{}: compiling it took more than {:.0f} s ({:.0f} s of CPU)", what,
                                         compile_limits.wall, compile_limits.cpu));
  if (end.how != End::How::exited || end.code != 0)
    throw std::runtime_error(fmt::format("{} does not compile:\n{}", what, end.chatter));
}

}  // namespace coursework
