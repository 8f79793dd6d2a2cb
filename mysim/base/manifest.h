// crosscheck.json lists Crosscheck's files in a folder, so that nothing else there is ever removed or replaced.
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
    std::string hash;  // FNV-1a, 16 digits; empty: announced, perhaps incomplete
  };
  std::string command;                // owner of the folder: "report", "run", ...
  bool finished = false;              // state: "finished" or "being written"
  long process = 0;                   // writer
  std::string since;                  // start of the writing, UTC
  std::map<std::string, File> files;  // by path inside the folder, without the manifest itself

  /// Manifest of a result that this process begins now.
  static Manifest begun(std::string command);
  /// True for a listed file and for the unfinished copy of one that a killed run left.
  bool names(const std::string& path) const;
  /// True if the file is Crosscheck's and unchanged.
  bool ours(const std::filesystem::path& folder, const std::string& path) const;
};

/// Nothing if there is no manifest. Throws InputError that names the file if it cannot be read or lists a path outside
/// the folder.
std::optional<Manifest> read_manifest(const std::filesystem::path& folder);
void write_manifest(const Manifest& manifest, const std::filesystem::path& folder);
/// Throws InputError that names the file if it cannot be read.
Manifest::File file_entry(const std::filesystem::path& file);

/// "x.csv" for "x.csv.123.part" and ".x.csv.123.part", the names of unfinished files and figures; otherwise nothing.
std::optional<std::string> whole_name(const std::string& path);

/// Sorted relative paths of all files below a folder except the manifest, and of empty folders, with a slash at the
/// end. Links are listed, not followed.
std::vector<std::string> paths_in(const std::filesystem::path& folder);

/// Current time, as "2026-11-23 03:10:00 UTC".
std::string utc_now();

}  // namespace crosscheck
