#include "report/page/same_pictures.h"

#include <fmt/format.h>

#include <map>
#include <string_view>
#include <vector>

namespace crosscheck {
namespace {

struct Tag {
  size_t from, size;
  std::string_view bytes, width, height, alt;
};

/// What stands in quotes behind `name="` in a tag.
std::string_view attribute(std::string_view tag, std::string_view name) {
  const size_t at = tag.find(name);
  if (at == std::string_view::npos) return "";
  const size_t from = at + name.size();
  return tag.substr(from, tag.find('"', from) - from);
}

std::vector<Tag> pictures_in(std::string_view page) {
  std::vector<Tag> tags;
  const std::string_view begin = "<img src=\"data:image/png";
  for (size_t at = page.find(begin); at != std::string_view::npos; at = page.find(begin, at + 1)) {
    const std::string_view tag = page.substr(at, page.find('>', at) + 1 - at);
    tags.push_back({at, tag.size(), attribute(tag, "src=\""), attribute(tag, " width=\""), attribute(tag, " height=\""),
                    attribute(tag, " alt=\"")});
  }
  return tags;
}

}  // namespace

std::string sharing_pictures(const std::string& page) {
  const std::vector<Tag> tags = pictures_in(page);
  std::map<std::string_view, int> uses, names;
  for (const Tag& tag : tags) ++uses[tag.bytes];
  std::string out;
  size_t done = 0;
  for (const Tag& tag : tags) {
    if (uses[tag.bytes] < 2) continue;
    const auto [name, first] = names.emplace(tag.bytes, static_cast<int>(names.size()) + 1);
    out.append(page, done, tag.from - done);
    out += fmt::format("<svg class=\"picture\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", tag.width,
                       tag.height, tag.alt);
    out += first ? fmt::format("<image id=\"picture-{}\" width=\"{}\" height=\"{}\" href=\"{}\"/></svg>", name->second,
                               tag.width, tag.height, tag.bytes)
                 : fmt::format("<use href=\"#picture-{}\"/></svg>", name->second);
    done = tag.from + tag.size;
  }
  return out + page.substr(done);
}

}  // namespace crosscheck
