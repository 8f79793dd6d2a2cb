#include "report/player/words.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "report/facts.h"
#include "report/figure.h"

namespace crosscheck {
namespace {

/// gnuplot's "(14,4)" as SVG's "14 4".
std::string dashes_of(const MethodStyle& style) {
  if (style.dash == "1") return "";
  std::string dash = style.dash.substr(1, style.dash.size() - 2);
  std::replace(dash.begin(), dash.end(), ',', ' ');
  return dash;
}

/// Why a run failed, without saying again that it did, and when.
std::string why_failed(const Outcome& out) {
  const std::string words(in_words(out.verdict));
  const size_t open = words.find('(');
  std::string why = open == std::string::npos ? "" : words.substr(open + 1, words.size() - open - 2);
  std::string told = out.reason;
  if (told.starts_with("the run failed at"))
    told = told.find(": ") == std::string::npos ? "" : told.substr(told.find(": ") + 2);
  if (!told.empty()) why += (why.empty() ? "" : "; ") + told;
  return why.empty() ? words : why;
}

}  // namespace

Json words_json(const Shown& s) {
  Json json{{"name", s.name}, {"colour", "#555555"}, {"dash", "1 4"}, {"stops", s.t.back()}, {"failed", nullptr},
            {"failure", ""},  {"reason", ""},        {"note", ""},    {"known", !s.answer}};
  json["end"] = s.answer ? "last good frame" : fmt::format("known up to {:.3g} s", s.t.back());
  if (!s.answer) return json;
  const Outcome& out = s.answer->outcome;
  json["colour"] = style_of(s.answer->method).colour;
  json["dash"] = dashes_of(style_of(s.answer->method));
  if (!out.different_law.empty()) json["note"] = fmt::format("{}", fmt::join(out.different_law, "; "));
  if (s.ok()) return json;
  json["failed"] = out.end;
  json["failure"] = fmt::format("{} at {:.3g} s", failure_word(std::string(name_of(out.verdict))), out.end);
  json["reason"] = why_failed(out);
  return json;
}

}  // namespace crosscheck
