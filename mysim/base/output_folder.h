// Result folders: one writer at a time; only files listed in the manifest are ever removed; a finished result stays
// until the next one is complete.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mysim/base/manifest.h"

namespace crosscheck {

/// The lock on a result folder, which ends with the process that holds it, and the working folder in which the next
/// result is prepared.
class OutputLock {
 public:
  /// Throws InputError "--out FOLDER: ..." if the folder cannot be created, written to or replaced (a file of that
  /// name, a dangling link, a mount point, a folder of another user), or if another process holds the lock. In the
  /// latter case the message names that process.
  OutputLock(const std::filesystem::path& given, const std::string& command);
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;
  /// False in forked children.
  bool own() const;
  /// Throws InputError "--out FOLDER: WHY"; by default WHY says that the folder cannot be created or written to.
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

/// A result that is prepared in the working folder. finish() links the user's files into it and exchanges the two
/// folders (renameat2, RENAME_EXCHANGE). On file systems that cannot exchange names (NFS, 9p, sshfs), the earlier
/// result is renamed to WORK/old and the new one is renamed to its place. If the process is killed in between, the next
/// writer moves the earlier one back. Listed files that the user has changed, and user files under names of the new
/// result, are kept as NAME.yours.
class OutputFolder {
 public:
  /// Acquires the lock, cleans up after a killed writer, and begins. Throws InputError "--out FOLDER: ..." like
  /// OutputLock, and if the folder belongs to another command or holds files but no manifest; in that case nothing is
  /// changed.
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
  /// Same conditions as OutputFolder's constructor; creates the folder if it is missing.
  ResumableOutput(const std::filesystem::path& folder, const std::string& command);
  ResumableOutput(const ResumableOutput&) = delete;
  ResumableOutput& operator=(const ResumableOutput&) = delete;

  /// Lists files that will be written next. The user's files under these names are kept as NAME.yours.
  void announce(const std::vector<std::string>& files);
  /// Path of a file that holds part of the result until finish(): "unfinished-NAME" if a finished result has a file of
  /// that name, otherwise NAME.
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
