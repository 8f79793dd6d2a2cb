// Folders of data files, programs and the user's cache.
#pragma once

#include <filesystem>
#include <optional>

namespace crosscheck {

// The file crosscheck.folders, beside the program or in the nearest folder above it, names two folders relative to its
// own. CMake writes one into the build folder and another one where it installs, so that trees may be moved as a whole.

/// The folder of files read at run time (scenes, baselines, the page's scripts, assignments), with the paths of the
/// source tree; in a build it is the source tree. Throws std::runtime_error if nothing names it.
std::filesystem::path data_folder();

/// The folder of built files: programs, mysim's library, the lab's module.
std::filesystem::path programs_folder();

/// $CROSSCHECK_CACHE, else $XDG_CACHE_HOME/crosscheck, else ~/.cache/crosscheck; nothing if HOME is not set either.
std::optional<std::filesystem::path> cache_folder();

}  // namespace crosscheck
