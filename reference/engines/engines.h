// The engines that `crosscheck engine NAME` builds an adapter for: the rows of engines.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace crosscheck {

struct OutsideEngine {
  std::string name, title;  // "mujoco", "MuJoCo 2"
  std::string built;        // "native", "JavaScript" or "WebAssembly"
  std::string licence, precision;
  std::string rule;    // its time-stepping rule, by default and by option
  std::string forces;  // option that applies springs as forces, where that is another rule than its default

  // Files in reference/engines that the adapter is built from: one source for the compiler, or a folder for CMake, or
  // a module for npm's package.
  std::string source, cmake, module;
  std::string package, header;     // Debian's package of the engine, and a header of it
  std::vector<std::string> flags;  // for the compiler
  std::string npm;                 // the package of npm; npm/NAME pins it
  std::string prefix;              // the tree that --prefix names, with `prefix_file` in it; empty: no such option
  std::string prefix_file;

  bool is_native() const { return built == "native"; }
};

/// The rows of the file, in its order. Throws InputError.
std::vector<OutsideEngine> outside_engines();

/// The program that `engine NAME` keeps for reports, whether or not it is there.
std::filesystem::path kept_program(const std::string& engine);

/// The row of the engine whose kept program the method "exec:PATH+option" names, or nothing.
std::optional<OutsideEngine> kept_engine_of(const std::string& method);

/// A method's name for the terminal: "mujoco+drag=callback" of a kept program, of others the whole name.
std::string without_folders(const std::string& method);

/// The commands that build it: "crosscheck engine box3d --prefix DIR".
std::string command_to_build(const OutsideEngine& engine);

}  // namespace crosscheck
