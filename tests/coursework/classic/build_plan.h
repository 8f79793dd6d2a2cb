// Turns the files that a student handed in into programs: lays them out so that every include is met, lists the classes
// and says which commands to run. The sandboxes run them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/classic/class_list.h"

namespace coursework::classic {

/// A call of the compiler (or of ar, where `archive`). All paths in it are absolute.
struct BuildStep {
  std::vector<std::string> words;  // what follows the program's name
  std::filesystem::path makes;
  std::string file;  // the student's file that it is about, as the student named it; empty: ours around the headers
  bool archive = false;
  std::filesystem::path source = {};  // what is compiled; empty: it archives or links
};

class BuildPlan {
 public:
  /// Writes the student's files, no two of the same flat name, and what we add into `tree`/in; steps write into
  /// `tree`/out. `coursework` is tests/coursework. Throws std::runtime_error where the tree cannot be written.
  BuildPlan(const Files& files, const std::filesystem::path& tree, const std::filesystem::path& coursework);

  const ClassList& classes() const { return classes_; }
  /// The student's sources and ours that stand in for missing ones. They may run in any order and side by side. One
  /// that fails costs only what needs it.
  const std::vector<BuildStep>& objects() const { return objects_; }
  /// After those: archives of the objects that were made.
  std::vector<BuildStep> archives() const;
  /// Our calls of a class, and of a second one that is the chain, compiled against the student's headers.
  BuildStep calls(const std::string& name, const ClassInfo& of, bool stepper, const ClassInfo* chain = nullptr) const;
  /// After those: the program. `child` is the object of tests/coursework/check/child_main.cpp.
  BuildStep link(const BuildStep& calls, const std::filesystem::path& child) const;
  /// True if the class is declared or defined in that file of the student's.
  bool concerns(const std::string& file, const ClassInfo& of) const;
  /// Declares the names of OpenGL that the compiler missed; false where it missed none.
  bool declare_drawing(const std::string& captured_output) const;

 private:
  void write_files();
  void plan_objects();
  std::filesystem::path file_on_disk(const ClassInfo& one) const;
  BuildStep compile(const std::filesystem::path& source, const std::string& object, const std::string& standard,
                    const std::vector<std::string>& more) const;

  std::filesystem::path tree_, ours_;
  Files files_;                                             // the student's
  std::map<std::string, std::vector<std::string>> tokens_;  // by path
  std::vector<BuildStep> objects_;
  ClassList classes_{{}};
};

}  // namespace coursework::classic
