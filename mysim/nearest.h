// The name that a misspelt word most probably means.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// The one of the names that is nearest to the word, or nothing where none is near: fewest letters added, left out,
/// exchanged or swapped with their neighbour (Damerau and Levenshtein), at most one in three of the longer of both;
/// capitals, '_' and '-' count as alike. Where none is that near, the shortest name that begins with the word, or has
/// it as a part behind a hyphen or slash; else the longest that is such a part of the word, or its beginning ("rest"
/// for "rest_length"); else the one that begins with the same five letters or more.
std::string nearest(std::string_view word, const std::vector<std::string>& names);

/// The same as the end of a message: "; did you mean 'NAME'?", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace crosscheck
