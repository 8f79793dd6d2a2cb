// Folders and users that a sandboxed run borrows: its private folder, copies of what it reads, what it wrote given
// back.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mysim/base/files.h"
#include "tests/coursework/grader/sandbox.h"

namespace coursework {

/// A fresh folder under the system's temporary one, removed at the end with all that is in it.
class PrivateFolder {
 public:
  /// Throws std::runtime_error where none can be made.
  explicit PrivateFolder(unsigned mode, unsigned owner = 0);
  const std::filesystem::path& path() const { return folder_.path; }

 private:
  crosscheck::TemporaryFolder folder_{"lane"};
};

/// A user id that nobody else has, held while this lives, across threads and processes. It needs no entry in the list
/// of users. At the end the files of that user in the folders open to all are removed.
class SandboxUser {
 public:
  /// Throws std::runtime_error where all are taken.
  SandboxUser();
  ~SandboxUser();
  SandboxUser(const SandboxUser&) = delete;
  SandboxUser& operator=(const SandboxUser&) = delete;
  unsigned id() const { return id_; }

 private:
  unsigned id_ = 0;
  int held_ = -1;
};

/// Lends `folder` to a user; the end of the loan makes all in it ours again, removes what is no plain file or folder or
/// has a second name elsewhere, and lets others read the rest. User 0: it is ours already. Empty path: nothing.
class ScopedOwner {
 public:
  ScopedOwner(std::filesystem::path folder, unsigned user);
  ~ScopedOwner();
  ScopedOwner(const ScopedOwner&) = delete;
  ScopedOwner& operator=(const ScopedOwner&) = delete;

 private:
  std::filesystem::path folder_;
  unsigned user_;
};

// What a job reads and writes, as copies that only its user reaches: the grader's own folders stay closed to everybody.

class StagingFolder {
 public:
  /// For a job that runs under `user`; 0: under ours, and nothing is copied.
  StagingFolder(const Job& job, unsigned user);
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  /// An empty folder of the user's own, but for the copies.
  const std::filesystem::path& own() const { return own_.path(); }
  /// Where one of the job's folders stands.
  const std::filesystem::path& of(const std::filesystem::path& folder) const;
  /// The job's command with these places in it.
  std::vector<std::string> command() const;

  /// After the run: what is in the writable folder by now becomes ours and returns to where the job named it.
  void give_back();

 private:
  const Job& job_;
  PrivateFolder own_;
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> places_;  // as the job names it, where it stands
  std::unique_ptr<ScopedOwner> owner_;
};

}  // namespace coursework
