// engine bullet: builds the Bullet adapter against another Bullet tree, as a program for exec:.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <thread>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "mysim/base/process.h"
#include "mysim/base/progress.h"
#include "report/commands/commands.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

struct EngineOptions {
  std::string what;
  fs::path prefix, program;
};

/// Throws InputError unless the folder holds what the adapter's CMakeLists.txt looks for.
void require_bullet(const fs::path& prefix) {
  for (const char* header :
       {"src/btBulletDynamicsCommon.h", "include/bullet/btBulletDynamicsCommon.h", "include/btBulletDynamicsCommon.h"})
    if (fs::exists(prefix / header)) return;
  throw InputError(
      fmt::format("--prefix {}: expected an installed Bullet (include/bullet/btBulletDynamicsCommon.h or "
                  "include/btBulletDynamicsCommon.h, and lib*/) or its source tree (src/btBulletDynamicsCommon.h)",
                  prefix.string()));
}

/// Runs cmake; on failure prints the end of what it said. True when all went well.
bool cmake(const std::vector<std::string>& words, const std::string& what) {
  std::vector<std::string> argv{"cmake"};
  argv.insert(argv.end(), words.begin(), words.end());
  const ProgramResult result = run_program(argv, fs::current_path());
  if (result.status == 0) return true;
  fmt::print(stderr, "crosscheck: engine bullet: {} failed; the last lines of its output:\n{}\n", what,
             last_lines(result.out + result.err, 30));
  return false;
}

/// Copies the program under a temporary name and renames it, so that no half program is ever started.
void install(const fs::path& program, const fs::path& as) {
  write_file(as, read_file(program, "a program"));
  fs::permissions(as, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                          fs::perms::others_exec);
}

int engine_command(const EngineOptions& options) {
  if (options.what != "bullet") throw InputError(fmt::format("engine {}: expected bullet", options.what));
  require_bullet(options.prefix);
  const fs::path prefix = fs::canonical(options.prefix), source = fs::path(CROSSCHECK_SOURCE_DIR).parent_path();
  if (fs::is_directory(options.program))
    throw InputError(fmt::format("-o {}: expected the name of a program, got a folder", options.program.string()));
  require_writable(options.program.has_parent_path() ? options.program.parent_path() : ".");

  const fs::path build = source / "build" / "engines" / fmt::format("{:016x}", Fnv1a::of(prefix.string()));
  fmt::print(stderr, "crosscheck: building the adapter against {} in {}\n", prefix.string(), build.string());
  // a precision or a library found once may be another after the tree was built again
  std::error_code none;
  fs::remove(build / "CMakeCache.txt", none);
  Progress progress(2);
  progress.begin("configuring", 2);
  const unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  const bool configured =
      cmake({"-S", (source / "reference/bullet/adapter").string(), "-B", build.string(), "-G", "Ninja",
             "-DCMAKE_BUILD_TYPE=Release", "-DBULLET_PREFIX=" + prefix.string(),
             "-DCROSSCHECK_BUILD=" CROSSCHECK_BINARY_DIR, "-DCMAKE_EXE_LINKER_FLAGS=" CROSSCHECK_LINK_FLAGS},
            "cmake");
  if (!configured) fs::remove_all(build, none);
  progress.begin("compiling the adapter", 30);  // s, on two cores
  if (!configured || !cmake({"--build", build.string(), "--parallel", std::to_string(jobs)}, "the build")) return 1;
  progress.done();
  install(build / "bullet_engine", options.program);
  fmt::print("{}\n", options.program.string());
  return 0;
}

}  // namespace

void add_engine(CLI::App& app, Invocation& call) {
  const auto options = std::make_shared<EngineOptions>();
  auto* engine =
      app.add_subcommand("engine", "builds Bullet's adapter against another version of Bullet, as a program for exec:");
  engine->add_option("NAME", options->what, "bullet")->required();
  engine->add_option("--prefix", options->prefix, "an installation or a source tree of Bullet")->required();
  engine->add_option("-o", options->program, "PROG: the program to write")->required();
  engine->callback([options, &call] { call.status = engine_command(*options); });
}

}  // namespace crosscheck
