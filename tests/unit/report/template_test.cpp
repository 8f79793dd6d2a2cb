#include "report/page/template.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "mysim/base/installation.h"
#include "report/base/assets.h"
#include "report/page/page.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

std::string fill(const std::string& text, const Json& data) { return Template("probe", text).filled(data); }
std::string failure(const std::string& text, const Json& data = Json::object()) {
  try {
    fill(text, data);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Templates, EscapeValuesUnlessTheyAreHtml) {
  const Json data{{"a", "<b> & \"c\""}, {"n", 12}, {"x", "at 3 mm < 2.0e-7 m"}};
  EXPECT_EQ(fill("<i title=\"{{a}}\">{{n}}</i>", data), "<i title=\"&lt;b&gt; &amp; &quot;c&quot;\">12</i>");
  EXPECT_EQ(fill("{{{a}}}", data), "<b> & \"c\"");
  EXPECT_EQ(fill("{{prose x}}|{{bold x}}", data),
            prose("at 3 mm < 2.0e-7 m") + "|" + prose_with_bold_numbers("at 3 mm < 2.0e-7 m"));
  EXPECT_EQ(fill("{{a}}", Json{{"a", "{{n}}"}, {"n", 1}}), "{{n}}") << "values are not templates";
}

TEST(Templates, RepeatAndChooseAndNest) {
  const Json data{{"title", "T"},
                  {"rows", {{{"name", "one"}, {"cells", {1, 2}}}, {{"name", "two"}, {"cells", Json::array()}}}},
                  {"scene", {{"name", "chain"}, {"truth", {{"tier", "exact"}}}}}};
  EXPECT_EQ(fill("{{#each rows}}{{name}}:{{#each cells}}[{{title}} {{this}}]{{/each}};{{/each}}", data),
            "one:[T 1][T 2];two:;")
      << "outer values are visible inside an item";
  EXPECT_EQ(fill("{{#each rows}}{{#if cells}}yes {{name}}{{else}}no {{name}}{{/if}} {{/each}}", data),
            "yes one no two ");
  EXPECT_EQ(fill("{{scene.name}} {{scene.truth.tier}}", data), "chain exact");
  for (const Json& nothing : {Json(nullptr), Json(false), Json(0), Json(""), Json::array(), Json::object()})
    EXPECT_EQ(fill("{{#if v}}yes{{/if}}", {{"v", nothing}}), "") << nothing.dump();
  for (const Json& something : {Json(true), Json(0.5), Json("0"), Json::array({0}), Json{{"a", nullptr}}})
    EXPECT_EQ(fill("{{#if v}}yes{{/if}}", {{"v", something}}), "yes") << something.dump();
}

TEST(Templates, DropIndentationAndLinesOfBlocks) {
  EXPECT_EQ(fill("<ul>\n  {{#each a}}\n    <li>{{this}}</li>\n  {{/each}}\n</ul>\n", {{"a", {1, 2}}}),
            "<ul>\n<li>1</li>\n<li>2</li>\n</ul>\n");
  EXPECT_EQ(fill("a {{#if a}}\nb{{/if}}\n", {{"a", true}}), "a \nb\n")
      << "a block on a shared line keeps the line break";
}

TEST(Templates, NameWhatIsMissing) {
  EXPECT_EQ(failure("a\n\n{{b}}"), "probe, line 3: unknown key 'b'");
  EXPECT_EQ(failure("{{#if b}}{{/if}}"), "probe, line 1: unknown key 'b'") << "conditions must have known keys too";
  EXPECT_EQ(failure("\n{{#each b}}\n{{/each}}"), "probe, line 2: unknown key 'b'");
  EXPECT_EQ(failure("{{a.c}}", {{"a", {{"b", 1}}}}), "probe, line 1: unknown key 'a.c'");
  EXPECT_EQ(failure("{{#each a}}{{c}}{{/each}}", {{"a", {{{"b", 1}}}}}), "probe, line 1: unknown key 'c'");
  EXPECT_EQ(failure("{{a}}", {{"a", nullptr}}), "probe, line 1: 'a' is not a text");
  EXPECT_EQ(failure("{{#each a}}{{/each}}", {{"a", "text"}}), "probe, line 1: 'a' is not a list");
  EXPECT_NE(failure("{{> no-such-template}}"), "");
}

TEST(Templates, NameWhatIsNotBalanced) {
  EXPECT_EQ(failure("\n{{#if a}}\n{{#each b}}{{/each}}\n"), "probe, line 2: {{#if}} is not closed");
  EXPECT_EQ(failure("{{#if a}}\n{{/each}}"), "probe, line 2: {{/each}} without its beginning");
  EXPECT_EQ(failure("{{#each a}}{{else}}{{/each}}"), "probe, line 1: {{else}} without its beginning");
  EXPECT_EQ(failure("{{#if a}}{{else}}{{else}}{{/if}}", {{"a", true}}), "probe, line 1: {{/if}} without its beginning");
  EXPECT_EQ(failure("{{/if}}"), "probe, line 1: {{/if}} without its beginning");
  EXPECT_EQ(failure("{{#with a}}{{/with}}"), "probe, line 1: unknown tag {{#with a}}");
  EXPECT_EQ(failure("{{a"), "probe, line 1: a tag without its end or its name");
  EXPECT_EQ(failure("{{}}"), "probe, line 1: a tag without its end or its name");
}

TEST(Templates, OfThePageAreBalanced) {
  int read = 0;
  for (const auto& file : std::filesystem::directory_iterator(data_folder() / "report/page/templates")) {
    EXPECT_NO_THROW(Template(file.path().filename(), content_of_file(file.path()))) << file.path();
    ++read;
  }
  EXPECT_GT(read, 20);
}

}  // namespace
}  // namespace crosscheck
