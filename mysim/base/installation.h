// Where programs find their files: what they were installed or built with, each other, and the user's cache.
#pragma once

#include <filesystem>
#include <optional>

namespace crosscheck {

// Beside the program, or in the nearest folder above it, stands the file crosscheck.folders, which names two folders,
// relative to its own. CMake writes one into the build folder and another where it installs: installed or not, files
// are found in the same way, and a tree that is moved as a whole is found as well.

/// The folder that holds, under the paths of the source tree, the files that are read at run time: scenes, baselines,
/// the page's scripts, assignments. In a build it is the source tree. Throws std::runtime_error where nothing names it.
std::filesystem::path data_folder();

/// The folder of all that was built and is looked for at run time: programs, mysim's library, the lab's module.
std::filesystem::path programs_folder();

/// The folder $CROSSCHECK_CACHE, else $XDG_CACHE_HOME/crosscheck, else ~/.cache/crosscheck; none where none is named.
std::optional<std::filesystem::path> cache_folder();

}  // namespace crosscheck
