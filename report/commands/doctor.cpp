// doctor: what is installed, what is missing, what each is for.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "reference/independent/integrators.h"
#include "report/commands/commands.h"
#include "report/run_program.h"

namespace crosscheck {
namespace {

struct Tool {
  const char* name;
  const char* package;  // Debian's
  const char* purpose;
  bool required;
};

}  // namespace

int doctor_command() {
  fmt::print("built with: {}\n", CROSSCHECK_COMPILER);
  fmt::print("  {:<14} {:<10} {}\n", "Eigen", CROSSCHECK_EIGEN_VERSION, "vectors and matrices");
  fmt::print("  {:<14} {:<10} {}\n", "Bullet", CROSSCHECK_BULLET_VERSION,
             "the engine that mysim is compared with (double precision; single in a program of its own)");
  fmt::print("  {:<14} {:<10} {}\n", "odeint", odeint_version(),
             "an independent integrator, of Boost: truth's other route");
  fmt::print("  {:<14} {:<10} {}{}\n", "SUNDIALS", sundials_version().value_or("absent"),
             "optional: a better one, in odeint's place",
             sundials_version() ? "" : "; apt-get install libsundials-dev, then build anew");
  fmt::print("  {:<14} {:<10} {}\n", "Benchmark", CROSSCHECK_BENCHMARK_VERSION,
             "Google's; optional: times kernels side by side for `bench`; of libbenchmark-dev");
  fmt::print("  {:<14} {:<10} {}\n\n", "OSMesa", "linked", "renders pictures without a display");

  static constexpr Tool tools[] = {
      {"gnuplot", "gnuplot-nox", "draws the figures", true},
      {"git", "git", "names the commit in tables and captions", false},
      {"ctest", "cmake", "runs the tests", true},
      {"python3", "python3-numpy", "runs the example of an outside engine, with NumPy; the tests need it", false},
      {"ffmpeg", "ffmpeg", "writes clips: `render -o FILE.mp4`", false},
      {"clang++", "clang", "another compiler, in which `regress --prove-builds` builds too", false},
      {"chromium", "chromium", "a browser: the tests try the page's player in it; prints the page as PDF", false},
  };
  bool complete = true;
  for (const Tool& tool : tools) {
    const bool found = on_path(tool.name);
    complete &= found || !tool.required;
    const std::string state = found ? "found" : tool.required ? "MISSING" : "absent";
    fmt::print("  {:<14} {:<10} {}{}\n", tool.name, state, tool.purpose,
               found ? "" : fmt::format("; apt-get install --no-install-recommends {}", tool.package));
  }
  fmt::print("\n{}\n", complete ? "all that is required is here" : "something required is missing");
  return complete ? 0 : 1;
}

}  // namespace crosscheck
