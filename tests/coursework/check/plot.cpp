#include "plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace coursework {
namespace {

constexpr double width = 360, height = 220, left = 52, right = 10, top = 24, bottom = 34;

struct Range {
  double low = 0, high = 0;
  void take(double value, bool first) {
    low = first ? value : std::min(low, value);
    high = first ? value : std::max(high, value);
  }
  void widen(double by) {
    const double more = high > low ? by * (high - low) : std::max(1e-12, 0.5 * std::abs(low));
    low -= more, high += more;
  }
};

std::string text_of(const char* form, double value) {
  char text[32];
  std::snprintf(text, sizeof text, form, value);
  return text;
}

double at_x(const Case& what, const Numbers& numbers, std::size_t row) {
  return what.plot_x < 0
             ? what.row_size * static_cast<double>(row)
             : numbers[row * static_cast<std::size_t>(what.columns) + static_cast<std::size_t>(what.plot_x)];
}

double at_y(const Case& what, const Numbers& numbers, std::size_t row) {
  return numbers[row * static_cast<std::size_t>(what.columns) + static_cast<std::size_t>(what.plot_y)];
}

/// Gives x and y the same scale (pixels per metre) if both are positions, so that a circle is round.
void equalise(Range& x, Range& y) {
  const double scale_x = (x.high - x.low) / (width - left - right),
               scale_y = (y.high - y.low) / (height - top - bottom);
  Range& smaller = scale_x < scale_y ? x : y;
  const double more = std::max(scale_x, scale_y) / std::min(scale_x, scale_y) - 1;
  const double margin = more * (smaller.high - smaller.low) / 2;
  smaller.low -= margin, smaller.high += margin;
}

/// Path of a curve in SVG. Ends before the first number that is not finite or lies far outside the window.
std::string curve(const Case& what, const Numbers& numbers, Range x, Range y, const std::string& style) {
  std::string path;
  for (std::size_t row = 0; row < numbers.size() / static_cast<std::size_t>(what.columns); ++row) {
    const double px = (width - left - right) * (at_x(what, numbers, row) - x.low) / (x.high - x.low);
    const double py = (height - top - bottom) * (y.high - at_y(what, numbers, row)) / (y.high - y.low);
    if (!(std::abs(px) < 1e4 && std::abs(py) < 1e4)) break;
    path += (path.empty() ? "M" : "L") + text_of("%.1f", px) + " " + text_of("%.1f", py);
  }
  return "<path fill=\"none\" " + style + " d=\"" + path + "\"/>\n";
}

std::string word(double x, double y, const std::string& anchor, const std::string& colour, const std::string& text) {
  return "<text x=\"" + text_of("%g", x) + "\" y=\"" + text_of("%g", y) + "\" text-anchor=\"" + anchor + "\" fill=\"" +
         colour + "\">" + escaped(text) + "</text>\n";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '&')
      safe += "&amp;";
    else if (c == '"')
      safe += "&quot;";
    else if (static_cast<unsigned char>(c) >= 32 || c == '\n' || c == '\t')
      safe += c;
  }
  return safe;
}

std::string plot(const Case& what, const Numbers& got, const PlotTexts& texts) {
  const std::size_t columns = static_cast<std::size_t>(std::max(1, what.columns));
  const std::size_t rows = what.expected.size() / columns;
  if (what.plot_y < 0 || what.plot_y >= what.columns || what.plot_x >= what.columns || rows < 2) return "";
  Range x, y;
  for (std::size_t row = 0; row < rows; ++row) {
    x.take(at_x(what, what.expected, row), row == 0);
    y.take(at_y(what, what.expected, row), row == 0);
  }
  x.widen(what.plot_x < 0 ? 0.0 : 0.3), y.widen(0.3);
  if (what.plot_x >= 0) equalise(x, y);
  const double floor = height - bottom;
  const std::string box = "<rect x=\"52\" y=\"24\" width=\"298\" height=\"162\" fill=\"none\" stroke=\"#999\"/>\n";
  // a nested svg clips its content
  const std::string inner = "<svg x=\"52\" y=\"24\" width=\"298\" height=\"162\">\n";
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 360 220\" width=\"360\" height=\"220\" "
         "font-family=\"sans-serif\" font-size=\"11\">\n" +
         box + inner +
         curve(what, what.expected, x, y, "stroke=\"#1f77b4\" stroke-width=\"4\" stroke-opacity=\"0.45\"") +
         curve(what, got, x, y, "stroke=\"#d62728\" stroke-width=\"1.5\" stroke-dasharray=\"7 3\"") + "</svg>\n" +
         word(left, 16, "start", "#1f77b4", "\u2501 " + texts.right) +
         word(left + 80, 16, "start", "#d62728", "\u2504 " + texts.yours) +
         word(left, floor + 13, "start", "#555", text_of("%.3g", x.low)) +
         word(width - right, floor + 13, "end", "#555", text_of("%.3g", x.high)) +
         word((left + width - right) / 2, height - 6, "middle", "#000", texts.x) +
         word(left - 4, floor, "end", "#555", text_of("%.3g", y.low)) +
         word(left - 4, top + 9, "end", "#555", text_of("%.3g", y.high)) +
         word(width - right, 16, "end", "#000", texts.y) + "</svg>\n";
}

}  // namespace coursework
