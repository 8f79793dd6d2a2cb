// Reads C++ as far as finding things takes: which file declares a class, what is included, which names of OpenGL are
// used. A tokeniser of its own: no regular expression runs on a text that anybody may have written.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/coursework/grader/submission.h"

namespace coursework::classic {

/// Path in the submission, with '/' -> content.
using Files = std::map<std::string, std::string>;

/// Identifiers and single characters, without comments, strings, numbers and lines of the preprocessor.
std::vector<std::string> tokens_of(const std::string& text);

/// What the lines `#include "X"` and `#include <X>` name, in order.
std::vector<std::string> includes_of(const std::string& text);
/// The text with each include renamed by `rename`, line by line; all else as it was.
std::string with_includes(const std::string& text, std::string (*rename)(const std::string&));

/// The name as the file spells it where it defines (not only announces) such a class, letters' case apart.
std::optional<std::string> defines_class(const std::vector<std::string>& tokens, const std::string& name);
/// Whether `owner::name` stands there, and, for a constructor or method, outside of its class.
bool defines_member(const std::vector<std::string>& tokens, const std::string& owner, const std::string& name);

struct GlNames {
  std::set<std::string> functions, constants;
};
/// Names of gl, glu, glut and glfw that are called or used and that the tokens do not define themselves.
GlNames gl_names_in(const std::vector<std::string>& tokens);

std::string folder_name(const std::string& path);
bool is_header(const std::string& path);
bool is_source(const std::string& path);

/// What of a submission counts: C++ files, no hidden ones, no drawing library brought along, a vecmath of its own only
/// where its sources came too, and one file of each name (that of the folder with most files), which can be written as
/// it is called. What was left out and matters is said in `notes`.
Files choose_files(const Files& all, std::vector<Remark>& notes);

}  // namespace coursework::classic
