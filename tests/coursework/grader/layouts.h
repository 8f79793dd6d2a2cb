// Who handed in what in a folder that was exported from somewhere.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/grader/submission.h"

namespace coursework {

/// Who handed in what, in the order of names. What Moodle, Canvas and Gradescope put into names of files is taken off;
/// several files of one person are one submission. Otherwise every entry is a submission, except what operating systems
/// and Git leave in folders: the names of those go to `skipped`. Names are printable and differ. Throws InputError
/// unless it is a folder.
std::vector<Handed> submissions_in(const std::filesystem::path& folder, std::vector<std::string>* skipped = nullptr);

/// The name of a submission's folder or archive without the archive's ending.
std::string without_archive_ending(std::string name);

/// Why a folder that should be one submission looks like a class ("Moodle", "Canvas", "Gradescope", "Git",
/// "folders"); empty: it does not.
std::string class_layout(const std::filesystem::path& folder, const std::vector<std::string>& wanted);

}  // namespace coursework
