// One run of an outside program: a folder of its own, scene.json in, files out.
#include "reference/protocol/exec_engine.h"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>

#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/json.h"
#include "mysim/temporary_folder.h"
#include "reference/npy.h"
#include "reference/protocol/delivery.h"
#include "reference/protocol/process.h"
#include "reference/protocol/run_json.h"
#include "reference/protocol/scene_json.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

/// The last line that says something: valid UTF-8, no control characters, not too long for a table.
std::string last_line(const std::string& text) {
  const size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string::npos) return "";
  const size_t begin = text.find_last_of('\n', last);
  std::string line = text.substr(begin == std::string::npos ? 0 : begin + 1);
  line.erase(line.find_last_not_of(" \t\r\n") + 1);
  if (line.size() > 300) line = line.substr(0, 300) + " ...";
  line = JsonField::parse(Json(line).dump(), "stderr").text();  // bytes that are no UTF-8 are replaced
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
  return line;
}

std::string how_it_ended(const ProcessEnd& end) {
  if (end.signal != 0) return fmt::format("was ended by signal {} ({})", end.signal, strsignal(end.signal));
  return fmt::format("ended with exit status {}", end.status);
}

Outcome failed(Outcome out, Verdict verdict, const std::string& what, const ProcessEnd& end) {
  const std::string said = last_line(end.err);
  out.verdict = verdict;
  out.reason = "the program " + what + (said.empty() ? "" : "; last line of its stderr: " + said);
  out.readback.reset();
  out.end = 0;
  return out;
}

/// Reads what the program wrote. Throws InputError where it is not what the protocol asks.
Frames read_delivery(const fs::path& folder, const Scene& scene, const Run& run, Outcome& out) {
  for (const char* file : {"run.json", "trajectory.npy", "velocities.npy"}) {
    const fs::file_status status = fs::status(folder / file);
    if (fs::exists(status) && !fs::is_regular_file(status)) throw InputError(fmt::format("{}: expected a file", file));
  }
  if (fs::exists(folder / "run.json")) read_run_json(folder / "run.json", out);
  if (!fs::exists(folder / "trajectory.npy")) throw InputError("trajectory.npy: missing in the folder for results");
  Frames frames{read_positions(folder / "trajectory.npy", scene, run, out.verdict != Verdict::ok), {}};
  const int count = static_cast<int>(frames.x.size());
  if (!scene.model.first_order() && fs::exists(folder / "velocities.npy"))
    frames.v = read_npy(folder / "velocities.npy", count, count, scene.model.particles.size());
  return frames;
}

}  // namespace

Outcome run_program(const Program& program, const Scene& scene, const Run& run, Observer& observer) {
  const TemporaryFolder folder("engine");
  const fs::path task = folder.path / "scene.json", results = folder.path / "out";
  write_file(task, scene_json(scene, run, program.options));
  fs::create_directory(results);

  Outcome out;
  out.step = plan(run).h;
  ProcessEnd end;
  try {
    end = run_process({program.path.string(), task.string(), results.string()}, program.timeout);
  } catch (const std::runtime_error& error) {
    out.verdict = Verdict::crash;
    out.reason = error.what();
    return out;
  }
  out.process_seconds = end.cpu_seconds;
  if (end.timed_out)
    return failed(out, Verdict::timeout, fmt::format("did not end within {:g} s and was killed", program.timeout), end);
  if (end.signal == 0 && end.status == 3) {
    const std::string said = last_line(end.err), why = said.empty() ? last_line(end.out) : said;
    throw Unsupported(why.empty() ? "the program says so (exit status 3) and gives no reason" : why);
  }
  if (end.signal != 0 || end.status != 0) return failed(out, Verdict::crash, how_it_ended(end), end);

  Frames frames;
  try {
    frames = read_delivery(results, scene, run, out);
  } catch (const std::exception& broken) {
    std::string what = broken.what();
    if (what.starts_with(results.string() + "/")) what.erase(0, results.string().size() + 1);
    Outcome none;
    none.step = plan(run).h;
    none.process_seconds = end.cpu_seconds;
    return failed(none, Verdict::crash, "did not deliver: " + what, end);
  }
  const Verdict told = out.verdict;
  play(frames, scene, run, observer, out);
  if (told != Verdict::ok && out.reason.empty()) out.reason = "by the program's own word";

  auto remark = [&](const std::string& what) { out.remark += (out.remark.empty() ? "" : "; ") + what; };
  if (const std::string said = last_line(end.err); !said.empty()) remark("it wrote on stderr, last: " + said);
  if (end.left_children) remark("it left a process behind that kept its output open, which was killed");
  if (out.step != plan(run).h)
    remark(fmt::format("it took steps of {:.6g} s, asked were {:.6g} s", out.step, plan(run).h));
  return out;
}

}  // namespace crosscheck
