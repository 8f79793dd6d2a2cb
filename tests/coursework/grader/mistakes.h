// Files of mistakes: one place of a solution, replaced. mistakes.txt, novel.txt and double.txt of an assignment.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/coursework/grader/assignment.h"

namespace coursework {

/// Paragraphs `[name]`, `part: NAME`, `loses: IDS` (may be left out), then `<<<<`, the text, `====`, its replacement,
/// `>>>>`. Throws InputError that names file, line and what was expected.
std::vector<Mistake> read_mistakes(const std::filesystem::path& file);

/// Paragraphs `[name]`, `a: NAME`, `b: NAME`: pairs of mistakes made together. Throws InputError likewise.
std::vector<std::pair<std::string, std::string>> read_pairs(const std::filesystem::path& file);

/// The source with the mistake made. Throws InputError that names the mistake unless its text stands there exactly
/// once.
std::string with_mistake(const std::string& source, const Mistake& mistake);

}  // namespace coursework
