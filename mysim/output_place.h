// Where a result goes, where it is prepared, and who may write it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crosscheck {

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

}  // namespace crosscheck
