#include "report/page/template.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/page/page.h"

namespace crosscheck {
namespace {

/// Converters of values to text; the key is the first word of the tag.
const std::map<std::string, std::string (*)(const std::string&)>& writers() {
  static const std::map<std::string, std::string (*)(const std::string&)> table{
      {"", escaped},
      {"prose", prose},
      {"bold", prose_with_bold_numbers},
      {"narrow", narrow_prose},
      {"{", [](const std::string& text) { return text; }}};
  return table;
}

bool is_true(const Json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number()) return value.get<double>() != 0;
  if (value.is_string()) return !value.get_ref<const std::string&>().empty();
  return !value.empty();
}

}  // namespace

class Template::Reader {
 public:
  Reader(const Template& of, std::string_view text) : template_(of) {
    for (const std::string& line : split(text, '\n'))
      text_ += line.substr(std::min(line.find_first_not_of(' '), line.size())) + "\n";
    text_.pop_back();
  }

  /// Reads to the end of the text, or of the block that begins on line `begun`. `closed_by` receives the closing tag.
  std::vector<Part> parts(const std::string& block, int begun, std::string& closed_by) {
    for (std::vector<Part> parts;;) {
      const size_t begin = std::min(text_.find("{{", at_), text_.size());
      if (begin > at_) parts.push_back({"text", text_.substr(at_, begin - at_), 0});
      at_ = begin;
      const int line = 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<long>(at_), '\n'));
      if (at_ == text_.size()) {
        if (!block.empty()) template_.fail(begun, fmt::format("{{{{#{}}}}} is not closed", block));
        return parts;
      }
      const std::string tag = next_tag(line);
      if (tag == "else" || tag[0] == '/') {
        if (block.empty() || (tag == "else" ? block != "if" : tag.substr(1) != block))
          template_.fail(line, fmt::format("{{{{{}}}}} without its beginning", tag));
        closed_by = tag;
        return parts;
      }
      std::vector<std::string> words = split(tag, ' ');
      if (tag[0] == '{') words = {"{", tag.substr(1)};
      if (words.size() == 1) words.insert(words.begin(), "");
      Part part{words[0], words[1], line, words.size() > 2 ? words[2] : ""};
      if (part.kind == "#each" || part.kind == "#if") {
        std::string end;
        part.inside = this->parts(part.kind.substr(1), line, end);
        if (end == "else") part.otherwise = this->parts("if", line, end);
      } else if (part.kind != ">" && (!writers().contains(part.kind) || words.size() > 2)) {
        template_.fail(line, fmt::format("unknown tag {{{{{}}}}}", tag));
      }
      parts.push_back(std::move(part));
    }
  }

 private:
  /// Returns the text between braces. If a line contains only a block's tag, removes its line end.
  std::string next_tag(int line) {
    const size_t end = text_.find("}}", at_);
    if (end == std::string::npos || end == at_ + 2) template_.fail(line, "a tag without its end or its name");
    const std::string tag = text_.substr(at_ + 2, end - at_ - 2);
    const bool block = std::string_view("#/>").find(tag[0]) != std::string_view::npos || tag == "else",
               first = at_ == 0 || text_[at_ - 1] == '\n';
    at_ = end + (tag[0] == '{' ? 3 : 2);
    if (first && block && at_ < text_.size() && text_[at_] == '\n') ++at_;
    return tag;
  }

  const Template& template_;
  std::string text_;
  size_t at_ = 0;
};

Template::Template(std::string name, std::string_view text) : name_(std::move(name)) {
  std::string end;
  parts_ = Reader(*this, text).parts("", 0, end);
}

std::string Template::filled(const Json& data) const {
  std::string out;
  fill(parts_, {&data}, out);
  return out;
}

void Template::fill(const std::vector<Part>& parts, const Scopes& scopes, std::string& out) const {
  const auto within = [&](const Json& item) {
    Scopes inside = scopes;
    inside.push_back(&item);
    return inside;
  };
  for (const Part& part : parts) {
    if (part.kind == "text") {
      out += part.key;
    } else if (part.kind == ">") {
      const Template other(part.key, asset("page/templates/" + part.key + ".html"));
      other.fill(other.parts_, part.item.empty() ? scopes : within(value(part.item, part.line, scopes)), out);
    } else if (const Json& found = value(part.key, part.line, scopes); part.kind == "#if") {
      fill(is_true(found) ? part.inside : part.otherwise, scopes, out);
    } else if (part.kind == "#each") {
      if (!found.is_array()) fail(part.line, fmt::format("'{}' is not a list", part.key));
      for (const Json& item : found) fill(part.inside, within(item), out);
    } else {
      if (!found.is_string() && !found.is_number()) fail(part.line, fmt::format("'{}' is not a text", part.key));
      out += writers().at(part.kind)(found.is_string() ? found.get<std::string>() : dump(found));
    }
  }
}

const Json& Template::value(const std::string& key, int line, const Scopes& scopes) const {
  if (key == "this") return *scopes.back();
  const std::vector<std::string> names = split(key, '.');
  const auto holds = [](const Json* data, const std::string& name) {
    return data->is_object() && data->contains(name);
  };
  const auto scope = std::find_if(scopes.rbegin(), scopes.rend(), [&](const Json* s) { return holds(s, names[0]); });
  const Json* found = scope == scopes.rend() ? nullptr : *scope;
  for (const std::string& name : names) {
    if (!found || !holds(found, name)) fail(line, fmt::format("unknown key '{}'", key));
    found = &found->at(name);
  }
  return *found;
}

void Template::fail(int line, const std::string& what) const {
  throw std::runtime_error(fmt::format("{}, line {}: {}", name_, line, what));
}

std::string filled(const std::string& name, const Json& data) {
  return Template(name, asset("page/templates/" + name + ".html")).filled(data);
}

}  // namespace crosscheck
