#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <stdexcept>

#include "mysim/base/pattern.h"
#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/page/page_parts.h"

namespace crosscheck {
namespace {

constexpr const char* chapter_ids[] = {"same-answer", "speed-accuracy", "stability", "energy", "adequacy"};

std::vector<std::string> trimmed_parts(std::string_view text, char separator) {
  static const Pattern blanks("^ +| +$");
  std::vector<std::string> parts;
  for (const std::string& part : split(text, separator)) parts.push_back(blanks.replaced_in(part, ""));
  return parts;
}

}  // namespace

Chapter chapter_of_text(const std::string& id, const std::string& text) {
  Chapter chapter{.id = id};
  const std::map<std::string, std::string*> texts{
      {"title", &chapter.title}, {"label", &chapter.label}, {"formula", &chapter.formula}};
  const std::map<std::string, std::vector<std::string>*> lists{
      {"joins", &chapter.joins}, {"leads", &chapter.leads}, {"folds", &chapter.folds}};
  static const Pattern head("- ([a-z ]+): *(.*)");
  const size_t end = std::min(text.find("\n\n"), text.size());
  for (const std::string& line : split(std::string_view(text).substr(0, end), '\n')) {
    if (line.empty()) continue;
    const auto parts = head.match(line);
    const std::string key = parts ? (*parts)[1] : "", value = parts ? (*parts)[2] : "";
    const std::vector<std::string> bars = trimmed_parts(value, '|');
    if (texts.contains(key))
      *texts.at(key) = value;
    else if (lists.contains(key))
      *lists.at(key) = trimmed_parts(value, ',');
    else if (key.ends_with("experiment") && bars.size() == 2)
      chapter.experiments.push_back({bars[0], bars[1], key.starts_with("contact ")});
    else if (key == "group" && bars.size() >= 2)
      chapter.groups.push_back({bars[0], bars[1], bars.size() > 2});
    else
      throw std::runtime_error(fmt::format("{}.md: unknown line '{}'", id, line));
  }
  if (chapter.title.empty() || chapter.label.empty() || end == text.size())
    throw std::runtime_error(id + ".md: expected title, label and a text after an empty line");
  chapter.teaching = text.substr(end + 2);
  return chapter;
}

std::vector<Chapter> chapters() {
  std::vector<Chapter> all;
  for (const char* id : chapter_ids) all.push_back(chapter_of_text(id, asset(fmt::format("page/texts/{}.md", id))));
  return all;
}

Json glossary_data() {
  Json words = Json::array();
  const std::string text = asset("page/texts/glossary.md");
  for (size_t at = text.find("## "); at != std::string::npos;) {  // "## TERM {#ID}", then the meaning
    const size_t brace = text.find(" {#", at), line = text.find('\n', at), next = text.find("\n## ", line);
    if (brace > line) throw std::runtime_error("glossary.md: a term without {#id}: " + text.substr(at, line - at));
    words.push_back(
        {{"id", text.substr(brace + 3, line - brace - 4)},
         {"term", text.substr(at + 3, brace - at - 3)},
         {"meaning", markdown_html(text.substr(line + 1, next == std::string::npos ? next : next - line))}});
    at = next == std::string::npos ? next : next + 1;
  }
  return words;
}

}  // namespace crosscheck
