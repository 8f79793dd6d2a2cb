// The grader's way from a whole submission to one program per part.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tests/coursework/classic/build_plan.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/sandbox.h"

namespace coursework::classic {

// Runs a plan (build_plan.h) in a sandbox: the grader's way from a whole submission to one program per part.

struct Program {
  std::filesystem::path file;  // empty: there is none
  bool missing = false;        // no class takes the part's role
  Remark why = {};             // there is no file
};

struct Programs {
  std::map<std::string, Program> of;  // by part
  std::vector<Remark> notes;          // on the choice of classes and files
  std::string base_file;              // the student's, with what all systems derive from; empty: ours
  int points = 0;                     // earned in the public tests; set if `rate` is
};

/// What stands in the place of the compiler's words where it had to be stopped, or was not begun any more.
constexpr std::string_view too_long = "the compiler did not come to an end in time";

/// Likewise where it needed too much memory, or wrote too large a file.
constexpr std::string_view too_much = "the compiler needed more memory than there is";

struct Toolchain {
  std::vector<std::string> compiler;  // g++ and options that every call begins with; absolute path
  std::filesystem::path ar;           // absolute
  std::filesystem::path child;        // object of tests/coursework/check/child_main.cpp
  const Compiler* cache = nullptr;    // keeps objects by content; null (untrusted code): none are kept
  unsigned jobs = 1;
  double seconds = 240;  // of processor time, all calls together; what has not begun by then is not tried
};

/// Where a part's solution stands within the folder of a solution: "TimeStepper.cpp".
std::string file_of_part(const std::string& part);

/// C++ files below a folder of ours.
Files files_below(const std::filesystem::path& folder);

/// Points of a role's public tests.
struct Earned {
  int points = 0, of = 0;
};
/// Runs a program around one class in a role.
using Trial = std::function<Earned(const std::filesystem::path& program, const Role& role)>;

/// Compiles and links `parts` (all, where empty) of the files in `tree`, a folder that need not exist. The sandbox sees
/// `tree` alone: what of ours it needs is copied there, and neither solution nor tests are. `coursework` is
/// tests/coursework. Where more than one class could take a role they are built and tried until one earns all points;
/// `wanted` is what the student says, by role. `rate`: try all that are chosen.
Programs build_programs(const Files& files, const std::filesystem::path& tree, const std::filesystem::path& coursework,
                        const Sandbox& sandbox, const Toolchain& tools, const std::vector<std::string>& parts = {},
                        const Trial& trial = nullptr, const std::map<std::string, std::string>& wanted = {},
                        bool rate = false);

// The classic assignment's programs, as the grader asks for them.

std::unique_ptr<Builder> whole_builder(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox);

}  // namespace coursework::classic
