// Files read and written whole, so that a killed run leaves no half file; and temporary folders.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace crosscheck {

// A file that is written piece by piece while a run goes on, and is seen only when it is whole.

/// Until finish() it has no name, or, where file systems know no nameless files, a temporary one next to the file: a
/// killed run leaves no half file. Everything throws InputError that names the file when it cannot be written.
class StreamingFile {
 public:
  /// Makes the folder where it is missing.
  explicit StreamingFile(std::filesystem::path file);
  /// Removes an unfinished file.
  ~StreamingFile();
  StreamingFile(const StreamingFile&) = delete;
  StreamingFile& operator=(const StreamingFile&) = delete;

  void append(std::string_view bytes);
  /// Writes over the first bytes; there must be as many.
  void rewrite_beginning(std::string_view bytes);
  /// Puts the file under its name, in place of one that was there. Nothing can be appended afterwards.
  void finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void fail(const std::string& why) const;

  std::filesystem::path file_, temporary_;
  bool named_ = false;  // the temporary name is there
  std::unique_ptr<std::FILE, Close> out_;
};

/// Bytes that can be written into the folder, or into the nearest one above it that is there. Infinite where nothing is
/// known.
double free_disk(const std::filesystem::path& folder);

// Writing files so that a killed run leaves no half file.

/// Writes under a temporary name next to the file and renames it. Makes the folder where it is missing.
/// Throws InputError that names the file when it cannot be written.
void write_file(const std::filesystem::path& file, std::string_view content);

/// The whole content of a file; nothing where it cannot be read. Throws InputError where it has no end, or takes more
/// than a quarter of the memory that is left.
std::optional<std::string> try_read_file(const std::filesystem::path& file);

/// The whole content of a file. Throws InputError that names it and what was expected there ("a scene file (TOML)").
std::string read_file(const std::filesystem::path& file, std::string_view expected);

/// Makes sure that files can be written into the folder, making it where it is missing. Throws InputError that names
/// it.
void require_writable(const std::filesystem::path& folder);

/// The text with '-' for each ASCII character outside [A-Za-z0-9._=+-], and for what is not printable (names.h): how
/// names of methods and scenes, and names that are made of them, appear in file names. One of more than
/// longest_derived_name bytes keeps its beginning and ends in a hash of the whole text.
std::string file_name_of(std::string_view text);

// A private folder that goes away with the object, or, where the process is killed, at the next start.

struct TemporaryFolder {
  /// crosscheck-PURPOSE-OWNER-XXXXXX where temporary files go; the owner is this process (see temporary_name()). Throws
  /// InputError that names it when it cannot be made.
  explicit TemporaryFolder(std::string_view purpose);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path path;
};

/// A name for mkdtemp that identifies the owner: its number, when it was started (clock ticks since the boot), and the
/// namespace in which the number means something.
std::string temporary_name(std::string_view purpose);

/// Removes the folders of processes that are gone, as far as they are this user's; root removes those that were lent to
/// other users too.
void remove_stale_temporary_folders();

/// Removes plain files in a folder that bear the name of a temporary folder, whatever their ending, of processes that
/// are gone: what a killed one left half written.
void remove_stale_files(const std::filesystem::path& folder);

/// The pid namespace of a process, as names of temporary folders hold it: a number.
std::string pid_namespace_of(std::string_view process = "self");

/// Removes the folders of a namespace all of whose processes have ended.
void remove_temporary_folders_of(const std::string& pid_namespace);

}  // namespace crosscheck
