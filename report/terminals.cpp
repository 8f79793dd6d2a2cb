// The three forms of a figure: SVG for the page, PDF for paper, PNG for everything else.
#include <fmt/format.h>

#include <cctype>

#include "report/figure.h"

namespace crosscheck {
namespace {

struct Terminal {
  std::string set, ending;
};

std::vector<Terminal> terminals_of(const FigureWords& figure, double height) {
  const double wide = figure.size.units();
  std::string svg_name = figure.name;  // gnuplot takes letters, digits and _ only
  for (char& c : svg_name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return {{fmt::format("svg size {:.0f},{:.0f} dynamic font \"DejaVu Sans,12\" background \"#FFFFFF\" name {}", wide,
                       height, single_quoted(svg_name)),
           ".svg"},
          // a font of 12 is as high as the figure's; 0.75 makes gnuplot's points those of the page
          {fmt::format("pdfcairo size {:.4g}cm,{:.4g}cm font \"DejaVu Sans,12\" fontscale {:.4g} linewidth {:.3g} "
                       "pointscale {:.3g}",
                       figure.size.width, figure.size.width * height / wide, 0.75 * figure.size.font / 12,
                       figure.size.font / 8.5, figure.size.font / 8.5),
           ".pdf"},
          {fmt::format("pngcairo size {:.0f},{:.0f} font \"DejaVu Sans,12\" fontscale 1.6 linewidth 1.7 pointscale 1.6",
                       2 * wide, 2 * height),
           ".png"}};
}

}  // namespace

std::string terminals(const FigureWords& figure, double tall, const std::string& plot) {
  // title, labels and key take what they take, the plot between them goes with the width
  const double height = 140 + 360 * figure.size.units() / 680 + 500 * (tall - 1);
  std::string out;
  for (const Terminal& t : terminals_of(figure, height))
    out += fmt::format("set term {}\nset output {}\n{}", t.set, single_quoted(figure.name + t.ending),
                       out.empty() ? plot : "replot\n");
  return out + "set output\n";
}

std::string terminals_of_block(const FigureWords& figure, double height, const std::string& block) {
  std::string out;
  for (const Terminal& t : terminals_of(figure, height))
    out += fmt::format("reset\nload \"style.gp\"\nset term {}\nset output {}\n{}set output\n", t.set,
                       single_quoted(figure.name + t.ending), block);
  return out;
}

}  // namespace crosscheck
