// What is wrong with text that is no TOML, in the words of somebody who wants to mend it.
#pragma once

#include <string>
#include <string_view>

namespace crosscheck {

/// A fault of the text: the line (from 1) that is to be mended, which need not be the one where a parser stumbles, and
/// how.
struct TomlFault {
  int line;
  std::string what;
};

/// line and description: where the parser stumbled, and what it says, which is kept where nothing better is known.
TomlFault explain_toml(std::string_view text, int line, std::string_view description);

}  // namespace crosscheck
