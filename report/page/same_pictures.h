// Pictures that a page shows more than once.
#pragma once

#include <string>

namespace crosscheck {

/// The page with the bytes of each picture once: where <img> elements hold the same ones, all become drawings that use
/// the first one's.
std::string sharing_pictures(const std::string& page);

}  // namespace crosscheck
