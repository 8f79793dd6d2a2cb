// A lock file in the working folder, by flock(2).
#include "mysim/output_place.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "mysim/errors.h"
#include "mysim/manifest.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

/// Only there can a folder not be renamed, though it and its parent are ours.
bool is_mount_point(const fs::path& folder) {
  struct statx about {};
  if (statx(AT_FDCWD, folder.c_str(), AT_SYMLINK_NOFOLLOW, STATX_TYPE, &about) != 0) return false;
  return (about.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) && (about.stx_attributes & STATX_ATTR_MOUNT_ROOT);
}

bool is_within(const fs::path& inner, const fs::path& outer) {
  const fs::path relative = inner.lexically_relative(outer);
  return !relative.empty() && *relative.begin() != "..";
}

struct Holder {
  long process = 0;
  std::string since, command;
};

Holder holder_in(int handle) {
  char text[512];
  const ssize_t size = pread(handle, text, sizeof text, 0);
  Holder holder;
  if (size <= 0) return holder;
  const std::string all(text, static_cast<size_t>(size));
  const size_t first = all.find('\n'), second = all.find('\n', first + 1);
  if (first == std::string::npos || second == std::string::npos) return holder;
  holder.process = std::strtol(all.c_str(), nullptr, 10);
  holder.since = all.substr(first + 1, second - first - 1);
  holder.command = all.substr(second + 1, all.find('\n', second + 1) - second - 1);
  return holder;
}

bool same_file(int handle, const fs::path& file) {
  struct stat opened {
  }, named{};
  return fstat(handle, &opened) == 0 && stat(file.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

}  // namespace

OutputPlace::OutputPlace(const fs::path& given) : asked(given) {
  try {
    target = fs::weakly_canonical(fs::absolute(given));
    if (!target.has_filename()) target = target.parent_path();
    if (given.empty() || !target.has_filename() || (fs::exists(target) && !fs::is_directory(target))) refuse();
  } catch (const fs::filesystem_error&) {
    refuse();
  }
  beside = target.parent_path() / fmt::format(".{}.crosscheck", target.filename().string());
  inside = target / inner_work_folder;
}

bool OutputPlace::writable_beside() const { return access(target.parent_path().c_str(), W_OK | X_OK) == 0; }

bool OutputPlace::exchangeable() const {
  if (!writable_beside()) return false;
  std::error_code error;
  if (!fs::exists(target, error)) return true;
  // a shell that stands in it would be left in a folder without a name
  const fs::path here = fs::current_path(error);
  return !is_mount_point(target) && (error || !is_within(here, target));
}

void OutputPlace::refuse(const std::string& why) const {
  throw InputError(fmt::format("--out {}: {}", asked.string(),
                               why.empty() ? "expected a folder that can be made and written to" : why));
}

OutputLock::OutputLock(const OutputPlace& place, const std::string& command) : process_(getpid()) {
  std::error_code error;
  for (fs::path above = place.target.parent_path(); above.has_relative_path() && !fs::exists(above, error);
       above = above.parent_path())
    made_.push_back(above);
  fs::create_directories(place.target.parent_path(), error);
  work_ = place.writable_beside() ? place.beside : place.inside;
  const fs::path file = work_ / "lock";
  // one that was killed lets go when the processes that it had started are gone too, which is soon
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
    fs::create_directories(work_, error);
    handle_ = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (handle_ < 0 && errno == ENOENT && std::chrono::steady_clock::now() < patience) continue;  // gone just now
    if (handle_ < 0) place.refuse();
    if (flock(handle_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      const Holder holder = holder_in(handle_);
      close(handle_);
      const bool alive = holder.process > 0 && (kill(static_cast<pid_t>(holder.process), 0) == 0 || errno == EPERM);
      if (!alive && std::chrono::steady_clock::now() < patience) continue;
      place.refuse(holder.process > 0
                       ? fmt::format("process {} (crosscheck {}) has been writing into it since {}; wait "
                                     "for it, or give another folder",
                                     holder.process, holder.command, holder.since)
                       : "another process is writing into it; wait for it, or give another folder");
    }
    if (same_file(handle_, file)) break;
    close(handle_);  // that of one who ended in between
  }
  const std::string text = fmt::format("{}\n{}\n{}\n", getpid(), present_time(), command);
  if (ftruncate(handle_, 0) != 0 || pwrite(handle_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
    const int why = errno;
    unlink(file.c_str());
    close(handle_);
    fs::remove(work_, error);
    place.refuse(fmt::format("cannot be written to: {}", std::strerror(why)));
  }
}

OutputLock::~OutputLock() {
  if (own()) {
    std::error_code ignored;
    fs::remove(work_ / "lock", ignored);
    fs::remove(work_, ignored);  // unless something is left in it
    for (const fs::path& above : made_) fs::remove(above, ignored);
  }
  close(handle_);
}

bool OutputLock::own() const { return process_ == getpid(); }

}  // namespace crosscheck
