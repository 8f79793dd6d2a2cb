// Figures and pictures of a failed question.
#pragma once

#include <filesystem>

#include "report/page/page.h"
#include "report/regress/evidence.h"

namespace crosscheck {

/// Draws into OUT/figures what the evidence has: both curves, the difference over time beside its tolerance, and both
/// shapes side by side. What cannot be drawn is said in `problems`.
std::vector<PageImage> failure_figures(const Evidence& evidence, const Provenance& lines,
                                       const std::filesystem::path& out, std::vector<std::string>& problems);

/// When and how the two part, in a sentence or two.
std::string parting_in_words(const Evidence& evidence);

}  // namespace crosscheck
