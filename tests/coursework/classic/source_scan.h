// Reads C++ as far as finding things takes: which classes a file declares and what it includes. A tokeniser of its own:
// no regular expression runs on a text that anybody may have written.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/coursework/grader/submission.h"

namespace coursework::classic {

/// Path in the submission, with '/' -> content.
using Files = std::map<std::string, std::string>;

/// Identifiers and single characters, without comments, strings, numbers and lines of the preprocessor.
std::vector<std::string> tokens_of(const std::string& text);

struct ClassInfo {
  std::string name, scope;         // scope: namespaces and classes around it, as "a::b"; empty: none
  std::string file;                // path in the submission; of a header of ours its flat name
  std::vector<std::string> bases;  // every name between ':' and '{', arguments of templates among them
  bool usable = true;              // no template, and not within a function
  bool ours = false;               // from a header that stands in for one that the course ships

  std::string full() const { return scope.empty() ? name : scope + "::" + name; }
};
std::vector<ClassInfo> classes_in(const std::vector<std::string>& tokens, const std::string& file);

/// True if the tokens hold `owner::name`.
bool defines_member(const std::vector<std::string>& tokens, const std::string& owner, const std::string& name);

/// The text with the name of each include, its quotes or brackets included, replaced by what `lead` returns for it;
/// empty: it stays.
std::string with_includes(const std::string& text,
                          const std::function<std::string(const std::string& name, bool in_brackets)>& lead);

bool is_header(const std::string& path);
bool is_source(const std::string& path);

/// The one name under which a file is kept, whatever its folder, its letters' case and the marks of copies.
std::string flat_name(const std::string& path);

struct Selection {
  Files files;                      // no two of them have the same flat name
  std::vector<Remark> notes;        // on files left out
  std::vector<std::string> others;  // folders and files to prefer in further tries: they hold other versions
};
/// The C++ files of a submission that count: none of a drawing library or of the hand-out's check, vecmath only if its
/// sources came too. Of several versions it takes the one below `preferred`, no backup, the shallowest.
Selection choose_files(const Files& all, const std::string& preferred = "");

}  // namespace coursework::classic
