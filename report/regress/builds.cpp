#include "report/regress/builds.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "report/run_program.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

/// The C library as it is from 2.33 on, whose variants of sin, exp and pow can be chosen from outside.
bool library_obeys() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
  return true;
#else
  return false;
#endif
}

bool fused_here() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

}  // namespace

const std::vector<Build>& builds() {
  // without optimisation everything takes up to 350 times as long: all scenes would be an hour
  constexpr auto small = "!(cloth*|flag*|jelly*)";
  static const std::vector<Build> table = {
      {"gcc-O3", "g++", "g++", "Release", "-O3 -DNDEBUG", ""},
      {"gcc-O2", "g++", "g++", "Release", "-O2 -DNDEBUG", ""},
      {"gcc-assert", "g++", "g++", "Debug", "-O2", ""},
      {"gcc-debug", "g++", "g++", "Debug", "-g", "", small},
      {"clang-O3", "clang++", "clang", "Release", "-O3 -DNDEBUG", ""},
      {"clang-O2", "clang++", "clang", "Release", "-O2 -DNDEBUG", ""},
      {"clang-debug", "clang++", "clang", "Debug", "-g", "", small},
      // Eigen's products and sums in fours, fused: written so in its source, whatever -ffp-contract says
      {"gcc-O3-avx2", "g++", "g++", "Release", "-O3 -DNDEBUG -march=x86-64-v3", "", "", true},
      // this program with the C library's other variants of sin, exp and pow, which round twice where these fuse
      {"no-fma", "", "", "", "", "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F", "", true},
  };
  return table;
}

std::string missing_for(const Build& build) {
  if (build.compiled() && !on_path(build.compiler))
    return fmt::format("{} (package {})", build.compiler, build.package);
  if (build.fused && !fused_here()) return "a processor with AVX2 and fused multiply-adds";
  if (!build.compiled() && !library_obeys()) return "the GNU C library from 2.33 on";
  return "";
}

Built built(const Build& build) {
  const fs::path source = fs::path(CROSSCHECK_SOURCE_DIR).parent_path(), folder = source / "build/builds" / build.name;
  std::string type = build.type;
  std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return std::toupper(c); });
  const auto jobs = std::to_string(std::max(1u, std::thread::hardware_concurrency()));
  const std::vector<std::vector<std::string>> commands = {
      {"cmake", "-S", source.string(), "-B", folder.string(), "-G", "Ninja", "-DCMAKE_CXX_COMPILER=" + build.compiler,
       "-DCMAKE_BUILD_TYPE=" + build.type, fmt::format("-DCMAKE_CXX_FLAGS_{}={}", type, build.flags)},
      {"cmake", "--build", folder.string(), "--parallel", jobs, "--target", "crosscheck", "bullet32_engine"}};
  for (const auto& command : commands) {
    const ProgramResult result = run_program(command, source);
    if (result.status != 0) return {folder / "crosscheck", last_lines(result.out + result.err, 30)};
  }
  return {folder / "crosscheck", ""};
}

}  // namespace crosscheck
