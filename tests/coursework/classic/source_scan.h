// Reads C++ just enough to find the classes that a file declares and its includes. Uses a tokeniser instead of regular
// expressions, because the text is untrusted.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/coursework/grader/submission.h"

namespace coursework::classic {

/// Path in the submission, with '/' as separator -> content.
using Files = std::map<std::string, std::string>;

/// Identifiers and single characters, without comments, strings, numbers and preprocessor lines.
std::vector<std::string> tokens_of(const std::string& text);

struct ClassInfo {
  std::string name, scope;         // scope: namespaces and classes around it, as "a::b"; empty: none
  std::string file;                // path in the submission; flat name for a header of ours
  std::vector<std::string> bases;  // every name between ':' and '{', including template arguments
  bool usable = true;              // neither a template nor local to a function
  bool ours = false;               // from a header that replaces one that the course provides

  std::string full() const { return scope.empty() ? name : scope + "::" + name; }
};
std::vector<ClassInfo> classes_in(const std::vector<std::string>& tokens, const std::string& file);

/// True if the tokens contain `owner::name`.
bool defines_member(const std::vector<std::string>& tokens, const std::string& owner, const std::string& name);

/// The text with the name of each include, including its quotes or brackets, replaced by the result of `lead`; an empty
/// result leaves it unchanged.
std::string with_includes(const std::string& text,
                          const std::function<std::string(const std::string& name, bool in_brackets)>& lead);

bool is_header(const std::string& path);
bool is_source(const std::string& path);

/// The unique name under which a file is stored, independent of folder, case and copy marks.
std::string flat_name(const std::string& path);

struct Selection {
  Files files;                      // no two of them have the same flat name
  std::vector<Remark> notes;        // on files that were left out
  std::vector<std::string> others;  // folders and files with other versions, to prefer in further tries
};
/// The C++ files of a submission that count: no drawing library, nothing of the hand-out's check, and vecmath only if
/// its sources were handed in. Of several versions, chooses the one below `preferred`, then non-backups, then the
/// shallowest.
Selection choose_files(const Files& all, const std::string& preferred = "");

}  // namespace coursework::classic
