// Words: a text split into parts, the name that a misspelt one probably means, and words quoted for a shell; bytes as
// Base64.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

// The name that a misspelt word most probably means.

/// The one of the names that is nearest to the word, or nothing where none is near: fewest letters added, left out,
/// exchanged or swapped with their neighbour (Damerau and Levenshtein), at most one in three of the longer of both;
/// capitals, '_' and '-' count as alike. Where none is that near, the shortest name that begins with the word, or has
/// it as a part behind a hyphen or slash; else the longest that is such a part of the word, or its beginning ("rest"
/// for "rest_length"); else the one that begins with the same five letters or more.
std::string closest_match(std::string_view word, const std::vector<std::string>& names);

/// The same as the end of a message: "; did you mean 'NAME'?", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

/// The message for a name that is not in the list, at most 200 bytes, nearest name first: "unknown KIND 'WORD'; did you
/// mean 'NAME'? (`LIST` shows all)". `list` is the command that prints the names.
std::string unknown_name(std::string_view kind, std::string_view word, const std::vector<std::string>& names,
                         std::string_view list);

/// Throws InputError: "method NAME: unknown option '+OPTION'; expected KNOWN", and which of the options in KNOWN, all
/// words behind a plus, is probably meant.
[[noreturn]] void refuse_option(const std::string& method, const std::string& option, const std::string& known);

/// The parts between the separators, one more than there are of these.
std::vector<std::string> split(std::string_view text, char separator);

/// The length of the UTF-8 character that begins at `at`; 0 where none does.
std::size_t utf8_length(std::string_view text, std::size_t at);

// Command lines as text that a shell reads back to the same words.

/// The word as bash reads it, on one line whatever is in it: plain where it can be, otherwise in quotes, and with
/// control characters and what is no UTF-8 as $'\n' or $'\377'.
std::string shell_quote(const std::string& word);

/// The word in single quotes, as every shell reads it, line feeds as they are.
std::string shell_single_quote(const std::string& word);

/// The words with blanks between them.
std::string shell_join(std::span<const std::string> words);

/// For people: "3.2 GB", powers of ten.
std::string format_bytes(double bytes);

/// RFC 4648, with padding, in one line.
std::string base64(std::string_view bytes);

}  // namespace crosscheck
