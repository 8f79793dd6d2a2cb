// The page keeps units with numbers, explains linked words, and lists all of its contents. An assembled report has the
// numbers of its charts, scenes and certificates, and its data reproduce the page.

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <set>

#include "experiments/scenes/scenes.h"
#include "experiments/sweep/sweep.h"
#include "experiments/tables/certificates.h"
#include "experiments/tables/speed_accuracy.h"
#include "mysim/base/files.h"
#include "mysim/base/text.h"
#include "report/base/provenance.h"
#include "report/page/assemble.h"
#include "report/page/page_parts.h"
#include "report/page/player_html.h"
#include "report/page/shown_runs.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/made_up_findings.h"
#include "tests/unit/report/readers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Prose, NumbersHoldOnToWhatBelongsToThem) {
  EXPECT_EQ(prose("to 0.25 % of 3 mm in 500 µs"), "to 0.25\u00a0% of 3\u00a0mm in 500\u00a0µs");
  EXPECT_EQ(prose("8 x 8 of 100 000, 0.32 ± 0.01"), "8\u00a0x\u00a08 of 100\u00a0000, 0.32\u00a0±\u00a00.01");
  EXPECT_EQ(prose("< 0.001 %"), "&lt;\u00a00.001\u00a0%");
  EXPECT_EQ(prose("on 7 scenes and 3 methods"), "on 7 scenes and 3 methods");  // neither seconds nor metres
  EXPECT_EQ(prose("2 of 13"), "2 of 13");
  EXPECT_EQ(prose("a < b & 1.0e-12 m"),
            "a &lt; b &amp; 1.0<span class=\"n\">\u00a0×\u00a010<sup>−12</sup></span>\u00a0m");
  EXPECT_EQ(prose("5.6e+10, 9e-06"),
            "5.6<span class=\"n\">\u00a0×\u00a010<sup>10</sup></span>, 9<span "
            "class=\"n\">\u00a0×\u00a010<sup>−6</sup></span>");
  EXPECT_EQ(prose(""), "");
  EXPECT_EQ(prose("5 "), "5 ");
}

TEST(Prose, NumbersWithTheirUnitsAreBoldAndNamesAreNot) {
  EXPECT_EQ(prose_with_bold_numbers("error 0.71 % at 2.5 ms"), "error <b>0.71\u00a0%</b> at <b>2.5\u00a0ms</b>");
  EXPECT_EQ(prose_with_bold_numbers("on 7 scenes by rk4"), "on <b>7</b> scenes by rk4");
  EXPECT_EQ(prose_with_bold_numbers("at most 3.0e-12 m"),
            "at most <b>3.0<span class=\"n\">\u00a0×\u00a010<sup>−12</sup></span>\u00a0m</b>");
  EXPECT_EQ(prose_with_bold_numbers("cloth-hang-6, a < b"), "cloth-hang-6, a &lt; b");
}

TEST(Prose, OfNarrowColumnsBreaksBehindSlashesOfTextsAlone) {
  EXPECT_EQ(narrow_prose("mysim/rk4, 2.0e-3 m"),
            "mysim/<wbr>rk4, 2.0<span class=\"n\">\u00a0×\u00a010<sup>−3</sup></span>\u00a0m");
}

TEST(Markdown, HasParagraphsEmphasisAndCode) {
  EXPECT_EQ(markdown_html("One **two\nthree**.\n\n*Four* `five/*`, <i>six</i>.\n"),
            "<p>One <b>two\nthree</b>.</p>\n<p><em>Four</em> <code>five/*</code>, <i>six</i>.</p>\n");
}

TEST(Glossary, ExplainsEachWordOnce) {
  std::set<std::string> ids;
  for (const Json& word : glossary_data()) {
    EXPECT_TRUE(ids.insert(word["id"].get<std::string>()).second) << word.dump();
    EXPECT_FALSE(word["term"].get<std::string>().empty()) << word.dump();
    EXPECT_TRUE(word["meaning"].get<std::string>().ends_with(".</p>\n")) << word.dump();
  }
  EXPECT_GT(ids.size(), 15u);
  EXPECT_TRUE(ids.contains("truth"));
}

TEST(ChapterTexts, HaveAHeadOfKnownKeysAndABody) {
  const Chapter chapter = chapter_of_text(
      "probe",
      "- title: T\n- label: L\n- leads: a, *-b\n- group: *-c | Of c | titled\n- contact experiment: n | N\n\nText.\n");
  EXPECT_EQ(chapter.leads, (std::vector<std::string>{"a", "*-b"}));
  ASSERT_EQ(chapter.groups.size(), 1u);
  EXPECT_TRUE(chapter.groups[0].titled);
  EXPECT_TRUE(chapter.experiments.at(0).contact);
  EXPECT_EQ(chapter.teaching, "Text.\n");
  const auto failure = [](const std::string& text) {
    try {
      chapter_of_text("probe", text);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(failure("- title: T\n- lable: L\n\nText."), "probe.md: unknown line '- lable: L'");
  EXPECT_TRUE(contains(failure("- title: T\n\nText."), "expected title, label"));
  EXPECT_TRUE(contains(failure("- title: T\n- label: L\n"), "expected title, label"));
}

std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const size_t begin = text.find(from);
  if (begin == std::string::npos) return "";
  const size_t end = text.find(to, begin + from.size());
  return text.substr(begin, end == std::string::npos ? end : end - begin);
}
std::string section(const std::string& html, const std::string& id) {
  return between(html, fmt::format("<section class=\"chapter\" id=\"{}\"", id), "</section>");
}
/// The part of the page that is visible after loading.
std::string at_load(std::string html) {
  for (const char* tag : {"template", "script", "style"}) {
    const std::string open = fmt::format("<{}", tag), close = fmt::format("</{}>", tag);
    for (size_t at; (at = html.find(open)) != std::string::npos;)
      html.erase(at, html.find(close, at) + close.size() - at);
  }
  return html;
}
/// The complete page, with folded contents.
std::string whole(const PageContent& content) { return with_folds_put_back(page_html(content)); }

/// Expects that each link inside the page leads to an element, or to a scene that it opens.
void expect_links_lead_somewhere(const std::string& html) {
  std::set<std::string> targets;
  for (size_t at = html.find("href=\"#"); at != std::string::npos; at = html.find("href=\"#", at + 1))
    targets.insert(html.substr(at + 7, html.find('"', at + 7) - at - 7));
  EXPECT_FALSE(targets.empty());
  for (const std::string& id : targets)
    EXPECT_TRUE(html.find(fmt::format("id=\"{}\"", id)) != std::string::npos ||
                html.find(fmt::format("<template data-scene=\"{}\">", id)) != std::string::npos)
        << id;
}

TEST(Contents, LeadToEveryPartThatIsThere) {
  const std::vector<Scene> scenes = load_scenes({"spring", "chain"});
  const SceneData none;
  PageContent content;
  content.chapters = chapters();
  content.chapters[1].entries = {{"speed-accuracy", "heading", "text", {}, {}, {{"one row", {"a"}, {{"b"}}}}}};
  for (const Scene& scene : scenes) content.scenes.push_back({&scene, &none, {}});
  const std::string html = whole(content), nav = between(html, "<nav", "</nav>");
  expect_links_lead_somewhere(html);
  for (const char* id : {"scenes", "same-answer", "speed-accuracy", "words"})
    EXPECT_TRUE(contains(nav, fmt::format("href=\"#{}\"", id))) << id;
  EXPECT_FALSE(contains(nav, "#stability")) << "a chapter without entries is left out";
  EXPECT_FALSE(contains(nav, "#changes")) << "there is no earlier report";
  for (const Chapter& chapter : chapters()) EXPECT_FALSE(chapter.label.empty()) << chapter.id;
}

TEST(Contents, HaveALabOnlyWhereThePageHasItsModule) {
  const Scene scene = load_scene("spring");
  const SceneData none;
  PageContent content;
  content.chapters = chapters();
  content.scenes.push_back({&scene, &none, {}});
  EXPECT_FALSE(contains(whole(content), "<live-lab"));
  content.lab.push_back(data_element("lab", "lab-module", "\"\""));
  EXPECT_TRUE(contains(whole(content), "<live-lab data-scene=\"spring\">"));
}

TEST(Chapters, AreFiveAndEachAnswersAQuestion) {
  std::vector<std::string> ids, asked;
  for (const Chapter& chapter : chapters()) {
    ids.push_back(chapter.id);
    EXPECT_FALSE(chapter.teaching.empty()) << chapter.id;
    EXPECT_EQ(chapter.leads.empty(), chapter.id == "same-answer") << "same-answer opens with its certificates";
  }
  for (const Question& question : questions())
    if (asked.empty() || asked.back() != question.chapter) asked.emplace_back(question.chapter);
  EXPECT_EQ(ids, (std::vector<std::string>{"same-answer", "speed-accuracy", "stability", "energy", "adequacy"}));
  EXPECT_EQ(asked, ids) << "questions must lead to the chapters in order";
}

/// A page with two charts and a table in each chapter, and with every answer.
class WholePage : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    content_.chapters = chapters();
    content_.figures = folder_;
    const char* leads[] = {"", "chain-speed-accuracy-cost", "stability-limits", "sphere-cone", "chain-adequacy"};
    for (size_t i = 0; i < 5; ++i) {
      for (const bool is_answer : {true, false}) {
        const Finding f = made_up(rule_of_chapter(content_.chapters[i].id, is_answer), fmt::format("probe-{}", i));
        (is_answer ? answers_ : others_)
            .push_back(is_answer ? prose_with_bold_numbers(sentence_of(f)) : prose(sentence_of(f)));
        content_.findings.push_back(f);
      }
      Chapter& chapter = content_.chapters[i];
      const std::string more = fmt::format("more-{}", i);
      if (*leads[i]) chapter.entries.push_back({chapter.id, "Lead", "Says what.", {{leads[i], "t", "Lead caption."}}});
      chapter.entries.push_back({chapter.id, "More < that", "Text.", {{more, "t", "More caption."}}});
      chapter.entries.push_back({chapter.id, "A table", "", {}, {}, {{"sizes", {"method"}, {{"mysim/rk4"}}}}});
      for (const std::string& name : {std::string(leads[i]), more})
        if (!name.empty()) content_.charts[name] = Json{{"name", name}, {"kind", "curves"}};
    }
    write("stability-limits.svg", "<svg><text>drawn</text></svg>");
    for (const char* ending : {"pdf", "csv", "gp"}) write(fmt::format("stability-limits.{}", ending), "x");
    write("more-2.csv", "x");
  }
  PageContent content_;
  std::vector<std::string> answers_, others_;  // as worded on the page
};

TEST_F(WholePage, OpensWithFiveAnswersThatLeadToTheirChapters) {
  const std::string html = whole(content_), first = between(html, "<section class=\"first\"", "</section>");
  EXPECT_EQ(count(first, "<div class=\"question\">"), 5);
  for (const std::string& answer : answers_) EXPECT_TRUE(contains(first, answer));
  for (const Question& question : questions()) {
    const bool answered = answer_to(question, content_.findings);
    EXPECT_EQ(contains(first, std::string(question.text)), answered) << question.text;
    if (answered) {
      EXPECT_TRUE(contains(first, fmt::format("href=\"#{}\"", question.chapter)));
    }
  }
  EXPECT_FALSE(contains(first, "<table")) << "the page must not open with a table";
  expect_links_lead_somewhere(html);
}

TEST_F(WholePage, AChapterHasItsAnswerItsLeadAndItsFolds) {
  const std::string html = whole(content_);
  for (size_t i = 0; i < 5; ++i) {
    const Chapter& chapter = content_.chapters[i];
    SCOPED_TRACE(chapter.id);
    const std::string part = section(html, chapter.id), seen = at_load(part);
    EXPECT_TRUE(contains(seen, "<p class=\"answer\">" + answers_[i]));
    EXPECT_EQ(count(seen, "data-chart="), i == 0 ? 0 : 1) << "only the lead is open";
    if (i > 0) {
      EXPECT_TRUE(contains(seen, fmt::format("data-chart=\"{}\"", chapter.entries[0].figures[0].name)));
    }
    EXPECT_TRUE(contains(seen, "<div class=\"teach\">"));
    EXPECT_GT(words_in(between(seen, "<div class=\"teach\">", "</section>")), 40u);
    // a fold for the findings, for the other chart, and for the table
    EXPECT_EQ(count(part, "<details class=\"fold\""), 3);
    EXPECT_EQ(count(part, "<template"), 3);
    EXPECT_EQ(count(part, fmt::format("data-chart=\"more-{}\"", i)), 1);
    EXPECT_FALSE(contains(seen, "More caption.")) << "folded contents are not visible until opened";
    EXPECT_FALSE(contains(seen, others_[i]));
    EXPECT_TRUE(contains(part, others_[i]));
    EXPECT_TRUE(contains(part, "More &lt; that"));
  }
}

TEST_F(WholePage, OnlyFiguresThatOpenAChapterAreDrawnForPaper) {
  for (const std::string& name : figures_of(content_))
    EXPECT_EQ(opens_a_chapter(content_, name), !name.starts_with("more-")) << name;
  const std::string html = whole(content_);
  EXPECT_EQ(count(at_load(html), "<noscript><img"), 1) << "only where a drawing exists";
  EXPECT_TRUE(contains(section(html, "stability"), "<noscript><img src=\"data:image/svg+xml;base64," +
                                                       base64(read(folder_ / "stability-limits.svg")) +
                                                       "\" alt=\"t\">"));
  for (const char* way : {"stability-limits.pdf", "stability-limits.csv", "stability-limits.gp", "more-2.csv"})
    EXPECT_TRUE(contains(html, fmt::format("href=\"figures/{}\"", way)));
  EXPECT_FALSE(contains(html, "more-2.pdf")) << "this file does not exist";
}

TEST_F(WholePage, TheLeadIsThatOfTheMainSceneWhereThereIsOne) {
  std::vector<Chapter::Entry>& entries = content_.chapters[1].entries;
  entries.push_back({"speed-accuracy", "Of a cloth", "", {{"cloth-hang-speed-accuracy-cost", "t", "c"}}});
  EXPECT_TRUE(opens_a_chapter(content_, "chain-speed-accuracy-cost"));
  content_.main_scene = "cloth-hang";
  EXPECT_TRUE(opens_a_chapter(content_, "cloth-hang-speed-accuracy-cost"));
  EXPECT_FALSE(opens_a_chapter(content_, "chain-speed-accuracy-cost"));
}

TEST_F(WholePage, ButtonsChooseWhoseFigureOpensAChapter) {
  Chapter& chapter = content_.chapters[1];
  chapter.entries.push_back({chapter.id, "Of a cloth", "", {{"cloth-hang-speed-accuracy-cost", "t", "Cloth's."}}});
  content_.main_scene = "cloth-hang";
  const std::string part = section(whole(content_), chapter.id), seen = at_load(part);
  EXPECT_LT(seen.find("data-figure=\"figure-cloth-hang-speed-accuracy-cost\" aria-pressed=\"true\">cloth-hang<"),
            seen.find("data-figure=\"figure-chain-speed-accuracy-cost\" aria-pressed=\"false\">chain<"))
      << "the main scene comes first";
  EXPECT_EQ(count(part, " hidden>\n<div class=\"drawn\""), 1);
  EXPECT_TRUE(contains(part, "id=\"figure-chain-speed-accuracy-cost\" aria-label=\"t\" hidden>"));
  EXPECT_EQ(count(part, "data-chart=\"cloth-hang-speed-accuracy-cost\""), 1) << "and nowhere else";
  EXPECT_EQ(count(section(whole(content_), "stability"), "class=\"choices\""), 0) << "there is nothing to choose";
}

TEST_F(WholePage, WhatIsShownIsNotFoldedAway) {
  Chapter& chapter = content_.chapters[2];
  Chapter::Entry entry{chapter.id, "One step too large", "", {{"stability-failure", "t", "Grows."}}};
  const std::filesystem::path picture =
      write("moment.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"4\" height=\"3\"/>");
  entry.images = {{picture, "8 ms", "8 ms"}, {folder_ / "missing.png", "m", "m"}};
  entry.shown = true;
  chapter.entries.push_back(entry);
  const std::string seen = at_load(section(whole(content_), chapter.id));
  EXPECT_TRUE(contains(seen, "<h3>One step too large</h3>"));
  EXPECT_TRUE(contains(seen, "data-chart=\"stability-failure\""));
  EXPECT_EQ(count(between(seen, "<div class=\"moments\">", "</figure>\n</div>"), "<img"), 1)
      << "existing pictures only";
}

TEST_F(WholePage, AChapterHasSixFoldsAtMostAndTheLastOneHoldsTheRest) {
  Chapter& chapter = content_.chapters[2];
  chapter.folds = {"kept-*"};
  for (const char* name : {"a", "b", "c", "d", "e", "kept-f"})
    chapter.entries.push_back({chapter.id, fmt::format("Chart {}", name), "", {{name, "t", "c"}}});
  const std::string html = whole(content_), part = section(html, chapter.id);
  EXPECT_EQ(count(part, "<details class=\"fold\""), 6);
  for (const char* name : {"a", "b", "c", "d", "e", "kept-f", "more-2"})
    EXPECT_EQ(count(part, fmt::format("data-chart=\"{}\"", name)), 1) << name;
  EXPECT_LT(part.find("Chart kept-f"), part.find("More &lt; that")) << "in order of importance";
  const std::string last = part.substr(part.rfind("<details class=\"fold\""));
  EXPECT_TRUE(contains(last, "More figures and tables"));
  EXPECT_EQ(count(last, "<button type=\"button\" data-figure="), 4)
      << "there was room for two of the charts and the table";
  EXPECT_TRUE(contains(last, "<span class=\"kind\">4 charts</span>"));
  EXPECT_EQ(count(last, "<div id=\"one-"), 4);
  EXPECT_EQ(count(last, "\" hidden>\n"), 3);
}

std::vector<std::string> tags(const std::string& html, const std::string& name) {
  std::vector<std::string> all;
  for (size_t at = html.find("<" + name); at != std::string::npos; at = html.find("<" + name, at + 1))
    if (html[at + name.size() + 1] == ' ' || html[at + name.size() + 1] == '>')
      all.push_back(html.substr(at, html.find('>', at) - at));
  return all;
}

TEST_F(WholePage, IsNamedForScreenReaders) {
  const std::string html = whole(content_);
  EXPECT_TRUE(contains(html, "<a class=\"skip\" href=\"#main\">"));
  EXPECT_TRUE(contains(html, "<main id=\"main\">"));
  EXPECT_GT(tags(html, "figure").size(), 5u);
  for (const std::string& tag : tags(html, "figure")) EXPECT_TRUE(contains(tag, "aria-label=\"")) << tag;
  for (const std::string& tag : tags(html, "img"))
    EXPECT_FALSE(contains(tag, "alt=\"\"")) << tag.substr(tag.size() - 80);
  int level = 0;
  for (size_t at = html.find("<h"); at != std::string::npos; at = html.find("<h", at + 1)) {
    if (html[at + 2] < '1' || html[at + 2] > '6') continue;
    EXPECT_LE(html[at + 2] - '0', level + 1) << html.substr(at, 60);
    level = html[at + 2] - '0';
  }
  EXPECT_GT(level, 0);
}

/// Relative luminance of "#rrggbb", as defined by WCAG 2.
double luminance(const std::string& colour) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double c = std::stoi(colour.substr(1 + 2 * static_cast<size_t>(i), 2), nullptr, 16) / 255.;
    sum += (i == 0   ? 0.2126
            : i == 1 ? 0.7152
                     : 0.0722) *
           (c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return sum;
}

TEST(Styles, TextsHaveAContrastOf4Point5OnEveryGround) {
  const std::string css = page_styles();
  size_t at = 0;
  for (const char* look : {"light", "dark"}) {
    SCOPED_TRACE(look);
    ASSERT_NE(at = css.find(":root {", at), std::string::npos);
    std::map<std::string, double> colours;
    const std::string block = css.substr(at, css.find('}', at) - at);
    for (size_t i = block.find("--"); i != std::string::npos; i = block.find("--", i + 1))
      if (const size_t value = block.find(": ", i); block.compare(value, 3, ": #") == 0)
        colours[block.substr(i + 2, value - i - 2)] = luminance(block.substr(value + 2, 7));
    int compared = 0;
    for (const char* ground : {"back", "panel", "stage"})
      for (const auto& [name, value] : colours) {
        if (name == "back" || name == "panel" || name == "stage" || name == "card" || name == "line") continue;
        const auto [low, high] = std::minmax(colours.at(ground), value);
        EXPECT_GE((high + 0.05) / (low + 0.05), 4.5) << name << " on " << ground;
        ++compared;
      }
    EXPECT_GT(compared, 40);
    at += block.size();
  }
}

TEST_F(WholePage, TextsOfScenesCannotBecomeMarkup) {
  const std::string evil = "<zq onclick='x'>\\\"&amp;</zq>";
  std::string text = scene_text("[[particle]]\nposition = [0, 0, 0]\nmass = 1\n");
  const auto put = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  put("question = \"q\"", "question = \"" + evil + "\"");
  put("parameters = \"p\"", "parameters = \"" + evil + "\"");
  const Scene scene = parse_scene(text, "a<zq>b");
  SceneData facts;
  MethodData run;
  run.method = "exec:./<zq>", run.verdict = Verdict::unsupported, run.reason = "<zq>", run.different_law = "<zq>";
  facts.methods = {run};
  const Certificate certificate{"exec:./<zq>", scene.name, {{"<zq>", "<zq>", "<zq>", "<zq>", Parity::mismatch}}};
  ScenePart part{&scene, &facts, {made_up(finding_rule("nearest"), "<zq>")}};
  part.certificates = {&certificate};
  part.motions = "{\"scene\": \"<zq></script>\"}";
  part.figures = {{"<zq>", "<zq>", "<zq>", "<zq>"}};
  content_.scenes = {part};
  content_.findings[0] = made_up(finding_rule("answer-agreement"), "<zq>");
  content_.notes = content_.problems = {"<zq>"};
  content_.provenance = {{"command", "<zq>"}};
  content_.against = "<zq>";
  content_.changes = {{"<zq>", "<zq>", "<zq>"}};
  content_.methods = {"exec:./<zq>"};
  content_.runs = {
      {"<zq>", "<zq>", "", {{"<zq>", "<zq>", "<zq>", write("x.u16.gz", ""), 1, {{"note", "<zq></script>"}}}}}};
  const std::string html = whole(content_);
  EXPECT_FALSE(contains(html, "<zq")) << between(html, "<zq", ">");
  EXPECT_FALSE(contains(html, "</zq"));
  EXPECT_TRUE(contains(html, "&lt;zq"));
  EXPECT_EQ(count(html, "<script"), count(html, "</script>"));
}

/// Tests which runs are shown, given a chart's runs: method, step (s), error (m), CPU time (s).
class ShownRuns : public ::testing::Test {
 protected:
  void chart(const std::string& method, double step, double error, double cpu) {
    Table runs = table_of<SpeedAccuracyRow>(), costs = table_of<SpeedAccuracyCostRow>();
    SpeedAccuracyRow run{.scene = scene_.name, .method = method, .requested = step, .step = step};
    run.error = error;
    add(runs, run);
    add(costs, SpeedAccuracyCostRow{.scene = scene_.name, .method = method, .requested = step, .cpu = cpu});
    rows_.add(runs), rows_.add(costs);
  }
  void own(const std::string& method, double error, Verdict verdict = Verdict::ok) {
    MethodData& data = facts_.methods.emplace_back();
    data.method = method, data.verdict = verdict, data.step = time_grid(default_run(scene_)).h, data.error = error;
  }
  std::vector<ShownRun> shown(std::optional<RecommendedRun> take) {
    facts_.scene = scene_.name, facts_.motion = 1;
    ScenePart part{&scene_, &facts_, {}};
    part.take = std::move(take);
    return shown_runs(part, rows_, [](const std::string&) { return true; });
  }
  static std::vector<std::string> keys(const std::vector<ShownRun>& runs) {
    std::vector<std::string> all;
    for (const ShownRun& run : runs) all.push_back(run.key + (run.beside ? " beside" : ""));
    return all;
  }
  Scene scene_ = load_scene("chain");
  SceneData facts_;
  TableSet rows_;
};

TEST_F(ShownRuns, BeginWithEachEnginesOwnThenTheRecommendedOneAndTheCheapestOfTheOthers) {
  chart("mysim/leapfrog", 2e-3, 5e-3, 1e-3), chart("mysim/leapfrog", 1e-3, 1e-3, 2e-3);
  chart("mysim/rk4", 2e-3, 2e-2, 3e-3), chart("mysim/rk4", 1e-3, 4e-3, 6e-3), chart("mysim/rk4", 5e-4, 1e-5, 12e-3);
  for (const char* method : {"mysim/symplectic-euler", "bullet/deformable-explicit"}) own(method, 1e-3);
  own("mysim/explicit-euler", 1, Verdict::energy);
  const auto runs = shown(RecommendedRun{.method = "mysim/leapfrog", .requested = 2e-3});
  EXPECT_EQ(keys(runs),
            (std::vector<std::string>{"mysim/symplectic-euler own beside", "bullet/deformable-explicit own beside",
                                      "mysim/leapfrog 0", "mysim/rk4 1"}))
      << "rk4's cheapest run within 1 %, and no failed runs";
  EXPECT_EQ(runs[2].run.step, 2e-3) << "the step that the page names must be the run's step";
  EXPECT_EQ(runs[0].run.step, default_run(scene_).step);
  EXPECT_EQ(runs[2].cpu, 1e-3);
}

TEST_F(ShownRuns, OfASceneWithoutRecommendationAreTheEnginesOwn) {
  for (const char* method : {"mysim/symplectic-euler", "bullet/deformable-explicit"}) own(method, 1e-3);
  EXPECT_EQ(keys(shown({})),
            (std::vector<std::string>{"mysim/symplectic-euler own beside", "bullet/deformable-explicit own beside"}));
}

TEST_F(ShownRuns, AreNineAtMost) {
  for (const Method& method : all_methods())
    if (method.family().by_default()) own(method.name, 1e-3);
  EXPECT_EQ(shown({}).size(), 9u);
}

using PageRoom = InFolder;

TEST_F(PageRoom, IsGivenToTheEnginesRepresentativesFirst) {
  const auto file = [&](const std::string& method, size_t bytes) {
    return RunFile{"a-engines", "a", method, write(file_name_of(method), std::string(bytes, 'x')), 1, Json::object()};
  };
  PageRuns runs({file("mysim/leapfrog", 3'000'000), file("mysim/rk4", 5'000'000), file("mysim/symplectic-euler", 10)});
  std::vector<std::string> notes;
  const auto taken = runs.take("a-engines", "", notes);
  ASSERT_TRUE(taken);
  ASSERT_EQ(taken->files.size(), 2u);
  EXPECT_EQ(taken->files[0].method, "mysim/symplectic-euler");
  EXPECT_EQ(taken->files[1].method, "mysim/leapfrog");
  EXPECT_EQ(notes, std::vector<std::string>{"a-engines: the runs of 1 methods are too large for the page to play"});
  EXPECT_FALSE(runs.take("b-engines", "", notes));
}

/// A small report on two scenes with a few methods, whose data are in the folder.
class Assembled : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    Request request;
    request.scenes = load_scenes({"projectile", "chain"});
    request.methods = find_methods("mysim/symplectic-euler,mysim/explicit-euler,bullet/deformable-explicit");
    data_.scenes = data_.all = request.scenes;
    data_.extent = Extent::named;
    for (const char* name : {"engines", "order"})
      for (const Point& point : find_experiment(name).points(request)) point.compute(data_.rows);
    data_.rows.notes = {"something was left out"};
    data_.provenance = with_scenes(
        {{"command", "crosscheck report"}, {"commit", "abc"}, {"date", "2026-11-22 10:00:00 UTC"}}, request.scenes);
  }
  /// Writes the report without drawing figures and pictures, but records their names.
  WrittenReport written(ReportData& data, const std::filesystem::path& folder) {
    drawn_.clear();
    return write_report(data, folder, "", [this](const std::vector<Point>& points) {
      for (const Point& point : points) drawn_.push_back(point.content);
      return std::vector<std::string>();
    });
  }
  void write_tables() {
    data_.rows.tables.push_back(certificate_table(data_.rows.certificates));
    for (const Table& table : data_.rows.tables) write_csv(table, data_.provenance, folder_ / "data");
    for (const Scene& scene : data_.scenes) write_file(folder_ / "data/scenes" / (scene.name + ".toml"), scene.source);
  }
  std::string page() const { return read(folder_ / "index.html"); }
  /// The complete page, with folded contents.
  std::string whole_page() const { return with_folds_put_back(page()); }

  ReportData data_;
  std::vector<std::string> drawn_;
};

/// The charts that are visible when the page opens.
JsonField open_charts_in(const std::string& html) {
  const std::string begin = "<script type=\"application/json\" id=\"open-charts\">";
  return JsonField::parse(between(html, begin, "</script>").substr(begin.size()), "charts in sight");
}

/// The other charts, after unpacking.
JsonField packed_charts_in(const std::string& html) {
  const std::string begin = "<script type=\"text/plain\" id=\"charts\">";
  return JsonField::parse(unpacked_text(between(html, begin, "</script>").substr(begin.size())), "charts");
}

TEST_F(Assembled, EveryFigureHasAsManyPointsAsItsTable) {
  write_tables();
  const WrittenReport report = written(data_, folder_);
  const std::string html = whole_page();
  const JsonField open = open_charts_in(html), packed = packed_charts_in(html);
  const std::vector<std::string> figures = figures_of(report.page);
  EXPECT_GT(std::set(figures.begin(), figures.end()).size(), 5u);
  int compared = 0;
  for (const std::string& name : figures) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(contains(html, fmt::format("data-chart=\"{}\"", name)));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "figures" / (name + ".gp")));
    const Table table = read_csv(folder_ / "figures" / (name + ".csv"));
    const auto chart = open.find(name) ? open.find(name) : packed.find(name);
    ASSERT_TRUE(chart);
    if (opens_a_chapter(report.page, name)) {
      EXPECT_TRUE(open.find(name)) << "needed if the page is printed immediately";
    }
    EXPECT_EQ((*chart)["name"].text(), name);
    if ((*chart)["kind"].text() != "curves") continue;
    std::map<std::string, size_t> rows;
    for (const auto& row : table.rows) ++rows[std::get<std::string>(row[0])];
    size_t failures = 0, failed = 0;
    for (const JsonField& part : (*chart)["parts"].elements()) {
      failures += part["failures"].size();
      for (const JsonField& series : part["series"].elements()) {
        std::string id = series["title"].text();
        for (char& sign : id)
          if (sign == ',' || sign == '"') sign = ';';
        EXPECT_GT(rows[id], 0u) << id;
        if (rows[id] <= 600)
          EXPECT_EQ(series["points"].size(), rows[id]) << id;
        else
          EXPECT_LE(series["points"].size(), 600u) << id;
        rows.erase(id), ++compared;
      }
    }
    for (const auto& [curve, points] : rows)
      if (curve.starts_with("failed: ")) failed += points;
    EXPECT_EQ(failed, failures);
  }
  EXPECT_GT(compared, 10);
  // figures that do not open a chapter have only numbers and a script
  for (const std::string& name : drawn_) EXPECT_TRUE(opens_a_chapter(report.page, name)) << name;
}

TEST_F(Assembled, EverySceneHasACardAndWhatItOpens) {
  write_tables();
  written(data_, folder_);
  const std::string html = whole_page(), scenes = between(html, "id=\"scenes\"", "id=\"words\"");
  EXPECT_EQ(count(scenes, "<a class=\"card\""), 2);
  for (const Scene& scene : data_.scenes) {
    SCOPED_TRACE(scene.name);
    EXPECT_TRUE(contains(scenes, fmt::format("class=\"card\" href=\"#{0}\" data-scene=\"{0}\"", scene.name)));
    const std::string inside = between(scenes, fmt::format("<template data-scene=\"{}\">", scene.name), "</template>");
    EXPECT_TRUE(contains(inside, "class=\"findings\""));
    EXPECT_TRUE(contains(inside, fmt::format("data-chart=\"{}-error\"", scene.name)));
    EXPECT_TRUE(contains(inside, fmt::format("crosscheck compare {}", scene.name)));
    EXPECT_TRUE(contains(inside, "Is it the same scene?"));
    EXPECT_EQ(count(inside, "<tr data-method=\"mysim/explicit-euler\">"), 1) << "all runs, including failed ones";
    EXPECT_FALSE(contains(at_load(html), fmt::format("data-chart=\"{}-energy\"", scene.name)));
  }
  // a dot per quantity
  size_t quantities = 0;
  for (const Certificate& c : data_.rows.certificates) quantities += c.rows.size();
  EXPECT_GT(quantities, 0u);
  EXPECT_EQ(static_cast<size_t>(count(section(html, "same-answer"), "<i class=\"")), quantities);
}

TEST_F(Assembled, SentencesAreShort) {
  write_tables();
  const WrittenReport report = written(data_, folder_);
  int answers = 0;
  for (const Finding& f : report.page.findings) answers += finding_rule(f.rule).topic == "answer";
  expect_short(report.page.findings);
  for (const ScenePart& part : report.page.scenes) expect_short(part.findings);
  EXPECT_GE(answers, 2);
  EXPECT_EQ(count(page(), "<div class=\"question\">"), answers);
}

TEST_F(Assembled, FromItsDataTheSamePageComesAgain) {
  const Scene& scene = data_.scenes[1];
  RunsWriter writer(folder_);
  writer.keep_truth(scene, default_run(scene));
  for (const char* name : {"mysim/symplectic-euler", "bullet/deformable-explicit"}) {
    Recorder recorder;
    const Outcome out = run_method(find_method(name), scene, default_run(scene), {&recorder});
    writer.keep({"engines", scene, name, {{out, recorder.trajectory}}}, default_run(scene));
  }
  data_.runs = take_index(folder_);
  write_tables();
  written(data_, folder_);
  const std::string html = page(), json = read(folder_ / "report.json");
  EXPECT_TRUE(contains(json, "\"extent\": \"named\""));
  EXPECT_TRUE(verify_report(folder_).mismatches.empty());
  ReportData again = read_report(folder_);
  EXPECT_EQ(again.extent, Extent::named);
  EXPECT_EQ(again.scenes.size(), data_.scenes.size());
  EXPECT_EQ(again.rows.notes, data_.rows.notes);
  EXPECT_EQ(again.provenance, data_.provenance);
  written(again, folder_);
  EXPECT_TRUE(page() == html);
  EXPECT_EQ(read(folder_ / "report.json"), json);
  for (const char* set : {"chain-truth", "chain-engines"})
    EXPECT_TRUE(contains(html, fmt::format("data-runs=\"{}\"", set))) << set;
}

TEST_F(WholePage, CountsEachByteInOneBlock) {
  std::vector<std::pair<std::string, size_t>> blocks;
  const std::string html = page_html(content_, &blocks);
  size_t bytes = 0;
  for (const auto& [name, size] : blocks) {
    EXPECT_GT(size, 0u) << name;
    bytes += size;
  }
  EXPECT_EQ(bytes, html.size());
  EXPECT_EQ(std::ranges::count(blocks, "charts", &std::pair<std::string, size_t>::first), 1);
}

TEST_F(Assembled, CertificatesSurviveTheirTable) {
  ASSERT_FALSE(data_.rows.certificates.empty());
  // cells with texts that look like numbers, and with characters that CSV must quote
  data_.rows.certificates[0].rows = {{"mass", "4", "4", "4", Parity::match},
                                     {"pins", "1, 2", "say \"so\"", "two\nlines", Parity::mismatch},
                                     {"law", "", "1e-3", "–", Parity::different_law},
                                     {"drag", "0.5", "", "", Parity::unattested}};
  write_tables();
  written(data_, folder_);
  const ReportData again = read_report(folder_);
  ASSERT_EQ(again.rows.certificates.size(), data_.rows.certificates.size());
  for (size_t i = 0; i < again.rows.certificates.size(); ++i) {
    const Certificate &before = data_.rows.certificates[i], &after = again.rows.certificates[i];
    EXPECT_EQ(after.method, before.method);
    EXPECT_EQ(after.scene, before.scene);
    ASSERT_EQ(after.rows.size(), before.rows.size());
    for (size_t k = 0; k < after.rows.size(); ++k) {
      EXPECT_EQ(after.rows[k].quantity, before.rows[k].quantity);
      EXPECT_EQ(after.rows[k].requested, before.rows[k].requested);
      EXPECT_EQ(after.rows[k].mapped, before.rows[k].mapped);
      EXPECT_EQ(after.rows[k].read_back, before.rows[k].read_back);
      EXPECT_EQ(after.rows[k].parity, before.rows[k].parity);
    }
  }
}

TEST_F(Assembled, ReportsThatWereChangedOrAreOlderAreRefused) {
  write_tables();
  written(data_, folder_);
  const std::string json = read(folder_ / "report.json");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = json;
    write_file(folder_ / "report.json", text.replace(text.find(from), from.size(), to));
    return refusal_of([&] { read_report(folder_); });
  };
  EXPECT_TRUE(contains(with("\"extent\": \"named\"", "\"extent\": \"huge\""), "huge"));
  EXPECT_TRUE(contains(with("\"format\": 2", "\"format\": 1"), "expected a report of format 2, got 1"));
  EXPECT_TRUE(contains(with("\"format\": 2,", ""), "expected a report of format 2, got one without a format"));
  EXPECT_TRUE(contains(with("\"hash\": \"", "\"hash\": \"0"), "its data differ from the report: scene "));
  EXPECT_EQ(with("\"tier\": \"measured\"", "\"tier\": \"guessed\""), "") << "another version may use other words";
  EXPECT_EQ(with("\"extent\"", "\"extent\""), "");
}

}  // namespace
}  // namespace crosscheck
