// Texts: splitting, glob patterns, the closest match for a misspelt name, shell quoting, Base64.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// The name closest to a misspelt word, or nothing; ignores case, '_' and '-'. The first choice is the name with the
/// smallest Damerau-Levenshtein distance (letters inserted, deleted, substituted or swapped with a neighbour), up to a
/// third of the longer word. The second is the shortest name that begins with the word or contains it after a hyphen or
/// slash; the third, the longest name that the word contains in the same way ("rest" for "rest_length"); the last, the
/// name with the longest common prefix of at least five letters.
std::string closest_match(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean 'NAME'?" for the closest match, or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

/// The message for an unknown name, at most 200 bytes: "unknown KIND 'WORD'; did you mean 'NAME'? (`LIST` shows all)".
/// `list` is the command that prints the names.
std::string unknown_name(std::string_view kind, std::string_view word, const std::vector<std::string>& names,
                         std::string_view list);

/// Throws InputError: "method NAME: unknown option '+OPTION'; expected KNOWN". Adds the closest of the options in
/// `known`, which are its words after a plus.
[[noreturn]] void refuse_option(const std::string& method, const std::string& option, const std::string& known);

std::vector<std::string> split(std::string_view text, char separator);

/// Length (bytes) of the UTF-8 character that begins at `at`; 0 if it is invalid.
std::size_t utf8_length(std::string_view text, std::size_t at);

/// The word quoted for bash, on one line: bare if possible, unprintable bytes as $'\012'.
std::string shell_quote(const std::string& word);

/// The word in single quotes, for any shell.
std::string shell_single_quote(const std::string& word);

std::string shell_join(std::span<const std::string> words);

/// "3.2 GB"; units are powers of 1000.
std::string format_bytes(double bytes);

/// RFC 4648, with padding, in one line.
std::string base64(std::string_view bytes);

}  // namespace crosscheck
