// Runs one program under limits and says how it ended. The lanes differ in what they hand over here.
#pragma once

#include <sys/resource.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/grader/lane.h"

namespace coursework {

struct Start {
  std::vector<std::string> command, environment;  // environment as NAME=value
  std::filesystem::path folder;                   // it starts there
  unsigned user = 0;                              // it runs under this user and group; 0: under ours
  std::string filter = {};                        // see filter_program(); empty: none
  std::vector<int> passed = {};                   // descriptors that it gets as 4, 5, ...
  std::string input = {};
  Limits limits = {};
  long processes = 0;  // that its user may have at once, itself included
};

struct Ended {
  int status = 0;                     // as wait gives it
  rusage used{};                      // by all its processes
  bool wall = false, output = false;  // stopped by us
  std::string answers, chatter;
};

/// Throws std::runtime_error where it cannot be started.
Ended spawn(const Start& start);

/// By the order that lane.h gives. `shell`: exit codes from 129 on are signals, as bwrap and shells report them.
End classify(Ended ended, const Limits& limits, bool shell);

}  // namespace coursework
