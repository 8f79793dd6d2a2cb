// The texts of an assignment in one language.
#pragma once

#include <map>
#include <string>

namespace coursework {

/// A file of paragraphs: a line `[key]`, then its text up to the next key. Lines that begin with `#` are comments.
/// fill() replaces {0}, {1}, ... in a text.
class Texts {
 public:
  /// Throws std::runtime_error with the file and line if the file is unreadable, repeats a key, or has text before the
  /// first key.
  static Texts read(const std::string& file);
  static Texts parse(const std::string& content, const std::string& name);
  bool has(const std::string& key) const { return map_.count(key) > 0; }
  /// Throws std::out_of_range with the key if there is no such text.
  const std::string& of(const std::string& key) const;
  template <class... A>
  std::string fill(const std::string& key, const A&... a) const {
    return filled(of(key), {a...});
  }
  const std::map<std::string, std::string>& all() const { return map_; }

 private:
  static std::string filled(std::string text, std::initializer_list<std::string> with);
  std::map<std::string, std::string> map_;
};

}  // namespace coursework
