#include "tests/coursework/grader/staging.h"

#include <fmt/core.h>
#include <pwd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace coursework {
namespace fs = std::filesystem;
namespace {

// These ids are between the ranges that distributions and systemd assign.
constexpr unsigned first_user = 61000, users = 128;
constexpr const char* open_to_all[] = {"/tmp", "/var/tmp", "/dev/shm", "/run/lock", "/dev/mqueue"};

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    found.push_back(at->path());
  return found;
}

bool has_name(unsigned user) {
  passwd entry{};
  passwd* found = nullptr;
  char text[4096];
  return getpwuid_r(user, &entry, text, sizeof text, &found) == 0 && found;
}

/// Precondition: no program of the user runs any more, so nothing changes concurrently.
void remove_files_of(unsigned user, const fs::path& folder) {
  for (const fs::path& entry : entries_of(folder)) {
    struct stat about {};
    if (lstat(entry.c_str(), &about) != 0) continue;
    std::error_code error;
    if (about.st_uid == user)
      fs::remove_all(entry, error);
    else if (S_ISDIR(about.st_mode) && (about.st_mode & S_IWOTH))
      remove_files_of(user, entry);
  }
}

void take_back(const fs::path& entry, unsigned user) {
  struct stat about {};
  if (lstat(entry.c_str(), &about) != 0) return;
  const bool folder = S_ISDIR(about.st_mode);
  if (about.st_uid == user) {
    if (!folder && (!S_ISREG(about.st_mode) || about.st_nlink > 1)) {
      unlink(entry.c_str());
      return;
    }
    if (lchown(entry.c_str(), geteuid(), getegid()) != 0) return;
    chmod(entry.c_str(), folder || (about.st_mode & S_IXUSR) ? 0755 : 0644);
  }
  if (folder)
    for (const fs::path& inner : entries_of(entry)) take_back(inner, user);
}

}  // namespace

PrivateFolder::PrivateFolder(unsigned mode, unsigned owner) {
  const std::string name = path().string();
  if (chmod(name.c_str(), mode) != 0 || (owner && chown(name.c_str(), owner, owner) != 0))
    throw std::runtime_error(fmt::format("cannot give {} away: {}", name, std::strerror(errno)));
}

SandboxUser::SandboxUser() {
  // An abstract socket serves as the lock: the kernel releases its name when the process ends, for whatever reason.
  for (int attempt = 0; attempt < 600; ++attempt) {
    for (unsigned id = first_user; id < first_user + users; ++id) {
      if (has_name(id)) continue;
      held_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
      sockaddr_un name{};
      name.sun_family = AF_UNIX;
      const std::string text = fmt::format("crosscheck-user-{}", id);
      std::memcpy(name.sun_path + 1, text.data(), text.size());
      const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
      if (held_ >= 0 && bind(held_, reinterpret_cast<sockaddr*>(&name), size) == 0) {
        id_ = id;
        return;
      }
      close(held_);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  throw std::runtime_error(fmt::format("all users from {} to {} are taken", first_user, first_user + users - 1));
}

SandboxUser::~SandboxUser() {
  for (const char* folder : open_to_all) remove_files_of(id_, folder);
  close(held_);
}

ScopedOwner::ScopedOwner(fs::path folder, unsigned user) : folder_(std::move(folder)), user_(user ? user : geteuid()) {
  if (!folder_.empty() && user && lchown(folder_.c_str(), user, user) != 0)
    throw std::runtime_error(fmt::format("cannot lend {}: {}", folder_.string(), std::strerror(errno)));
}

ScopedOwner::~ScopedOwner() {
  if (!folder_.empty()) take_back(folder_, user_);
}

namespace {

/// Copies plain files and folders. The copies are readable for everyone with access to the folder.
void copy_for_others(const fs::path& from, const fs::path& to) {
  fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::skip_symlinks);
  fs::permissions(to, fs::perms(0755));
  for (const auto& entry : fs::recursive_directory_iterator(to)) {
    const bool runs =
        entry.is_directory() || (fs::status(entry.path()).permissions() & fs::perms::owner_exec) != fs::perms::none;
    fs::permissions(entry.path(), fs::perms(runs ? 0755 : 0644));
  }
}

void move_entries(const fs::path& from, const fs::path& to) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(from)) entries.push_back(entry.path());
  for (const fs::path& entry : entries) {
    std::error_code elsewhere;
    fs::rename(entry, to / entry.filename(), elsewhere);
    if (elsewhere)  // the two paths are on different file systems
      fs::copy(entry, to / entry.filename(), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  }
}

}  // namespace

StagingFolder::StagingFolder(const Job& job, unsigned user) : job_(job), own_(0700, user) {
  for (std::size_t i = 0; i < job.readable.size(); ++i) {
    places_.emplace_back(job.readable[i], job.readable[i]);
    if (!user) continue;
    // preserves the last component of the path, which compiler messages contain
    const fs::path above = own() / std::to_string(i);
    fs::create_directory(above);
    fs::permissions(above, fs::perms(0755));
    places_.back().second = above / job.readable[i].filename();
    copy_for_others(job.readable[i], places_.back().second);
  }
  if (job.writable.empty()) return;
  places_.emplace_back(job.writable, job.writable);
  if (user) {
    places_.back().second = own() / "writable";
    fs::create_directory(places_.back().second);
    move_entries(job.writable, places_.back().second);
  }
  owner_ = std::make_unique<ScopedOwner>(places_.back().second, user);
}

const fs::path& StagingFolder::of(const fs::path& folder) const {
  for (const auto& [named, stands] : places_)
    if (named == folder) return stands;
  throw std::logic_error(folder.string() + " is no folder of the job");
}

std::vector<std::string> StagingFolder::command() const {
  auto longest_first = places_;
  std::sort(longest_first.begin(), longest_first.end(),
            [](const auto& a, const auto& b) { return a.first.string().size() > b.first.string().size(); });
  std::vector<std::string> words = job_.command;
  for (std::string& word : words)
    for (const auto& [named, stands] : longest_first) {
      if (named == stands) continue;
      std::size_t at = 0;
      while ((at = word.find(named.string(), at)) != std::string::npos) {
        word.replace(at, named.string().size(), stands.string());
        at += stands.string().size();
      }
    }
  return words;
}

void StagingFolder::give_back() {
  if (!owner_) return;
  owner_.reset();
  if (of(job_.writable) != job_.writable) move_entries(of(job_.writable), job_.writable);
}

}  // namespace coursework
