// A lock in the working folder, then an exchange of names, or two renames.
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
#include <cstdlib>
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

bool is_mount_point(const fs::path& folder) {
  struct statx about {};
  if (statx(AT_FDCWD, folder.c_str(), AT_SYMLINK_NOFOLLOW, STATX_TYPE, &about) != 0) return false;
  return (about.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) && (about.stx_attributes & STATX_ATTR_MOUNT_ROOT);
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

OutputPlace::OutputPlace(const fs::path& given) : requested(given) {
  try {
    target = fs::weakly_canonical(fs::absolute(given));
    if (!target.has_filename()) target = target.parent_path();
    if (given.empty() || !target.has_filename() || (fs::exists(target) && !fs::is_directory(target))) refuse();
    for (fs::path at = target; at.has_relative_path(); at = at.parent_path())
      if (fs::is_symlink(at))
        refuse(fmt::format("{} is a link to {}, which does not exist; make that folder, or give another one",
                           at.string(), fs::read_symlink(at).string()));
  } catch (const fs::filesystem_error&) {
    refuse();
  }
  work = target.parent_path() / fmt::format(".{}.crosscheck", target.filename().string());
}

void OutputPlace::require_replaceable() const {
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

void OutputPlace::refuse(const std::string& why) const {
  throw InputError(fmt::format("--out {}: {}", requested.string(),
                               why.empty() ? "expected a folder that can be made and written to" : why));
}

OutputLock::OutputLock(const OutputPlace& place, const std::string& command) : process_(getpid()) {
  std::error_code error;
  for (fs::path above = place.target.parent_path(); above.has_relative_path() && !fs::exists(above, error);
       above = above.parent_path())
    made_.push_back(above);
  fs::create_directories(place.target.parent_path(), error);
  place.require_replaceable();
  work_ = place.work;
  const fs::path file = work_ / "lock";
  // one that was killed lets go when the processes that it had started are gone too, which is soon
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
    struct stat about {};
    if (mkdir(work_.c_str(), 0700) != 0 && errno == EEXIST && lstat(work_.c_str(), &about) == 0 &&
        (!S_ISDIR(about.st_mode) || about.st_uid != geteuid()))
      place.refuse(work_.string() + " is not a folder of yours; remove it, or give another folder");
    handle_ = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (handle_ < 0 && errno == ENOENT && std::chrono::steady_clock::now() < deadline) continue;  // gone just now
    if (handle_ < 0) place.refuse();
    if (flock(handle_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      const Holder holder = holder_in(handle_);
      close(handle_);
      const bool alive = holder.process > 0 && (kill(static_cast<pid_t>(holder.process), 0) == 0 || errno == EPERM);
      if (!alive && std::chrono::steady_clock::now() < deadline) continue;
      place.refuse(holder.process > 0
                       ? fmt::format("process {} (crosscheck {}) has been writing into it since {}; wait "
                                     "for it, or give another folder",
                                     holder.process, holder.command, holder.since)
                       : "another process is writing into it; wait for it, or give another folder");
    }
    if (same_file(handle_, file)) break;
    close(handle_);  // of a process that ended in between
  }
  const std::string text = fmt::format("{}\n{}\n{}\n", getpid(), utc_now(), command);
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

namespace {

constexpr auto new_result = "new", old_result = "old";

bool is_there(const fs::path& path) { return fs::exists(fs::symlink_status(path)); }
bool is_folder(const fs::path& path) { return fs::is_directory(fs::symlink_status(path)); }

/// Where something of the user's finds a place under a folder: its own path, or NAME.yours where that is taken, or
/// where it is to have another one.
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
  std::error_code error;
  fs::rename(from, to, error);
  if (!error) return;
  fs::copy(from, to, fs::copy_options::copy_symlinks | fs::copy_options::recursive);  // another file system
  fs::remove_all(from);
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

std::pair<dev_t, ino_t> identity(const fs::path& file) {
  struct stat about {};
  if (lstat(file.c_str(), &about) != 0) return {};
  return {about.st_dev, about.st_ino};
}

/// Folders above a file that have become empty, up to the root.
void remove_empty_above(const fs::path& root, const fs::path& path) {
  std::error_code error;
  for (fs::path at = path.parent_path(); !at.empty() && fs::remove(root / at, error); at = at.parent_path()) {
  }
}

/// The user's files under `target` get a second name under `stage`, where a new result lies.
void link_what_is_the_users(const fs::path& target, const std::optional<Manifest>& old, const fs::path& stage) {
  const std::vector<std::string> paths = paths_in(target);
  // those that change their names come last, so that they take no other file's
  for (const bool changed : {false, true})
    for (const std::string& path : paths) {
      if (changed != (old && old->names(path)) || (changed && old->ours(target, path))) continue;
      const bool folder = path.ends_with("/");
      if (folder && is_folder(stage / path)) continue;
      const fs::path to = free_path(stage, folder ? path.substr(0, path.size() - 1) : path, changed);
      // folders on the way look like those they stand for
      fs::path from_above = target, to_above = stage;
      for (const fs::path& part : (folder ? to : to.parent_path()).lexically_relative(stage)) {
        if (part == ".") continue;
        from_above /= part, to_above /= part;
        if (is_there(to_above)) continue;
        if (is_folder(from_above))
          fs::create_directory(to_above, from_above);
        else
          fs::create_directory(to_above);
      }
      if (!folder) link_or_copy(target / path, to);
    }
}

/// Empties a folder that another has replaced: Crosscheck's files go, and those of the user's that are not in `target`
/// move there.
void absorb(const fs::path& from, const fs::path& target) {
  const std::optional<Manifest> old = read_manifest(from);
  std::set<std::pair<dev_t, ino_t>> there;
  for (const std::string& path : paths_in(target)) there.insert(identity(target / path));
  for (const std::string& path : paths_in(from)) {
    const fs::path file = from / path;
    if (path.ends_with("/")) continue;
    if ((old && old->ours(from, path)) || there.contains(identity(file)) || same_bytes(file, target / path) ||
        same_bytes(file, (target / path) += ".yours"))
      fs::remove(file);
    else
      move_file(file, free_path(target, path, old && old->names(path)));
  }
  fs::remove_all(from);
}

/// Gives the folder's name to the new result; returns where the earlier one is now.
fs::path replaced(const OutputPlace& place, const fs::path& stage) {
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

/// Removes what a writer killed in its first write left: a manifest under its temporary name.
void remove_half_manifests(const fs::path& folder) {
  std::vector<fs::path> halves;
  for (const auto& entry : fs::directory_iterator(folder))
    if (whole_name(entry.path().filename()) == Manifest::file_name) halves.push_back(entry.path());
  for (const fs::path& half : halves) fs::remove(half);
}

/// Leftovers of a killed writer.
void recover(const OutputPlace& place) {
  const fs::path left = place.work / new_result, old = place.work / old_result;
  for (const fs::path& leftover : {left, old})
    if (is_there(leftover) && !is_folder(leftover))
      place.refuse(leftover.string() + " is not a folder that crosscheck made; remove it, or give another folder");
  if (!is_there(place.target) && is_folder(old)) fs::rename(old, place.target);
  if (is_there(left)) {
    const std::optional<Manifest> manifest = read_manifest(left);
    if (manifest && !manifest->finished)
      fs::remove_all(left);  // half a result
    else {
      if (!manifest) remove_half_manifests(left);
      absorb(left, place.target);
    }
  }
  if (is_there(old)) absorb(old, place.target);
}

/// Whether it lies in another result's folder inside of this one, as the parts of a sweep do.
bool is_of_another_result(const fs::path& target, const std::string& path) {
  for (fs::path above = fs::path(path).parent_path(); !above.empty(); above = above.parent_path())
    if (is_there(target / above / Manifest::file_name)) return true;
  return false;
}

/// The manifest of a folder that may be written into; nothing where it is empty or not there.
std::optional<Manifest> require_ours(const OutputPlace& place, const std::string& command) {
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
        fmt::format("holds files that are not of crosscheck {} ({}{}), and nothing in it was changed; give an "
                    "empty or a new folder, or move them away",
                    command, paths[0], paths.size() > 1 ? fmt::format(" among {}", paths.size()) : ""));
  return manifest;
}

/// Whatever the file system says becomes a word about --out.
template <class F>
auto with_output_errors(const OutputPlace& place, F work) {
  try {
    return work();
  } catch (const fs::filesystem_error& error) {
    const fs::path where = error.path2().empty() ? error.path1() : error.path2();
    place.refuse(fmt::format("{}: {}", where.string(), error.code().message()));
  }
}

/// With the lock: tidies up, and looks whether the folder may be written into.
std::optional<Manifest> entered(const OutputPlace& place, const std::string& command) {
  return with_output_errors(place, [&] {
    recover(place);
    return require_ours(place, command);
  });
}

}  // namespace

void recover_output(const fs::path& folder) {
  const OutputPlace place(folder);
  if (!is_there(place.work)) return;
  std::optional<OutputLock> lock;
  try {
    lock.emplace(place, "that tidies up after another");
  } catch (const InputError&) {
    return;  // another process does it
  }
  with_output_errors(place, [&] { recover(place); });
}

OutputFolder::OutputFolder(const fs::path& folder, const std::string& command)
    : place_(folder), lock_(place_, command), command_(command), stage_(place_.work / new_result) {
  entered(place_, command);
  register_output(place_.target);
  with_output_errors(place_, [&] {
    fs::create_directory(stage_);
    write_manifest(Manifest::begun(command), stage_);
  });
}

OutputFolder::~OutputFolder() {
  if (!lock_.own() || finished_) return;
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
      link_what_is_the_users(place_.target, read_manifest(place_.target), stage_);
      fs::permissions(stage_, fs::status(place_.target).permissions());
    }
    write_manifest(manifest, stage_);
    if (first) {
      fs::rename(stage_, place_.target);
      finished_ = true;
      return;
    }
    const fs::path old = replaced(place_, stage_);
    finished_ = true;  // from here on the stage may be the earlier result
    absorb(old, place_.target);
  });
}

ResumableOutput::ResumableOutput(const fs::path& folder, const std::string& command)
    : place_(folder), lock_(place_, command) {
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
