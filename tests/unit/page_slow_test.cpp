// The page in a browser: drawings, markers that speak, tables that sort, dark mode, paper.
#include "report/page/page.h"

#include "report/assets.h"
#include "report/figure.h"
#include "tests/unit/helpers.h"
#include "tests/unit/in_browser.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class Page : public InBrowser {
 protected:
  /// A page with one chapter: a chart whose markers speak, and a table of eight rows.
  std::filesystem::path page() {
    Figure f;
    f.name = "chart", f.title = "a chart", f.caption = "c", f.finding = "It falls.";
    f.x = {"t / s"}, f.y = {"x / m"};
    f.curves = {{"mysim/leapfrog", style_of("mysim/leapfrog"), {{0, 3}, {1, 2}, {2, 1}}, true, true}};
    f.curves[0].told = {{"first run"}, {"second run"}, {"third run"}};
    draw(drawing_of(f), {}, folder_);
    PageTable table{"sizes", {"method", "error"}, {}};
    const char* sizes[] = {"1.2 mm", "0.5 µm", "< 3.0e-13 m", "2 m", "20 mm", "", "900 µm", "blew up at 2 s"};
    for (int i = 0; i < 8; ++i)
      table.rows.push_back({fmt::format("{}-{}", i % 3 == 0 ? "bullet/pbd" : "mysim/rk4", i), sizes[i]});
    PageContent content;
    content.findings = {{"", "agreement", "They agree.", "measured", "same-rule"}};
    content.chapters = {{"chapter", "A chapter", "What it asks.", {{"heading", "text", {}, {table}}}}};
    content.chapters[0].entries[0].images = {{folder_ / "chart.svg", "It falls.", "a caption", {told_of(f), {}}}};
    std::string html = page_html(content);
    html.insert(html.find("</head>"), scripts({"page_selftest.js"}));
    return write("page.html", html);
  }
};

TEST_F(Page, ChartsSpeakAndTablesSort) {
  NEEDS_CHROMIUM;
  const JsonField saw = seen(page(), {});
  EXPECT_EQ(saw["complaints"].dump(), "[]");
  EXPECT_EQ(saw["charts"].number(), 1);
  EXPECT_TRUE(saw["named"].truth());
  EXPECT_TRUE(saw["drawn"].truth());
  EXPECT_GT(saw["markerSize"].number(), 3) << "pixels: markers are drawn, their shapes stand at the page's beginning";
  EXPECT_EQ(saw["tip"].text(), "first run");
  EXPECT_TRUE(saw["gone"].truth());
  // by size in metres, whatever the unit; words below numbers, either way
  EXPECT_EQ(saw["up"].texts(), (std::vector<std::string>{"< 3.0e-13 m", "0.5 µm", "900 µm", "1.2 mm", "20 mm", "2 m",
                                                         "–", "blew up at 2 s"}));
  EXPECT_EQ(saw["down"][0].text(), "2 m");
  EXPECT_EQ(saw["down"][5].text(), "< 3.0e-13 m");
  EXPECT_EQ(saw["says"].text(), "descending");
  EXPECT_EQ(saw["kept"].texts(), (std::vector<std::string>{"bullet/pbd-3", "bullet/pbd-0", "bullet/pbd-6"}));
  EXPECT_NE(saw["csv"].text().find("\"method\",\"error"), std::string::npos) << saw["csv"].dump();
  EXPECT_EQ(saw["csv"].text().find("mysim/rk4"), std::string::npos) << "rows that are hidden are not saved";
  EXPECT_LE(saw["height"].number(), 0) << "the page is no wider than the window";
}

TEST_F(Page, IsDarkWhereTheReaderWantsIt) {
  NEEDS_CHROMIUM;
  const auto file = page();
  const JsonField light = seen(file, {"--blink-settings=preferredColorScheme=1"}),
                  dark = seen(file, {"--blink-settings=preferredColorScheme=0"});
  EXPECT_EQ(light["background"].text(), "rgb(255, 255, 255)");
  EXPECT_EQ(dark["background"].text(), "rgb(21, 24, 27)");
  // drawings too; what is printed never is
  EXPECT_EQ(light["filter"].text(), "none");
  EXPECT_TRUE(contains(dark["filter"].text(), "invert"));
  EXPECT_TRUE(contains(asset("page/style.css"), "@media screen and (prefers-color-scheme: dark)"));
}

TEST_F(Page, GoesOnPaper) {
  NEEDS_CHROMIUM;
  const auto pdf = folder_ / "page.pdf";
  browse(page(), {"--print-to-pdf=" + pdf.string(), "--no-pdf-header-footer"});
  const std::string bytes = read(pdf);
  EXPECT_EQ(bytes.substr(0, 5), "%PDF-");
  EXPECT_NE(bytes.find("/Type /Page"), std::string::npos);
  EXPECT_GT(bytes.size(), 10'000u);
}

}  // namespace
}  // namespace crosscheck
