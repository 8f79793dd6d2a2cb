// Any program as an engine, exec:PATH, by the interface in PROTOCOL.md.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mysim/run/run.h"
#include "reference/protocol/trajectory_files.h"

namespace crosscheck {

/// A program's process that serves many scenes (PROTOCOL.md, Serve mode), started at its first use.
class Server;

struct Program {
  std::filesystem::path path;
  std::vector<std::string> options;  // for scene.json
  double timeout = 600;              // s, wall-clock time
  std::shared_ptr<Server> server;    // shared by copies; null: one call per run
};

/// Parses "PATH+option+option". PATH is relative to the working directory; a bare word is searched for there, then in
/// $PATH. Everything after the longest prefix that is a file is options; timeout=SECONDS is for Crosscheck, the others
/// are for the program. Throws InputError if there is no such program.
Program find_program(const std::string& text);

/// Adds an option of a method's name; timeout=SECONDS is for Crosscheck. Throws InputError that names `method` if the
/// timeout is invalid.
void add_option(Program& program, const std::string& method, const std::string& option);

/// Runs the program on the scene and replays its results through the observer. The verdict is timeout or crash, with
/// the reason, if the program delivers no results. Throws Unsupported if the program refuses the scene. The stderr
/// output of a successful run becomes the outcome's remark. States have no velocities if the program delivers none.
Outcome run_outside_engine(const Program& program, const Scene& scene, const Run& run, Observer& observer);

/// Throws InputError if a result file is a link or a special file, or if run.json is longer than a scene of this size
/// requires, which bounds the data to read. (The run determines the lengths of the .npy files.)
void require_result_files(const std::filesystem::path& folder, const Scene& scene);

/// Describes the pin whose frames deviate most from the prescribed motion; empty if all are right to the rounding of
/// the engine's precision, as stated in the read-back.
std::string misled_pin(const Frames& frames, const Scene& scene, const Run& run, const Outcome& out);

}  // namespace crosscheck
