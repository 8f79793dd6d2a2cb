// engine: programs for exec: that put another engine behind the protocol: Bullet's adapter built against another Bullet
// tree, Jolt's against a tree of Jolt or with npm's build of Jolt inside.

#include <unistd.h>

#include <cstdint>
#include <thread>

#include "mysim/base/hash.h"
#include "mysim/base/installation.h"
#include "mysim/base/process.h"
#include "report/commands/command_line.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

struct EngineOptions {
  std::string what;
  fs::path prefix, program;
};

/// Where adapters are built: what was compiled once is not compiled again.
fs::path build_folder(const std::string& name) {
  return cache_folder().value_or(fs::temp_directory_path() / fmt::format("crosscheck-{}", getuid())) / "engines" / name;
}

/// False where one of the tools is not on the path, with a line that says how to install what is missing.
bool have_tools(const EngineOptions& options, std::initializer_list<std::pair<const char*, const char*>> tools,
                std::string_view packages) {
  for (const auto& [tool, package] : tools)
    if (!on_path(tool)) {
      fmt::print(stderr,
                 "crosscheck: engine {}: there is no {}; package {} is not installed: "
                 "apt-get install --no-install-recommends {}\n",
                 options.what, tool, package, packages);
      return false;
    }
  return true;
}

/// Runs a program in the folder; on failure prints the end of what it said. True when all went well.
bool run_tool(const std::vector<std::string>& argv, const fs::path& folder, const EngineOptions& options,
              const std::string& what) {
  const ProgramResult result = run_program(argv, folder);
  if (result.status == 0) return true;
  fmt::print(stderr, "crosscheck: engine {}: {} failed; the last lines of its output:\n{}\n", options.what, what,
             last_lines(result.out + result.err, 30));
  return false;
}

/// Writes the program under a temporary name and renames it, so that no half program is ever started.
void install(const std::string& program, const fs::path& as) {
  write_file(as, program);
  fs::permissions(as, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                          fs::perms::others_exec);
}

/// Builds the adapter in `folder` of the sources against the tree of --prefix, which its CMakeLists.txt calls
/// `variable`, and installs its one program.
int build_adapter(const EngineOptions& options, const std::string& folder, const std::string& variable,
                  const std::string& program, double seconds) {
  const fs::path prefix = fs::canonical(options.prefix);
  if (!have_tools(options, {{"cmake", "cmake"}, {"ninja", "ninja-build"}, {"g++", "g++"}},
                  "cmake ninja-build g++ libeigen3-dev libfmt-dev"))
    return 1;
  const fs::path build = build_folder(fmt::format("{}-{:016x}", options.what, Fnv1a::of(prefix.string())));
  fmt::print(stderr, "crosscheck: building the adapter against {} in {}\n", prefix.string(), build.string());
  // a precision or a library found once may be another after the tree was built again
  std::error_code none;
  fs::remove(build / "CMakeCache.txt", none);
  Progress progress(2);
  progress.begin("configuring", 2);
  const unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  const bool configured =
      run_tool({"cmake", "-S", (data_folder() / folder).string(), "-B", build.string(), "-G", "Ninja",
                "-DCMAKE_BUILD_TYPE=Release", fmt::format("-D{}={}", variable, prefix.string()),
                fmt::format("-DCROSSCHECK_LIBRARIES={}", programs_folder().string()),
                "-DCMAKE_EXE_LINKER_FLAGS=" CROSSCHECK_LINK_FLAGS},
               fs::current_path(), options, "cmake");
  if (!configured) fs::remove_all(build, none);
  progress.begin("compiling the adapter", seconds);
  if (!configured || !run_tool({"cmake", "--build", build.string(), "--parallel", std::to_string(jobs)},
                               fs::current_path(), options, "the build"))
    return 1;
  progress.done();
  install(read_file(build / program, "a program"), options.program);
  return 0;
}

// Bullet

int build_bullet(const EngineOptions& options) {
  if (options.prefix.empty())
    throw InputError("engine bullet: expected --prefix DIR, an installation or a source tree of Bullet");
  constexpr const char* folders[] = {"src", "include/bullet", "include"};
  if (std::ranges::none_of(folders, [&](const char* folder) {
        return fs::exists(options.prefix / folder / "btBulletDynamicsCommon.h");
      }))
    throw InputError(
        fmt::format("--prefix {}: expected an installed Bullet (include/bullet/btBulletDynamicsCommon.h or "
                    "include/btBulletDynamicsCommon.h, and lib*/) or its source tree (src/btBulletDynamicsCommon.h)",
                    options.prefix.string()));
  return build_adapter(options, "reference/bullet/adapter", "BULLET_PREFIX", "bullet_engine", 30);  // s, on two cores
}

// Jolt

/// The text with `from`, which must occur so many times, replaced by `to`.
std::string replaced(std::string text, std::string_view from, std::string_view to, int times, const fs::path& file) {
  int found = 0;
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size(), ++found)
    text.replace(at, from.size(), to);
  if (found != times)
    throw InputError(fmt::format("{}: expected '{}' {} times, found it {} times", file.string(), from, times, found));
  return text;
}

/// Node takes a file without an ending for a script, not for a module: what only modules have is taken out of the
/// bundle. Its function is defined before the adapter runs, wherever it stands.
std::string jolt_program(const fs::path& package) {
  const fs::path bundle = package / "dist/jolt-physics.wasm-compat.js";
  std::string text = read_file(bundle, "Jolt's WebAssembly with its JavaScript");
  text = replaced(std::move(text), "import.meta.url", "\"file:///jolt.js\"", 2, bundle);
  text = replaced(std::move(text), "export default Jolt;", "", 1, bundle);
  return fmt::format("{}\n/* jolt-physics of npm, from here to the end:\n{}*/\n{}\n",
                     read_file(data_folder() / "reference/jolt/jolt_engine.js", "Jolt's adapter"),
                     read_file(package / "LICENSE", "the licence of jolt-physics"), text);
}

/// Jolt compiled for this machine.
int build_native_jolt(const EngineOptions& options) {
  for (const char* needed : {"Build/CMakeLists.txt", "Jolt/Physics/SoftBody/SoftBodyMotionProperties.h"})
    if (!fs::exists(options.prefix / needed))
      throw InputError(
          fmt::format("--prefix {}: expected a source tree of Jolt with its {}", options.prefix.string(), needed));
  return build_adapter(options, "reference/jolt/adapter", "JOLT_PREFIX", "jolt_engine", 240);  // s, on two cores
}

int build_jolt(const EngineOptions& options) {
  if (!options.prefix.empty()) return build_native_jolt(options);
  if (!have_tools(options, {{"node", "nodejs"}, {"npm", "npm"}}, "nodejs npm")) return 1;
  // npm holds what it fetches against the checksum in package-lock.json, and keeps it in its own cache; two that are
  // started at once have a folder each
  const fs::path folder = build_folder(fmt::format("jolt-{}", getpid()));
  for (const char* file : {"package.json", "package-lock.json"})
    write_file(folder / file, read_file(data_folder() / "reference/jolt" / file, "what npm is to fetch"));
  Progress progress(1);
  progress.begin("fetching jolt-physics", 5);  // s
  const bool fetched =
      run_tool({"npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--no-update-notifier", "--prefer-offline"},
               folder, options, "npm");
  if (fetched) {
    progress.done();
    install(jolt_program(folder / "node_modules/jolt-physics"), options.program);
  }
  std::error_code none;
  fs::remove_all(folder, none);
  return fetched ? 0 : 1;
}

int engine_command(const EngineOptions& options) {
  if (options.what != "bullet" && options.what != "jolt")
    throw InputError(fmt::format("engine {}: expected bullet or jolt{}", options.what,
                                 did_you_mean(options.what, {"bullet", "jolt"})));
  require_output_file(options.program);
  const int status = options.what == "bullet" ? build_bullet(options) : build_jolt(options);
  if (status == 0) fmt::print("{}\n", options.program.string());
  return status;
}

}  // namespace

void add_engine(CLI::App& app, Invocation& call) {
  auto [engine, options] = add_command(
      app, call, "engine", "builds an external engine for exec: from another Bullet, or from Jolt", engine_command);
  engine.add_option("NAME", options.what, "bullet or jolt")->required();
  engine.add_option(
      "--prefix", options.prefix,
      "bullet: an installation or a source tree of Bullet; jolt: a source tree of Jolt, without it npm's build");
  engine.add_option("-o", options.program, "PROG: the program to write")->required();
}

}  // namespace crosscheck
