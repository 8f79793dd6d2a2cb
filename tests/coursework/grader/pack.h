// The package that Gradescope takes: an assignment with its grader, as a zip.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/coursework/grader/assignment.h"

namespace coursework {

// Zip files.

/// Files by their path inside the archive; those that begin with "#!" can be executed. Throws std::runtime_error where
/// it cannot be written.
void write_zip(const std::filesystem::path& zip, const std::map<std::string, std::string>& files);

/// Unpacks into the folder. Throws std::runtime_error where the zip cannot be read, names a file outside, or holds more
/// than a submission may.
void unpack_zip(const std::filesystem::path& zip, const std::filesystem::path& folder);

// The package for Gradescope; its grader is built where it will run.

/// Writes the zip: setup.sh (packages, then build.sh), run_autograder, the sources of the grader, of the part of mysim
/// that it uses and of this assignment, the headers of the libraries that consist of headers, and `secret`, the line
/// that hidden tests are made from. Throws std::runtime_error where a source or a library is not found.
void write_package(const Assignment& assignment, const std::string& secret, const std::filesystem::path& zip);

/// A file of an unpacked package that is missing, or not what write_package() would write; empty: none. The secret may
/// be any.
std::string foreign_file(const Assignment& assignment, const std::filesystem::path& folder);

/// Source files below `root` that the program made of `first` needs: what they include, and what belongs to that: the
/// .cpp beside a header, and each .cpp without a header of its own that includes one of these headers from its own
/// folder and is no program. Paths are relative to `root`, sorted.
std::vector<std::string> sources_needed(const std::filesystem::path& root, std::vector<std::string> first);

/// Unpacks the zip into a fresh folder laid out as Gradescope's /autograder. A package of this version, and no other,
/// is built there, with the rights of the caller; then it runs run_autograder on the solution as in such a container:
/// 768 MB, half a CPU, 10 minutes, no new namespaces. Prints what it does; the last line is "ready", or "not ready" and
/// why. Returns whether it is ready.
bool rehearse(const Assignment& assignment, const std::filesystem::path& zip);

}  // namespace coursework
