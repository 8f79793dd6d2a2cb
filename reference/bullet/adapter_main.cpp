// Bullet as a program of the engine protocol: the same worlds in another precision, or built against another Bullet.
//
//   PROGRAM scene.json OUTDIR [world=deformable-explicit | world=pbd ...] [options of that world]

#include <cstdio>
#include <filesystem>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/run/observers.h"
#include "reference/bullet/worlds.h"
#include "reference/protocol/run_json.h"
#include "reference/protocol/scene_json.h"
#include "reference/protocol/trajectory_files.h"

using namespace crosscheck;

namespace {

void run_task(const EngineTask& task, const std::filesystem::path& folder) {
  std::string world = "deformable-explicit";
  std::vector<std::string> options;
  for (const std::string& option : task.options) {
    if (option.starts_with("world="))
      world = option.substr(6);
    else
      options.push_back(option);
  }
  Recorder recorder;
  // a run that blew up ends here as it would inside: Bullet is not made to step through what is no number
  DivergenceMonitor monitor(task.scene, task.run);
  MonitoredObservers observers(monitor, {&recorder});
  const Outcome out = bullet::choose_world(world, options).engine(task.scene, task.run, observers);
  write_file(folder / "trajectory.npy", npy_bytes(recorder.trajectory.x));
  write_file(folder / "velocities.npy", npy_bytes(recorder.trajectory.v));
  write_file(folder / "run.json", run_json(out));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw InputError("expected: PROGRAM scene.json OUTDIR");
    run_task(read_scene_json(argv[1]), argv[2]);
    return 0;
  } catch (const Unsupported& lack) {
    std::fprintf(stderr, "%s\n", lack.what());
    return 3;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
