// How wide a text will be, so that it can be made to fit before it is set.
#pragma once

#include <string>
#include <vector>

namespace crosscheck::render {

/// Width of a UTF-8 text in DejaVu Sans (or its bold), in units of the font size; letters outside ASCII are guessed.
double text_width(const std::string& text, bool bold);

inline constexpr double line_height = 1.25;  // from one line of a text to the next, in units of the font size

/// A text with line feeds, line by line; at least one.
std::vector<std::string> lines_of(const std::string& text);

/// The text with line feeds where a line would be wider than the room (in units of the font size): after a slash, a
/// comma with its space, or before a plus.
std::string wrapped(const std::string& text, bool bold, double room);

}  // namespace crosscheck::render
