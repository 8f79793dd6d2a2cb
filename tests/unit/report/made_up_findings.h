#pragma once

#include <gtest/gtest.h>

#include <sstream>

#include "mysim/base/text.h"
#include "report/findings/findings.h"

namespace crosscheck::testing_tools {

inline size_t words_in(const std::string& sentence) {
  std::istringstream in(sentence);
  return static_cast<size_t>(std::distance(std::istream_iterator<std::string>(in), {}));
}

inline int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// An artificial finding with the rule's first text, and `word` for every placeholder.
inline Finding made_up(const FindingRule& rule, const std::string& word) {
  Finding f{.rule = std::string(rule.key),
            .scene = word,
            .method = "mysim/rk4",
            .other = "bullet/pbd",
            .value = 5e-3,
            .low = 4e-3,
            .high = 6e-3,
            .tier = "converged"};
  for (const auto& [key, text] : finding_texts())
    if (!finding_texts().contains(f.rule) && key.starts_with(f.rule + ".")) f.rule = key;
  for (const std::string& name : split(rule.words, ' ')) f.words[name] = word;
  return f;
}

inline const FindingRule& rule_of_chapter(std::string_view chapter, bool is_answer) {
  for (const FindingRule& rule : finding_rules())
    if (rule.chapter == chapter && (rule.topic == "answer") == is_answer) return rule;
  throw std::out_of_range("no rule of that chapter");
}

inline std::vector<Finding> of_rule(const std::vector<Finding>& findings, std::string_view rule) {
  std::vector<Finding> found;
  for (const Finding& f : findings)
    if (f.rule == rule) found.push_back(f);
  return found;
}
/// Returns the only finding of a rule. Fails and returns an empty finding if there is not exactly one.
inline Finding the(const std::vector<Finding>& findings, std::string_view rule) {
  const std::vector<Finding> found = of_rule(findings, rule);
  EXPECT_EQ(found.size(), 1u) << rule;
  return found.size() == 1 ? found[0] : Finding{};
}
inline std::vector<std::string> rules_of(const std::vector<Finding>& findings) {
  std::vector<std::string> rules;
  for (const Finding& f : findings) rules.push_back(f.rule);
  return rules;
}

/// Expects that every sentence has at most 30 words, a full stop and a tier, and that no placeholder is left.
inline void expect_short(const std::vector<Finding>& findings) {
  for (const Finding& f : findings) {
    const std::string sentence = sentence_of(f);
    EXPECT_LE(words_in(sentence), 30u) << sentence;
    EXPECT_TRUE(sentence.ends_with('.')) << sentence;
    EXPECT_FALSE(tier_of(f).empty()) << sentence;
  }
}

}  // namespace crosscheck::testing_tools
