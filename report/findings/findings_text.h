// Names, numbers and lists as findings write them.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "report/findings/report_data.h"

namespace crosscheck {

// the methods that stand for the subject and for the first of its peers
inline const std::string ours(subject().representative), sticky_sphere = sticky_method(),
                                                         theirs(default_peers().front()->representative);

/// A peer's position-based method, or an empty name.
std::string position_based(const MethodFamily& peer = *default_peers().front());

/// The methods that stand for the engines, and the peers' position-based ones, which differ from them.
std::vector<std::string> representatives();
/// The same with the sticky sphere, for scenes with contact.
std::vector<std::string> representatives_in_contact();

/// Whether findings speak of the method by name where they speak of a few: it stands for its engine, or is a program of
/// the reader's.
bool stands_for_its_engine(const std::string& method);
/// Whether it belongs to another engine than mysim, and is no truth.
bool is_another_engine(const std::string& method);
/// The same without others' integrators on our right-hand side.
bool is_rival(const std::string& method);
/// True if it stands for another engine by a rule that is not position-based, so that its motion may be the same.
bool may_move_alike(const std::string& method);
inline bool is_implicit(const Stepper& s) { return s.evaluations == 0; }
inline bool never_stable_undamped(const Stepper& s) { return s.order == 1 && s.limit(1, 0) == 0; }
inline bool is_symplectic_of_second_order(const Stepper& s) { return s.symplectic && s.order == 2 && !is_implicit(s); }

/// A method or an engine: "leapfrog", "Bullet's pbd", "Bullet", "odeint/dopri5", and of programs the base name.
std::string name_in_sentence(const std::string& name);
std::vector<std::string> names_in_sentence(const std::vector<std::string>& names);

std::string percent(double part, double whole);
/// "100 000"
std::string count_text(long count);
/// "1 scene", "8 scenes"
inline std::string counted(size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}
/// "4 iterations"; of mysim's xpbd "4 sub-steps", of one pass each.
inline std::string passes_text(const std::string& method, long n) {
  return counted(static_cast<size_t>(n), family_of(method).is_subject() ? "sub-step" : "iteration");
}
/// How many times as much: two digits, written plainly ("160", "2.4").
std::string times_text(double factor);
/// "a, b and c"
std::string joined(const std::vector<std::string>& words);
/// The same, of more than `most` the first ones and "2 more".
std::string listed(std::vector<std::string> words, size_t most = 3);
/// "0.12 % to 66 %", or one of them where both read the same.
inline std::string range(const std::string& low, const std::string& high) {
  return low == high ? low : low + " to " + high;
}

/// Appends a word that is not there yet.
void add_once(std::vector<std::string>& words, const std::string& word);

/// True where no contact, no other law and no chaos excuses it: a method of the same rule, more than round-off apart.
bool same_rule_differs(const SceneData& data, const MethodData& method);

}  // namespace crosscheck
