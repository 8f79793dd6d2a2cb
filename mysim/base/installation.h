// Folders of data files, of programs, and of the user's cache.
#pragma once

#include <filesystem>
#include <optional>

namespace crosscheck {

// The file crosscheck.folders, next to the program or in the nearest folder above it, names two folders relative to
// itself. CMake writes one into the build folder and one into the installation, so that both can be moved.

/// Folder of files read at run time (scenes, baselines, the page's scripts, assignments), laid out as in the source
/// tree. For a build, it is the source tree itself. Throws std::runtime_error if there is no crosscheck.folders.
std::filesystem::path data_folder();

/// Folder of built files: programs, mysim's library, the lab's Python module.
std::filesystem::path programs_folder();

/// $CROSSCHECK_CACHE, else $XDG_CACHE_HOME/crosscheck, else ~/.cache/crosscheck; nothing if HOME is not set either.
std::optional<std::filesystem::path> cache_folder();

}  // namespace crosscheck
