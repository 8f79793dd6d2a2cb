// Folders of results: a lock for one writer, and a finished result that stays until the next one is whole.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mysim/base/manifest.h"

namespace crosscheck {

/// A folder for results, and the working folder in which the next one is prepared.
struct OutputPlace {
  /// Throws InputError where there is a file of that name, or a link to nothing.
  explicit OutputPlace(const std::filesystem::path& requested);

  std::filesystem::path requested;  // as given
  std::filesystem::path target;     // absolute, without links
  std::filesystem::path work;       // PARENT/.NAME.crosscheck

  /// Throws InputError where another folder cannot take its name: its parent cannot be written to, it is a mount point,
  /// or another user's in a sticky folder.
  void require_replaceable() const;
  /// Throws InputError: the folder cannot be made or written to, or why else.
  [[noreturn]] void refuse(const std::string& why = "") const;
};

/// Held by the one process that writes into a folder; gone with it, however it ends.
class OutputLock {
 public:
  /// Throws InputError that names the process which holds it, and since when, or a working folder of another user.
  OutputLock(const OutputPlace& place, const std::string& command);
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;
  /// Whether this is the process that took it, and no child of it.
  bool own() const;

 private:
  std::filesystem::path work_;
  std::vector<std::filesystem::path> made_;  // folders above the place that were not there
  int handle_ = -1;
  int process_;
};

// Folders of results: Crosscheck's files in them are listed in a manifest, everything else is left alone, and a
// finished result stays until the next one is whole.

/// A result that is prepared in the working folder and put in place when it is whole. The user's files are linked into
/// it first, then the two folders exchange their names (renameat2, RENAME_EXCHANGE). Where the file system cannot do
/// that (NFS, 9p, sshfs), the earlier result is renamed to WORK/old and the new one takes its place; if a process is
/// killed in between, the next writer puts the earlier one back. Listed files that a user has changed, and the user's
/// files under names that the new result has, are kept as NAME.yours.
class OutputFolder {
 public:
  /// Takes the lock, tidies up after a killed writer, and begins. Throws InputError "--out FOLDER: ..." where another
  /// process writes there, where the folder is of another command, where it holds files and no manifest, or where it
  /// cannot be replaced. Nothing is changed then.
  OutputFolder(const std::filesystem::path& folder, const std::string& command);
  /// Removes an unfinished result; the earlier one is there as before.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// The folder to write the files into.
  const std::filesystem::path& path() const { return stage_; }
  /// Puts all that was written in place. Throws InputError where that fails.
  void finish();

 private:
  OutputPlace place_;
  OutputLock lock_;
  std::string command_;
  std::filesystem::path stage_;
  bool finished_ = false;
};

/// A result that grows in place, so that an interrupted command can go on with what is there.
class ResumableOutput {
 public:
  /// As OutputFolder's; the folder is made where it is missing.
  ResumableOutput(const std::filesystem::path& folder, const std::string& command);
  ResumableOutput(const ResumableOutput&) = delete;
  ResumableOutput& operator=(const ResumableOutput&) = delete;

  /// Says which files will be written next. What a user has under these names is kept as NAME.yours.
  void announce(const std::vector<std::string>& files);
  /// The place of a file that holds a part of the result until finish(): under its own name, or as "unfinished-NAME" as
  /// long as a finished result has a file of that name.
  std::filesystem::path growing(const std::string& file);
  /// Counts what is listed in a folder inside to this result too.
  void keep(const std::string& inner);
  /// Removes what is listed of an earlier result and was not announced or kept since.
  void finish();

 private:
  OutputPlace place_;
  OutputLock lock_;
  Manifest manifest_;
  std::map<std::string, Manifest::File> now_;  // announced and kept
};

/// Tidies up after a killed writer, unless another process writes there: for the process that started it.
void recover_output(const std::filesystem::path& folder);

}  // namespace crosscheck
