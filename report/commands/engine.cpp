// Builds the adapters of reference/engines/engines.json, which run as exec:PROGRAM.

#include <unistd.h>

#include <cstdint>
#include <thread>

#include "mysim/base/hash.h"
#include "mysim/base/installation.h"
#include "mysim/base/process.h"
#include "mysim/base/text.h"
#include "reference/engines/engines.h"
#include "report/commands/command_line.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

struct EngineOptions {
  std::string what;
  fs::path prefix, program;
};

/// Build folder of an adapter, kept to avoid recompilation.
fs::path build_folder(const std::string& name) { return kept_program(name).parent_path().parent_path() / name; }

/// Returns false if a tool is not on the path, and prints how to install what is missing.
bool have_tools(const EngineOptions& options, std::initializer_list<std::pair<const char*, const char*>> tools,
                const std::string& packages) {
  for (const auto& [tool, package] : tools)
    if (!on_path(tool)) {
      fmt::print(stderr,
                 "crosscheck: engine {}: {} is missing; package {} is not installed: "
                 "apt-get install --no-install-recommends {}\n",
                 options.what, tool, package, packages);
      return false;
    }
  return true;
}

/// If the program fails, prints the end of its output and returns false.
bool run_tool(const std::vector<std::string>& argv, const fs::path& folder, const EngineOptions& options,
              const std::string& what) {
  const ProgramResult result = run_program(argv, folder);
  if (result.status == 0) return true;
  fmt::print(stderr, "crosscheck: engine {}: {} failed; the last lines of its output:\n{}\n", options.what, what,
             last_lines(result.out + result.err, 30));
  return false;
}

/// Writes the program under a temporary name and then renames it, so that a partial program is never started.
void install(const std::string& program, const fs::path& as) {
  write_file(as, program);
  fs::permissions(as, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                          fs::perms::others_exec);
}

int build_adapter(const EngineOptions& options, const OutsideEngine& engine, const fs::path& program) {
  const fs::path prefix = fs::canonical(options.prefix);
  if (!have_tools(options, {{"cmake", "cmake"}, {"ninja", "ninja-build"}, {"g++", "g++"}},
                  "cmake ninja-build g++ libeigen3-dev libfmt-dev"))
    return 1;
  const fs::path build = build_folder(fmt::format("{}-{:016x}", options.what, Fnv1a::of(prefix.string())));
  fmt::print(stderr, "crosscheck: building the adapter against {} in {}\n", prefix.string(), build.string());
  // drop the cache: the engine may have been rebuilt with another precision or other libraries
  std::error_code none;
  fs::remove(build / "CMakeCache.txt", none);
  Progress progress(2);
  progress.begin("configuring", 2);
  const unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  const bool configured =
      run_tool({"cmake", "-S", (data_folder() / engine.cmake).string(), "-B", build.string(), "-G", "Ninja",
                "-DCMAKE_BUILD_TYPE=Release", fmt::format("-DENGINE_PREFIX={}", prefix.string()),
                fmt::format("-DCROSSCHECK_LIBRARIES={}", programs_folder().string()),
                "-DCMAKE_EXE_LINKER_FLAGS=" CROSSCHECK_LINK_FLAGS},
               fs::current_path(), options, "cmake");
  if (!configured) fs::remove_all(build, none);
  progress.begin("compiling the adapter", 60);  // s
  if (!configured || !run_tool({"cmake", "--build", build.string(), "--parallel", std::to_string(jobs)},
                               fs::current_path(), options, "the build"))
    return 1;
  progress.done();
  install(read_file(build / "engine", "a program"), program);
  return 0;
}

/// Compiles an adapter that is a single source file, against Debian's package of its engine.
int compile_source(const EngineOptions& options, const OutsideEngine& engine, const fs::path& program) {
  if (!have_tools(options, {{"g++", "g++"}}, fmt::format("g++ {}", engine.package))) return 1;
  std::vector<std::string> look{"g++", "-x", "c++", "-E", "-include", engine.header, "/dev/null"};
  look.insert(look.end(), engine.flags.begin(), engine.flags.end());
  if (run_program(look, ".").status != 0) {
    fmt::print(stderr,
               "crosscheck: engine {}: {} is missing; package {} is not installed: apt-get install "
               "--no-install-recommends {}\n",
               engine.name, engine.header, engine.package, engine.package);
    return 1;
  }
  Progress progress(1);
  progress.begin("compiling the adapter", 20);  // s
  const fs::path folder = data_folder() / "reference";
  // -ffp-contract=off, as in mysim's build: fused multiply-add would change results
  std::vector<std::string> call{"g++",
                                "-std=c++17",
                                "-O2",
                                "-ffp-contract=off",
                                "-I",
                                (folder / "protocol").string(),
                                (folder / "engines" / engine.source).string(),
                                "-o",
                                program.string()};
  call.insert(call.end(), engine.flags.begin(), engine.flags.end());
  if (!run_tool(call, ".", options, "the compiler")) return 1;
  progress.done();
  return 0;
}

/// Bundles npm's build of an engine with its adapter.
int bundle_module(const EngineOptions& options, const OutsideEngine& engine, const fs::path& program) {
  if (!have_tools(options, {{"node", "nodejs"}, {"npm", "npm"}, {"esbuild", "esbuild"}}, "nodejs npm esbuild"))
    return 1;
  // npm has its own cache and verifies checksums; the process id separates concurrent builds
  const fs::path folder = build_folder(fmt::format("{}-{}", engine.name, getpid())),
                 sources = data_folder() / "reference";
  for (const char* file : {"package.json", "package-lock.json"})
    write_file(folder / file, read_file(sources / "engines/npm" / engine.name / file, "the packages that npm fetches"));
  Progress progress(2);
  progress.begin(fmt::format("fetching {}", engine.npm), 5);  // s
  bool done =
      run_tool({"npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--no-update-notifier", "--prefer-offline"},
               folder, options, "npm");
  if (done) {
    progress.begin("bundling", 2);  // s
    for (const std::string& file : {"engines/" + engine.module, std::string("protocol/crosscheck_engine.mjs")})
      write_file(folder / file, read_file(sources / file, "the adapter"));
    std::string licence;
    for (const fs::path& from : {sources / "engines/npm" / engine.name, folder / "node_modules" / engine.npm})
      for (const char* name : {"LICENSE", "LICENSE.md"})
        if (fs::exists(from / name)) licence = read_file(from / name, "the licence");
    for (size_t at = 0; (at = licence.find("*/", at)) != std::string::npos;) licence.insert(at + 1, " ");
    // make a single script for Node: in such a script import.meta.url does not exist, and WebAssembly must be embedded
    done = run_tool(
        {"esbuild", "engines/" + engine.module, "--bundle", "--platform=node", "--target=node18", "--format=cjs",
         "--loader:.wasm=binary", "--define:import.meta.url=\"file:///engine.js\"", "--log-level=error",
         fmt::format("--footer:js=/* {}:\n{}*/", engine.npm, licence), "--outfile=" + program.string()},
        folder, options, "esbuild");
  }
  std::error_code none;
  fs::remove_all(folder, none);
  if (done) progress.done();
  return done ? 0 : 1;
}

void require_prefix(const EngineOptions& options, const OutsideEngine& engine) {
  if (options.prefix.empty())
    throw InputError(fmt::format("engine {}: expected --prefix DIR, {}", engine.name, engine.prefix));
  if (engine.prefix.empty())
    throw InputError(fmt::format("engine {}: expected no --prefix: it is built from {}", engine.name,
                                 engine.npm.empty() ? engine.package : "npm's " + engine.npm));
  const std::vector<std::string> files = split(engine.prefix_file, '|');
  if (std::ranges::none_of(files, [&](const std::string& file) { return fs::exists(options.prefix / file); }))
    throw InputError(fmt::format("--prefix {}: expected {} with its {}", options.prefix.string(), engine.prefix,
                                 fmt::join(files, " or ")));
}

int engine_command(const EngineOptions& options) {
  const std::vector<OutsideEngine> all = outside_engines();
  std::vector<std::string> names;
  for (const OutsideEngine& engine : all) names.push_back(engine.name);
  const auto found = std::ranges::find(all, options.what, &OutsideEngine::name);
  if (found == all.end())
    throw InputError(fmt::format("engine {}: expected one of {}{}", options.what, fmt::join(names, ", "),
                                 did_you_mean(options.what, names)));
  const OutsideEngine& engine = *found;
  const bool from_tree = !options.prefix.empty() || (engine.source.empty() && engine.module.empty());
  if (from_tree) require_prefix(options, engine);
  if (!options.program.empty()) require_output_file(options.program);
  const fs::path kept = kept_program(engine.name), made = kept.string() + fmt::format(".{}", getpid());
  fs::create_directories(kept.parent_path());
  const int status = from_tree               ? build_adapter(options, engine, made)
                     : engine.source.empty() ? bundle_module(options, engine, made)
                                             : compile_source(options, engine, made);
  std::error_code none;
  if (status == 0) {
    install(read_file(made, "a program"), kept);
    if (!options.program.empty()) install(read_file(made, "a program"), options.program);
    fmt::print("{}\n", (options.program.empty() ? kept : options.program).string());
  }
  fs::remove(made, none);
  return status;
}

}  // namespace

void add_engine(CLI::App& app, Invocation& call) {
  auto [engine, options] =
      add_command(app, call, "engine", "builds a program for exec: from another engine", engine_command);
  engine.add_option("NAME", options.what, "mujoco, simbody, ode, ...: `list engines` shows all")->required();
  engine.add_option("--prefix", options.prefix, "DIR: an installation or a source tree of the engine");
  engine.add_option("-o", options.program, "PROG: writes the program here, too");
}

}  // namespace crosscheck
