#include "tests/coursework/grader/formats/feedback.h"

#include <algorithm>
#include <cstdint>

#include "tests/coursework/grader/text_format.h"

namespace coursework {
namespace {

/// Length of the UTF-8 sequence that begins at i; 0 where none does.
size_t sequence(const std::string& text, size_t i) {
  auto byte = [&](size_t at) { return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u; };
  const unsigned first = byte(i);
  const size_t length = first < 0x80                      ? 1
                        : first >= 0xc2 && first < 0xe0   ? 2
                        : first >= 0xe0 && first < 0xf0   ? 3
                        : first >= 0xf0 && first <= 0xf4u ? 4
                                                          : 0;
  std::uint32_t code = length < 2 ? first : first & (0x7fu >> length);
  for (size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i + k) & 0x3f);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000, never = code == 0xfffe || code == 0xffff;
  return length > 0 && (code < least[length] || code > 0x10ffff || surrogate || never) ? 0 : length;
}

}  // namespace

std::string clean(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size();) {
    const size_t length = sequence(text, i);
    const unsigned char c = static_cast<unsigned char>(text[i]);
    if (length == 0 || (c < 0x20 && c != '\t' && c != '\n') || c == 0x7f)
      out += "\xef\xbf\xbd";
    else
      out.append(text, i, length);
    i += std::max<size_t>(length, 1);
  }
  return out;
}

std::string feedback_on(const Result& result, const TestResult& test, const Texts& common) {
  std::string out;
  for (const std::string& line : lines_on(result, test, common)) out += (out.empty() ? "" : "\n") + line;
  return clean(out);
}

std::string summary_of(const Result& result, const Texts& common) {
  int tests = 0, good = 0, hidden = 0;
  double points = 0, earned = 0;
  for (const TestResult& test : result.tests) {
    if (test.hidden) {
      ++hidden;
      continue;
    }
    ++tests, good += passed(test);
    points += test.points, earned += test.earned;
  }
  std::string out;
  for (const std::string& line : result.preflight) out += line + "\n";
  out += common.fill("total", points_text(earned), points_text(points)) + "\n";
  const std::string later = std::to_string(hidden);
  out += good == tests ? common.fill("public_done", later)
                       : common.fill("public_now", std::to_string(good), std::to_string(tests), later);
  if (!result.complete) out += "\n" + common.of("page.not_done");
  return clean(out);
}

}  // namespace coursework
