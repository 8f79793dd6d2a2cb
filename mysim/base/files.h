// Reads and writes whole files, leaves no partial file when a run is killed, and creates temporary folders.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace crosscheck {

/// A file that is written piece by piece and gets its name only when complete. Until then it is unnamed or, on file
/// systems without unnamed files, has a temporary name in the same folder. All members throw InputError if they cannot
/// write the file; the message names the file.
class StreamingFile {
 public:
  /// Creates a missing folder.
  explicit StreamingFile(std::filesystem::path file);
  /// Removes an unfinished file.
  ~StreamingFile();
  StreamingFile(const StreamingFile&) = delete;
  StreamingFile& operator=(const StreamingFile&) = delete;

  void append(std::string_view bytes);
  /// Overwrites the first bytes, which must exist.
  void rewrite_beginning(std::string_view bytes);
  /// Gives the file its name, replacing any earlier file. Nothing can be appended afterwards.
  void finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void fail(const std::string& why) const;

  std::filesystem::path file_, temporary_;
  bool named_ = false;  // the temporary name exists
  std::unique_ptr<std::FILE, Close> out_;
};

/// Free disk space (bytes) in the folder, or in its nearest existing ancestor; infinite if unknown.
double free_disk(const std::filesystem::path& folder);

/// Writes a file atomically, through StreamingFile.
void write_file(const std::filesystem::path& file, std::string_view content);

/// Returns the content of a file, or nothing if it cannot be read. Throws InputError if the file is endless or larger
/// than a quarter of the free memory.
std::optional<std::string> try_read_file(const std::filesystem::path& file);

/// Throws InputError with the file's name and `expected` ("a scene file (TOML)").
std::string read_file(const std::filesystem::path& file, std::string_view expected);

/// Creates a missing folder. Throws InputError with its name if files cannot be written into it.
void require_writable(const std::filesystem::path& folder);

/// Turns method and scene names into parts of file names: replaces each ASCII character outside [A-Za-z0-9._=+-] and
/// each unprintable one (names.h) by '-'. Texts longer than longest_derived_name are shortened and end in a hash of the
/// whole text.
std::string file_name_of(std::string_view text);

/// A private folder crosscheck-PURPOSE-PROCESS.tmp-XXXXXX, removed with the object or, if the process was killed, at
/// the next start.
class TemporaryFolder {
 public:
  /// `place`: parent folder, by default the system's folder for temporary files. Throws InputError that names the
  /// folder.
  explicit TemporaryFolder(std::string_view purpose, const std::filesystem::path& place = {});
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path path;

 private:
  int lock_ = -1;
};

/// Removes temporary folders of terminated processes from `place` (default: the system's folder for temporary files).
/// Only root removes folders of other users.
void remove_stale_temporary_folders(const std::filesystem::path& place = {});

}  // namespace crosscheck
