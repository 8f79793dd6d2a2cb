// How a whole program that a student handed in becomes one test program per part: finds the classes, lays the files
// out so that every include is met, and says which commands to run. It runs nothing itself; the sandboxes do.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/coursework/classic/class_list.h"
#include "tests/coursework/classic/source_scan.h"

namespace coursework::classic {

/// A call of the compiler (or of ar, where `archive`). All paths in it are absolute.
struct BuildStep {
  std::vector<std::string> words;  // what follows the program's name
  std::filesystem::path makes;
  std::string file;  // the student's file that it is about, as he named it; empty: ours around his headers
  bool archive = false;
  std::filesystem::path source = {};  // what is compiled; empty: it archives or links
};

/// What one part's program is made of.
struct PartBuild {
  std::string part;
  std::string missing;             // the class that no file defines; then nothing else is set
  BuildStep calls;                 // our calls, compiled against the student's headers
  std::vector<std::string> files;  // the student's files in which its class stands: whose errors are to be told
};

/// A class that is to be tried, where names leave a choice.
struct Scout {
  int of;  // its place in the list of classes
  bool stepper;
  PartBuild build;
};

class BuildPlan {
 public:
  /// Writes the student's files and what we add into `tree`/in; steps write into `tree`/out. `coursework` is
  /// tests/coursework. `wanted` is the class that the student's grade.toml says, by role. Throws std::runtime_error
  /// where the tree cannot be written.
  BuildPlan(const Files& submitted, std::filesystem::path tree, std::filesystem::path coursework,
            std::map<std::string, std::string> wanted = {});

  /// Classes to be tried before choose(); none where there is no choice.
  std::vector<Scout> scouts() const;
  /// Chooses each part's class by what those did. Until then names alone have chosen.
  void choose(const std::map<int, Fits>& fits);
  /// The student's file that defines what all systems derive from; empty where it is ours.
  std::string base_file() const;
  /// The class in that place of the list.
  std::string name_of(int of) const { return classes_.at(of).full(); }

  const std::vector<PartBuild>& parts() const { return parts_; }
  /// The student's sources and ours that stand in for missing ones. Together with each part's `calls` they may run in
  /// any order and side by side. One that fails costs only what needs it.
  const std::vector<BuildStep>& objects() const { return objects_; }
  /// After those: archives of the objects that were made.
  std::vector<BuildStep> archives() const;
  /// After those: the part's program. `child` is the object of tests/coursework/check/child_main.cpp.
  BuildStep link(const PartBuild& part, const std::filesystem::path& child) const;
  /// What was left out.
  const std::vector<Remark>& notes() const { return notes_; }

 private:
  void lay_out();
  void add_base(const std::filesystem::path& base);
  std::vector<std::string> folders() const;
  void add_forwarders(const std::vector<std::string>& folders);
  void add_drawing();
  void plan_objects();
  void list_classes();
  void plan_parts(const Chosen& chosen);
  void tell_choice(const Chosen& chosen, bool tried);
  /// Options that name the class in our calls.
  std::vector<std::string> names_of(int of) const;
  std::string file_on_disk(const ClassInfo& one) const;
  /// The file, ours included, that defines such a class, and the name as spelt there.
  bool find(const std::vector<std::string_view>& names, std::string& file, std::string& name) const;
  BuildStep compile(const std::string& source, const std::string& object, const std::string& standard,
                    const std::vector<std::string>& more) const;

  std::filesystem::path tree_, ours_, coursework_;
  Files files_;  // the student's, those that count
  std::map<std::string, std::vector<std::string>>
      tokens_;                        // of each, and of our headers that stand in for missing ones
  std::vector<std::string> options_;  // include folders and forced includes
  std::vector<BuildStep> objects_;
  std::vector<PartBuild> parts_;
  std::vector<Remark> notes_;
  std::map<std::string, std::string> wanted_;
  ClassList classes_{{}};
};

}  // namespace coursework::classic
