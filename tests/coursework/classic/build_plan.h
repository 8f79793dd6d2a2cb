// Turns a student's files into programs: lays them out so that every include is found, lists the classes, and plans the
// commands. The sandboxes run them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/classic/source_scan.h"

namespace coursework::classic {

/// A call of the compiler (or of ar, if `archive`). All paths in it are absolute.
struct BuildStep {
  std::vector<std::string> words;  // arguments after the program's name
  std::filesystem::path makes;
  std::string file = {};  // the student's file that is compiled; empty for our code around the headers
  bool archive = false;
  std::filesystem::path source = {};  // the compiled file; empty for archiving or linking
};

class BuildPlan {
 public:
  /// Writes the student's files, under distinct flat names, and our additions into `tree`/in; steps write into
  /// `tree`/out. `coursework` is tests/coursework. Throws std::runtime_error if the tree cannot be written.
  BuildPlan(const Files& files, const std::filesystem::path& tree, const std::filesystem::path& coursework);

  const ClassList& classes() const { return classes_; }
  /// Steps for the student's sources and our replacements of missing ones. They may run in any order and in parallel. A
  /// failing step affects only its dependents.
  const std::vector<BuildStep>& objects() const { return objects_; }
  /// The step to run after objects(): packs the objects that were made into an archive.
  BuildStep archive() const;
  /// Compiles our calls of the class `of` (with the class `chain` for the chain's calls) against the student's headers.
  BuildStep calls(const ClassInfo& of, bool stepper, const ClassInfo* chain = nullptr) const;
  /// The step to run after `calls`: links the program. `child` is the object of tests/coursework/check/child_main.cpp.
  BuildStep link(const BuildStep& calls, const std::filesystem::path& child) const;
  /// True if the student's `file` declares or defines the class.
  bool concerns(const std::string& file, const ClassInfo& of) const;
  /// Declares the OpenGL names that the compiler reported as missing; returns false if there are none.
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
  ClassList classes_;
};

}  // namespace coursework::classic
