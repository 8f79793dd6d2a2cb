// Folders and users that a run borrows and gives back.
#pragma once

#include <filesystem>

namespace coursework {

/// A fresh folder under the system's temporary one, removed at the end with all that is in it.
class OwnFolder {
 public:
  /// Throws std::runtime_error where none can be made.
  explicit OwnFolder(unsigned mode, unsigned owner = 0);
  ~OwnFolder();
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A user id that nobody else has, held while this lives, across threads and processes. It needs no entry in the list
/// of users. At the end the files of that user in the folders open to all are removed.
class BorrowedUser {
 public:
  /// Throws std::runtime_error where all are taken.
  BorrowedUser();
  ~BorrowedUser();
  BorrowedUser(const BorrowedUser&) = delete;
  BorrowedUser& operator=(const BorrowedUser&) = delete;
  unsigned id() const { return id_; }

 private:
  unsigned id_ = 0;
  int held_ = -1;
};

/// Lends `folder` to a user; the end of the loan makes all in it ours again, removes what is no plain file or folder or
/// has a second name elsewhere, and lets others read the rest. User 0: it is ours already. Empty path: nothing.
class Loan {
 public:
  Loan(std::filesystem::path folder, unsigned user);
  ~Loan();
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;

 private:
  std::filesystem::path folder_;
  unsigned user_;
};

}  // namespace coursework
