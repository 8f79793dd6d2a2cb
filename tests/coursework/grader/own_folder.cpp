#include "tests/coursework/grader/own_folder.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <pwd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "mysim/temporary_folder.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

// Between the ranges that distributions and systemd give away.
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

/// No program of the user runs any more, so that nothing changes under our hands.
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

OwnFolder::OwnFolder(unsigned mode, unsigned owner) {
  std::string name = crosscheck::temporary_name("lane");
  if (!mkdtemp(name.data())) throw std::runtime_error(fmt::format("cannot make {}: {}", name, std::strerror(errno)));
  path_ = name;
  if (chmod(name.c_str(), mode) != 0 || (owner && chown(name.c_str(), owner, owner) != 0))
    throw std::runtime_error(fmt::format("cannot give {} away: {}", name, std::strerror(errno)));
}

OwnFolder::~OwnFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

BorrowedUser::BorrowedUser() {
  // An abstract socket's name is the lock: it goes with the process that holds it, however that ends.
  for (int patience = 0; patience < 600; ++patience) {
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

BorrowedUser::~BorrowedUser() {
  for (const char* folder : open_to_all) remove_files_of(id_, folder);
  close(held_);
}

Loan::Loan(fs::path folder, unsigned user) : folder_(std::move(folder)), user_(user ? user : geteuid()) {
  if (!folder_.empty() && user && lchown(folder_.c_str(), user, user) != 0)
    throw std::runtime_error(fmt::format("cannot lend {}: {}", folder_.string(), std::strerror(errno)));
}

Loan::~Loan() {
  if (!folder_.empty()) take_back(folder_, user_);
}

}  // namespace coursework
