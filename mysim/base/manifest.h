// crosscheck.json lists Crosscheck's files in a folder. No other file there is ever removed or replaced.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace crosscheck {

struct Manifest {
  static constexpr auto file_name = "crosscheck.json";
  struct File {
    std::uintmax_t bytes = 0;
    std::string hash;  // FNV-1a, 16 digits; empty for an announced file, which may be incomplete
  };
  std::string command;                // command that owns the folder: "report", "run", ...
  bool finished = false;              // state: "finished" or "being written"
  long process = 0;                   // the writer's process id
  std::string since;                  // start of writing, UTC
  std::map<std::string, File> files;  // by relative path, without the manifest itself

  /// The manifest of a result that this process begins to write now.
  static Manifest begun(std::string command);
  /// True for a listed file, and for its unfinished copy left by a killed run.
  bool names(const std::string& path) const;
  bool ours(const std::filesystem::path& folder, const std::string& path) const;
};

/// Returns nothing if there is no manifest. Throws InputError with the file's name if it cannot be read or lists a path
/// outside the folder.
std::optional<Manifest> read_manifest(const std::filesystem::path& folder);
void write_manifest(const Manifest& manifest, const std::filesystem::path& folder);
/// Throws InputError with the file's name if it cannot be read.
Manifest::File file_entry(const std::filesystem::path& file);

/// "x.csv" for "x.csv.123.part" and ".x.csv.123.part" (unfinished files and figures); nothing for other names.
std::optional<std::string> whole_name(const std::string& path);

/// Sorted relative paths of all files below a folder, except the manifest, and of empty folders (with a trailing
/// slash). Does not follow symbolic links.
std::vector<std::string> paths_in(const std::filesystem::path& folder);

/// Current time, as "2026-11-23 03:10:00 UTC".
std::string utc_now();

}  // namespace crosscheck
