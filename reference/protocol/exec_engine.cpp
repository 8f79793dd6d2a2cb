#include "reference/protocol/exec_engine.h"

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <sstream>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "mysim/base/names.h"
#include "mysim/base/process.h"
#include "reference/protocol/run_json.h"
#include "reference/protocol/scene_json.h"
#include "reference/protocol/trajectory_files.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::optional<fs::path> find_in_path(const std::string& name) {
  if (name.empty()) return std::nullopt;
  const bool path_given = name.find('/') != std::string::npos;
  if (is_file(name) || (path_given && fs::is_directory(fs::path(name)))) return fs::absolute(name);
  if (path_given) return std::nullopt;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty() && is_file(fs::path(folder) / name)) return fs::absolute(fs::path(folder) / name);
  return std::nullopt;
}

double parse_timeout(const std::string& method, const std::string& value) {
  char* end = nullptr;
  const double seconds = std::strtod(value.c_str(), &end);
  if (value.empty() || *end != '\0' || !std::isfinite(seconds) || !(seconds > 0))
    throw InputError(fmt::format("method {}: timeout: expected seconds above zero, got '{}'", method, value));
  return std::min(seconds, 1e8);
}

}  // namespace

class Server {
 public:
  /// Allows use of the server. Called after a run in which the program reported a serve mode.
  void allow() { allowed_ = !failed_; }

  /// Runs the task in the server. Returns nullopt if the program does not serve, is busy in another thread, or gave no
  /// valid answer; the caller must then start the program for this task.
  std::optional<ProgramResult> run(const Program& program, const fs::path& task, const fs::path& results) {
    const std::unique_lock lock(busy_, std::try_to_lock);
    if (!lock || !allowed_) return std::nullopt;
    if (!process_ || !process_->is_mine())
      process_ = std::make_unique<LineServer>(std::vector{program.path.string(), std::string("--serve")}, ".");
    const Json request{{"scene", task.string()}, {"out", results.string()}};
    LineServer::Answer answer = process_->ask(request.dump(), program.timeout);
    ProgramResult end{.timed_out = answer.timed_out, .cpu_seconds = answer.cpu_seconds, .err = answer.err};
    try {
      if (!answer.timed_out) {
        const JsonField told = JsonField::parse(answer.line, "the server's answer");
        end.status = told["status"].whole_number(0, 255);
        if (const auto reason = told.find("reason"); reason && end.status != 0) end.err = reason->text();
        if (end.status != 0 && end.status != 3) process_.reset();  // a failed process may be ending or damaged
        return end;
      }
    } catch (const InputError&) {
      allowed_ = false, failed_ = true;
    }
    process_.reset();
    return answer.timed_out ? std::optional(end) : std::nullopt;
  }

 private:
  std::mutex busy_;
  bool allowed_ = false, failed_ = false;
  std::unique_ptr<LineServer> process_;
};

Program find_program(const std::string& text) {
  Program program;
  // the longest prefix that is a file: names may contain plus signs, option values may contain slashes
  size_t end = text.size();
  std::optional<fs::path> found = find_in_path(text);
  while (!found && end > 0 && (end = text.rfind('+', end - 1)) != std::string::npos)
    found = find_in_path(text.substr(0, end));
  if (!found)
    throw InputError(
        fmt::format("method exec:{}: no such file; expected the path of a program, or a program in PATH", text));
  program.path = *found;
  program.server = std::make_shared<Server>();
  if (fs::is_directory(program.path))
    throw InputError(fmt::format("method exec:{}: {} is a folder; expected a program", text, program.path.string()));
  if (access(program.path.c_str(), X_OK) != 0)
    throw InputError(fmt::format("method exec:{}: {} is not executable; expected a program (chmod +x makes it one)",
                                 text, program.path.string()));
  if (end == text.size()) return program;
  std::istringstream options(text.substr(end + 1));
  for (std::string option; std::getline(options, option, '+');) add_option(program, "exec:" + text, option);
  return program;
}

void add_option(Program& program, const std::string& method, const std::string& option) {
  if (option.starts_with("timeout="))
    program.timeout = parse_timeout(method, option.substr(8));
  else
    program.options.push_back(option);
}

namespace {

/// The last non-blank line, printable and short enough for a table.
std::string last_line(const std::string& text) {
  const size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string::npos) return "";
  const size_t begin = text.find_last_of('\n', last);
  std::string line = text.substr(begin == std::string::npos ? 0 : begin + 1);
  line.erase(line.find_last_not_of(" \t\r\n") + 1);
  if (line.size() > 300) line = line.substr(0, 300) + " ...";
  return printable(line);
}

std::string exit_text(const ProgramResult& end) {
  if (end.signal != 0) return fmt::format("was ended by signal {} ({})", end.signal, strsignal(end.signal));
  return fmt::format("ended with exit status {}", end.status);
}

Outcome failed(Outcome out, Verdict verdict, const std::string& what, const ProgramResult& end) {
  const std::string last_stderr_line = last_line(end.err);
  out.verdict = verdict;
  out.reason =
      "the program " + what + (last_stderr_line.empty() ? "" : "; last line of its stderr: " + last_stderr_line);
  out.readback.reset();
  out.end = 0;
  return out;
}

/// Maximum size of run.json in bytes. A number with its blank and comma takes 26 bytes. A particle has 27 numbers
/// (mass, pin, drag, two vectors of the start, five of the probe, one of later positions): 702 bytes. A link has 4, and
/// 60 bytes for its keys: 164 bytes. Three times these sizes plus a mebibyte leaves room for line breaks and texts.
std::uintmax_t largest_run_json(const Scene& scene) {
  const auto* springs = scene.model.find<Springs>();
  const auto* constraints = scene.model.find<Constraints>();
  const std::uintmax_t links = (springs ? springs->list.size() : 0) + (constraints ? constraints->list.size() : 0);
  return (1 << 20) + 2106 * static_cast<std::uintmax_t>(scene.model.particles.size()) + 492 * links;
}

}  // namespace

void require_result_files(const fs::path& folder, const Scene& scene) {
  for (const char* file : {"run.json", "trajectory.npy", "velocities.npy"}) {
    const fs::file_status status = fs::symlink_status(folder / file);
    if (fs::exists(status) && !fs::is_regular_file(status))
      throw InputError(fmt::format("{}: expected a file, got {}", file,
                                   fs::is_symlink(status)     ? "a symbolic link"
                                   : fs::is_directory(status) ? "a folder"
                                                              : "a device, pipe or socket"));
  }
  const fs::path told = folder / "run.json";
  const auto size = fs::exists(told) ? fs::file_size(told) : 0, most = largest_run_json(scene);
  if (size > most)
    throw InputError(fmt::format("run.json: expected at most {} bytes for a scene of this size, got {}", most, size));
}

namespace {

/// Throws InputError if the results violate the protocol.
Frames read_results(const fs::path& folder, const Scene& scene, const Run& run, Outcome& out) {
  require_result_files(folder, scene);
  if (fs::exists(folder / "run.json")) read_run_json(folder / "run.json", out, run.duration);
  if (!fs::exists(folder / "trajectory.npy")) throw InputError("trajectory.npy: missing in the folder for results");
  Frames frames{read_positions(folder / "trajectory.npy", scene, run, out.verdict != Verdict::ok), {}};
  const int count = static_cast<int>(frames.x.size());
  if (!scene.model.first_order() && fs::exists(folder / "velocities.npy"))
    frames.v = read_npy(folder / "velocities.npy", count, count, scene.model.particles.size());
  return frames;
}

}  // namespace

// Allowed deviation: sixteen half ulps of the pin's initial position, of its displacement and of their sum, as for the
// first frame. Half an ulp is 2^-53, or 2^-24 if the engine's precision is single or unknown. A program that adds up
// its steps also loses half an ulp of the time per step, during which the pin moves along its path.
std::string misled_pin(const Frames& frames, const Scene& scene, const Run& run, const Outcome& out) {
  const Particles& particles = scene.model.particles;
  const TimeGrid grid = time_grid(run);
  const auto is_float = [](double value) { return static_cast<double>(static_cast<float>(value)) == value; };
  const auto is_single = [&](const Points& x) { return std::ranges::all_of(x.reshaped(), is_float); };
  const bool is_double =
      out.readback && out.readback->precision == "double" && !std::ranges::all_of(frames.x, is_single);
  const double ulp = std::ldexp(1, is_double ? -53 : -24),
               path = particles.move ? max_speed(*particles.move) * run.duration : 0,
               steps = static_cast<double>(grid.samples) * grid.steps_per_sample,
               allowed = ulp * (16 * (scene.size() + largest_column(scene.start.x)) + (16 + steps) * path);
  double worst = 0, when = 0;
  int which = -1;
  for (size_t frame = 0; frame < frames.x.size(); ++frame) {
    const double t = grid.time(static_cast<int>(frame), 0);
    const Vec3 moved = particles.move ? displacement_at(*particles.move, t) : Vec3::Zero();
    for (size_t i = 0; i < particles.pins.size(); ++i) {
      const Vec3 off = frames.x[frame].col(particles.pins[i]) - particles.pin_home.col(static_cast<int>(i)) - moved;
      // a non-finite value fails the run anyway
      if (off.norm() > std::max(worst, allowed)) worst = off.norm(), when = t, which = particles.pins[i];
    }
  }
  if (which < 0) return "";
  return fmt::format(
      "it moved the pinned particle {} off its prescribed path: by {:.3g} m at t = {:.4g} s, where "
      "rounding explains {:.2g} m",
      which, worst, when, allowed);
}

Outcome run_outside_engine(const Program& program, const Scene& scene, const Run& asked, Observer& observer) {
  // requests every state on which verdicts are based, so that the program is judged like other engines
  const TimeGrid grid = time_grid(asked);
  const int per_sample =
      observer.between_samples() ? grid.steps_per_sample / verdict_stride(grid, scene.model.particles.size()) : 1;
  Run run = asked;
  run.samples *= per_sample;
  const TemporaryFolder folder("engine");
  const fs::path task = folder.path / "scene.json", results = folder.path / "out";
  write_file(task, scene_json(scene, run, program.options));
  fs::create_directory(results);

  Outcome out;
  out.step = grid.h;
  ProgramResult end;
  try {
    if (auto served = program.server ? program.server->run(program, task, results) : std::nullopt)
      end = std::move(*served);
    else
      end = run_program({program.path.string(), task.string(), results.string()}, ".", {}, program.timeout);
  } catch (const CannotStart& error) {
    out.verdict = Verdict::crash;
    out.reason = fmt::format("{} cannot be started: {}", program.path.string(), error.reason);
    return out;
  }
  out.process_seconds = end.cpu_seconds;
  if (end.timed_out)
    return failed(out, Verdict::timeout, fmt::format("did not end within {:g} s and was killed", program.timeout), end);
  if (end.signal == 0 && end.status == 3) {
    const std::string last_stderr_line = last_line(end.err),
                      why = last_stderr_line.empty() ? last_line(end.out) : last_stderr_line;
    throw Unsupported(why.empty() ? "the program refused the scene (exit status 3) without a reason" : why);
  }
  if (end.killed_watcher)
    return failed(out, Verdict::crash,
                  "killed its supervising process; its remaining processes may still run, because this kernel permits "
                  "no pid namespace",
                  end);
  if (end.signal != 0 || end.status != 0) return failed(out, Verdict::crash, exit_text(end), end);

  Frames frames;
  try {
    frames = read_results(results, scene, run, out);
  } catch (const std::exception& broken) {
    std::string what = broken.what();
    if (what.starts_with(results.string() + "/")) what.erase(0, results.string().size() + 1);
    Outcome none;
    none.step = grid.h;
    none.process_seconds = end.cpu_seconds;
    return failed(none, Verdict::crash, "gave no valid answer: " + what, end);
  }
  if (out.serves && out.cpu_seconds > 0 && program.server) program.server->allow();  // cpu_seconds is without start-up
  const Verdict reported = out.verdict;
  const std::string misled = misled_pin(frames, scene, run, out);
  replay(frames, scene, run, observer, out, per_sample);
  if (reported != Verdict::ok && out.reason.empty()) out.reason = "reported by the program without a reason";

  auto remark = [&](const std::string& what) { out.remark += (out.remark.empty() ? "" : "; ") + what; };
  if (const std::string last_stderr_line = last_line(end.err); !last_stderr_line.empty())
    remark("last line of its stderr: " + last_stderr_line);
  if (!misled.empty()) remark(misled);
  if (end.left_children) remark("it left a process behind, which was killed");
  const double rounding = out.readback && out.readback->precision == "single" ? 0x1p-23 : 1e-12;
  if (std::abs(out.step - grid.h) <= rounding * grid.h)
    out.step = grid.h;
  else if (!out.adaptive)
    remark(fmt::format("it used a step of {:.6g} s instead of {:.6g} s", out.step, grid.h));
  return out;
}

}  // namespace crosscheck
