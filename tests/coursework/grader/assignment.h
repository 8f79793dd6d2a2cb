// Assignments with their parts, tests and points. assignments.cpp has the table.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/check/random.h"
#include "tests/coursework/check/texts.h"

namespace coursework {

/// A file that the student writes. Earlier parts that it calls are linked from the official solution.
struct Part {
  std::string_view name;   // the file without its extension; calls_NAME.cpp calls it
  std::string_view title;  // key of the texts
  /// Comma-separated names of its functions, if students may write the part in Python; empty otherwise. Either all
  /// parts of an assignment have such names, or none (python.h).
  std::string_view functions = {};
};

struct Test {
  std::string_view id;    // "2.1": part and number
  std::string_view part;  // a Part's name
  int points;             // for the test with the public seed of the hand-out
  int hidden;             // for the same property with the lecturer's seed
  std::vector<std::string_view> concepts;
  std::string_view read;                // heading of the hand-out's section that explains it
  std::vector<Case> (*cases)(Random&);  // inputs and expected answers; deterministic in the seed
  /// Converts the raw numbers of a call into the numbers to compare, for oracles that hold for any constants that a
  /// student chooses. Null: compares the raw numbers.
  Found (*reduce)(const Case&, const Numbers& raw) = nullptr;
  /// Small cases, in order of size, for a test with large cases; they show a student where to begin. They run only
  /// after the test failed, and do not affect the verdict.
  std::vector<Case> (*small)(Random&) = nullptr;
};

/// Runs a program and returns one answer per case.
using Ask = std::function<std::vector<Answer>(const std::vector<Case>&)>;

/// Result of an assignment's formula analysis; empty text if it found nothing.
struct Looked {
  std::string text = {};
  bool explains = false;  // the text states an error
};

class Builder;
class Sandbox;

struct Assignment {
  std::string_view name, title;
  std::span<const Part> parts;  // in the order in which they depend on each other
  std::span<const Test> tests;  // points and hidden points sum to 100
  /// Finds the parts in a whole program that students hand in, with files of any name. Null if they hand in a file per
  /// part.
  std::unique_ptr<Builder> (*builder)(const Assignment&, const Sandbox& trusted, const Sandbox& sandbox) = nullptr;
  bool takes_whole_program() const { return builder != nullptr; }
  std::span<const std::string_view> roles = {};  // roles for which a student's grade.toml may name a class
  /// Runs the student's code for a failing part and reports which terms of its formula are wrong or right.
  Looked (*look)(const Texts& common, const std::string& part, const Ask& student) = nullptr;
  /// Reports constants of a part that are measured, but not graded, because students choose them. Called for any part.
  std::string (*measured)(const Texts& common, const std::string& part, const Ask& student) = nullptr;
  /// For tests with reduced answers: text with the question and the answer at the first error.
  std::string (*shown)(const Texts& own, const Case& what, const Numbers& raw) = nullptr;
  std::filesystem::path folder() const;
};

/// The folder tests/coursework: the one that the environment variable CROSSCHECK_COURSEWORK names, otherwise found
/// relative to the program (mysim/base/installation.h).
std::filesystem::path folder_of_coursework();

std::span<const Assignment> assignments();
/// Throws std::invalid_argument with a list of the known names.
const Assignment& find_assignment(const std::string& name);

/// A known mistake: one replacement in the solution. Read from the assignment's mistakes.txt.
struct Mistake {
  std::string name;  // key "mistake.NAME" of the texts: "behaves like ..."
  std::string part;
  std::string find, replace;       // `find` occurs exactly once in the part's solution
  std::vector<std::string> loses;  // ids of the tests that it fails, public and hidden alike
};
std::vector<Mistake> mistakes_of(const Assignment& assignment);

}  // namespace coursework
