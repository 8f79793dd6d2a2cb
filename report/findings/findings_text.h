#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "report/findings/report_data.h"

namespace crosscheck {

// representatives of the subject and of its first peer
inline const std::string ours(subject().representative), sticky_sphere = sticky_method(),
                                                         theirs(default_peers().front()->representative);

/// The peer's position-based method, or "".
std::string position_based(const MethodFamily& peer = *default_peers().front());

/// Representative methods of all engines, and position-based methods of the peers.
std::vector<std::string> representatives();
/// representatives() and the sticky sphere, for scenes with contact.
std::vector<std::string> representatives_in_contact();

/// True for representatives of engines and for users' programs. Findings that name only a few methods choose from
/// these.
bool stands_for_its_engine(const std::string& method);
/// True for engines other than mysim, but not for truths.
bool is_another_engine(const std::string& method);
/// True if is_another_engine(), except for external integrators of our right-hand side.
bool is_rival(const std::string& method);
/// True for another engine's representative that is not position-based, so that it may move like mysim.
bool may_move_alike(const std::string& method);
inline bool is_implicit(const Stepper& s) { return s.evaluations == 0; }
inline bool never_stable_undamped(const Stepper& s) { return s.order == 1 && s.limit(1, 0) == 0; }
inline bool is_symplectic_of_second_order(const Stepper& s) { return s.symplectic && s.order == 2 && !is_implicit(s); }

/// Names for sentences: "leapfrog", "Bullet's pbd", "Bullet", "odeint/dopri5"; for programs the base name.
std::string name_in_sentence(const std::string& name);
std::vector<std::string> names_in_sentence(const std::vector<std::string>& names);

std::string percent(double part, double whole);
/// "100 000"
std::string count_text(long count);
/// "1 scene", "8 scenes"
inline std::string counted(size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}
/// "4 iterations"; for mysim's xpbd "4 sub-steps" of one pass each.
inline std::string passes_text(const std::string& method, long n) {
  return counted(static_cast<size_t>(n), family_of(method).is_subject() ? "sub-step" : "iteration");
}
/// Two digits without an exponent: "160", "2.4".
std::string times_text(double factor);
/// "a, b and c"
std::string joined(const std::vector<std::string>& words);
/// Lists words. Replaces those after the first `most` by, for instance, "2 more".
std::string listed(std::vector<std::string> words, size_t most = 3);
/// "0.12 % to 66 %", or only one of the values if they are equal.
inline std::string range(const std::string& low, const std::string& high) {
  return low == high ? low : low + " to " + high;
}

void add_once(std::vector<std::string>& words, const std::string& word);

/// True for a method of the same rule whose difference exceeds round-off, and is explained neither by contact, nor by a
/// different force law, nor by chaos.
bool same_rule_differs(const SceneData& data, const MethodData& method);

}  // namespace crosscheck
