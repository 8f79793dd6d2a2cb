// The gnuplot script that puts titles, legend and colour bar on a drawn image.
#pragma once

#include <string>

#include "report/render/layout.h"

namespace crosscheck::render {

/// A script that reads the raw pixels from `pixels` and writes `output`; both are names without quotes, in gnuplot's
/// working folder.
std::string lettering_script(const Picture& picture, const Layout& layout, const std::string& pixels,
                             const std::string& output);

}  // namespace crosscheck::render
