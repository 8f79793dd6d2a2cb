// Result folders: one writer at a time; only files listed in the manifest are ever removed; a finished result stays
// until the next one is complete.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mysim/base/manifest.h"

namespace crosscheck {

/// The lock on a result folder (ends with this object or process), and the working folder for the next result.
class OutputLock {
 public:
  /// Throws InputError "--out FOLDER: ..." if the folder cannot be created, written to or replaced (because it is a
  /// file, a dangling link, a mount point or a folder of another user), or if another process holds the lock. The
  /// message names that process.
  OutputLock(const std::filesystem::path& given, const std::string& command);
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;
  /// False in forked children.
  bool own() const;
  /// Throws InputError "--out FOLDER: WHY"; by default, WHY says that the folder cannot be created or written to.
  [[noreturn]] void refuse(const std::string& why = "") const;

  std::filesystem::path requested;  // as given
  std::filesystem::path target;     // absolute, links resolved
  std::filesystem::path work;       // PARENT/.NAME.crosscheck

 private:
  void find_target();
  void require_replaceable() const;
  void release();

  std::vector<std::filesystem::path> made_;  // new folders above the target
  int handle_ = -1;
  int process_;
};

/// A result in preparation, in the working folder. finish() links the user's files into it and exchanges the two
/// folders (renameat2, RENAME_EXCHANGE). On file systems that cannot exchange names (NFS, 9p, sshfs), it renames the
/// earlier result to WORK/old, and then the new one to its place; if the process is killed in between, the next writer
/// moves the earlier one back. A listed file that the user has changed is kept as NAME.yours, and so is a user file
/// whose name the new result needs.
class OutputFolder {
 public:
  /// Acquires the lock, cleans up after a killed writer, and begins a result. Throws like OutputLock. Also throws,
  /// without changing anything, if the folder belongs to another command or holds files but no manifest.
  OutputFolder(const std::filesystem::path& folder, const std::string& command);
  /// Removes an unfinished result.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// The folder to write the files into.
  const std::filesystem::path& path() const { return stage_; }
  /// Installs the result. Throws InputError.
  void finish();

 private:
  OutputLock place_;
  std::string command_;
  std::filesystem::path stage_;
  bool finished_ = false;
};

/// A result that grows in place, so that an interrupted command can continue it.
class ResumableOutput {
 public:
  /// Throws like OutputFolder's constructor. Creates a missing folder.
  ResumableOutput(const std::filesystem::path& folder, const std::string& command);
  ResumableOutput(const ResumableOutput&) = delete;
  ResumableOutput& operator=(const ResumableOutput&) = delete;

  /// Lists the files that will be written next. User files under these names are kept as NAME.yours.
  void announce(const std::vector<std::string>& files);
  /// Path of an incomplete file until finish(): "unfinished-NAME" if a finished result has the file NAME, else NAME.
  std::filesystem::path growing(const std::string& file);
  /// Includes the listed files of an inner folder in this result.
  void keep(const std::string& inner);
  /// Removes files of the earlier result that were not announced or kept.
  void finish();

 private:
  OutputLock place_;
  Manifest manifest_;
  std::map<std::string, Manifest::File> now_;  // announced and kept files
};

/// Cleans up after a killed writer, unless another process is writing there.
void recover_output(const std::filesystem::path& folder);

}  // namespace crosscheck
