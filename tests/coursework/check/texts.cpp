#include "texts.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace coursework {
namespace {

std::string without_blank_ends(const std::string& text) {
  const char* blank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

}  // namespace

Texts Texts::read(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream content;
  content << in.rdbuf();
  if (!in) throw std::runtime_error(file + ": cannot be read");
  return parse(content.str(), file);
}

Texts Texts::parse(const std::string& content, const std::string& name) {
  Texts texts;
  std::string line, key;
  int number = 0;
  auto wrong = [&](const std::string& what) {
    return std::runtime_error(name + ":" + std::to_string(number) + ": " + what);
  };
  for (std::istringstream in(content); std::getline(in, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty() && line[0] == '#') continue;
    if (line.size() > 2 && line[0] == '[' && line.back() == ']') {
      key = line.substr(1, line.size() - 2);
      if (!texts.map_.emplace(key, "").second) throw wrong("the key [" + key + "] stands there twice");
    } else if (!key.empty()) {
      texts.map_[key] += line + "\n";
    } else if (!without_blank_ends(line).empty()) {
      throw wrong("text before the first [key]");
    }
  }
  for (auto& entry : texts.map_) entry.second = without_blank_ends(entry.second);
  return texts;
}

const std::string& Texts::of(const std::string& key) const {
  const auto found = map_.find(key);
  if (found == map_.end()) throw std::out_of_range("no text [" + key + "]");
  return found->second;
}

std::string Texts::filled(std::string text, std::initializer_list<std::string> with) {
  // a single pass from left to right does not expand inserted text again
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text[at] == '{' ? text.find('}', at) : std::string::npos;
    const std::string inside = end == std::string::npos ? "" : text.substr(at + 1, end - at - 1);
    const bool number = inside.size() == 1 && inside[0] >= '0' && inside[0] <= '9';
    if (number && static_cast<std::size_t>(inside[0] - '0') < with.size()) {
      result += *(with.begin() + (inside[0] - '0'));
      at = end + 1;
    } else {
      result += text[at++];
    }
  }
  return result;
}

}  // namespace coursework
