// A zip for Gradescope with an assignment and its grader.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/coursework/grader/assignment.h"

namespace coursework {

/// Writes files by their path inside the archive. Files that begin with "#!" are executable. Throws std::runtime_error
/// if the zip cannot be written.
void write_zip(const std::filesystem::path& zip, const std::map<std::string, std::string>& files);

/// Unpacks the zip into the folder. Throws std::runtime_error if the zip cannot be read, contains a path outside the
/// folder, or exceeds the limits of a submission.
void unpack_zip(const std::filesystem::path& zip, const std::filesystem::path& folder);

// The package for Gradescope; its grader is built on the target machine.

/// Writes the zip: setup.sh (which installs packages and runs build.sh), run_autograder, sources (the grader, the part
/// of mysim that it uses, and this assignment), the headers of header-only libraries, and `secret`, the line from which
/// hidden tests are derived. Throws std::runtime_error if a source or a library is not found.
void write_package(const Assignment& assignment, const std::string& secret, const std::filesystem::path& zip);

/// Returns a file of an unpacked package that is missing, superfluous, or different from what write_package() writes;
/// empty if there is none. Any secret is accepted.
std::string foreign_file(const Assignment& assignment, const std::filesystem::path& folder);

/// Source files below `root` that a program with the sources `first` needs: included files, and sources that implement
/// them. A .cpp implements the header of the same name next to it. If there is none, and the .cpp is not a program, it
/// implements every header of its folder that it includes. Paths are relative to `root`, and sorted.
std::vector<std::string> sources_needed(const std::filesystem::path& root, std::vector<std::string> first);

/// Unpacks the zip into a fresh folder laid out as Gradescope's /autograder. If it is a package of this version, builds
/// it there with the caller's rights, and runs run_autograder on the solution under emulated container limits: 768 MB,
/// half a CPU, 10 minutes, no new namespaces. Prints its progress; the last line is "ready", or "not ready" with the
/// reason. Returns true if the package is ready.
bool rehearse(const Assignment& assignment, const std::filesystem::path& zip);

}  // namespace coursework
