// The engines of `crosscheck engine NAME`, which builds their adapters: the rows of engines.json.
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
  std::string rule;    // time stepping, by default and by option
  std::string forces;  // option that applies springs as forces, if this changes the rule

  // Files in reference/engines from which the adapter is built: a source file, a folder for CMake, or a module for
  // npm's package.
  std::string source, cmake, module;
  std::string package, header;     // Debian package, and one of its headers
  std::vector<std::string> flags;  // compiler options
  std::string npm;                 // npm package; npm/NAME pins its version
  std::string prefix;              // the tree for --prefix, which contains `prefix_file`; empty: no such option
  std::string prefix_file;

  bool is_native() const { return built == "native"; }
};

/// The engines in the order of the file. Throws InputError.
std::vector<OutsideEngine> outside_engines();

/// The program that `crosscheck engine NAME` keeps for reports; it need not exist.
std::filesystem::path kept_program(const std::string& engine);

/// The engine to whose kept program the method "exec:PATH+option" refers, or nullopt.
std::optional<OutsideEngine> kept_engine_of(const std::string& method);

/// The method's name without folders if it names a kept program, e.g. "mujoco+drag=callback"; otherwise unchanged.
std::string without_folders(const std::string& method);

/// The command that builds the engine's adapter: "crosscheck engine box3d --prefix DIR".
std::string command_to_build(const OutsideEngine& engine);

}  // namespace crosscheck
