// Which classes of a program may take which role, in the order in which they are tried.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/coursework/classic/source_scan.h"

namespace coursework::classic {

/// What a part's tests ask of one class. The chain is tested with the pendulum.
struct Role {
  std::string_view name;                // in grade.toml
  std::string_view part;                // whose program calls it
  bool stepper;                         // moves systems; else it is one
  std::vector<std::string_view> names;  // under which it has been seen
};
const std::vector<Role>& roles();
const Role& role_of(std::string_view name);
std::span<const std::string_view> role_names();

/// All classes of a program: those of the student's headers, of the student's sources, and of ours that stand in for
/// what was left to the course.
class ClassList {
 public:
  explicit ClassList(std::vector<ClassInfo> all) : all_(std::move(all)) {}

  const ClassInfo& at(int i) const { return all_[static_cast<std::size_t>(i)]; }
  struct Candidate {
    int of;
    bool named;  // it bears the role's name, or the student's grade.toml says so: it takes the role even if it is wrong
    bool likely;  // it is named, or bears the name of the other role that is tested with this one
  };
  /// Those to be tried: where `wanted` (role -> class) names one, that one alone; else those that bear its name, and
  /// then all others of the kind that bear the name of no other role.
  std::vector<Candidate> candidates(const Role& role, const std::map<std::string, std::string>& wanted) const;
  /// The class of that name that counts; null: there is none.
  const ClassInfo* named(std::string_view name) const;
  /// True if it derives from TimeStepper, or from ParticleSystem.
  bool is_kind(int i, bool stepper) const;
  int size() const { return static_cast<int>(all_.size()); }

 private:
  std::vector<ClassInfo> all_;
};

}  // namespace coursework::classic
