#include "words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <set>
#include <vector>

#include "layout.h"
#include "seen.h"

namespace coursework {

std::string with_digits(double value, int digits) {
  if (std::isnan(value)) return "nan";  // nan and zero are written without a sign
  if (value == 0) return "0";
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

namespace {

std::string count_text(double value) { return std::to_string(static_cast<long>(std::round(value))); }

/// The items of "(x, y, z)".
std::vector<std::string> listed(const std::string& text) {
  std::vector<std::string> names(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, ", ") == 0) {
      names.emplace_back();
      ++i;
    } else {
      names.back() += text[i];
    }
  }
  return names;
}

/// Place of the first difference, such as "step 3, velocity[1]"; the index is omitted if there is only one row.
std::string place(const Texts& common, const Texts& own, const Case& what, const Judged& judged) {
  const std::size_t columns = static_cast<std::size_t>(what.columns > 0 ? what.columns : 1);
  const std::string column = column_text(own, what, judged.column);
  if (what.expected.size() <= columns) return column;
  // rows are counted from 0, as in code, unless the texts specify another start: the first step is step 1
  const std::string first = "row." + what.row + ".first";
  const int row = judged.row + (own.has(first) ? std::atoi(own.of(first).c_str()) : 0);
  return common.fill("place", name_text(own, "row.", what.row), std::to_string(row), column);
}

/// Keys of the texts, in the order of the enumerators of How.
constexpr const char* how_keys[] = {"answered",    "threw",    "unusable",      "crashed",         "recursion",
                                    "out_of_time", "waiting",  "out_of_memory", "too_much_output", "too_much_answered",
                                    "undecided",   "no_token", "not_compiled",  "missing"};
static_assert(std::size(how_keys) == static_cast<std::size_t>(How::missing) + 1);

std::string count_text(const Answer& answer, std::size_t i) {
  return i < answer.counts.size() ? std::to_string(answer.counts[i].second) : "?";
}

std::string ending(const Texts& common, const Answer& answer) {
  if (answer.how == How::unusable)
    return common.fill("how.unusable", common.fill(common.has("unusable." + answer.detail) ? "unusable." + answer.detail
                                                                                           : "unusable.other",
                                                   count_text(answer, 0), count_text(answer, 1)));
  if (answer.how == How::threw) {
    if (answer.detail == "Resource temporarily unavailable") return common.of("how.threads");
    std::size_t index = 0, size = 0;  // as printed by libstdc++
    for (const char* form : {"vector::_M_range_check: __n (which is %zu) >= this->size() (which is %zu)",
                             "array::at: __n (which is %zu) >= _Nm (which is %zu)"})
      if (std::sscanf(answer.detail.c_str(), form, &index, &size) == 2)
        return common.fill("how.threw_index", std::to_string(static_cast<std::ptrdiff_t>(index)), std::to_string(size));
  }
  if (answer.how == How::crashed)
    return common.fill("how.crashed", name_text(common, "signal.", answer.detail)) + " " + common.of("crash.guess");
  if (answer.how != How::out_of_time)
    return common.fill(std::string("how.") + how_keys[static_cast<std::size_t>(answer.how)], answer.detail);
  std::string text = common.fill("how.out_of_time", answer.detail, with_digits(answer.reference, 2));
  std::string others;
  for (std::size_t i = 0; i + 1 < answer.counts.size(); ++i)
    others += (others.empty() ? "" : ", ") + answer.counts[i].first + " " + count_text(answer, i);
  if (!answer.counts.empty())
    text += " " + common.fill("slow.where", answer.counts.back().first, count_text(answer, answer.counts.size() - 1));
  if (!others.empty()) text += " " + common.fill("slow.others", others);
  return text + " " + common.of("slow.then");
}

}  // namespace

std::string number_text(double value, double other) {
  int digits = 6;
  while (digits < 17 && value != other && with_digits(value, digits) == with_digits(other, digits)) ++digits;
  // the digit that differs may be due to rounding: one more digit shows the size of the difference
  return with_digits(value, digits == 6 || digits == 17 ? digits : digits + 1);
}

std::string name_text(const Texts& own, const std::string& kind, const std::string& word) {
  return own.has(kind + word) ? own.of(kind + word) : word;
}

std::string column_text(const Texts& own, const Case& what, int column) {
  const std::string text = name_text(own, "column.", what.column);
  if (what.columns <= 1 || column < 0) return text;
  const std::string numbered = text + "[" + std::to_string(column) + "]";
  const std::size_t open = text.find('('), close = text.rfind(')');
  if (open == std::string::npos || close == std::string::npos || close < open) return numbered;
  const std::vector<std::string> names = listed(text.substr(open + 1, close - open - 1));
  const std::size_t count = names.size(), all = static_cast<std::size_t>(what.columns),
                    at = static_cast<std::size_t>(column);
  std::string around = text.substr(0, open) + names[at % count] + text.substr(close + 1);
  const std::size_t mark = around.find('#');
  if (mark != std::string::npos && all % count == 0) return around.replace(mark, 1, std::to_string(at / count));
  return count == all && text.size() == close - open + 1 ? names[at] : numbered;
}

bool has_layout(const Texts& own, const Case& what) { return own.has(layout_key(own, what)); }

std::string given_text(const Texts& common, const Texts& own, const Case& what, const Judged& judged,
                       std::size_t most) {
  const CallLayout layout = CallLayout::of(own, what, judged.row);
  if (!layout.fits) return "";
  std::string given;
  std::size_t shown = 0;
  for (const Field& field : layout.fields) {
    if (field.other) continue;
    std::string list;
    for (std::size_t i = 0; i < field.size(); ++i)
      list += (i == 0 ? "" : i % field.columns == 0 ? "; " : ", ") + with_digits(what.in[field.begin + i], 6);
    given += (given.empty() ? "" : ", ") + field.name;
    if (field.item >= 0) given += "[" + std::to_string(field.item) + "]";
    given += " = " + (field.size() == 1 ? list : "(" + list + ")");
    shown += field.size();
  }
  if (given.empty() || shown > most) return "";
  const std::string& text = own.of(layout_key(own, what));
  const std::size_t bar = text.find('|');
  const std::string sentence = bar == 0 ? "" : text.substr(0, text.find_last_not_of(' ', bar - 1) + 1);
  return sentence + (sentence.empty() ? "" : " ") + common.fill("given", given);
}

std::string hint_text(const Texts& common, const Texts& own, const std::string& test,
                      const std::string& failed_before) {
  if (!failed_before.empty()) return common.fill("first", failed_before);
  return own.has(test + ".hint") ? common.fill("hint", own.of(test + ".hint")) : "";
}

std::string factors_text(const Texts& common, const std::vector<Case>& cases, const std::vector<Answer>& answers) {
  std::string list;
  for (std::size_t i = 0; i < cases.size() && i < answers.size(); ++i) {
    const Answer& answer = answers[i];
    if (cases[i].expected.size() != 1 || cases[i].tolerance > 1e-4 * std::abs(cases[i].expected[0])) return "";
    if (answer.how != How::answered || answer.got.size() != 1 || !std::isfinite(answer.got[0])) return "";
    const std::string factor = with_digits(answer.got[0] / cases[i].expected[0], 6);
    list += (list.empty() ? "" : ", ") + std::to_string(i + 1) + ": " + factor;
  }
  return cases.size() > 1 ? common.fill("factors", list) : "";
}

std::string function_of(const Texts& own, const std::string& part, const Case& what) {
  return own.has("function." + what.call) ? own.of("function." + what.call) : part;
}

std::vector<std::size_t> angles_in(const Texts& own, const Case& what) {
  std::vector<std::size_t> angles;
  const CallLayout layout = CallLayout::of(own, what);
  for (const Field& field : layout.fields)
    if (layout.fits && field.angle) angles.push_back(field.begin);
  return angles;
}

namespace {

/// The first rows of `some` that are not in `others`, as "(0, 3), (2, 5)".
std::string rows_without(const Numbers& some, const Numbers& others, std::size_t columns) {
  std::multiset<Numbers> rest;
  const auto row = [&](const Numbers& all, std::size_t at) {
    return Numbers(all.begin() + static_cast<std::ptrdiff_t>(at),
                   all.begin() + static_cast<std::ptrdiff_t>(at + columns));
  };
  for (std::size_t at = 0; at + columns <= others.size(); at += columns) rest.insert(row(others, at));
  std::string text;
  int more = 0;
  for (std::size_t at = 0; at + columns <= some.size(); at += columns) {
    const Numbers one = row(some, at);
    if (const auto same = rest.find(one); same != rest.end()) {
      rest.erase(same);
      continue;
    }
    if (++more > 3) continue;
    text += text.empty() ? "(" : ", (";
    for (std::size_t k = 0; k < columns; ++k) text += (k ? ", " : "") + with_digits(one[k], 6);
    text += ")";
  }
  return more > 3 ? text + ", ..." : text;
}

/// For rows in any order, a missing or surplus row is more informative than the first number that differs.
std::string as_set(const Texts& common, const Texts& own, const Case& what, const Answer& answer) {
  const std::string key = "set." + what.row;
  if (!own.has(key) || what.columns < 1) return "";
  const std::size_t columns = static_cast<std::size_t>(what.columns);
  const std::string missing = rows_without(what.expected, answer.got, columns),
                    extra = rows_without(answer.got, what.expected, columns);
  std::string text;
  if (!missing.empty()) text += " " + common.fill("set.missing", own.of(key), missing);
  if (!extra.empty()) text += " " + common.fill("set.extra", own.of(key), extra);
  return text;
}

}  // namespace

std::string words(const Texts& common, const Texts& own, const Case& what, const Answer& answer, const Judged& judged) {
  if (judged.right) return "";
  if (judged.how != How::answered) return ending(common, answer);
  if (judged.wrong_size) {
    std::string text = common.fill("size", count_text(judged.expected), count_text(judged.got));
    const auto columns = static_cast<double>(what.columns);
    if (columns > 1 && std::fmod(judged.got, columns) == 0)
      text += " " + common.fill("size.rows", count_text(judged.expected / columns), count_text(judged.got / columns),
                                name_text(own, "row.", what.row));
    return text + as_set(common, own, what, answer);
  }
  std::string legend;
  for (const std::string& key : {"row." + what.row + ".legend", "column." + what.column + ".legend"})
    if (own.has(key)) legend += " " + own.of(key);
  if (judged.of > 0 && !judged.not_finite)
    return common.fill("counted", place(common, own, what, judged), count_text(judged.expected * judged.of),
                       count_text(judged.got * judged.of)) +
           legend;
  if (!judged.not_finite)
    if (const std::string set = as_set(common, own, what, answer); !set.empty()) return set.substr(1);
  return common.fill(judged.not_finite ? "not_finite" : "differs", place(common, own, what, judged),
                     number_text(judged.expected, judged.got), number_text(judged.got, judged.expected)) +
         legend;
}

namespace {

/// Number of columns that a text occupies in a monospaced font; a Chinese character occupies two.
std::size_t columns_of(const std::string& text) {
  std::size_t columns = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0) != 0x80) columns += byte >= 0xe0 ? 2 : 1;  // lead byte of a UTF-8 character
  }
  return columns;
}

std::string blanks(std::size_t columns, const std::string& text) {
  return std::string(columns > columns_of(text) ? columns - columns_of(text) : 0, ' ');
}

/// A number with six digits. It becomes 0 if it is negligible compared with the largest.
std::string plain(double value, double largest) { return with_digits(std::abs(value) < 1e-9 * largest ? 0 : value, 6); }

}  // namespace

std::string table_text(const Texts& common, const Texts& own, const Case& what, const Answer& answer) {
  constexpr std::size_t most = 6;
  const std::size_t all = what.expected.size(), columns = static_cast<std::size_t>(what.columns > 0 ? what.columns : 1);
  if (answer.how != How::answered || answer.got.size() != all || all < 2 || !answer.of.empty()) return "";
  if (own.has("set." + what.row)) return "";
  const auto is_right = [&](std::size_t i) { return std::abs(answer.got[i] - what.expected[i]) <= what.tolerance; };
  double largest = 0;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < all; ++i) {
    largest = std::max(largest, std::abs(what.expected[i]));
    if (all <= most || !is_right(i)) shown.push_back(i);
  }
  if (shown.empty() || shown.size() > most) return "";
  std::vector<std::array<std::string, 3>> lines{{"", common.of("table.expected"), common.of("table.got")}};
  for (const std::size_t i : shown) {
    Judged at;
    at.row = static_cast<int>(i / columns), at.column = static_cast<int>(i % columns);
    const double expected = what.expected[i], got = answer.got[i];
    const std::string right = is_right(i) ? plain(expected, largest) : number_text(expected, got);
    lines.push_back({place(common, own, what, at), right, is_right(i) ? right : number_text(got, expected)});
  }
  std::array<std::size_t, 3> widths{};
  for (const auto& line : lines)
    for (std::size_t k = 0; k < 3; ++k) widths[k] = std::max(widths[k], columns_of(line[k]));
  std::string text;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    text += (n ? "\n  " : "  ") + lines[n][0] + blanks(widths[0], lines[n][0]);
    for (const std::size_t k : {1, 2}) text += "  " + blanks(widths[k], lines[n][k]) + lines[n][k];
    if (n > 0 && !is_right(shown[n - 1])) text += "  " + common.of("table.differs");
  }
  return text + (all > most ? "\n  " + common.fill("table.rest", std::to_string(all - shown.size())) : "");
}

bool is_of_table(const std::string& line) { return line.compare(0, 2, "  ") == 0; }

std::string smaller_text(const Texts& common, const Texts& own, const std::vector<Case>& small,
                         const std::vector<Answer>& answers) {
  for (std::size_t i = 0; i < small.size() && i < answers.size(); ++i) {
    const Judged judged = judge(small[i], answers[i]);
    if (judged.right) continue;
    if (ungraded(answers[i].how)) return "";
    std::string text = common.fill("smaller", words(common, own, small[i], answers[i], judged),
                                   given_text(common, own, small[i], judged, 80));
    for (const std::string& more : {table_text(common, own, small[i], answers[i]),
                                    seen_text(common, own, small[i], answers[i], others_of(small[i], small, answers))})
      if (!more.empty()) text += "\n" + more;
    return text;
  }
  return "";
}

}  // namespace coursework
