// Why a student's code crashed, and in which line: found by running it once more with every index checked.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/sandbox.h"

namespace coursework {

struct Crash {
  enum class Why { other, index, empty, iterator } why = Why::other;
  long index = 0, size = 0;  // that was asked for, and how many elements there are
  std::string file;          // the student's, where it ended
  int line = 0;
  std::size_t which = 0;  // the case, from 0
};

/// What a program of Builder::checked() printed: of the checks' message what was asked for, and the addresses of the
/// calls at hand. Students may have written anything else there: only numbers are taken.
Crash crash_in(const std::string& captured, std::vector<std::string>& addresses);

/// Asks the program of Builder::checked() and finds the line in which it crashes; nothing where it
/// does not, or not in a line of the student's: what our calls do with an answer of another size is no index of his.
std::optional<Crash> crash_of(const Sandbox& sandbox, const std::filesystem::path& program,
                              const std::vector<Case>& cases);

/// A sentence; `told` is the case, from 0, that is spoken of.
std::string crash_text(const Texts& common, const Crash& crash, std::size_t told);

}  // namespace coursework
