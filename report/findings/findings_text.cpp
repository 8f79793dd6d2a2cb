#include "report/findings/findings_text.h"

#include <algorithm>

namespace crosscheck {

std::string position_based(const MethodFamily& peer) {
  for (const Method& m : builtin_methods())
    if (m.position_based && &m.family() == &peer) return m.name;
  return "";
}

std::vector<std::string> representatives() {
  std::vector<std::string> names{ours};
  for (const MethodFamily* peer : default_peers())
    for (const std::string& name : {std::string(peer->representative), position_based(*peer)})
      if (!name.empty() && name != names.back()) names.push_back(name);
  return names;
}

std::vector<std::string> representatives_in_contact() {
  std::vector<std::string> names = representatives();
  names.push_back(sticky_sphere);
  return names;
}

bool stands_for_its_engine(const std::string& method) {
  return family_of(method).role == Role::outside || std::ranges::count(representatives(), method) > 0;
}

bool is_another_engine(const std::string& method) {
  const Role role = family_of(method).role;
  return role != Role::subject && role != Role::truth;
}

bool is_rival(const std::string& method) {
  return is_another_engine(method) && family_of(method).role != Role::integrator;
}

bool may_move_alike(const std::string& method) {
  return is_another_engine(method) && stands_for_its_engine(method) && method != position_based(family_of(method));
}

std::string name_in_sentence(const std::string& name) {
  const MethodFamily& family = family_of(name);
  const bool is_program = name.starts_with(program_prefix);
  const size_t slash = is_program ? name.rfind('/', name.find('+')) : name.find('/');
  if (is_program) return name.substr(slash == std::string::npos ? program_prefix.size() : slash + 1);
  if (slash == std::string::npos) return name == family.name && family.by_default() ? std::string(family.title) : name;
  // the reader sees the name in the literature; commands and tables use the assignment's name
  if (family.is_subject()) return name == "mysim/trapezoidal" ? "Heun" : short_name(name);
  return family.by_default() ? fmt::format("{}'s {}", family.title, name.substr(slash + 1)) : name;
}

std::vector<std::string> names_in_sentence(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  std::ranges::transform(names, std::back_inserter(all), name_in_sentence);
  return all;
}

std::string percent(double part, double whole) {
  const double value = 100 * part / whole;
  if (value < 1e-4) return nice(value) + " %";
  return value < 99.5 ? fmt::format("{:.2g} %", value) : fmt::format("{:.0f} %", value);
}

std::string count_text(long count) {
  std::string text = std::to_string(count);
  for (size_t at = text.size(); at > 3 && text.size() > 4; at -= 3) text.insert(at - 3, " ");
  return text;
}

std::string times_text(double factor) {
  if (!(factor >= 99.5)) return fmt::format("{:.2g}", factor);
  const double unit = std::pow(10, std::floor(std::log10(factor)) - 1);
  return fmt::format("{:.0f}", std::round(factor / unit) * unit);
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (size_t i = 0; i < words.size(); ++i) out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return out;
}

std::string listed(std::vector<std::string> words, size_t most) {
  if (words.size() > most) {
    const size_t left = words.size() - most;
    words.resize(most);
    words.push_back(fmt::format("{} more", left));
  }
  return joined(words);
}

void add_once(std::vector<std::string>& words, const std::string& word) {
  if (std::ranges::find(words, word) == words.end()) words.push_back(word);
}

bool same_rule_differs(const SceneData& data, const MethodData& method) {
  return method.same_rule.value_or(false) && is_another_engine(method.method) && method.ok() && method.difference &&
         !data.touched() && method.different_law.empty() && method.round_off_bound &&
         *method.difference > *method.round_off_bound;
}

}  // namespace crosscheck
