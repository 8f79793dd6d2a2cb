// Command lines as text that a shell reads back to the same words.
#pragma once

#include <span>
#include <string>

namespace crosscheck {

/// The word as bash reads it, on one line whatever is in it: plain where it can be, otherwise in quotes, and with
/// control characters and what is no UTF-8 as $'\n' or $'\377'.
std::string shell_word(const std::string& word);

/// The words with blanks between them.
std::string shell_line(std::span<const std::string> words);

}  // namespace crosscheck
