#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

/// Reads the texts of a file. Skips the lines before the first key, which are notes for editors.
void read_texts(const std::string& file, std::map<std::string, FindingText>& texts) {
  FindingText* text = nullptr;
  int number = 0;
  for (const std::string& line : split(asset(file), '\n')) {
    ++number;
    const auto fail = [&](const char* expected) {
      throw std::runtime_error(fmt::format("{}:{}: expected {}", file, number, expected));
    };
    if (line.starts_with("## ")) {
      const auto [at, is_new] = texts.try_emplace(line.substr(3));
      if (!is_new) fail("a key that no other text has");
      text = &at->second;
    } else if (text && line.starts_with("Formula: ")) {
      if (text->sentence.empty() || !text->formula.empty()) fail("a sentence, then one formula");
      text->formula = line.substr(9);
    } else if (text && !line.empty()) {
      if (!text->formula.empty()) fail("nothing after the formula of a text");
      text->sentence += (text->sentence.empty() ? "" : " ") + line;
    }
  }
}

std::string number_text(double value) {
  if (value == std::round(value) && std::abs(value) < 1e6) return count_text(std::lround(value));
  return std::abs(value) < 1e4 ? times_text(value) : nice(value);
}

std::string in_unit(double value, std::string_view unit) {
  static const std::pair<std::string_view, std::string (*)(double)> forms[] = {
      {"m", nice_length},
      {"s", step_text},
      {"%", [](double v) { return percent(v, 100); }},
      {"m/s", [](double v) { return nice(1e3 * v) + " mm/s"; }},
      {"1/s", [](double v) { return fmt::format("{:.2g} per second", v); }},
      {"degrees", [](double v) { return fmt::format("{:.2g} degrees", v); }},
      {"1", number_text}};
  for (const auto& [name, form] : forms)
    if (name == unit) return form(value);
  throw std::logic_error("no form for the unit " + std::string(unit));
}

std::string filled_word(const Finding& f, const std::string& name) {
  const std::string_view unit = finding_rule(f.rule).unit;
  if (name == "scene") return f.scene;
  if (name == "method") return name_in_sentence(f.method);
  if (name == "other") return name_in_sentence(f.other);
  if (name == "value") return in_unit(f.value, unit);
  if (name == "low" && f.low) return in_unit(*f.low, unit);
  if (name == "high" && f.high) return in_unit(*f.high, unit);
  if (name == "range" && f.low && f.high) return range(in_unit(*f.low, unit), in_unit(*f.high, unit));
  if (name == "value±" && f.high) return fmt::format("{:.2f} ± {:.2f}", f.value, *f.high - f.value);
  if (const auto word = f.words.find(name); word != f.words.end()) return word->second;
  throw std::logic_error(fmt::format("a finding of {} lacks {}", f.rule, name));
}

/// Fills in a text without brackets. Sets `complete` to false if a word is empty.
std::string filled_part(const Finding& f, const std::string& text, bool& complete) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const size_t open = std::min(text.find('{', at), text.size());
    out += text.substr(at, open - at);
    if (open == text.size()) break;
    const size_t close = text.find('}', open);
    const std::string word = filled_word(f, text.substr(open + 1, close - open - 1));
    complete &= !word.empty();
    out += word;
    at = close + 1;
  }
  return out;
}

const FindingText& text_of(const Finding& f) {
  const auto found = finding_texts().find(f.rule);
  if (found == finding_texts().end()) throw std::logic_error("no text for findings of " + f.rule);
  return found->second;
}

}  // namespace

const std::map<std::string, FindingText>& finding_texts() {
  static const std::map<std::string, FindingText> texts = [] {
    std::map<std::string, FindingText> all;
    for (const char* file : {"answers", "agreement", "speed", "stability", "energy", "adequacy", "scenes"})
      read_texts(fmt::format("findings/texts/{}.md", file), all);
    return all;
  }();
  return texts;
}

std::string sentence_of(const Finding& f) {
  const std::string& text = text_of(f).sentence;
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const bool optional = text[at] == '[';
    const size_t end = std::min(text.find(optional ? ']' : '[', at), text.size());
    bool complete = true;
    const std::string part = filled_part(f, text.substr(at + optional, end - at - optional), complete);
    if (!optional || complete) out += part;
    at = end + optional;
  }
  return out;
}

std::string sentences_of(const Findings& findings) {
  std::string out;
  for (const Finding& f : findings) out += (out.empty() ? "" : " ") + sentence_of(f);
  return out;
}

std::string tier_of(const Finding& f) { return f.tier.empty() ? std::string(finding_rule(f.rule).tier) : f.tier; }

Json json_of(const Finding& f) {
  const FindingRule& rule = finding_rule(f.rule);
  return {{"scene", f.scene},
          {"topic", rule.topic},
          {"sentence", sentence_of(f)},
          {"tier", tier_of(f)},
          {"method", f.method},
          {"other_method", f.other},
          {"quantity", rule.quantity},
          {"value", f.value},
          {"unit", rule.unit},
          {"low", f.low ? Json(*f.low) : Json()},
          {"high", f.high ? Json(*f.high) : Json()},
          {"chapter", rule.chapter},
          {"rule", f.rule},
          {"formula", text_of(f).formula}};
}

}  // namespace crosscheck
