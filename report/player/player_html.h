// The player's part of the page: a poster, the data, and the element that plays them.
#pragma once

#include <filesystem>
#include <string>

#include "report/page/page.h"

namespace crosscheck {

/// Styles and script of all players of a page, for its head.
std::string player_head();

/// The poster, which stays where nothing can be played and on paper, and the motions over it (JSON of player_data.h).
std::string player_html(const PageImage& poster, const std::filesystem::path& motions);

/// The runs that a figure plays under a click, for the page's end. Throws std::runtime_error where a file cannot be
/// read.
std::string runs_html(const PlayedRuns& runs);

}  // namespace crosscheck
