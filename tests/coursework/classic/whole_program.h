// Turns a whole submission into one program per part, for the grader: runs a plan (build_plan.h) in a sandbox.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/coursework/classic/build_plan.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/sandbox.h"

namespace coursework::classic {

struct Programs {
  std::map<std::string, Built> of;  // key: part; `missing`: no class has the part's role
  std::vector<Remark> notes;        // on the choice of classes and files
  std::string base_file;            // the student's file with the base class of all systems; empty if it is ours
  int points = 0;                   // earned in the public tests; set only if `rate`
};

struct Toolchain {
  std::vector<std::string> compiler;  // g++ and the options of every call; absolute path
  std::filesystem::path ar;           // absolute
  std::filesystem::path child;        // object of tests/coursework/check/child_main.cpp
  const Compiler* cache = nullptr;    // caches objects by content; null for untrusted code
  unsigned jobs = 1;
  double seconds = 240;  // CPU time (s) of all calls together; later calls are not started
};

/// Path of a part's solution within the folder of a solution: "TimeStepper.cpp".
std::string file_of_part(const std::string& part);

/// C++ files below one of our folders.
Files files_below(const std::filesystem::path& folder);

/// Points of a role's public tests.
struct Earned {
  int points = 0, of = 0;
};
/// Runs a program that was built with one class in a role.
using Trial = std::function<Earned(const std::filesystem::path& program, const Role& role)>;

/// Compiles and links `parts` (all, if empty) of `files` in the folder `tree`, which need not exist. The sandbox sees
/// only `tree`: our files that it needs are copied there, but neither solution nor tests. `coursework` is
/// tests/coursework. If several classes could take a role, builds and tries them until one earns all points. `wanted`
/// maps roles to the classes that the student chose. If `rate`, also tries classes that were the only candidates for
/// their role, and adds up the points.
Programs build_programs(const Files& files, const std::filesystem::path& tree, const std::filesystem::path& coursework,
                        const Sandbox& sandbox, const Toolchain& tools, const std::vector<std::string>& parts = {},
                        const Trial& trial = nullptr, const std::map<std::string, std::string>& wanted = {},
                        bool rate = false);

/// The classic assignment's programs, in the form that the grader requires.
std::unique_ptr<Builder> whole_builder(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox);

}  // namespace coursework::classic
