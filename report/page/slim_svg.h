// Figures of gnuplot in fewer bytes, for the page: a report holds a hundred of them. Files in figures/ stay as they
// are.
#pragma once

#include <string>

namespace crosscheck {

/// The same drawing, to a tenth of its unit (a tenth of a pixel at its own size): white space, groups that hold
/// nothing, definitions that nobody uses and attributes that say what holds anyway are gone, and paths go from point to
/// point. What it does not know it leaves alone.
std::string slim_svg(const std::string& text);

/// An SVG as an address: "data:image/svg+xml,...", without quotes or bare ampersands, ready for an attribute.
std::string svg_address(const std::string& text);

}  // namespace crosscheck
