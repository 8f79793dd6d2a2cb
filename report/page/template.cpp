#include "report/page/template.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>

#include "report/base/assets.h"
#include "report/page/page.h"

namespace crosscheck {
namespace {

std::string without_indentation(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    out += text.substr(0, end);
    text.remove_prefix(std::min(end, text.size()));
  }
  return out;
}

bool is_true(const Json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number()) return value.get<double>() != 0;
  if (value.is_string()) return !value.get_ref<const std::string&>().empty();
  return !value.empty();
}

}  // namespace

/// Turns a text into parts.
class Template::Reader {
 public:
  Reader(const Template& of, std::string text) : template_(of), text_(std::move(text)) {}

  /// Up to the end of the text, or of the block that begins on that line; `closed_by`: the tag that ended it.
  std::vector<Part> parts(const std::string& block, int begun, std::string& closed_by) {
    std::vector<Part> parts;
    for (;;) {
      const size_t begin = std::min(text_.find("{{", at_), text_.size());
      if (begin > at_) parts.push_back({Part::Kind::text, text_.substr(at_, begin - at_), line()});
      at_ = begin;
      if (at_ == text_.size()) {
        if (!block.empty()) template_.fail(begun, fmt::format("{{{{#{}}}}} is not closed", block));
        return parts;
      }
      const int here = line();
      const std::string tag = next_tag();
      const size_t blank = std::min(tag.find(' '), tag.size());
      const std::string word = tag.substr(0, blank), key = tag.substr(std::min(blank + 1, tag.size()));
      if (tag == "else" || tag[0] == '/') {
        if (block.empty() || (tag == "else" ? block != "if" : tag.substr(1) != block))
          template_.fail(here, fmt::format("{{{{{}}}}} without its beginning", tag));
        closed_by = tag;
        return parts;
      }
      if (word == "#each" || word == "#if") {
        Part part{word == "#if" ? Part::Kind::condition : Part::Kind::each, key, here};
        std::string end;
        part.inside = this->parts(word.substr(1), here, end);
        if (end == "else") part.otherwise = this->parts("if", here, end);
        parts.push_back(std::move(part));
      } else if (word == ">") {
        const size_t second = std::min(key.find(' '), key.size());
        parts.push_back({Part::Kind::other, key.substr(0, second), here, key.substr(std::min(second + 1, key.size()))});
      } else if (tag[0] == '{') {
        parts.push_back({Part::Kind::html, tag.substr(1), here});
      } else if (word == "prose" || word == "bold" || word == "narrow") {
        parts.push_back({word == "bold"     ? Part::Kind::bold
                         : word == "narrow" ? Part::Kind::narrow
                                            : Part::Kind::prose,
                         key, here});
      } else if (key.empty() && word[0] != '#') {
        parts.push_back({Part::Kind::value, word, here});
      } else {
        template_.fail(here, fmt::format("unknown tag {{{{{}}}}}", tag));
      }
    }
  }

 private:
  int line() const {
    return 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<long>(at_), '\n'));
  }

  /// The text between the braces; a line of nothing but a block's tag goes with its end.
  std::string next_tag() {
    const size_t end = text_.find("}}", at_);
    if (end == std::string::npos || end == at_ + 2) template_.fail(line(), "a tag without its end or its name");
    const std::string tag = text_.substr(at_ + 2, end - at_ - 2);
    const bool alone = at_ == 0 || text_[at_ - 1] == '\n';
    at_ = end + (tag[0] == '{' ? 3 : 2);
    const bool holds_no_text = tag[0] == '#' || tag[0] == '/' || tag[0] == '>' || tag == "else";
    if (alone && holds_no_text && at_ < text_.size() && text_[at_] == '\n') ++at_;
    return tag;
  }

  const Template& template_;
  std::string text_;
  size_t at_ = 0;
};

Template::Template(std::string name, std::string_view text) : name_(std::move(name)) {
  std::string end;
  parts_ = Reader(*this, without_indentation(text)).parts("", 0, end);
}

std::string Template::filled(const Json& data) const {
  std::string out;
  fill(parts_, {&data}, out);
  return out;
}

void Template::fill(const std::vector<Part>& parts, const Scopes& scopes, std::string& out) const {
  for (const Part& part : parts) {
    if (part.kind == Part::Kind::text) {
      out += part.key;
      continue;
    }
    if (part.kind == Part::Kind::other) {
      const Template other(part.key, asset("page/templates/" + part.key + ".html"));
      Scopes inside = scopes;
      if (!part.item.empty()) inside.push_back(&value(part.item, part, scopes));
      other.fill(other.parts_, inside, out);
      continue;
    }
    const Json& found = value(part.key, part, scopes);
    if (part.kind == Part::Kind::condition) {
      fill(is_true(found) ? part.inside : part.otherwise, scopes, out);
    } else if (part.kind == Part::Kind::each) {
      if (!found.is_array()) fail(part.line, fmt::format("'{}' is no list", part.key));
      for (const Json& item : found) {
        Scopes inside = scopes;
        inside.push_back(&item);
        fill(part.inside, inside, out);
      }
    } else {
      if (!found.is_string() && !found.is_number()) fail(part.line, fmt::format("'{}' is no text", part.key));
      const std::string text = found.is_string() ? found.get<std::string>() : dump(found);
      out += part.kind == Part::Kind::html     ? text
             : part.kind == Part::Kind::prose  ? prose(text)
             : part.kind == Part::Kind::narrow ? narrow_prose(text)
             : part.kind == Part::Kind::bold   ? prose_with_bold_numbers(text)
                                               : escaped(text);
    }
  }
}

const Json& Template::value(const std::string& key, const Part& part, const Scopes& scopes) const {
  if (key == "this") return *scopes.back();
  const std::string first = key.substr(0, key.find('.'));
  for (auto scope = scopes.rbegin(); scope != scopes.rend(); ++scope) {
    if (!(*scope)->is_object() || !(*scope)->contains(first)) continue;
    const Json* found = &(**scope)[first];
    for (size_t dot = key.find('.'); dot != std::string::npos;) {
      const size_t next = key.find('.', dot + 1);
      const std::string member = key.substr(dot + 1, next == std::string::npos ? next : next - dot - 1);
      if (!found->is_object() || !found->contains(member)) fail(part.line, fmt::format("unknown key '{}'", key));
      found = &(*found)[member], dot = next;
    }
    return *found;
  }
  fail(part.line, fmt::format("unknown key '{}'", key));
}

void Template::fail(int line, const std::string& what) const {
  throw std::runtime_error(fmt::format("{}, line {}: {}", name_, line, what));
}

std::string filled(const std::string& name, const Json& data) {
  return Template(name, asset("page/templates/" + name + ".html")).filled(data);
}

}  // namespace crosscheck
