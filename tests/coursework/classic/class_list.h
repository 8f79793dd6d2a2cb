// The classes that a program defines, and which of them may be meant by which part: by their names and what they derive
// from, and, where that leaves a choice, by what each does when it is tried.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace coursework::classic {

struct ClassInfo {
  std::string name, scope;         // scope: namespaces, as "a::b"; empty: none
  std::string file;                // path in the submission; of ours an absolute one
  std::vector<std::string> bases;  // without their namespaces
  bool declares_eval = false, declares_step = false;
  bool abstract = false;  // one of the two is pure
  bool ours = false;      // of a header that stands in for one that the course ships

  std::string full() const { return scope.empty() ? name : scope + "::" + name; }
};

/// Those defined at the level of a namespace; templates and classes within classes are left out.
std::vector<ClassInfo> classes_in(const std::vector<std::string>& tokens, const std::string& file);

/// What a part's tests ask of one class. The chain is tested with the pendulum.
struct Role {
  std::string_view name;                // in grade.toml
  std::string_view part;                // whose program calls it
  bool stepper;                         // moves systems; else it is one
  std::vector<std::string_view> names;  // under which it has been seen
  std::vector<std::string_view> words;  // that its name holds, where it has another
};
const std::vector<Role>& roles();
const Role& role_of(std::string_view name);
std::span<const std::string_view> role_names();

/// What a class did when it was tried in a role.
struct Fit {
  bool alive = false;  // it answered, and not with nothing
  bool shape = false;  // what it does is what the role does: two particles on a spring, a chain, a grid, the rule
  bool slow = false;   // it did not come to an end
  int right = 0;       // tests that it would pass
  int decided = 0;     // cases that said something of its shape
};

/// Fills in how a class fits each role that its kind has; where it cannot be built or run, nothing.
using Fits = std::map<std::string_view, Fit>;

struct Chosen {
  std::map<std::string_view, int> of;  // role -> place in candidates(); missing: no class
  std::vector<int> others;             // candidates that nothing was chosen of
};

/// All classes of a program, the student's headers first, then his sources, then ours.
class ClassList {
 public:
  explicit ClassList(std::vector<ClassInfo> all);

  const ClassInfo& at(int i) const { return all_[static_cast<std::size_t>(i)]; }
  /// Those that could be a system, or a stepper, of the student's or of ours.
  std::vector<int> candidates(bool steppers) const;
  /// The first class of that name; nothing where there is none.
  std::optional<int> named(std::string_view name) const;
  /// Whether names alone leave a choice: another class than those named could be meant.
  bool ambiguous(bool steppers) const;
  /// `fits`, by class, is empty where nothing was tried; `wanted`, by role, is what the student says.
  Chosen choose(const std::map<int, Fits>& fits, const std::map<std::string, std::string>& wanted) const;

 private:
  bool derives(int i, const std::string& base) const;
  bool is_named(int i, const Role& role) const;
  double rank(int i, const Role& role, const std::map<int, Fits>& fits, const Chosen& so_far) const;
  std::vector<ClassInfo> all_;
};

}  // namespace coursework::classic
