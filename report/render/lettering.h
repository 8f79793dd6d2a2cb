// The gnuplot scripts that put titles, legend and colour bar on a drawn image.
#pragma once

#include <string>
#include <vector>

#include "report/render/layout.h"
#include "report/render/letter_page.h"

namespace crosscheck::render {

/// A script that reads the raw pixels from `pixels` (or, where that is empty, none) and writes `output`; both are names
/// without quotes, in gnuplot's working folder.
std::string lettering_script(const Picture& picture, const Layout& layout, const Paper& paper,
                             const std::string& pixels, const std::string& output);

/// A script that writes a PNG of bands, one above the other, with the subtitles of one frame of a clip in each; sizes
/// in pixels, `middle` is where in a band its text stands.
std::string subtitles_script(const std::vector<std::vector<std::string>>& bands, const Layout& layout, int width,
                             int height, double middle, const std::string& output);

}  // namespace crosscheck::render
