// Tests relations on the page: marks per engine, causes of violations, and findings.

#include "experiments/check/relations.h"
#include "report/page/page_parts.h"
#include "tests/unit/helpers.h"
#include "tests/unit/report/made_up_findings.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

RelationRow row(const std::string& method, const std::string& relation, RelationMark mark) {
  RelationRow r{.method = method, .relation = relation, .scene = "small-net", .mark = mark, .unit = "m"};
  r.measured = 3e-9, r.tolerance = 1e-10, r.ratio = 30, r.since = 0.25;
  if (mark == RelationMark::known) r.reason = "one pass goes through the springs in turn";
  return r;
}

std::vector<RelationRow> rows_of_two_engines() {
  return {row("mysim/xpbd", "free-fall", RelationMark::holds),
          row("mysim/xpbd", "free-fall", RelationMark::not_applicable),
          row("mysim/xpbd", "mirror", RelationMark::known),
          row("mysim/xpbd", "resume", RelationMark::not_applicable),
          row("exec:./mine", "free-fall", RelationMark::holds),
          row("exec:./mine", "free-fall", RelationMark::broken),
          row("exec:./mine", "mirror", RelationMark::holds)};
}

std::string relations_html(const std::vector<RelationRow>& rows) { return filled("relations", relations_data(rows)); }

TEST(RelationsOnThePage, HaveARowOfMarksForEachEngineAndTheWorstMarkOfSeveralScenes) {
  const std::string html = relations_html(rows_of_two_engines());
  const std::string marks = html.substr(0, html.find("</table>"));
  EXPECT_EQ(count(marks, "<tr>"), 3);                      // a header and two engines
  EXPECT_EQ(count(marks, "class=\"match\""), 2) << marks;  // xpbd: free fall, mine: symmetry
  EXPECT_EQ(count(marks, "class=\"law\""), 1);             // xpbd: symmetry is broken for a known cause
  EXPECT_EQ(count(marks, "class=\"mismatch\""), 1);        // mine: free fall fails in one of two scenes
  EXPECT_EQ(count(marks, "class=\"none\""), 2);            // one relation is not applicable, and one was not checked
  EXPECT_TRUE(contains(marks, std::string(find_relation("mirror").sentence))) << "the header must contain the sentence";
  EXPECT_TRUE(relations_data({}).is_null());
}

TEST(RelationsOnThePage, SayByHowMuchAndWhy) {
  const std::string html = relations_html(rows_of_two_engines());
  const std::string breaks = html.substr(html.find("</table>"));
  EXPECT_TRUE(contains(breaks, "one pass goes through the springs in turn"));
  EXPECT_TRUE(contains(breaks, "30\u00a0times the tolerance")) << breaks;
  EXPECT_TRUE(contains(breaks, "since 0.25\u00a0s"));
  EXPECT_TRUE(contains(breaks, "unknown"));
  RelationRow gone = row("exec:./mine", "turned", RelationMark::broken);
  gone.ratio = gone.measured = gone.tolerance = std::nullopt, gone.reason = "it fell over";
  EXPECT_TRUE(contains(relations_html({gone}), "fails at 0.25\u00a0s"));
}

TEST(RelationsOnThePage, AreToldEngineByEngine) {
  TableSet tables;
  Table table = table_of<RelationRow>();
  for (const RelationRow& r : rows_of_two_engines()) add(table, r);
  tables.add(table);
  const std::vector<Finding> all = relation_findings(tables);
  const std::vector<Finding> held = of_rule(all, "relations"), broken = of_rule(all, "relations-broken");
  ASSERT_EQ(held.size(), 2u);
  EXPECT_EQ(held[0].method, "mysim");
  EXPECT_EQ(held[0].value, 1);  // two are applicable
  EXPECT_TRUE(contains(sentence_of(held[0]), "known causes")) << sentence_of(held[0]);
  EXPECT_EQ(held[1].value, 2);
  EXPECT_FALSE(contains(sentence_of(held[1]), "known causes"));
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_TRUE(contains(sentence_of(broken[0]), "free-fall")) << sentence_of(broken[0]);
  for (const Finding& f : all) EXPECT_LE(words_in(sentence_of(f)), 30u) << sentence_of(f);
}

}  // namespace
}  // namespace crosscheck
