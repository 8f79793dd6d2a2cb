// Recognises common errors in hand-written TOML from the line that contains them.

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "mysim/base/pattern.h"
#include "mysim/scene/toml.h"

namespace crosscheck {
namespace {

/// A line without its comment and the content of its texts, so that only syntax remains.
struct BareLine {
  std::string code;     // as long as the line up to its comment; content of texts is '_'
  std::string shown;    // the original line, trimmed
  bool open = false;    // a text in this line is not closed
  bool inside = false;  // the line begins in a multi-line text
};

std::string trimmed_line(std::string_view text) {
  const auto from = text.find_first_not_of(" \t\r"), to = text.find_last_not_of(" \t\r");
  return from == std::string_view::npos ? "" : std::string(text.substr(from, to - from + 1));
}

std::vector<BareLine> bare_lines(std::string_view text) {
  std::vector<BareLine> lines;
  std::string_view fence;  // delimiter of the open multi-line text: """ or '''
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    BareLine bare{"", trimmed_line(line), false, !fence.empty()};
    for (std::size_t i = 0; i < line.size();) {
      if (!fence.empty()) {
        const bool closes = line.substr(i).starts_with(fence);
        bare.code.append(closes ? 3 : 1, '_');
        i += closes ? 3 : line[i] == '\\' && fence == "\"\"\"" ? 2 : 1;
        if (closes) fence = {};
      } else if (line[i] == '#') {
        break;
      } else if (line.substr(i).starts_with("\"\"\"") || line.substr(i).starts_with("'''")) {
        fence = line[i] == '"' ? "\"\"\"" : "'''";
        bare.code += "___", i += 3;
      } else if (const char quote = line[i]; quote == '"' || quote == '\'') {
        std::size_t close = i + 1;
        while (close < line.size() && line[close] != quote) close += quote == '"' && line[close] == '\\' ? 2 : 1;
        bare.open = close >= line.size();
        close = std::min(close, line.size() - 1);
        bare.code += '"' + std::string(close - i - (close > i), '_') + (close > i ? "\"" : "");
        i = close + 1;
      } else {
        bare.code += line[i++];
      }
    }
    lines.push_back(std::move(bare));
    begin = end + 1;
  }
  return lines;
}

/// The code point at `at`, and its length in bytes; nothing if the bytes there are not UTF-8.
std::optional<std::pair<char32_t, int>> code_point_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const int length = byte(at) < 0x80       ? 1
                     : byte(at) >> 5 == 6  ? 2
                     : byte(at) >> 4 == 14 ? 3
                     : byte(at) >> 3 == 30 ? 4
                                           : 0;
  if (length == 0 || at + length > text.size()) return std::nullopt;
  char32_t value = length == 1 ? byte(at) : byte(at) & (0x7f >> length);
  for (int i = 1; i < length; ++i) {
    if (byte(at + i) >> 6 != 2) return std::nullopt;
    value = value << 6 | (byte(at + i) & 0x3f);
  }
  return std::pair{value, length};
}

std::string strange_character(char32_t c, std::string_view as_written) {
  if ((c >= 0x2018 && c <= 0x201f) || c == 0xab || c == 0xbb || c == 0x2039 || c == 0x203a || c == 0xb4 || c == 0xff02)
    return fmt::format("{} is a typographic quotation mark; expected the straight one, \"", as_written);
  if (c == 0x2212 || (c >= 0x2010 && c <= 0x2015) || c == 0xff0d)
    return fmt::format("{} is a typographic minus or dash; expected the plain one, -", as_written);
  if (c == 0xa0 || c == 0x202f || (c >= 0x2000 && c <= 0x200a) || c == 0x3000 || c == 0x200b || c == 0xfeff ||
      c == 0x2060)
    return fmt::format("the line contains an invisible character (U+{:04X}); expected a plain space or nothing",
                       static_cast<unsigned>(c));
  return fmt::format("unexpected character {} (U+{:04X}) outside quotes; expected plain letters, digits and signs",
                     as_written, static_cast<unsigned>(c));
}

/// Characters and bytes that TOML does not allow anywhere.
std::optional<TomlError> strange_characters(std::string_view text) {
  if (text.find('\0') != std::string_view::npos)
    return TomlError{1, "the file is not plain text (it may be UTF-16); expected text saved as UTF-8"};
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const auto point = code_point_at(text, at);
    if (!point)
      return TomlError{line, "the text is not encoded as UTF-8 (but as Latin-1?); expected text saved as UTF-8"};
    line += text[at] == '\n';
    if (text[at] == '\r' && at + 1 < text.size() && text[at + 1] != '\n')
      return TomlError{line, "lines end with a carriage return alone; expected line feeds (save with Unix line ends)"};
    at += point->second;
  }
  line = 0;
  for (const BareLine& bare : bare_lines(text)) {
    ++line;
    for (std::size_t at = 0; at < bare.code.size();) {
      const auto point = code_point_at(bare.code, at);
      if (!point) break;
      const std::string as_written = bare.code.substr(at, point->second);
      if (point->first >= 0x80 && !(line == 1 && at == 0 && point->first == 0xfeff))
        return TomlError{line, strange_character(point->first, as_written)};
      at += point->second;
    }
  }
  return std::nullopt;
}

bool line_matches(const std::string& text, const char* pattern) { return Pattern(pattern).is_in(text); }

/// The error in a single value (code only); empty if it looks correct.
std::string wrong_with_value(const std::string& v) {
  if (v.empty()) return "there is nothing after the =; expected a value";
  if (v[0] == '=') return "expected a single = between key and value";
  if (line_matches(v, R"(^[-+]?(Inf|INF|[iI]nfinity|NaN|NAN|Nan)$)")) return "expected a number in digits";
  if (line_matches(v, R"(^[-+]?\.\d)"))
    return fmt::format("expected a digit before the decimal point: 0{}", v[0] == '.' ? v : v.substr(1));
  if (line_matches(v, R"(^[-+]?\d+\.($|[eE]))")) return "expected a digit after the decimal point, as in 5.0";
  if (line_matches(v, R"(^[-+]?0\d)")) return "expected a number without leading zeros";
  if (line_matches(v, R"(^[-+]?\d[\d.]*([eE][-+]?\d+)?\s*[/*^+-])"))
    return "expressions are not evaluated; expected the number itself, as in 0.0166667 or 1e-3";
  if (line_matches(v, R"(^[-+]?\d+,\d)")) return "numbers contain no commas; expected a decimal point, as in 0.5";
  if (line_matches(v, R"(^[-+]?\d+['. ]\d{3}['. ]\d{3})")) return "expected a number without separators, as in 1000000";
  if (line_matches(v, R"(^[-+]?\d[\d._]*[eE]$)")) return "expected a power of ten after the e, as in 1e-3";
  if (line_matches(v, R"(^[-+]?\d[\d._]*([eE][-+]?\d+)?\s*[,;]$)"))
    return "expected nothing after the number: no comma, no semicolon";
  if (line_matches(v, R"(^\d+\s*[xX]\s*\d+)")) return "expected a list in square brackets: [20, 20]";
  if (line_matches(v, R"(^[-+]?[\d.]*[oO][\d.oO]*$)")) return "the number contains the letter O; expected the digit 0";
  if (line_matches(v, R"(^[-+]?[\d.]+\s+[eE]\s*[-+]?\s*\d)") || line_matches(v, R"(^[-+]?[\d.]+[eE]\s+[-+]?\s*\d)"))
    return "expected the number in one piece, as in 1e-3";
  if (line_matches(v, R"(^[-+]?\d[\d._]*([eE][-+]?\d+)?\s*(?![eE][-+]?\d)[A-Za-z%])"))
    return "expected the number alone, without its unit (units are fixed); comments begin with #";
  if (line_matches(v, R"(^[-+]?\d[\d._]*([eE][-+]?\d+)?\s+[-+]?\d)"))
    return "there are two numbers after one =; expected one, or a list: [1, 2, 3]";
  if (line_matches(v, R"(^[A-Za-z][\w./+-]*\s*;?$)") && v != "true" && v != "false" && v != "inf" && v != "nan")
    return fmt::format("expected a text in quotes: \"{}\"", trimmed_line(v.substr(0, v.find(';'))));
  if (line_matches(v, R"(^[A-Za-z][\w,.'-]*\s+[^\s=])")) return "expected the whole text in quotes";
  if (v[0] == '"' && v.size() > 1) {
    const std::string rest = trimmed_line(v.substr(std::min(v.find('"', 1), v.size() - 1) + 1));
    if (rest == "," || rest == ";") return "expected nothing after the text: no comma, no semicolon";
    if (!rest.empty()) return "there is something after the closing quote; expected a quote within a text as \\\"";
  }
  return "";
}

std::string wrong_with_list(const std::string& v) {
  if (v.find(';') != std::string::npos)
    return "expected commas, no semicolons, between the entries of a list: [1, 2, 3]";
  if (line_matches(v, R"([\d.]\s+[-+.]?\d)")) return "expected commas between the entries of a list: [1, 2, 3]";
  if (line_matches(v, R"(,\s*,)")) return "two commas follow each other; expected an entry between them";
  if (line_matches(v, R"(\[\s*,)")) return "expected an entry before the first comma of the list";
  const std::string inner = v.substr(1, v.rfind(']') == std::string::npos ? std::string::npos : v.rfind(']') - 1);
  for (std::size_t begin = 0, index = 0; begin <= inner.size(); ++index) {
    const std::size_t end = std::min(inner.find(',', begin), inner.size());
    const std::string entry = trimmed_line(inner.substr(begin, end - begin));
    if (const std::string wrong = entry.empty() || entry[0] == '[' || entry[0] == '{' ? "" : wrong_with_value(entry);
        !wrong.empty())
      return fmt::format("entry [{}] is {}: {}", index, entry, wrong);
    begin = end + 1;
  }
  const std::size_t closed = v.rfind(']');
  if (closed != std::string::npos && !trimmed_line(v.substr(closed + 1)).empty())
    return "expected nothing after the closing ] of the list";
  return "";
}

std::string wrong_with_header(const std::string& code) {
  const auto open = code.find_first_not_of('['), close = code.find(']');
  if (open == std::string::npos) return "expected the name of a table between the brackets";
  const std::string name = trimmed_line(code.substr(open, close == std::string::npos ? close : close - open));
  const auto closing = static_cast<std::size_t>(std::count(code.begin(), code.end(), ']'));
  if (open != closing || open > 2)
    return fmt::format(
        "expected as many closing brackets as opening ones: [{0}] for a table, [[{0}]] for one of several", name);
  if (name.empty()) return "expected the name of a table between the brackets";
  if (name.find(' ') != std::string::npos) return "expected one word between the brackets, without blanks";
  const std::string rest = trimmed_line(code.substr(code.rfind(']') + 1));
  if (!rest.empty()) return "expected nothing after the closing bracket; keys go on lines of their own";
  return "";
}

std::string wrong_with_line(const BareLine& line) {
  const std::string code = trimmed_line(line.code);
  if (code.starts_with("<<<<<<<") || code.starts_with("=======") || code.starts_with(">>>>>>>"))
    return "this line was left by a merge of two versions; expected one of them, without such lines";
  if (line.open)
    return line_matches(code, R"(=\s*[A-Za-z])")
               ? "expected the whole text in quotes"
               : "the text has no closing quote; expected one at its end, on the same line";
  if (code.starts_with("//") || code.starts_with(";") || code.starts_with("/*") || code.starts_with("--") ||
      code.starts_with("%") || code.starts_with("!"))
    return "expected comments to begin with #";
  const bool brace = code.starts_with("{");
  const std::size_t equals = code.find('=');
  if (code.starts_with("[") && (equals == std::string::npos || code.find(']') < equals)) return wrong_with_header(code);
  if (brace) return "the file looks like JSON; expected TOML: lines of KEY = VALUE below [TABLE]";
  if (equals == std::string::npos) {
    if (const std::size_t colon = code.find(':'); colon != std::string::npos)
      return fmt::format("expected = in place of the colon: {} = ...", trimmed_line(code.substr(0, colon)));
    return "the line contains no =; expected KEY = VALUE, [TABLE] or a comment that begins with #";
  }
  const std::string key = trimmed_line(code.substr(0, equals)), value = trimmed_line(code.substr(equals + 1));
  if (key.empty()) return "expected the name of a key before the =";
  if (key.back() == ':' || key.back() == '+') return "expected a single = between key and value";
  if (!line_matches(key, R"(^[A-Za-z0-9_."-]+$)"))
    return fmt::format("expected the name of a key alone before the =, one word without unit or index, got '{}'", key);
  if (value.starts_with("(") || (value.starts_with("{") && value.find('=') == std::string::npos && value.size() > 1))
    return "expected a list in square brackets: [1, 2, 3]";
  if (value.starts_with("<")) return "expected a list in square brackets: [1, 2, 3]";
  if (value.starts_with("{")) {
    if (value.find('}') == std::string::npos)
      return "a table in braces must end on the same line; expected } there, or a table [NAME] with lines of its own";
    if (line_matches(value, R"(,\s*\})")) return "expected no comma before the closing }";
    if (value.find(':') != std::string::npos) return "expected = in place of the colon";
    return "";
  }
  if (value.starts_with("[")) return wrong_with_list(value);
  if (line_matches(value, R"(^[-+]?[\d.]+([eE][-+]?\d+)?\s*,(\s+[-+]?[\d.]|\s*[-+]?[\d.]+([eE][-+]?\d+)?\s*,))"))
    return "expected a list in square brackets: [1, 2, 3]";
  return wrong_with_value(value);
}

/// A list or braces that are still open when the next key or table begins, at or before the line where the parser
/// stumbled.
std::optional<TomlError> open_list(const std::vector<BareLine>& lines, int stumbled) {
  int depth = 0, opened = 0;
  const int seen = std::min(stumbled + 1, static_cast<int>(lines.size()));
  const auto fault = [&] {
    return TomlError{opened, "the list that begins here has no closing ]; expected as many ] as ["};
  };
  for (int i = 0; i < seen; ++i) {
    const std::string code = trimmed_line(lines[i].code);
    const bool begins = !lines[i].inside && (line_matches(code, R"(^[A-Za-z0-9_."-]+\s*=)") ||
                                             line_matches(code, R"(^\[\[?[A-Za-z][A-Za-z0-9_.]*\]\]?$)"));
    if (depth > 0 && begins) return fault();
    if (begins && i < stumbled && line_matches(code, R"(=\s*\{[^}]*$)"))
      return TomlError{i + 1, wrong_with_line(lines[i])};
    if (depth > 0 || (begins && !code.starts_with("[")))
      for (const char c : code) {
        if (c == '[' && depth++ == 0) opened = i + 1;
        if (c == ']') depth -= depth > 0;
      }
  }
  if (depth > 0 && seen == static_cast<int>(lines.size())) return fault();
  return std::nullopt;
}

/// A duplicate key or header, with the line of its first definition.
std::optional<TomlError> standing_twice(const std::vector<BareLine>& lines, int line, std::string_view description) {
  if (description.find("redefine") == std::string_view::npos || line < 1 || line > static_cast<int>(lines.size()))
    return std::nullopt;
  const std::string code = trimmed_line(lines[line - 1].code);
  const bool header = code.starts_with("[");
  const auto name_in = [](const std::string& text) {
    if (text.starts_with("[")) {
      const auto open = text.find_first_not_of("[ "), close = text.find_first_of(" ]", open);
      return open == std::string::npos ? "" : text.substr(open, close - open);
    }
    return trimmed_line(text.substr(0, text.find('=')));
  };
  const std::string name = name_in(code);
  for (int i = line - 2; i >= 0; --i) {
    const std::string above = trimmed_line(lines[i].code);
    if (above.starts_with("[") != header) {
      if (!header) break;  // another table
      continue;
    }
    if (name_in(above) != name) continue;
    if (!header)
      return TomlError{
          line, fmt::format("{} is defined twice in this table, first in line {}; expected it once", name, i + 1)};
    return TomlError{
        line, fmt::format("the table {} is defined twice, first as {} in line {}; expected all its keys below one "
                          "[{}], or [[{}]] each time where there are several",
                          name, above, i + 1, name, name)};
  }
  return TomlError{line, fmt::format("{} is already defined in another notation; expected it once", name)};
}

}  // namespace

std::optional<TomlError> too_deep_key(std::string_view text) {
  constexpr int most = 30;  // toml++ nests values up to 256 deep, each with such a key
  int line = 0;
  for (const BareLine& bare : bare_lines(text)) {
    ++line;
    int dots = 0;
    for (const char c : bare.code) {
      dots = c == '.' ? dots + 1 : std::string_view(",[]{}=").find(c) == std::string_view::npos ? dots : 0;
      if (dots > most) return TomlError{line, fmt::format("expected keys of at most {} parts", most)};
    }
  }
  return std::nullopt;
}

TomlError diagnose_toml(std::string_view text, int line, std::string_view description) {
  const std::vector<BareLine> lines = bare_lines(text);
  const auto with_line = [&](TomlError fault) {
    const std::string& shown = lines[std::clamp(fault.line - 1, 0, static_cast<int>(lines.size()) - 1)].shown;
    std::string printable;
    for (const char c : shown.substr(0, 80)) printable += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    while (!printable.empty() && shown.size() > 80 && static_cast<unsigned char>(printable.back()) >= 128)
      printable.pop_back();
    return TomlError{fault.line,
                     fmt::format("{}; the line is: {}{}", fault.what, printable, shown.size() > 80 ? "..." : "")};
  };
  if (const auto strange = strange_characters(text))
    return strange->what.find("UTF-") == std::string::npos ? with_line(*strange) : *strange;
  if (const auto again = standing_twice(lines, line, description)) return with_line(*again);
  // an unclosed text is reported where it begins
  for (int i = 0; i < std::min(line, static_cast<int>(lines.size())); ++i)
    if (lines[i].open) return with_line({i + 1, wrong_with_line(lines[i])});
  if (const auto list = open_list(lines, line)) return with_line(*list);
  if (lines[std::clamp(line - 1, 0, static_cast<int>(lines.size()) - 1)].inside || lines.back().inside)
    for (int i = static_cast<int>(lines.size()); i-- > 0;)
      if (!lines[i].inside && lines[i].code.find("___") != std::string::npos)
        return with_line(
            {i + 1, "the text of several lines that begins here has no closing quotes; expected the same three again"});
  for (const int at : {line, line - 1})
    if (at >= 1 && at <= static_cast<int>(lines.size()) && !trimmed_line(lines[at - 1].code).empty())
      if (const std::string wrong = wrong_with_line(lines[at - 1]); !wrong.empty()) return with_line({at, wrong});
  return with_line({line, std::string(description)});
}

}  // namespace crosscheck
