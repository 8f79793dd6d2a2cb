// Whole-file reading and writing that leaves no partial file when a run is killed, and temporary folders.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace crosscheck {

/// A file that is written piece by piece and appears under its name only when complete. Until then it is unnamed, or,
/// on file systems without unnamed files, has a temporary name in the same folder. All members throw InputError with
/// the file's name if it cannot be written.
class StreamingFile {
 public:
  /// Creates the folder if it is missing.
  explicit StreamingFile(std::filesystem::path file);
  /// Removes an unfinished file.
  ~StreamingFile();
  StreamingFile(const StreamingFile&) = delete;
  StreamingFile& operator=(const StreamingFile&) = delete;

  void append(std::string_view bytes);
  /// Overwrites the first bytes, which must have been appended before.
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

/// Returns the whole content of a file, or nothing if it cannot be read. Throws InputError if the file is larger than a
/// quarter of the free memory, or endless.
std::optional<std::string> try_read_file(const std::filesystem::path& file);

/// Returns the whole content of a file. Throws InputError with the file's name and what was expected ("a scene file
/// (TOML)").
std::string read_file(const std::filesystem::path& file, std::string_view expected);

/// Creates the folder if it is missing. Throws InputError with its name if files cannot be written into it.
void require_writable(const std::filesystem::path& folder);

/// The text with '-' for each ASCII character outside [A-Za-z0-9._=+-] and for each unprintable one (names.h): turns
/// method and scene names into parts of file names. Texts of more than longest_derived_name bytes are shortened and end
/// in a hash of the whole text.
std::string file_name_of(std::string_view text);

/// A private folder crosscheck-PURPOSE-PROCESS.tmp-XXXXXX. It is removed with the object or, if the process was killed,
/// at the next start.
class TemporaryFolder {
 public:
  /// Creates it in `place`, by default in the system's folder for temporary files. Throws InputError that names it.
  explicit TemporaryFolder(std::string_view purpose, const std::filesystem::path& place = {});
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path path;

 private:
  int lock_ = -1;
};

/// Removes temporary folders of terminated processes from `place`, by default the system's folder for temporary files.
/// Folders of other users are removed only by root.
void remove_stale_temporary_folders(const std::filesystem::path& place = {});

}  // namespace crosscheck
