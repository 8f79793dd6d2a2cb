// Stacked bars: what comes in and what goes out is stacked on its own side of zero, and nothing bad is drawn.
#include "report/bars.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

Bars two_bars() {
  Bars bars;
  bars.name = "test-bars", bars.title = "bars", bars.label = "energy / J";
  bars.names = {"mysim/a", "bullet/b"};
  bars.parts = {{"drag", "#0072B2", false, {2, 1}},
                {"contact (inferred)", "#D55E00", true, {0, 3}},
                {"gravity", "#999999", false, {-1.5, 0.5}},
                {"wind", "#E69F00", false, {-0.5, -4.5}}};
  return bars;
}

TEST(Bars, StackEachSignFromZero) {
  const Table data = drawing_of(two_bars()).data;
  // part, bar, place, from, to; heights of zero have no row
  const std::vector<std::vector<Cell>> expected = {{"drag", "mysim/a", 1., 0., 2.},
                                                   {"drag", "bullet/b", 2., 0., 1.},
                                                   {"contact (inferred)", "bullet/b", 2., 1., 4.},
                                                   {"gravity", "mysim/a", 1., 0., -1.5},
                                                   {"gravity", "bullet/b", 2., 4., 4.5},
                                                   {"wind", "mysim/a", 1., -1.5, -2.},
                                                   {"wind", "bullet/b", 2., 0., -4.5}};
  EXPECT_EQ(data.rows, expected);
}

TEST(Bars, InferredPartsAreHatchedAndOthersAreNot) {
  const std::string script = drawing_of(two_bars()).script;
  size_t hatched = 0, solid = 0;
  for (size_t at = 0; (at = script.find("boxxyerror", at)) != std::string::npos; ++at) {
    const std::string rest = script.substr(at, 200);
    const bool inferred = rest.find("inferred") < rest.find(", \\");
    EXPECT_EQ(rest.find("pattern") < rest.find("title"), inferred) << rest;
    (inferred ? hatched : solid) += 1;
  }
  EXPECT_EQ(hatched, 1u);  // plotted once, then drawn again for the other files
  EXPECT_EQ(solid, 3u);
}

TEST(Bars, NothingAndWhatIsNotFiniteAreRefused) {
  const auto message = [](const Bars& bars) -> std::string {
    try {
      drawing_of(bars);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  Bars empty = two_bars(), bad = two_bars();
  for (Bars::Part& part : empty.parts) part.height = {0, 0};
  bad.parts[1].height[1] = NAN;
  EXPECT_EQ(message(empty), "figure test-bars: nothing to draw");
  EXPECT_EQ(message(bad), "figure test-bars: a value is not finite");
  EXPECT_EQ(message(two_bars()), "");
}

}  // namespace
}  // namespace crosscheck
