// Locks the working folder, then installs the result by exchanging names, or by two renames.
#include "mysim/base/output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>

#include "mysim/base/errors.h"
#include "mysim/base/manifest.h"
#include "mysim/base/this_process.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

constexpr auto new_result = "new", old_result = "old";

bool is_there(const fs::path& path) { return fs::exists(fs::symlink_status(path)); }
bool is_folder(const fs::path& path) { return fs::is_directory(fs::symlink_status(path)); }

std::pair<dev_t, ino_t> identity(const fs::path& file) {
  struct stat about {};
  if (lstat(file.c_str(), &about) != 0) return {};
  return {about.st_dev, about.st_ino};
}

bool is_mount_point(const fs::path& folder) {
  struct statx about {};
  if (statx(AT_FDCWD, folder.c_str(), AT_SYMLINK_NOFOLLOW, STATX_TYPE, &about) != 0) return false;
  return (about.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) && (about.stx_attributes & STATX_ATTR_MOUNT_ROOT);
}

}  // namespace

void OutputLock::refuse(const std::string& why) const {
  throw InputError(fmt::format("--out {}: {}", requested.string(),
                               why.empty() ? "expected a folder that can be made and written to" : why));
}

void OutputLock::find_target() {
  target = fs::weakly_canonical(fs::absolute(requested));
  if (!target.has_filename()) target = target.parent_path();
  if (requested.empty() || !target.has_filename() || (fs::exists(target) && !fs::is_directory(target))) refuse();
  for (fs::path at = target; at.has_relative_path(); at = at.parent_path())
    if (fs::is_symlink(at))
      refuse(fmt::format("{} is a link to {}, which does not exist; create that folder, or give another one",
                         at.string(), fs::read_symlink(at).string()));
  work = target.parent_path() / fmt::format(".{}.crosscheck", target.filename().string());
}

void OutputLock::require_replaceable() const {
  const fs::path parent = target.parent_path();
  struct stat above {
  }, about{};
  const bool exists = lstat(target.c_str(), &about) == 0;
  if (access(parent.c_str(), W_OK | X_OK) != 0 || stat(parent.c_str(), &above) != 0)
    refuse(exists ? parent.string() + ", where the result is prepared, cannot be written to; give a folder inside"
                  : "");
  if (!exists) return;
  if (is_mount_point(target)) refuse("a mount point cannot be replaced by the next result; give a folder inside");
  const uid_t user = geteuid();
  if ((above.st_mode & S_ISVTX) && user != 0 && user != above.st_uid && user != about.st_uid)
    refuse("belongs to another user; give another folder");
}

OutputLock::OutputLock(const fs::path& given, const std::string& command) : requested(given), process_(getpid()) {
  std::error_code error;
  try {
    find_target();
  } catch (const fs::filesystem_error&) {
    refuse();
  }
  for (fs::path above = target.parent_path(); above.has_relative_path() && !fs::exists(above, error);
       above = above.parent_path())
    made_.push_back(above);
  fs::create_directories(target.parent_path(), error);
  require_replaceable();
  const fs::path file = work / "lock";
  // child processes of a killed writer hold its lock until they end
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
    struct stat about {};
    if (mkdir(work.c_str(), 0700) != 0 && errno == EEXIST && lstat(work.c_str(), &about) == 0 &&
        (!S_ISDIR(about.st_mode) || about.st_uid != geteuid()))
      refuse(work.string() + " is not a folder of yours; remove it, or give another folder");
    handle_ = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0666);
    const bool in_time = std::chrono::steady_clock::now() < deadline;
    if (handle_ < 0 && errno == ENOENT && in_time) continue;  // another process has just removed it
    if (handle_ < 0) refuse();
    if (flock(handle_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(handle_);
      std::ifstream in(file);
      pid_t holder = 0;
      std::string since, writes;
      if (!(in >> holder >> std::ws && std::getline(in, since) && std::getline(in, writes))) holder = 0;
      const bool alive = holder > 0 && (kill(holder, 0) == 0 || errno == EPERM);
      if (!alive && in_time) continue;
      refuse(holder > 0 ? fmt::format("process {} (crosscheck {}) has been writing into it since {}; wait for it, or "
                                      "give another folder",
                                      holder, writes, since)
                        : "another process is writing into it; wait for it, or give another folder");
    }
    if (fstat(handle_, &about) == 0 && identity(file) == std::pair(about.st_dev, about.st_ino)) break;
    close(handle_);  // the lock file of a process that has ended in the meantime
  }
  const std::string text = fmt::format("{}\n{}\n{}\n", getpid(), utc_now(), command);
  if (ftruncate(handle_, 0) != 0 || pwrite(handle_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
    const int why = errno;
    release();
    refuse(fmt::format("cannot be written to: {}", std::strerror(why)));
  }
}

void OutputLock::release() {
  std::error_code ignored;
  fs::remove(work / "lock", ignored);
  fs::remove(work, ignored);  // fails, as intended, if not empty
  for (const fs::path& above : made_) fs::remove(above, ignored);
  close(handle_);
}

OutputLock::~OutputLock() {
  if (own())
    release();
  else
    close(handle_);
}

bool OutputLock::own() const { return process_ == getpid(); }

namespace {

/// A free path for a user's file: its own path, or NAME.yours if that is taken or `other` is set.
fs::path free_path(const fs::path& root, const fs::path& path, bool other) {
  fs::path at = root;
  for (const fs::path& part : path.parent_path()) {
    at /= part;
    while (is_there(at) && !is_folder(at)) at += ".yours";
  }
  at /= path.filename();
  if (!other && !is_there(at)) return at;
  at += ".yours";
  const fs::path first = at;
  for (int n = 2; is_there(at); ++n) at = fs::path(first) += fmt::format("-{}", n);
  return at;
}

void move_file(const fs::path& from, const fs::path& to) {
  fs::create_directories(to.parent_path());
  fs::rename(from, to);
}

void keep_as_yours(const fs::path& root, const fs::path& path) { move_file(root / path, free_path(root, path, true)); }

void link_or_copy(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_hard_link(from, to, error);
  if (!error) return;
  fs::copy(from, to, fs::copy_options::copy_symlinks);
  if (fs::is_regular_file(fs::symlink_status(to))) fs::last_write_time(to, fs::last_write_time(from));
}

bool same_bytes(const fs::path& a, const fs::path& b) {
  if (!fs::is_regular_file(fs::symlink_status(a)) || !fs::is_regular_file(fs::symlink_status(b))) return false;
  if (fs::file_size(a) != fs::file_size(b)) return false;
  std::ifstream one(a, std::ios::binary), other(b, std::ios::binary);
  return std::equal(std::istreambuf_iterator<char>(one), {}, std::istreambuf_iterator<char>(other), {});
}

void remove_empty_above(const fs::path& root, const fs::path& path) {
  std::error_code error;
  for (fs::path at = path.parent_path(); !at.empty() && fs::remove(root / at, error); at = at.parent_path()) {
  }
}

void link_users_files(const fs::path& target, const std::optional<Manifest>& old, const fs::path& stage) {
  const std::vector<std::string> paths = paths_in(target);
  // links changed files of the earlier result last: their new names must not be those of other files
  for (const bool changed : {false, true})
    for (const std::string& path : paths) {
      if (changed != (old && old->names(path)) || (changed && old->ours(target, path))) continue;
      const bool folder = path.ends_with("/");
      if (folder && is_folder(stage / path)) continue;
      const fs::path to = free_path(stage, folder ? path.substr(0, path.size() - 1) : path, changed);
      fs::path above;
      for (const fs::path& part : (folder ? to : to.parent_path()).lexically_relative(stage)) {
        above /= part;
        if (is_there(stage / above)) continue;
        if (is_folder(target / above))
          fs::create_directory(stage / above, target / above);  // copies the permissions
        else
          fs::create_directory(stage / above);
      }
      if (!folder) link_or_copy(target / path, to);
    }
}

/// Empties a replaced folder: removes Crosscheck's files and those that `target` also has, and moves the others to
/// `target`.
void absorb(const fs::path& from, const fs::path& target) {
  const std::optional<Manifest> old = read_manifest(from);
  std::set<std::pair<dev_t, ino_t>> there;
  for (const std::string& path : paths_in(target)) there.insert(identity(target / path));
  for (const std::string& path : paths_in(from)) {
    const fs::path file = from / path;
    if (path.ends_with("/") || whole_name(path) == Manifest::file_name) continue;  // empty, or an unfinished manifest
    if ((old && old->ours(from, path)) || there.contains(identity(file)) || same_bytes(file, target / path) ||
        same_bytes(file, (target / path) += ".yours"))
      fs::remove(file);
    else
      move_file(file, free_path(target, path, old && old->names(path)));
  }
  fs::remove_all(from);
}

/// Replaces the earlier result by the new one; returns the new location of the earlier one.
fs::path replaced(const OutputLock& place, const fs::path& stage) {
  std::error_code gone;
  const fs::path here = fs::current_path(gone), inside = here.lexically_relative(place.target);
  fs::path old = stage;
  if (renameat2(AT_FDCWD, stage.c_str(), AT_FDCWD, place.target.c_str(), RENAME_EXCHANGE) != 0) {
    old = place.work / old_result;
    fs::rename(place.target, old);
    std::error_code error;
    fs::rename(stage, place.target, error);
    if (error) {
      fs::rename(old, place.target);
      throw fs::filesystem_error("rename", place.target, error);
    }
  }
  if (!gone && !inside.empty() && *inside.begin() != "..") {
    fs::current_path(here, gone);
    fmt::print(stderr, "crosscheck: {} is now another folder; `cd \"$PWD\"` shows the new result\n",
               place.requested.string());
  }
  return old;
}

/// Removes the files and folders that a killed writer left behind.
void recover(const OutputLock& place) {
  const fs::path left = place.work / new_result, old = place.work / old_result;
  for (const fs::path& leftover : {left, old})
    if (is_there(leftover) && !is_folder(leftover))
      place.refuse(leftover.string() + " is not a folder that crosscheck made; remove it, or give another folder");
  if (!is_there(place.target) && is_folder(old)) fs::rename(old, place.target);
  const std::optional<Manifest> unfinished = read_manifest(left);
  if (unfinished && !unfinished->finished) fs::remove_all(left);
  for (const fs::path& leftover : {left, old})
    if (is_there(leftover)) absorb(leftover, place.target);
}

/// True if the path lies in a nested folder that holds another result, such as a shard of a sweep.
bool is_of_another_result(const fs::path& target, const std::string& path) {
  for (fs::path above = fs::path(path).parent_path(); !above.empty(); above = above.parent_path())
    if (is_there(target / above / Manifest::file_name)) return true;
  return false;
}

/// Manifest of a folder that may be written into; nothing if it is empty or does not exist.
std::optional<Manifest> require_ours(const OutputLock& place, const std::string& command) {
  std::optional<Manifest> manifest = read_manifest(place.target);
  if (manifest && manifest->command != command)
    place.refuse(fmt::format("holds a result of crosscheck {}, and nothing in it was changed; give another folder",
                             manifest->command));
  if (manifest) return manifest;
  std::vector<std::string> paths = paths_in(place.target);
  std::erase_if(paths, [&](const std::string& path) {
    return whole_name(path) == Manifest::file_name || is_of_another_result(place.target, path);
  });
  if (!paths.empty())
    place.refuse(
        fmt::format("holds files that crosscheck {} did not write ({}{}), and nothing in it was changed; give an "
                    "empty or a new folder, or move them away",
                    command, paths[0], paths.size() > 1 ? fmt::format(" and {} more", paths.size() - 1) : ""));
  return manifest;
}

template <class F>
auto with_output_errors(const OutputLock& place, F work) {
  try {
    return work();
  } catch (const fs::filesystem_error& error) {
    const fs::path where = error.path2().empty() ? error.path1() : error.path2();
    place.refuse(fmt::format("{}: {}", where.string(), error.code().message()));
  }
}

/// Cleans up after killed writers. Refuses a folder that must not be written into; otherwise returns its manifest, or
/// nullopt if it is empty or does not exist.
std::optional<Manifest> entered(const OutputLock& place, const std::string& command) {
  return with_output_errors(place, [&] {
    recover(place);
    return require_ours(place, command);
  });
}

}  // namespace

void recover_output(const fs::path& folder) {
  std::optional<OutputLock> lock;
  try {
    lock.emplace(folder, "that tidies up after another");
  } catch (const InputError&) {
    return;  // another process is already cleaning up
  }
  with_output_errors(*lock, [&] { recover(*lock); });
}

OutputFolder::OutputFolder(const fs::path& folder, const std::string& command)
    : place_(folder, command), command_(command), stage_(place_.work / new_result) {
  entered(place_, command);
  register_output(place_.target);
  with_output_errors(place_, [&] {
    fs::create_directory(stage_);
    write_manifest(Manifest::begun(command), stage_);
  });
}

OutputFolder::~OutputFolder() {
  if (!place_.own() || finished_) return;
  std::error_code ignored;
  fs::remove_all(stage_, ignored);
}

void OutputFolder::finish() {
  with_output_errors(place_, [&] {
    Manifest manifest = Manifest::begun(command_);
    manifest.since = read_manifest(stage_).value_or(manifest).since;
    for (const std::string& path : paths_in(stage_))
      if (path.ends_with("/")) {
        fs::remove(stage_ / path);
        remove_empty_above(stage_, path.substr(0, path.size() - 1));
      } else {
        manifest.files[path] = file_entry(stage_ / path);
      }
    manifest.finished = true;
    const bool first = !is_there(place_.target);
    if (!first) {
      link_users_files(place_.target, read_manifest(place_.target), stage_);
      fs::permissions(stage_, fs::status(place_.target).permissions());
    }
    write_manifest(manifest, stage_);
    const fs::path old = first ? fs::path() : replaced(place_, stage_);
    if (first) fs::rename(stage_, place_.target);
    finished_ = true;  // the stage may now hold the earlier result
    if (!first) absorb(old, place_.target);
  });
}

ResumableOutput::ResumableOutput(const fs::path& folder, const std::string& command) : place_(folder, command) {
  register_output(place_.target);
  const std::optional<Manifest> old = entered(place_, command);
  manifest_ = Manifest::begun(command);
  if (old) manifest_.files = old->files;
  with_output_errors(place_, [&] {
    fs::create_directories(place_.target);
    write_manifest(manifest_, place_.target);
  });
}

void ResumableOutput::announce(const std::vector<std::string>& files) {
  with_output_errors(place_, [&] {
    for (const std::string& path : files) {
      fs::path above;
      for (const fs::path& part : fs::path(path).parent_path())
        if (above /= part; is_there(place_.target / above) && !is_folder(place_.target / above))
          keep_as_yours(place_.target, above);
      if (is_there(place_.target / path) && !manifest_.ours(place_.target, path)) keep_as_yours(place_.target, path);
      manifest_.files[path] = now_[path] = {};
    }
    write_manifest(manifest_, place_.target);
  });
}

std::filesystem::path ResumableOutput::growing(const std::string& file) {
  const auto known = manifest_.files.find(file);
  const bool whole = known != manifest_.files.end() && !known->second.hash.empty();
  const std::string name = whole ? "unfinished-" + file : file;
  if (!manifest_.files.contains(name)) announce({name}), now_.erase(name);
  return place_.target / name;
}

void ResumableOutput::keep(const std::string& inner) {
  for (const auto& [path, about] : manifest_.files)
    if (path.starts_with(inner + "/")) now_.emplace(path, about);
}

void ResumableOutput::finish() {
  with_output_errors(place_, [&] {
    for (const std::string& path : paths_in(place_.target)) {
      if (!manifest_.names(path) || now_.contains(path)) continue;
      if (manifest_.ours(place_.target, path))
        fs::remove(place_.target / path);
      else
        keep_as_yours(place_.target, path);
      remove_empty_above(place_.target, path);
    }
    manifest_.files.clear();
    for (auto& [path, about] : now_)
      if (fs::is_regular_file(fs::symlink_status(place_.target / path)))
        manifest_.files[path] = about.hash.empty() ? file_entry(place_.target / path) : about;
    manifest_.finished = true;
    write_manifest(manifest_, place_.target);
  });
}

}  // namespace crosscheck
