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
    std::string hash;  // FNV-1a, 16 digits; empty: announced, and not known to be whole
  };
  std::string command;                // the command that owns the folder: "report", "run", ...
  bool finished = false;              // the state: "finished", or "being written"
  long process = 0;                   // the process that wrote or writes
  std::string since;                  // since when, UTC
  std::map<std::string, File> files;  // by their path inside the folder; the manifest itself is not among them

  /// Of a result that this process begins now.
  static Manifest begun(std::string command);
  /// Whether the path names a listed file, or what a killed run left of one under its temporary name.
  bool names(const std::string& path) const;
  /// Whether the path is Crosscheck's and unchanged: listed, and not changed since.
  bool ours(const std::filesystem::path& folder, const std::string& path) const;
};

/// Nothing where there is no manifest. Throws InputError that names the file where it cannot be read, or lists a path
/// that does not stay inside the folder.
std::optional<Manifest> read_manifest(const std::filesystem::path& folder);
void write_manifest(const Manifest& manifest, const std::filesystem::path& folder);
/// Throws InputError that names the file where it cannot be read.
Manifest::File file_entry(const std::filesystem::path& file);

/// "x.csv" of "x.csv.123.part" and of ".x.csv.123.part", how files and figures are called until they are whole; nothing
/// of other names.
std::optional<std::string> whole_name(const std::string& path);

/// The paths of all that is in a folder and below and is no folder itself, relative, sorted, the manifest left out;
/// links are not followed. Empty folders are listed too, with a slash at the end.
std::vector<std::string> paths_in(const std::filesystem::path& folder);

/// The present, as "2026-11-23 03:10:00 UTC".
std::string utc_now();

}  // namespace crosscheck
