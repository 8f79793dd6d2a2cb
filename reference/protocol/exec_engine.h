// Any program as an engine: exec:PATH. What the program must do is in PROTOCOL.md.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mysim/run/run.h"
#include "reference/protocol/trajectory_files.h"

namespace crosscheck {

/// The process of a program that serves many scenes (PROTOCOL.md, Serve mode), started when it is first needed.
class Server;

struct Program {
  std::filesystem::path path;
  std::vector<std::string> options;  // handed over in scene.json
  double timeout = 600;              // s of wall-clock time
  std::shared_ptr<Server> server;    // shared by copies; null: each run is a call
};

/// Reads "PATH+option+option". PATH is relative to the working directory; a bare word is looked for there, then in
/// PATH. What follows the longest part that is a file are options; timeout=SECONDS is Crosscheck's, the others are for
/// the program. Throws InputError when there is no such program.
Program find_program(const std::string& text);

/// Adds what stands behind a plus: timeout=SECONDS is Crosscheck's. `method` is named where that is no time: throws
/// InputError.
void add_option(Program& program, const std::string& method, const std::string& option);

/// Runs the program on the scene and plays what it delivered to the observer. Verdict::timeout and Verdict::crash, with
/// the reason, when it does not deliver; throws Unsupported when it says so. What a good run wrote on stderr is the
/// outcome's remark. Without velocities the states have none.
Outcome run_outside_engine(const Program& program, const Scene& scene, const Run& run, Observer& observer);

/// Throws InputError where a file of results is a link or a special file, or run.json is longer than a scene of this
/// size needs: what is read is bounded. (The lengths of the .npy files follow from the run.)
void require_result_files(const std::filesystem::path& folder, const Scene& scene);

/// The pin that the delivered frames lead furthest from where it is prescribed, in words; empty where all are in place
/// within the rounding of the engine's precision, which the outcome's read-back tells.
std::string misled_pin(const Frames& frames, const Scene& scene, const Run& run, const Outcome& out);

}  // namespace crosscheck
