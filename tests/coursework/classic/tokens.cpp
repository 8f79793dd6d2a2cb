// The tokeniser and what is read off its tokens.
#include <algorithm>
#include <cctype>
#include <sstream>

#include "tests/coursework/classic/survey.h"

namespace coursework::classic {
namespace {

bool starts_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Behind the comment, string or line of the preprocessor that begins at `at`; `at` itself where none does.
std::size_t skip(const std::string& text, std::size_t at, bool first_of_line) {
  const auto past = [&](const char* end, std::size_t from) {
    const std::size_t found = text.find(end, from);
    return found == std::string::npos ? text.size() : found + std::string(end).size();
  };
  if (text.compare(at, 2, "//") == 0) return std::min(text.find('\n', at), text.size());
  if (text.compare(at, 2, "/*") == 0) return past("*/", at + 2);
  if (text[at] == '#' && first_of_line) {
    while (at < text.size() && text[at] != '\n') at += text[at] == '\\' && at + 1 < text.size() ? 2 : 1;
    return std::min(at, text.size());
  }
  if (text[at] != '"' && text[at] != '\'') return at;
  const char quote = text[at];
  for (++at; at < text.size() && text[at] != quote && text[at] != '\n'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

}  // namespace

std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> tokens;
  bool first = true;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (std::isspace(static_cast<unsigned char>(c))) {
      first = first || c == '\n';
      ++at;
      continue;
    }
    if (const std::size_t next = skip(text, at, first); next != at) {
      at = next;
      continue;
    }
    first = false;
    std::size_t end = at + 1;
    if (in_word(c))
      while (end < text.size() && in_word(text[end])) ++end;
    if (starts_word(c) || !in_word(c)) tokens.push_back(text.substr(at, end - at));
    at = end;
  }
  return tokens;
}

std::optional<std::string> defines_class(const std::vector<std::string>& tokens, const std::string& name) {
  for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
    if ((tokens[i] != "class" && tokens[i] != "struct") || lower(tokens[i + 1]) != lower(name)) continue;
    const std::string& next = tokens[i + 2] == "final" && i + 3 < tokens.size() ? tokens[i + 3] : tokens[i + 2];
    if (next == ":" || next == "{") return tokens[i + 1];
  }
  return {};
}

bool defines_member(const std::vector<std::string>& tokens, const std::string& owner, const std::string& name) {
  for (std::size_t i = 0; i + 3 < tokens.size(); ++i)
    if (tokens[i] == owner && tokens[i + 1] == ":" && tokens[i + 2] == ":" && tokens[i + 3] == name) return true;
  return false;
}

Drawing drawing_in(const std::vector<std::string>& tokens) {
  Drawing found;
  std::set<std::string> own;
  const auto begins = [](const std::string& word, const char* prefix) {
    const std::size_t size = std::string(prefix).size();
    return word.size() > size && word.compare(0, size, prefix) == 0;
  };
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::string& word = tokens[i];
    for (const char* prefix : {"GL_", "GLU_", "GLUT_", "GLFW_"})
      if (begins(word, prefix)) found.constants.insert(word);
    const bool called = i + 1 < tokens.size() && tokens[i + 1] == "(";
    if (!called || (i > 0 && (tokens[i - 1] == "." || tokens[i - 1] == ":" || tokens[i - 1] == ">"))) continue;
    for (const char* prefix : {"gl", "glu", "glut", "glfw"})
      if (begins(word, prefix) && std::isupper(static_cast<unsigned char>(word[std::string(prefix).size()])))
        found.functions.insert(word);
    // "void glFlag(": a function of the student's that is only called so
    if (i > 0 && starts_word(tokens[i - 1][0]) && tokens[i - 1] != "return" && tokens[i - 1] != "else")
      own.insert(word);
  }
  for (const std::string& word : own) found.functions.erase(word);
  return found;
}

namespace {

/// Where the name of an include begins and how long it is; nothing where the line is none.
std::optional<std::pair<std::size_t, std::size_t>> include_in(const std::string& line) {
  std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string::npos || line[at] != '#') return {};
  at = line.find_first_not_of(" \t", at + 1);
  if (at == std::string::npos || line.compare(at, 7, "include") != 0) return {};
  at = line.find_first_of("\"<", at + 7);
  if (at == std::string::npos) return {};
  const std::size_t end = line.find(line[at] == '<' ? '>' : '"', at + 1);
  if (end == std::string::npos) return {};
  return std::pair{at + 1, end - at - 1};
}

}  // namespace

std::vector<std::string> includes_of(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const auto place = include_in(line)) found.push_back(line.substr(place->first, place->second));
  return found;
}

std::string with_includes(const std::string& text, std::string (*rename)(const std::string&)) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (const auto place = include_in(line))
      line.replace(place->first, place->second, rename(line.substr(place->first, place->second)));
    out += line + "\n";
  }
  return out;
}

}  // namespace coursework::classic
