// The texts of the page, from report/page/texts/: chapters and glossary.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/page/page_parts.h"

namespace crosscheck {
namespace {

constexpr const char* chapter_ids[] = {"same-answer", "speed-accuracy", "stability", "energy", "adequacy"};

std::string trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(' ');
  return begin == std::string_view::npos ? "" : std::string(text.substr(begin, text.find_last_not_of(' ') + 1 - begin));
}

std::vector<std::string> trimmed_parts(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (const std::string& part : split(text, separator)) parts.push_back(trimmed(part));
  return parts;
}

}  // namespace

Chapter chapter_of_text(const std::string& id, const std::string& text) {
  Chapter chapter{.id = id};
  const size_t end = text.find("\n\n");
  for (const std::string& line : split(std::string_view(text).substr(0, end), '\n')) {
    if (line.empty()) continue;
    const size_t colon = std::min(line.find(": "), line.size());
    const std::string key = line.substr(std::min<size_t>(2, colon), colon - std::min<size_t>(2, colon)),
                      value = trimmed(line.substr(std::min(colon + 1, line.size())));
    const std::vector<std::string> parts = trimmed_parts(value, '|');
    if (key == "title")
      chapter.title = value;
    else if (key == "label")
      chapter.label = value;
    else if (key == "formula")
      chapter.formula = value;
    else if (key == "joins")
      chapter.joins = trimmed_parts(value, ',');
    else if (key == "leads")
      chapter.leads = trimmed_parts(value, ',');
    else if (key == "folds")
      chapter.folds = trimmed_parts(value, ',');
    else if (key.ends_with("experiment") && parts.size() == 2)
      chapter.experiments.push_back({parts[0], parts[1], key.starts_with("contact ")});
    else if (key == "group" && parts.size() >= 2)
      chapter.groups.push_back({parts[0], parts[1], parts.size() > 2});
    else
      throw std::runtime_error(fmt::format("{}.md: unknown line '{}'", id, line));
  }
  if (chapter.title.empty() || chapter.label.empty() || end == std::string::npos)
    throw std::runtime_error(id + ".md: expected title, label and a text behind an empty line");
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
  for (size_t at = text.find("## "); at != std::string::npos;) {  // "## TERM {#ID}", then what it means
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
