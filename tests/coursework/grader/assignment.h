// Assignments: their parts, tests and points. The table of all is in assignments.cpp; a new one is a folder and a row.
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

/// A file that the student writes, and what of the earlier parts it calls (those are ours when it is graded).
struct Part {
  std::string_view name;   // the file without its ending; calls_NAME.cpp calls it
  std::string_view title;  // key of the texts
};

struct Test {
  std::string_view id;    // "2.1": part and number
  std::string_view part;  // a Part's name
  int points;             // with the seed that the hand-out shows
  int hidden;             // the same property with the lecturer's seed
  std::vector<std::string_view> concepts;
  std::string_view read;                // heading of the handout that explains it
  std::vector<Case> (*cases)(Random&);  // inputs and right answers; with the same seed the same
  /// Turns the raw numbers of a call into those that are compared; null: the raw ones are. For oracles that hold
  /// whatever constants a student chose.
  Found (*reduce)(const Case&, const Numbers& raw) = nullptr;
  /// Of a test whose cases are large: small ones, in the order of their size, which tell a student where to begin. They
  /// are asked only where the test failed already, and decide nothing.
  std::vector<Case> (*small)(Random&) = nullptr;
};

/// Answers of a program, one for each case.
using Ask = std::function<std::vector<Answer>(const std::vector<Case>&)>;

/// What a look at a formula found; empty where it found nothing.
struct Looked {
  std::string text = {};
  bool explains = false;  // it says what is wrong
};

class Builder;
class Sandbox;

struct Assignment {
  std::string_view name, title;
  std::span<const Part> parts;  // in the order in which they build on each other
  std::span<const Test> tests;  // points and hidden points sum to 100
  /// Null: a file per part is handed in. Else a whole program is, whatever its files are called, and this finds the
  /// parts in it.
  std::unique_ptr<Builder> (*builder)(const Assignment&, const Sandbox& trusted, const Sandbox& sandbox) = nullptr;
  bool takes_whole_program() const { return builder != nullptr; }
  std::span<const std::string_view> roles = {};  // what a student's grade.toml may name a class for
  /// Asks the student's code for a part that fails and says what of its formula is found to be wrong, or right.
  Looked (*look)(const Texts& common, const std::string& part, const Ask& student) = nullptr;
  /// Says of a part what no test judges, whether it fails or not: constants that are a student's choice.
  std::string (*measured)(const Texts& common, const std::string& part, const Ask& student) = nullptr;
  /// Where answers are reduced: what was asked of the student's code and what came, of what is not as it should be.
  std::string (*shown)(const Texts& own, const Case& what, const Numbers& raw) = nullptr;
  std::filesystem::path folder() const;
};

/// tests/coursework itself: beside the program (mysim/base/installation.h), or where the environment says
/// (CROSSCHECK_COURSEWORK).
std::filesystem::path folder_of_coursework();

std::span<const Assignment> assignments();
/// Throws std::invalid_argument that lists what there is.
const Assignment& find_assignment(const std::string& name);

/// A known mistake: one place of the solution, replaced. Read from the assignment's mistakes.txt.
struct Mistake {
  std::string name;  // key "mistake.NAME" of the texts: "behaves like ..."
  std::string part;
  std::string find, replace;       // `find` stands in the part's solution exactly once
  std::vector<std::string> loses;  // ids of the tests that it fails, public and hidden alike
};
std::vector<Mistake> mistakes_of(const Assignment& assignment);

}  // namespace coursework
