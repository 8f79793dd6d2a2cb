// How wide a text will be, so that it can be made to fit before it is set.
#pragma once

#include <string>

namespace crosscheck::render {

/// Width of a UTF-8 text in DejaVu Sans (or its bold), in units of the font size; letters outside ASCII are guessed.
double text_width(const std::string& text, bool bold);

}  // namespace crosscheck::render
