// The command `engine` runs a student's part in the sandbox as a program of the engine protocol
// (reference/protocol/PROTOCOL.md). Converts scene.json into the numbers of one call, and the answer into the
// trajectory.
#include "tests/coursework/grader/engine.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "mysim/base/text.h"
#include "reference/protocol/crosscheck_engine.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/commands.h"
#include "tests/coursework/grader/run.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

using crosscheck_engine::Scene;
using crosscheck_engine::Vec;

/// Limits per run. The charts' scenes have one moving particle and take at most a second. There are a thousand runs, so
/// an endless loop must be stopped early.
constexpr Limits engine_limits{
    .cpu = 10, .wall = 300, .idle = 5, .memory = 1024, .processes = 0, .answers = 1 << 18, .file = 1};

/// Limit on the CPU time (s) of all runs of a part, several times the time that the integrators in the hand-out
/// need. Beyond the limit, runs fail immediately.
constexpr double most_in_all = 300;

/// CPU time of a part so far, stored in a file beside its program, because runs are separate, parallel processes.
class Spent {
 public:
  explicit Spent(const std::string& program) : file_(program + ".spent") {}
  double sum() const {
    std::istringstream lines(crosscheck::try_read_file(file_).value_or(""));
    double sum = 0;
    for (double one; lines >> one;) sum += one;
    return sum;
  }
  void add(double seconds) const {
    std::ofstream(file_, std::ios::app) << fmt::format("{:.3f}\n", seconds) << std::flush;
  }

 private:
  std::string file_;
};

Case call_of(const std::string& part, const Scene& scene) {
  Case what;
  what.call = "engine." + part;
  const auto add = [&](auto... numbers) { (what.in.push_back(static_cast<double>(numbers)), ...); };
  add(scene.step, scene.steps_per_sample, scene.samples, scene.x.size());
  for (std::size_t i = 0; i < scene.x.size(); ++i) add(scene.mass[i], scene.drag[i], scene.pinned[i]);
  add(scene.gravity[0], scene.gravity[1], scene.gravity[2], scene.springs.size());
  for (const auto& s : scene.springs) add(s.a, s.b, s.stiffness, s.rest_length);
  for (const auto* vectors : {&scene.x, &scene.v})
    for (const Vec& v : *vectors) add(v[0], v[1], v[2]);
  return what;
}

void require_known(const Scene& scene) {
  scene.require_only({"springs", "drag", "gravity"});
  if (scene.mass.empty()) crosscheck_engine::unsupported("no first-order scenes");
  if (scene.pins_move) crosscheck_engine::unsupported("no pins that move");
  if (scene.spring_law != "hooke") crosscheck_engine::unsupported("no springs but Hooke's");
}

}  // namespace

int engine_command(const EngineCommand& command) {
  const Spent spent(command.program);
  if (spent.sum() > most_in_all)
    throw std::runtime_error(
        fmt::format("the student's code took more than {:g} s in the charts; no more of it is run", most_in_all));
  const Scene scene = crosscheck_engine::read_scene(command.scene);
  require_known(scene);
  const auto sandbox = sandbox_named(command.sandbox);
  const auto begin = std::chrono::steady_clock::now();
  double cpu = 0;
  const Answer answer = run_calls(*sandbox, command.program, {call_of(command.part, scene)}, engine_limits, &cpu).at(0);
  // counts the wall-clock time of a program that waits without using CPU time, because it delays the charts too
  const double clock = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  spent.add(answer.how == How::waiting ? clock : cpu);
  const std::size_t n = scene.x.size(), frames = static_cast<std::size_t>(scene.samples) + 1;
  if (answer.how != How::answered)
    throw std::runtime_error("the student's code did not answer" + (answer.detail.empty() ? "" : ": " + answer.detail));
  if (answer.got.size() != 6 * n * frames + 2) throw std::runtime_error("the student's code answered something else");
  std::vector<std::vector<Vec>> x(frames, std::vector<Vec>(n)), v = x;
  for (std::size_t f = 0; f < frames; ++f)
    for (std::size_t i = 0; i < 3 * n; ++i) {
      x[f][i / 3][i % 3] = answer.got[6 * n * f + i];
      v[f][i / 3][i % 3] = answer.got[6 * n * f + 3 * n + i];
    }
  crosscheck_engine::write_npy(command.folder + "/trajectory.npy", x);
  crosscheck_engine::write_npy(command.folder + "/velocities.npy", v);
  const double evaluations = answer.got[answer.got.size() - 2], seconds = answer.got.back();
  if (!(evaluations >= 0 && evaluations < 1e15 && seconds >= 0))
    throw std::runtime_error("the student's code answered something else");
  crosscheck_engine::RunReport report;
  report.cpu_seconds = seconds;
  report.steps = static_cast<long>(scene.samples) * scene.steps_per_sample;
  report.force_evaluations = static_cast<long>(evaluations);
  crosscheck_engine::write_run_json(command.folder + "/run.json", report);
  return 0;
}

bool has_engine(const Assignment& assignment) { return fs::exists(assignment.folder() / "calls_engine.cpp"); }

void keep_engine(const fs::path& program, const std::string& part, const Sandbox& sandbox, const fs::path& folder) {
  fs::create_directories(folder);
  const std::string name = "your-" + part;  // distinct from mysim's rule of the same name
  const fs::path kept = folder / (name + ".program"), script = folder / name;
  fs::copy_file(program, kept, fs::copy_options::overwrite_existing);
  fs::permissions(kept, fs::perms(0755));
  // The script contains a hash of the program, because caches of results read only the script. It finds the program
  // next to itself, so both files can be moved together, into a folder with any name
  crosscheck::write_file(
      script,
      fmt::format("#!/bin/sh\n# {:016x}\nexec {} engine \"$(dirname -- \"$0\")\"/{} {} \"$1\" \"$2\" --lane {}\n",
                  crosscheck::Fnv1a::of(content_of_file(program)),
                  crosscheck::shell_single_quote(fs::read_symlink("/proc/self/exe").string()),
                  crosscheck::shell_single_quote(kept.filename().string()), part, sandbox.name()));
  fs::permissions(script, fs::perms(0755));
}

}  // namespace coursework
