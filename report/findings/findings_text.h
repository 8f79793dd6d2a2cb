// Words and numbers that findings share.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "report/findings/report_data.h"

namespace crosscheck {

// the methods that stand for the subject and for its peer
inline const std::string ours(subject().representative),
    sticky_sphere = sticky_method(),
    theirs(std::ranges::find_if(method_families(), &MethodFamily::is_default_peer)->representative);

/// The peer's position-based method.
inline const std::string& position_based() {
  static const std::string name = [] {
    for (const Method& m : all_methods())
      if (m.position_based && m.family().is_default_peer()) return m.name;
    return std::string();
  }();
  return name;
}

inline std::string percent(double part, double whole) {
  const double value = 100 * part / whole;
  if (value < 1e-4) return nice(value) + " %";
  return value < 99.5 ? fmt::format("{:.2g} %", value) : fmt::format("{:.0f} %", value);
}

/// "100 000"
inline std::string count_text(long count) {
  std::string text = std::to_string(count);
  for (size_t at = text.size(); at > 3 && text.size() > 4; at -= 3) text.insert(at - 3, " ");
  return text;
}

/// How many times as much: two digits, written plainly ("160", "2.4").
inline std::string times_text(double factor) {
  if (!(factor >= 100)) return fmt::format("{:.2g}", factor);
  const double unit = std::pow(10, std::floor(std::log10(factor)) - 1);
  return fmt::format("{:.0f}", std::round(factor / unit) * unit);
}

inline std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (size_t i = 0; i < words.size(); ++i) out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return out;
}

/// "0.12 % to 66 %", or one of them where both read the same.
inline std::string range(const std::string& low, const std::string& high) {
  return low == high ? low : low + " to " + high;
}

/// True where no contact, no other law and no chaos excuses it: the same rule, more than round-off apart.
inline bool same_rule_differs(const SceneData& facts) {
  const MethodData* b = facts.find(theirs);
  return b && b->ok() && b->difference && !facts.touched() && b->different_law.empty() && facts.round_off &&
         *b->difference > *facts.round_off;
}

inline std::string growth_text(double growth) {
  return growth < 2 ? "a perturbation hardly grows" : fmt::format("a perturbation grows {}-fold", nice(growth));
}

}  // namespace crosscheck
