// The roles, and the class names that are known for them.
#include "tests/coursework/classic/class_list.h"

#include <algorithm>
#include <set>

namespace coursework::classic {

const std::vector<Role>& roles() {
  static const std::vector<Role> all = {
      {"euler", "euler", true, {"ForwardEuler", "Euler", "ExplicitEuler", "EulerStepper"}},
      {"trapezoidal", "trapezoidal", true, {"Trapzoidal", "Trapezoidal", "Trapezoid", "TrapezoidalRule"}},
      {"simple", "simple", false, {"SimpleSystem"}},
      {"cloth", "cloth", false, {"ClothSystem", "Cloth"}},
      {"pendulum", "pendulum", false, {"PendulumSystem", "Pendulum", "SimplePendulum"}},
      {"chain", "pendulum", false, {"ChainSystem", "ParticleChain", "PendulumChain", "ChainPendulum"}},
  };
  return all;
}

std::span<const std::string_view> role_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const Role& role : roles()) all.push_back(role.name);
    return all;
  }();
  return names;
}

const Role& role_of(std::string_view name) {
  return *std::find_if(roles().begin(), roles().end(), [&](const Role& role) { return role.name == name; });
}

namespace {

bool same_name(std::string_view a, std::string_view b) { return lower(std::string(a)) == lower(std::string(b)); }

/// The role with this name; null if none.
const Role* named_role(const std::string& name) {
  for (const Role& role : roles())
    for (const std::string_view known : role.names)
      if (same_name(known, name)) return &role;
  return nullptr;
}

}  // namespace

bool ClassList::is_kind(int i, bool stepper) const {
  std::vector<std::string> open = at(i).bases;
  std::set<std::string> seen;
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    if (same_name(name, stepper ? "TimeStepper" : "ParticleSystem")) return true;
    if (!seen.insert(name).second) continue;
    for (const ClassInfo& one : all_)
      if (one.name == name) open.insert(open.end(), one.bases.begin(), one.bases.end());
  }
  return false;
}

std::vector<ClassList::Candidate> ClassList::candidates(const Role& role,
                                                        const std::map<std::string, std::string>& wanted) const {
  if (const auto says = wanted.find(std::string(role.name)); says != wanted.end())
    for (int i = 0; i < size(); ++i)
      if (at(i).name == says->second || at(i).full() == says->second) return {{i, true, true}};
  std::vector<Candidate> named, partners, others;
  for (const std::string_view name : role.names)
    for (int i = 0; i < size(); ++i)
      if (same_name(at(i).name, name)) named.push_back({i, true, true});
  for (int i = 0; i < size(); ++i) {
    const Role* bears = named_role(at(i).name);
    if (bears == &role || !at(i).usable || !is_kind(i, role.stepper) || same_name(at(i).name, "RK4")) continue;
    // a pendulum of more particles is a chain, and a chain of two is a pendulum
    if (bears && bears->part == role.part) partners.push_back({i, false, true});
    if (!bears) others.push_back({i, false, false});
  }
  named.insert(named.end(), partners.begin(), partners.end());
  named.insert(named.end(), others.begin(), others.end());
  return named;
}

const ClassInfo* ClassList::named(std::string_view name) const {
  const auto found = std::find_if(all_.begin(), all_.end(),
                                  [&](const ClassInfo& one) { return one.usable && same_name(one.name, name); });
  return found == all_.end() ? nullptr : &*found;
}

}  // namespace coursework::classic
