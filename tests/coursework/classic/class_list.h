// The classes of a program that may take each role, in the order in which they are tried.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/coursework/classic/source_scan.h"

namespace coursework::classic {

/// A role that a class can take in the tests of a part. The chain is tested with the pendulum.
struct Role {
  std::string_view name;                // in grade.toml
  std::string_view part;                // part whose program calls the class
  bool stepper;                         // true: a time stepper; false: a particle system
  std::vector<std::string_view> names;  // known class names
};
const std::vector<Role>& roles();
const Role& role_of(std::string_view name);
std::span<const std::string_view> role_names();

/// All classes of a program: from the student's headers, from the student's sources, and from our replacements of files
/// that the course provides.
class ClassList {
 public:
  explicit ClassList(std::vector<ClassInfo> all) : all_(std::move(all)) {}

  const ClassInfo& at(int i) const { return all_[static_cast<std::size_t>(i)]; }
  struct Candidate {
    int of;
    bool named;   // it has the role's name, or the student's grade.toml names it: it takes the role even if it is wrong
    bool likely;  // it is named, or has the name of the other role that is tested with this one
  };
  /// Candidates in the order of trial: the class that `wanted` (role -> class) names, alone; otherwise the classes with
  /// the role's name, and then all others of the kind that do not have the name of another role.
  std::vector<Candidate> candidates(const Role& role, const std::map<std::string, std::string>& wanted) const;
  /// The effective class of this name; null if none.
  const ClassInfo* named(std::string_view name) const;
  /// True if the class derives from TimeStepper (`stepper`) or from ParticleSystem.
  bool is_kind(int i, bool stepper) const;
  int size() const { return static_cast<int>(all_.size()); }

 private:
  std::vector<ClassInfo> all_;
};

}  // namespace coursework::classic
