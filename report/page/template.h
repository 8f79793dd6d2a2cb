// Fills templates: text files with placeholders, mostly HTML, in report/page/templates/.
//
//   {{key}}                          the value as text, safe for HTML
//   {{prose key}}                    the same for prose: keeps a number and its unit on one line
//   {{bold key}}  {{narrow key}}     as prose, with numbers in bold; as prose, for narrow columns
//   {{{key}}}                        the raw value: HTML that another template made
//   {{#each key}} … {{/each}}        once for each item of a list; {{this}} is the item
//   {{#if key}} … {{else}} … {{/if}} unless the value is null, false, 0 or empty
//   {{> name}}  {{> name key}}       another template, with the same data or with that value
//
// A key (`scene.name`) is looked up in the innermost item first, then in the enclosing data. Indentation and lines that
// contain only a block's tag are removed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mysim/base/json.h"

namespace crosscheck {

class Template {
 public:
  /// Throws std::runtime_error ("NAME, line 3: …") for an unclosed block or an unknown tag.
  Template(std::string name, std::string_view text);

  /// Throws std::runtime_error with template, line and key if a value is missing or of the wrong type.
  std::string filled(const Json& data) const;

 private:
  struct Part {
    std::string kind;  // "text", "{" for {{{key}}}, or the tag's first word: "", "prose", "#each", ">"
    std::string key;   // key, literal text, or name of another template
    int line;
    std::string item = {};  // key of the data passed to the other template
    std::vector<Part> inside = {}, otherwise = {};
  };
  class Reader;
  using Scopes = std::vector<const Json*>;

  void fill(const std::vector<Part>& parts, const Scopes& scopes, std::string& out) const;
  const Json& value(const std::string& key, int line, const Scopes& scopes) const;
  [[noreturn]] void fail(int line, const std::string& what) const;

  std::string name_;
  std::vector<Part> parts_;
};

std::string filled(const std::string& name, const Json& data);

}  // namespace crosscheck
