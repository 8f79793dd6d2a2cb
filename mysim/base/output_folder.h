// Folders of results: who may write there, and a finished result that stays until the next one is whole.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mysim/base/manifest.h"

namespace crosscheck {

// Where a result goes, where it is prepared, and who may write it.

/// A folder for results, and our working folders for it.
struct OutputPlace {
  /// Throws InputError where there is a file of that name.
  explicit OutputPlace(const std::filesystem::path& asked);

  std::filesystem::path asked;   // as given
  std::filesystem::path target;  // absolute, without links
  std::filesystem::path beside;  // PARENT/.NAME.crosscheck
  std::filesystem::path inside;  // TARGET/.crosscheck, where nothing can be made beside it

  bool writable_beside() const;
  /// Whether another folder can take its name: it is no mount point, and nobody's working folder whom we know.
  bool exchangeable() const;
  /// Throws InputError: the folder cannot be made or written to, or why else.
  [[noreturn]] void refuse(const std::string& why = "") const;
};

/// Held by the one process that writes into a folder; gone with it, however it ends.
class OutputLock {
 public:
  /// Throws InputError that names the process which holds it, and since when.
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

// Folders of results: what is ours in them is known by a manifest, everything else is left alone, and a finished result
// stays until the next one is whole.

/// A result that is prepared in another folder and put in place when it is whole. The two folders exchange their names
/// (renameat2, RENAME_EXCHANGE) after the user's files were linked into the new one; where that cannot be done (no such
/// call, a mount point, a parent folder that belongs to others) the files are moved one by one by a journal, which the
/// next start finishes. Listed files that a user has changed, and the user's files under names that the new result
/// has, are kept as NAME.yours.
class OutputFolder {
 public:
  /// Takes the lock, finishes what an earlier start could not, and begins. Throws InputError "--out FOLDER: ..." where
  /// somebody else writes there, where the folder is of another command, where it holds files and no manifest of ours
  /// (those of version 0.1 are known by their names and taken over), or where it cannot be written to. Nothing is
  /// changed then.
  OutputFolder(const std::filesystem::path& folder, const std::string& command);
  /// What was not finished is gone, and the earlier result is there as before.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where the files are to be written.
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

  /// Removes what is listed in a folder inside, that is, an earlier result's.
  void forget(const std::string& inner);
  /// Says which files will be written next. What a user has under these names is kept as NAME.yours.
  void announce(const std::vector<std::string>& files);
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

/// Finishes what a killed process could not, where there is anything to finish and nobody else writes there: for those
/// who read results, and for who started the process.
void recover_output(const std::filesystem::path& folder);

}  // namespace crosscheck
