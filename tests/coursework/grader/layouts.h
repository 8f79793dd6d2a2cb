// Finds the submissions, and their authors, in an exported folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/grader/submission.h"

namespace coursework {

/// The submissions in a folder, in the order of names. If the entries are named as by Moodle, Canvas or Gradescope,
/// removes what these systems added to the names, and combines all files of a person into one submission. Otherwise
/// every entry is a submission, except files that operating systems and Git leave behind, whose names are appended to
/// `skipped`. Names of submissions are printable and distinct. Throws InputError if `path` is not a folder.
std::vector<Handed> submissions_in(const std::filesystem::path& folder, std::vector<std::string>* skipped = nullptr);

/// The name of a submission's folder or archive without the archive's extension.
std::string without_archive_ending(std::string name);

/// The layout ("Moodle", "Canvas", "Gradescope", "Git", "folders") of a folder that contains a class; empty if the
/// folder looks like a single submission.
std::string class_layout(const std::filesystem::path& folder, const std::vector<std::string>& wanted);

}  // namespace coursework
