// Files that are read and written whole, so that a killed run leaves no half file; and temporary folders.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace crosscheck {

/// A file that is written piece by piece and appears under its name only when it is whole. Until then it has no name,
/// or, on file systems without nameless files, a temporary one beside the file. Everything throws InputError that names
/// the file if it cannot be written.
class StreamingFile {
 public:
  /// Makes the folder if it is missing.
  explicit StreamingFile(std::filesystem::path file);
  /// Removes an unfinished file.
  ~StreamingFile();
  StreamingFile(const StreamingFile&) = delete;
  StreamingFile& operator=(const StreamingFile&) = delete;

  void append(std::string_view bytes);
  /// Overwrites the first bytes, which must have been appended before.
  void rewrite_beginning(std::string_view bytes);
  /// Gives the file its name and replaces an earlier one. Nothing can be appended afterwards.
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

/// Free bytes for files in the folder, or in the nearest existing one above it; infinite if unknown.
double free_disk(const std::filesystem::path& folder);

/// Writes a file as StreamingFile does.
void write_file(const std::filesystem::path& file, std::string_view content);

/// The whole content of a file; nothing if it cannot be read. Throws InputError if it is endless or larger than a
/// quarter of the free memory.
std::optional<std::string> try_read_file(const std::filesystem::path& file);

/// The whole content of a file. Throws InputError that names it and what was expected there ("a scene file (TOML)").
std::string read_file(const std::filesystem::path& file, std::string_view expected);

/// Makes the folder if it is missing. Throws InputError that names it if files cannot be written into it.
void require_writable(const std::filesystem::path& folder);

/// The text with '-' for each ASCII character outside [A-Za-z0-9._=+-] and for unprintable ones (names.h): the names of
/// methods and scenes as parts of file names. Texts of more than longest_derived_name bytes keep their beginning and
/// end in a hash of the whole.
std::string file_name_of(std::string_view text);

/// A private folder crosscheck-PURPOSE-PROCESS.tmp-XXXXXX. It is removed with the object or, if the process is killed,
/// at the next start.
class TemporaryFolder {
 public:
  /// Makes it in `place`, by default where temporary files go. Throws InputError that names it.
  explicit TemporaryFolder(std::string_view purpose, const std::filesystem::path& place = {});
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path path;

 private:
  int lock_ = -1;
};

/// Removes temporary folders of processes that have ended, in `place`, by default where temporary files go. Those of
/// other users are removed by root only.
void remove_stale_temporary_folders(const std::filesystem::path& place = {});

}  // namespace crosscheck
