// Figure sets and PNG files: sizes, captions in plain text and LaTeX, and drawings that gnuplot can redraw.

#include "report/figures/figure_set.h"

#include <zlib.h>

#include <cstdlib>
#include <regex>

#include "mysim/base/errors.h"
#include "mysim/base/json.h"
#include "mysim/base/names.h"
#include "mysim/base/process.h"
#include "reference/method.h"
#include "report/base/gnuplot.h"
#include "report/figures/plot_layout.h"
#include "report/pictures/picture.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/readers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

std::string message_of(const std::string& set, const std::string& width) {
  try {
    figure_size(set, width);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FigureSize, IsThatOfTheSetOrAsAsked) {
  EXPECT_EQ(figure_size("paper", "").width, 8.5);
  EXPECT_EQ(figure_size("paper", "85mm").width, 8.5);
  EXPECT_NEAR(figure_size("paper", "3.3in").width, 8.382, 1e-12);
  EXPECT_EQ(figure_size("lecture", "").font, 20);
  EXPECT_NEAR(FigureSize{}.units(), 680, 0.5);
  for (const char* bad : {"8.5", "cm", "8.5 cm", "-8cm", "1cm", "200cm", "8.5pt", "nancm"})
    EXPECT_TRUE(contains(message_of("paper", bad), "expected 4cm to 100cm, in cm, mm or in")) << bad;
  EXPECT_TRUE(contains(message_of("poster", ""), "--set poster: expected paper or lecture"));
}

TEST(GnuplotTexts, StayOneLineInQuotesAndCommentsAndNamesStartNoCommand) {
  EXPECT_EQ(single_quoted("a\n`touch X`\n#'\x1b"), "'a `touch X` #''?'");
  EXPECT_EQ(one_line("a\r\nb"), "a? b");
  for (const char* name : {"<touch X", "|touch X", "../x", "a\nb", "", "-e"})
    EXPECT_THROW(draw({name, {}, ""}, {}, testing::TempDir()), InputError) << name;
}

TEST(Latex, SpecialCharactersAreEscaped) {
  EXPECT_EQ(latex("a_b & 5 % of #1 {x} ~ ^ \\ $"),
            "a\\_b \\& 5 \\% of \\#1 \\{x\\} \\textasciitilde{} \\textasciicircum{} \\textbackslash{} \\$");
  EXPECT_EQ(latex("< 3 µm ± 1, 2 × ω"), "$<$ 3 $\\mu$m $\\pm$ 1, 2 $\\times$ $\\omega$");
}

TEST(CurveFigures, AreDrawnWithCategoryNamesOfEveryLength) {
  for (const size_t length : {1u, 60u, 200u})
    for (const char* set : {"paper", "lecture"}) {
      Figure f;
      f.name = "categories", f.title = "names", f.size = figure_size(set, "");
      f.x = {"", false, -0.6, std::nullopt}, f.y = {"y", true, 1e-3, 10};
      std::string name;
      while (name.size() + 3 <= length) name += "布";
      f.categories = {{0, name + "a"}, {1, std::string(length, 's')}};
      f.curves = {{"mysim/rk4", style_of("mysim/rk4"), {{0, 1}, {1, 2}}, false, true}};
      const std::string script = drawing_of(f).script;  // throws if the plot is left without space
      EXPECT_EQ(printable(script), script) << length << " in " << set;
    }
}

/// One chart of each kind.
std::vector<Chart> charts() {
  Figure lines;
  lines.name = "lines", lines.title = "two lines", lines.caption = "Scene a_b.", lines.finding = "They cross.";
  lines.x = {"t / s"}, lines.y = {"x / m"};
  lines.curves = {{"mysim/leapfrog", style_of("mysim/leapfrog"), {{0, 1}, {1, 2}, {2, 0}}},
                  {"bullet/pbd", style_of("bullet/pbd"), {{0, 2}, {1, 1}, {2, 3}}}};
  StackedBars bars;
  bars.name = "bars", bars.title = "bars", bars.label = "energy / J", bars.names = {"one", "two"};
  bars.parts = {{"drag", "#0072B2", false, {1, -2}}};
  HeatMap map;
  map.name = "map", map.title = "a map", map.x_label = "time step / s", map.y_label = "k",
  map.kinds = {{"holds", "#D8E8F0"}};
  for (const char* title : {"a", "b", "c", "d"})
    map.panels.push_back({title, {{1, 1, 0}, {10, 1, 0}, {1, 10, 0}, {10, 10, 0}}, {}, {}});
  return {{"a_b", lines}, {"", bars, "energy"}, {"", map, "stability"}};
}

class FigureSet : public InFolder {
 protected:
  void make(const FigureSize& size) {
    all = charts();
    for (Chart& chart : all) {
      ASSERT_TRUE(resize(chart, size));
      std::visit(
          [&]<class F>(const F& figure) {
            if constexpr (std::derived_from<F, FigureInfo>) draw(drawing_of(figure), {}, folder_);
          },
          chart.figure);
    }
  }
  /// Width of the page in points (1/72 inch).
  double width_of(const std::string& name) const { return page_of(read(folder_ / (name + ".pdf"))).first; }
  std::vector<Chart> all;
};

TEST_F(FigureSet, EveryKindHasTheWidthThatWasAsked) {
  for (const double width : {8.5, 12.0, 17.0}) {
    make({width, 8, false});
    // gnuplot rounds the width to whole points
    for (const char* name : {"lines", "bars", "map"}) EXPECT_NEAR(width_of(name), width / 2.54 * 72, 1.01) << name;
  }
}

TEST_F(FigureSet, LettersOnThePageHaveTheSizeThatWasAsked) {
  for (const double font : {7.5, 11.0}) {
    make({12, font, false});
    for (const char* name : {"lines", "bars", "map"}) {
      const std::set<double> letters = letters_of(read(folder_ / (std::string(name) + ".pdf")));
      ASSERT_FALSE(letters.empty()) << name;
      // superscripts are separate characters of the same size
      EXPECT_NEAR(*letters.begin(), font, 0.05) << name;
      EXPECT_NEAR(*letters.rbegin(), font, 0.05) << name;
    }
  }
  EXPECT_GE(figure_size("paper", "").font, 7);
  EXPECT_LE(figure_size("paper", "").font, 8);
}

/// Many methods over wide ranges, with failures.
Figure crowded() {
  Figure f;
  f.name = "crowded", f.title = "many", f.x = {"time step / s", true}, f.y = {"error / m", true};
  double y = 1e-12;
  for (const Method& m : builtin_methods()) {
    if (!m.family().by_default()) continue;
    f.curves.push_back({m.name, style_of(m.name), {}, true, true});
    for (const double x : {1e-4, 1e-3, 1e-2}) f.curves.back().points.emplace_back(x, y * x);
    f.failures.push_back({m.name + ": blew up", style_of(m.name), 0.1, 1, "blew up"});
    y *= 3;
  }
  f.size = figure_size("paper", "");
  return f;
}

TEST_F(FigureSet, AtMostSixMethodsAreInColourAndTheOthersAreGrey) {
  const std::string script = drawing_of(crowded()).script;
  const std::string plot = script.substr(script.find("\nplot "));
  std::set<std::string> colours;
  const std::regex colour("lc rgb \"(#[0-9A-F]+)\"");
  for (std::sregex_iterator i(plot.begin(), plot.end(), colour), end; i != end; ++i) colours.insert((*i)[1]);
  EXPECT_EQ(colours.size(), 7u) << "expected six colours and grey";
  EXPECT_TRUE(contains(script, " others'"));
  EXPECT_FALSE(contains(script, "set title"));
  EXPECT_FALSE(contains(script, "set label 'mysim/")) << "readers must see its display name";
}

TEST_F(FigureSet, NoTextLeavesTheSheet) {
  const FigureSize size = figure_size("paper", "");
  const Figure f = crowded();
  draw(drawing_of(f), {}, folder_);
  const std::string script = drawing_of(f).script;
  const std::regex label("set label '([^']*)' at screen ([-0-9.]+),([-0-9.]+) (left|center|right) ");
  int seen = 0;
  for (std::sregex_iterator i(script.begin(), script.end(), label), end; i != end; ++i) {
    const double x = std::stod((*i)[2]), y = std::stod((*i)[3]);
    if ((*i)[4] == "left") {
      EXPECT_LE(x + crosscheck::width_of((*i)[1].str()) / size.units(), 1.005) << (*i)[1];
      EXPECT_GE(x, 0) << (*i)[1];
    }
    EXPECT_GE(y, 0) << (*i)[1];
    EXPECT_LE(y, 1) << (*i)[1];
    ++seen;
  }
  EXPECT_GT(seen, 6);
}

TEST_F(FigureSet, NumbersThatNoAxisReachesAreRefusedInNoTime) {
  for (const double bad : {0., -1., 1e-320 / 1e10, static_cast<double>(INFINITY), static_cast<double>(NAN)}) {
    EXPECT_THROW(ticks_of(bad, 1, true, 200, false), std::runtime_error) << bad;
    EXPECT_THROW(ticks_of(1, bad, true, 200, false), std::runtime_error) << bad;
  }
  for (const auto& [low, high] : {std::pair(1e300, std::nextafter(1e300, INFINITY)), std::pair(-1.5e308, 1.5e308),
                                  std::pair(1., 1.), std::pair<double, double>(0, INFINITY), std::pair(NAN + 0., 1.)})
    EXPECT_THROW(ticks_of(low, high, false, 200, false), std::runtime_error) << low;
  EXPECT_THROW(Board({0, 1e300, 0, 100}), std::runtime_error);
  EXPECT_THROW(Board({0, NAN, 0, 100}), std::runtime_error);
  Board board({0, 100, 0, 100});
  for (const double far : {1e300, 1e20, static_cast<double>(-INFINITY), static_cast<double>(NAN)})
    for (int i = 0; i < 100; ++i) board.add_line({50, 50}, {far, far}), board.add_mark({far, 50});
  EXPECT_EQ(board.cost({10, 20, 10, 20}), 0);
}

TEST_F(FigureSet, TicksHaveRoomAndRoundNumbers) {
  const auto texts = [](const std::vector<Tick>& ticks) {
    std::vector<std::string> found;
    for (const Tick& t : ticks)
      if (!t.text.empty()) found.push_back(t.text);
    return found;
  };
  EXPECT_EQ(texts(ticks_of(0, 3, false, 200, false)),
            (std::vector<std::string>{"0", "0.5", "1", "1.5", "2", "2.5", "3"}));
  EXPECT_EQ(texts(ticks_of(1e-12, 1, true, 90, true)).front(), "10⁻¹²");
  for (const double high : {0.002, 0.03, 7., 1e9})
    EXPECT_GE(texts(ticks_of(1e-3, high, true, 150, false)).size(), 2u) << high;
}

TEST_F(FigureSet, TitlesStandInLecturesOnly) {
  make(figure_size("paper", ""));
  for (const char* name : {"lines", "map"}) {
    const std::string svg = read(folder_ / (std::string(name) + ".svg"));
    EXPECT_EQ(svg.find(name == std::string("map") ? ">a map<" : ">two lines<"), std::string::npos) << name;
  }
  make(figure_size("lecture", ""));
  EXPECT_TRUE(contains(read(folder_ / "lines.svg"), ">two lines<"));
  EXPECT_TRUE(contains(read(folder_ / "map.svg"), ">a map<"));
}

TEST_F(FigureSet, GnuplotAloneDrawsTheSameAgain) {
  make(figure_size("paper", ""));
  for (const char* name : {"lines", "bars", "map"}) {
    const std::string before = read(folder_ / (std::string(name) + ".svg"));
    const std::string picture = read(folder_ / (std::string(name) + ".png"));
    std::filesystem::remove(folder_ / (std::string(name) + ".svg"));
    const ProgramResult drawn = run_program({"gnuplot", std::string(name) + ".gp"}, folder_);
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_EQ(drawn.err, "");
    EXPECT_EQ(read(folder_ / (std::string(name) + ".svg")), before) << name;
    EXPECT_EQ(read(folder_ / (std::string(name) + ".png")), picture) << name;
  }
}

TEST_F(FigureSet, WordsSayWhatEachShows) {
  make(figure_size("paper", ""));
  std::vector<FigureInSet> drawn;
  for (const Chart& chart : all) {
    drawn.push_back({*figure_info(chart), chart.scene, chart_endings});
    write_captions(*figure_info(chart), folder_);
  }
  write_catalogue(drawn, {{"commit", "abc"}, {"date", "2026-11-22T10:00:00Z"}}, folder_);
  EXPECT_EQ(read(folder_ / "lines.txt"), "two lines\nThey cross. Scene a_b.\n");
  const std::string tex = read(folder_ / "lines.tex");
  EXPECT_TRUE(contains(tex, "\\includegraphics[width=8.5cm]{lines.pdf}"));
  EXPECT_TRUE(contains(tex, "\\caption{two lines. They cross. Scene a\\_b.}"));
  const JsonField json = JsonField::parse_file(folder_ / "figures.json");
  ASSERT_EQ(json["figures"].size(), 3u);
  EXPECT_EQ(json["figures"][0]["finding"].text(), "They cross.");
  EXPECT_EQ(json["figures"][0]["files"]["csv"].text(), "lines.csv");
  EXPECT_EQ(json["provenance"]["commit"].text(), "abc");
  EXPECT_TRUE(contains(read(folder_ / "CITATION.cff"), "version: \"abc\"\ndate-released: \"2026-11-22\""));
}

/// Non-ASCII characters in the C++ sources of a folder.
std::set<std::string> letters_in(const std::filesystem::path& folder) {
  std::set<std::string> letters;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (size_t i = 0; i < text.size(); ++i)
      if ((text[i] & 0xC0) == 0xC0)  // first byte of a UTF-8 sequence
        letters.insert(text.substr(i, (text[i] & 0xF0) == 0xF0 ? 4 : (text[i] & 0xE0) == 0xE0 ? 3 : 2));
  }
  return letters;
}

TEST_F(FigureSet, APaperWithTheSetCompiles) {
  NEEDS_PROGRAM("pdflatex", "texlive-latex-base", "compiling a paper with a figure set is not tested");
  all = charts();
  // characters with a special meaning in LaTeX, and all that occur in captions
  std::string letters = "a_b & 5 % of #1 {x} ~ ^ \\ $ < >";
  for (const char* room : {"report/figures", "report/findings", "experiments"})
    for (const std::string& letter : letters_in(std::filesystem::path(CROSSCHECK_SOURCE) / room))
      letters += " " + letter;
  EXPECT_GT(letters.size(), 80u);
  std::string paper = "\\documentclass{article}\n\\usepackage{graphicx}\n\\begin{document}\n";
  for (Chart& chart : all) {
    ASSERT_TRUE(resize(chart, figure_size("paper", "")));
    draw_figure(chart, {}, folder_);
    FigureInfo words = *figure_info(chart);
    words.caption += letters;
    write_captions(words, folder_);
    paper += "Figure~\\ref{fig:" + words.name + "} is input as it is.\n\\input{" + words.name + "}\n";
  }
  write("paper.tex", paper + "\\end{document}\n");
  for (int pass = 0; pass < 2; ++pass) {  // the second pass resolves labels
    const ProgramResult compiled =
        run_program({"pdflatex", "-interaction=nonstopmode", "-halt-on-error", "paper.tex"}, folder_);
    ASSERT_EQ(compiled.status, 0) << compiled.out;
  }
  const std::string log = read(folder_ / "paper.log");
  for (const char* bad : {"Missing character", "undefined references", "Overfull", "not set up"})
    EXPECT_FALSE(contains(log, bad)) << log;
  for (const char* name : {"lines", "bars", "map"}) EXPECT_TRUE(contains(log, "<" + std::string(name) + ".pdf"));
  if (const char* keep = std::getenv("CROSSCHECK_KEPT_PICTURE"))
    std::filesystem::copy_file(folder_ / "paper.pdf", keep, std::filesystem::copy_options::overwrite_existing);
}

using namespace testing_tools;
namespace fs = std::filesystem;

class PngFile : public InFolder {};

TEST_F(PngFile, LargerThanAnyPictureOfOursIsNotUnpacked) {
  const auto number = [](unsigned n) {
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(n >> shift);
    return bytes;
  };
  const auto chunk = [&](const std::string& name, const std::string& data) {
    const std::string all = name + data;
    return number(static_cast<unsigned>(data.size())) + all +
           number(static_cast<unsigned>(
               crc32(0, reinterpret_cast<const Bytef*>(all.data()), static_cast<uInt>(all.size()))));
  };
  const auto grey = [&](unsigned width) {
    const std::string row(width + 1, '\0');
    std::string packed(compressBound(row.size()), '\0');
    uLongf size = packed.size();
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(row.data()), row.size());
    return write("grey.png", "\x89PNG\r\n\x1a\n" +
                                 chunk("IHDR", number(width) + number(1) + std::string("\10\0\0\0\0", 5)) +
                                 chunk("IDAT", packed.substr(0, size)) + chunk("IEND", ""));
  };
  EXPECT_EQ(render::read_png(grey(8192)).width, 8192);
  EXPECT_THROW(render::read_png(grey(8193)), std::runtime_error);
}

TEST_F(PngFile, KeepsEveryPixelAndNamesWhatIsNoPng) {
  const render::Image image{2, 1, {1, 2, 3, 250, 128, 0}};
  EXPECT_EQ(render::read_png(write("two.png", render::png_bytes(image, 300))).rgb, image.rgb);
  const fs::path file = write("none.png", "\x89PNG, but not further than that: no chunk of it is whole");
  try {
    render::read_png(file);
    FAIL() << "expected an error";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("cannot read " + file.string())) << error.what();
  }
}

}  // namespace
}  // namespace crosscheck
