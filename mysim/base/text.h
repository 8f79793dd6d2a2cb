// Texts: parts, the closest match for a misspelt name, words quoted for a shell, Base64.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// The name closest to a misspelt word, or nothing: fewest letters added, omitted, exchanged or swapped with their
/// neighbour (Damerau and Levenshtein), at most one in three of the longer of both; case, '_' and '-' are ignored. If
/// there is none, the shortest name that has the word as its beginning or as a part behind a hyphen or slash; else the
/// longest that is such a part of the word ("rest" for "rest_length"); else the one with the longest common beginning
/// of five letters or more.
std::string closest_match(std::string_view word, const std::vector<std::string>& names);

/// The closest match as the end of a message: "; did you mean 'NAME'?", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

/// The message for an unknown name, at most 200 bytes: "unknown KIND 'WORD'; did you mean 'NAME'? (`LIST` shows all)".
/// `list` is the command that prints the names.
std::string unknown_name(std::string_view kind, std::string_view word, const std::vector<std::string>& names,
                         std::string_view list);

/// Throws InputError: "method NAME: unknown option '+OPTION'; expected KNOWN", with the closest match among the options
/// in KNOWN (the words behind a plus).
[[noreturn]] void refuse_option(const std::string& method, const std::string& option, const std::string& known);

/// The parts between the separators.
std::vector<std::string> split(std::string_view text, char separator);

/// The length of the UTF-8 character that begins at `at`; 0 if there is no valid one.
std::size_t utf8_length(std::string_view text, std::size_t at);

/// The word as bash reads it, on one line: unquoted if possible, otherwise in quotes, with unprintable bytes as
/// $'\012'.
std::string shell_quote(const std::string& word);

/// The word in single quotes, for any shell.
std::string shell_single_quote(const std::string& word);

/// The quoted words with blanks between them.
std::string shell_join(std::span<const std::string> words);

/// "3.2 GB", powers of ten.
std::string format_bytes(double bytes);

/// RFC 4648, with padding, in one line.
std::string base64(std::string_view bytes);

}  // namespace crosscheck
