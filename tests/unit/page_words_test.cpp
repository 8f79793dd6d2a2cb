// Words of the page: numbers and units stay together, every word that is linked is explained, every part is listed.
#include <set>

#include "experiments/scenes.h"
#include "report/page/page.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Prose, NumbersHoldOnToWhatBelongsToThem) {
  EXPECT_EQ(prose("to 0.25 % of 3 mm in 500 µs"), "to 0.25\u00a0% of 3\u00a0mm in 500\u00a0µs");
  EXPECT_EQ(prose("8 x 8 of 100 000, 0.32 ± 0.01"), "8\u00a0x\u00a08 of 100\u00a0000, 0.32\u00a0±\u00a00.01");
  EXPECT_EQ(prose("< 0.001 %"), "&lt;\u00a00.001\u00a0%");
  EXPECT_EQ(prose("on 7 scenes and 3 methods"), "on 7 scenes and 3 methods");  // no s, no m
  EXPECT_EQ(prose("2 of 13"), "2 of 13");
  EXPECT_EQ(prose("a < b & 1.0e-12 m"), "a &lt; b &amp; 1.0<span class=\"n\">e-12</span>\u00a0m");
  EXPECT_EQ(prose(""), "");
  EXPECT_EQ(prose("5 "), "5 ");
}

TEST(Glossary, ExplainsEveryColumnOfTheOpeningTableOnce) {
  const std::string html = glossary_html();
  for (const ChoiceColumn& column : choice_columns())
    EXPECT_TRUE(contains(html, fmt::format("id=\"word-{}\"", column.term))) << column.head;
  EXPECT_THROW(term_link("unheard-of"), std::logic_error);
  std::set<std::string> ids;
  for (size_t at = html.find("id=\"word-"); at != std::string::npos; at = html.find("id=\"word-", at + 1))
    EXPECT_TRUE(ids.insert(html.substr(at, html.find('"', at + 4) - at)).second);
  EXPECT_GT(ids.size(), 15u);
}

TEST(Contents, LeadToEveryPartThatIsThere) {
  const std::vector<Scene> scenes = load_scenes({"spring", "chain"});
  const SceneFacts none;
  PageContent content;
  content.chapters = chapters();
  content.chapters[0].entries = {{"heading", "text", {}, {{"one row", {"a"}, {{"b"}}}}}};
  for (const Scene& scene : scenes) {
    content.scenes.push_back({&scene, &none, {}, {}, {}, {}});
    content.scenes.back().choice = choice_of(scene, none, {});
  }
  const std::string html = page_html(content), nav = contents_html(content);
  std::set<std::string> targets;
  for (size_t at = html.find("href=\"#"); at != std::string::npos; at = html.find("href=\"#", at + 1))
    targets.insert(html.substr(at + 7, html.find('"', at + 7) - at - 7));
  for (const std::string& id : targets) EXPECT_TRUE(contains(html, "id=\"" + id + "\"")) << id;
  for (const char* id : {"scenes", "speed-accuracy", "spring", "chain", "words", "made"})
    EXPECT_TRUE(contains(nav, fmt::format("href=\"#{}\"", id))) << id;
  EXPECT_FALSE(contains(nav, "#stability")) << "a chapter without entries has no part";
  for (const Chapter& chapter : chapters()) EXPECT_FALSE(chapter.label.empty()) << chapter.id;
}

}  // namespace
}  // namespace crosscheck
