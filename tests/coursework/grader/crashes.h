// Locates a crash of a student's code by running it again with checks of every index.
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
  long index = 0, size = 0;  // requested index, and number of elements
  std::string file;          // the student's file with the crash
  int line = 0;
  std::size_t which = 0;  // index of the case, from 0
};

/// Parses the output of a program of Builder::checked(). Returns the requested index from the check's message, and the
/// `addresses` of the call stack. Takes only numbers from the output, because students' programs may print anything.
Crash crash_in(const std::string& captured, std::vector<std::string>& addresses);

/// Runs the program of Builder::checked() and finds the line of the crash. Returns nullopt if the program does not
/// crash, or crashes outside of the student's lines, for example by an index error in our calls after an answer of the
/// wrong size.
std::optional<Crash> crash_of(const Sandbox& sandbox, const std::filesystem::path& program,
                              const std::vector<Case>& cases);

/// The crash as a sentence; `told` is the index of the case (from 0) that the feedback describes.
std::string crash_text(const Texts& common, const Crash& crash, std::size_t told);

}  // namespace coursework
