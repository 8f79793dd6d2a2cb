// Parses C++ just enough to find the classes that a file declares, and lists the candidate classes for each role in the
// order of trial. Uses a tokeniser instead of regular expressions, because the text is untrusted.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/coursework/grader/submission.h"

namespace coursework::classic {

/// Path in the submission, with '/' as separator -> content.
using Files = std::map<std::string, std::string>;

/// Identifiers and single characters, without comments, strings, numbers and preprocessor lines.
std::vector<std::string> tokens_of(const std::string& text);

struct ClassInfo {
  std::string name, scope;         // scope: namespaces and classes around the class, as "a::b", or empty
  std::string file;                // path in the submission; flat name for a header of ours
  std::vector<std::string> bases;  // every name between ':' and '{', including template arguments
  bool ours = false;               // belongs to a header that replaces one that the course provides

  std::string full() const { return scope.empty() ? name : scope + "::" + name; }
};
std::vector<ClassInfo> classes_in(const std::vector<std::string>& tokens, const std::string& file);

/// True if the tokens contain `owner::name`.
bool defines_member(const std::vector<std::string>& tokens, const std::string& owner, const std::string& name);

/// A role that a class can take in the tests of a part. The chain is tested with the pendulum.
struct Role {
  std::string_view name;                // in grade.toml
  std::string_view part;                // the part whose program calls the class
  bool stepper;                         // true: a time stepper; false: a particle system
  std::vector<std::string_view> names;  // known class names
};
const std::vector<Role>& roles();
const Role& role_of(std::string_view name);
std::span<const std::string_view> role_names();

/// All classes of a program: from the student's headers, from the student's sources, and from our replacements of files
/// that the course provides.
using ClassList = std::vector<ClassInfo>;

struct Candidate {
  const ClassInfo* of;
  bool named;   // has the role's name, or is named in the student's grade.toml: gets the role even if it is wrong
  bool likely;  // named, or has the name of the other role of the same part
};
/// Candidates in the order of trial. If `wanted` (role -> class) names a class, only that class; otherwise first the
/// classes with the role's name, then others of the same kind, except those named like a role of another part.
std::vector<Candidate> candidates(const ClassList& all, const Role& role,
                                  const std::map<std::string, std::string>& wanted);
/// The first class of this name, or null.
const ClassInfo* named(const ClassList& all, std::string_view name);
/// True if the class derives from TimeStepper (`stepper`) or from ParticleSystem.
bool is_kind(const ClassList& all, const ClassInfo& one, bool stepper);

bool is_header(const std::string& path);

/// The unique name under which a file is stored, independent of folder, case and copy marks.
std::string flat_name(const std::string& path);

struct Selection {
  Files files;                      // flat names are unique
  std::vector<Remark> notes;        // on files that were left out
  std::vector<std::string> others;  // folders and files with other versions, which further tries should prefer
};
/// Chooses which files of read_submission() are compiled: none of the hand-out's check, and vecmath only if its sources
/// were handed in. Of several versions, prefers the one below `preferred`, then one that is not a backup, then a source
/// named after its class, then the one in the fewest folders.
Selection choose_files(const Files& all, const std::string& preferred = "");

}  // namespace coursework::classic
