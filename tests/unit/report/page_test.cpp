// The page: units stay together, linked words are explained, every part is listed, drawings inside it show what they
// showed.

#include <cmath>
#include <regex>
#include <set>

#include "experiments/scenes/scenes.h"
#include "report/figures/figure.h"
#include "report/page/inline_svg.h"
#include "report/page/page.h"
#include "tests/unit/helpers.h"
#include "tests/unit/temporary.h"

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
  for (const RecommendationColumn& column : recommendation_columns())
    EXPECT_TRUE(contains(html, fmt::format("id=\"word-{}\"", column.term))) << column.head;
  EXPECT_THROW(term_link("unheard-of"), std::logic_error);
  std::set<std::string> ids;
  for (size_t at = html.find("id=\"word-"); at != std::string::npos; at = html.find("id=\"word-", at + 1))
    EXPECT_TRUE(ids.insert(html.substr(at, html.find('"', at + 4) - at)).second);
  EXPECT_GT(ids.size(), 15u);
}

TEST(Contents, LeadToEveryPartThatIsThere) {
  const std::vector<Scene> scenes = load_scenes({"spring", "chain"});
  const SceneData none;
  PageContent content;
  content.chapters = chapters();
  content.chapters[0].entries = {{"heading", "text", {}, {{"one row", {"a"}, {{"b"}}}}}};
  for (const Scene& scene : scenes) {
    content.scenes.push_back({&scene, &none, {}, {}, {}, {}});
    content.scenes.back().recommendations = recommendations_of(scene, none, {});
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

using namespace testing_tools;

class InlineSvg : public InFolder {
 protected:
  Figure figure() const {
    Figure f;
    f.name = "waves", f.title = "two waves", f.caption = "c", f.finding = "f";
    f.x = {"t / s"}, f.y = {"x / m"};
    Curve a{"mysim/leapfrog", style_of("mysim/leapfrog"), {}, true, true}, b{"bullet/pbd", style_of("bullet/pbd"), {}};
    for (int i = 0; i < 40; ++i)
      a.points.emplace_back(i, std::sin(0.3 * i)), a.tooltips.push_back({fmt::format("run {}", i)});
    for (int i = 0; i < 400; ++i) b.points.emplace_back(0.1 * i, std::cos(0.03 * i));
    f.curves = {a, b};
    f.failures = {{"mysim/rk4: blew up", style_of("mysim/rk4"), 5, 0.5, "blew up", 2, {"lost < \"here\""}}};
    return f;
  }
  std::string drawn(const Figure& f) const {
    draw(drawing_of(f), {}, folder_);
    return read(folder_ / (f.name + ".svg"));
  }
  /// All coordinates of lines, absolute, in the order in which they are drawn.
  static std::vector<double> coordinates(const std::string& svg) {
    std::vector<double> all;
    const std::regex path(" d='([^']*)'"), number("-?(\\d+\\.?\\d*|\\.\\d+)");
    for (std::sregex_iterator p(svg.begin(), svg.end(), path), none; p != none; ++p) {
      const std::string d = (*p)[1];
      double x = 0, y = 0;
      bool relative = false;
      for (size_t i = 0; i < d.size();) {
        if (d[i] == 'M' || d[i] == 'L' || d[i] == 'l') {
          relative = d[i++] == 'l';
          continue;
        }
        std::smatch found;
        const std::string rest = d.substr(i);
        if (!std::regex_search(rest, found, number, std::regex_constants::match_continuous)) {
          ++i;
          continue;
        }
        const double first = std::stod(found.str());
        std::string after = rest.substr(found.length());
        after = after.substr(after.find_first_of("-.0123456789"));
        std::regex_search(after, found, number, std::regex_constants::match_continuous);
        const double second = std::stod(found.str());
        i = d.size() - after.size() + static_cast<size_t>(found.length());
        x = relative ? x + first : first, y = relative ? y + second : second;
        all.push_back(x), all.push_back(y);
      }
    }
    return all;
  }
};

TEST_F(InlineSvg, LinesStayWhereTheyAre) {
  const std::string svg = drawn(figure());
  // markers' own shapes aside, which stay as they are
  const auto body = [](const std::string& text) { return text.substr(text.find("</defs>")); };
  const std::vector<double> before = coordinates(body(svg)), after = coordinates(body(inline_svg(svg, "alt")));
  ASSERT_EQ(before.size(), after.size());
  EXPECT_GT(before.size(), 800u);
  // rounded to tenths of a pixel, not to be seen; differences of rounded numbers do not add up
  for (size_t i = 0; i < before.size(); ++i) ASSERT_NEAR(before[i], after[i], 0.0501) << i;
}

TEST_F(InlineSvg, WeighsLessAndKeepsItsWords) {
  const std::string svg = drawn(figure()), out = inline_svg(svg, "a \"finding\"");
  EXPECT_LT(out.size(), 0.6 * static_cast<double>(svg.size()));
  EXPECT_TRUE(contains(out, "role=\"img\" aria-label=\"a &quot;finding&quot;\""));
  for (const char* word : {"two waves", "mysim/leapfrog", "t / s", "x / m"}) EXPECT_TRUE(contains(out, word));
}

TEST_F(InlineSvg, MarkersSayWhatTheirRunsAre) {
  const Figure f = figure();
  const Tooltips tooltips{tooltips_of(f), {}};
  ASSERT_EQ(tooltips.markers.size(), 3u);
  EXPECT_TRUE(tooltips.markers[1].empty());
  const std::string out = inline_svg(drawn(f), "alt", tooltips);
  EXPECT_TRUE(contains(out, "lost &lt; &quot;here&quot;</title>"));
  // each word at its marker: further right as the runs are
  const std::regex marker("<use class=\"told\"[^>]*translate\\(([0-9.]+),[^>]*><title>run ([0-9]+)</title>");
  double last = 0;
  int count = 0;
  for (std::sregex_iterator m(out.begin(), out.end(), marker), none; m != none; ++m, ++count) {
    EXPECT_EQ(std::stoi((*m)[2]), count);
    EXPECT_GT(std::stod((*m)[1]), last);
    last = std::stod((*m)[1]);
  }
  EXPECT_EQ(count, 40);
}

TEST_F(InlineSvg, FewerMarkersThanWordsAreAnError) {
  Tooltips tooltips{{std::vector<Tooltip>(1000, {"run"})}, {}};
  EXPECT_THROW(inline_svg(drawn(figure()), "alt", tooltips), std::runtime_error);
  EXPECT_THROW(inline_svg("<html>", "alt"), std::runtime_error);
}

TEST_F(InlineSvg, APageHoldsTheShapesOfMarkersOnce) {
  const std::string one = inline_svg(drawn(figure()), "alt");
  const std::string page = deduplicate_markers("<body>" + one + one + "</body>");
  const auto count = [&](const std::string& what) {
    int n = 0;
    for (size_t at = page.find(what); at != std::string::npos; at = page.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("id='gpDot'"), 1);
  EXPECT_EQ(count("<svg"), 3);
  EXPECT_LT(page.find("id='gpDot'"), page.find("role=\"img\""));
}

TEST_F(InlineSvg, CellsOfAMapAreABoxEachAndSayWhatTheirRunsAre) {
  HeatMap map;
  map.name = "map", map.title = "a map", map.caption = "c", map.finding = "f";
  map.x_label = "x", map.y_label = "y";
  map.kinds = {{"holds", "#D8E8F0"}, {"fails", "#D55E00"}};
  HeatMap::Panel panel{"mysim/rk4", {}, {{1, 1}, {2, 4}}, {}};
  for (int i = 0; i < 12; ++i)
    panel.cells.push_back(
        {std::pow(2, i % 4), std::pow(2, i / 4), i % 2, {fmt::format("cell {}", i), std::to_string(i)}});
  map.panels = {panel};
  draw(drawing_of(map), {}, folder_);
  const std::string svg = read(folder_ / "map.svg"), out = inline_svg(svg, "alt", {{}, tooltips_of(map)});
  const std::regex cell(
      "<polygon data-run=\"([0-9]+)\" fill=\"(#[0-9a-f]+)\" points=\"([0-9.]+),([0-9.]+) "
      "[^\"]*\"><title>cell ([0-9]+)</title></polygon>");
  std::set<std::pair<double, double>> corners;
  int count = 0;
  for (std::sregex_iterator m(out.begin(), out.end(), cell), none; m != none; ++m, ++count) {
    EXPECT_EQ((*m)[1], (*m)[5]);
    EXPECT_EQ((*m)[2], std::stoi((*m)[1]) % 2 ? "#d55e00" : "#d8e8f0");
    corners.emplace(std::stod((*m)[3]), std::stod((*m)[4]));
  }
  EXPECT_EQ(count, 12);
  EXPECT_EQ(corners.size(), 12u) << "each in its own place";
  // what is no cell stays: the key's samples, lines of limits
  EXPECT_TRUE(contains(out, "limit by theory"));
  const std::string shape = "fill=\"#d8e8f0\"";
  EXPECT_TRUE(contains(out, shape));
}

TEST(SamePictures, AreInThePageOnce) {
  const std::string bytes(3000, 'A');
  const auto picture = [&](const std::string& data, const std::string& alt) {
    return fmt::format("<img src=\"data:image/png;base64,{}\" width=\"40\" height=\"20\" alt=\"{}\">", data, alt);
  };
  const std::string page = "<p>" + picture(bytes, "one") + picture("BBBB", "other") + picture(bytes, "two") + "</p>";
  const std::string out = deduplicate_pictures(page);
  EXPECT_EQ(out.find(bytes), out.rfind(bytes));
  EXPECT_TRUE(contains(out, picture("BBBB", "other"))) << "what is there once stays as it is";
  EXPECT_TRUE(contains(out, "aria-label=\"one\"><image id=\"picture-1\" width=\"40\" height=\"20\""));
  EXPECT_TRUE(contains(
      out, "<svg class=\"picture\" viewBox=\"0 0 40 20\" role=\"img\" aria-label=\"two\"><use href=\"#picture-1\"/>"));
  EXPECT_EQ(deduplicate_pictures("<p>no picture</p>"), "<p>no picture</p>");
}

}  // namespace
}  // namespace crosscheck
