// Temporary folders and users of a sandboxed run: a private folder, copies of its inputs, and the return of its
// outputs.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mysim/base/files.h"
#include "tests/coursework/grader/sandbox.h"

namespace coursework {

/// A new folder below the system's temporary folder. The destructor removes it with its content.
class PrivateFolder {
 public:
  /// Throws std::runtime_error if the folder cannot be created.
  explicit PrivateFolder(unsigned mode, unsigned owner = 0);
  const std::filesystem::path& path() const { return folder_.path; }

 private:
  crosscheck::TemporaryFolder folder_{"lane"};
};

/// An exclusive user id, reserved across threads and processes during the lifetime of this object. It needs no entry in
/// the user database. The destructor removes the user's files in world-writable folders.
class SandboxUser {
 public:
  /// Throws std::runtime_error if all ids are in use.
  SandboxUser();
  ~SandboxUser();
  SandboxUser(const SandboxUser&) = delete;
  SandboxUser& operator=(const SandboxUser&) = delete;
  unsigned id() const { return id_; }
  /// Descriptor that reserves the id while any process has it open.
  int lock() const { return held_; }

 private:
  unsigned id_ = 0;
  int held_ = -1;
};

/// Makes `user` the owner of `folder` for a time. The destructor makes us the owner of everything in the folder again,
/// removes entries that are not plain files or folders or have hard links elsewhere, and makes the rest readable for
/// others. No effect if the user is 0 or the path is empty.
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

// Copies of a job's inputs and outputs that only its user can access. The grader's own folders remain inaccessible.

class StagingFolder {
 public:
  /// Prepares a job for `user`, or for our own user and without copies if `user` is 0.
  StagingFolder(const Job& job, unsigned user);
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  /// Private folder of the sandbox user; it contains only the copies.
  const std::filesystem::path& own() const { return own_.path(); }
  /// Actual path of one of the job's folders.
  const std::filesystem::path& of(const std::filesystem::path& folder) const;
  /// The job's command with the actual paths.
  std::vector<std::string> command() const;

  /// To be called after the run: takes ownership of the writable folder's content and moves it to the path in the job.
  void give_back();

 private:
  const Job& job_;
  PrivateFolder own_;
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> places_;  // path in the job -> actual path
  std::unique_ptr<ScopedOwner> owner_;
};

}  // namespace coursework
