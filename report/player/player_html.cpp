// Puts the player's files into the page.
#include "report/player/player_html.h"

#include <fmt/format.h>

#include "mysim/json.h"
#include "report/assets.h"

namespace crosscheck {
namespace {

/// In the order in which they know each other: pages from a folder cannot load modules.
constexpr const char* scripts[] = {"unpack", "vectors", "colours", "orbit", "shaders", "gl",     "shapes", "motion",
                                   "extent", "stage",   "hands",   "plot",  "desk",    "player", "runs"};

/// JSON inside a script element: the one sign that could end it is written otherwise.
std::string without_brackets(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) c == '<' ? out += "\\u003c" : out += c;
  return out;
}

}  // namespace

std::string player_head() {
  std::string out = "<style>\n" + asset("player/player.css") + "</style>\n<script>(() => {\n'use strict';\n";
  for (const char* name : scripts) out += asset(fmt::format("player/{}.js", name));
  return out + "})();</script>\n";
}

std::string player_html(const PageImage& poster, const std::filesystem::path& motions) {
  return fmt::format(
      "<div class=\"player\">\n<figure class=\"render\"><div class=\"stage\">{}</div><figcaption>{}</figcaption>"
      "</figure>\n<script type=\"application/json\" class=\"motion\">{}</script>\n<motion-player></motion-player>\n"
      "</div>\n",
      image_tag(poster), escaped(poster.caption), without_brackets(content_of_file(motions)));
}

std::string runs_html(const PlayedRuns& runs) {
  const std::string base =
      runs.stage.empty() ? fmt::format("\"scene\":{}", Json(runs.scene).dump()) : "\"stage\":" + runs.stage;
  std::string methods;
  for (const auto& file : runs.methods) methods += (methods.empty() ? "" : ",") + content_of_file(file);
  return fmt::format("<script type=\"application/json\" class=\"runs\" data-runs=\"{}\">{}</script>\n",
                     escaped(runs.key), without_brackets(fmt::format("{{{},\"methods\":[{}]}}", base, methods)));
}

}  // namespace crosscheck
