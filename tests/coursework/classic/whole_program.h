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
  std::filesystem::path file;   // empty: there is none, and why stands in one of the next lines
  std::string missing;          // the class that no file of the submission defines
  std::string source;           // the student's file that does not compile, empty where it is our calls of his classes
  std::string captured_output;  // what compiler or linker said
};

struct Programs {
  std::map<std::string, Program> of;  // by part
  std::vector<Remark> notes;          // what of the files was left out
  std::string base_file;              // the student's, with what all systems derive from; empty: ours
};

/// What stands in the place of the compiler's words where it had to be stopped, or was not begun any more.
constexpr std::string_view too_long = "the compiler did not come to an end in time";

/// Likewise where it needed too much memory, or wrote too large a file.
constexpr std::string_view too_much = "the compiler needed more memory than there is";

struct Toolchain {
  std::vector<std::string> compiler;  // g++ and options that every call begins with; absolute path
  std::filesystem::path ar;           // absolute
  std::filesystem::path child;        // object of tests/coursework/check/child_main.cpp
  std::filesystem::path cache = {};   // where objects are kept by content; empty (untrusted code): nowhere
  unsigned jobs = 1;
  double seconds = 240;  // of processor time, all calls together; what has not begun by then is not tried
};

/// Where a part's solution stands within the folder of a solution: "TimeStepper.cpp".
std::string file_of_part(const std::string& part);

/// C++ files below a folder of ours.
Files files_below(const std::filesystem::path& folder);

/// Tries a class: what its program does in each role of its kind.
using Trial = std::function<Fits(const std::filesystem::path& program, bool stepper)>;

/// Compiles and links `parts` (all, where empty) of the files in `tree`, a folder that need not exist. The sandbox sees
/// `tree` alone: what of ours it needs is copied there, and neither solution nor tests are. `coursework` is
/// tests/coursework. Where names leave a choice of classes, each is built and tried; `wanted` is what the student says.
Programs build_programs(const Files& files, const std::filesystem::path& tree, const std::filesystem::path& coursework,
                        const Sandbox& sandbox, const Toolchain& tools, const std::vector<std::string>& parts = {},
                        const Trial& trial = nullptr, const std::map<std::string, std::string>& wanted = {});

// The classic assignment's programs, as the grader asks for them.

std::unique_ptr<Builder> whole_builder(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox);

}  // namespace coursework::classic
