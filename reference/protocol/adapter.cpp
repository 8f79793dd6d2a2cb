#include "reference/protocol/adapter.h"

#include <cstdio>
#include <filesystem>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/run/observers.h"
#include "reference/protocol/run_json.h"
#include "reference/protocol/scene_json.h"
#include "reference/protocol/trajectory_files.h"

namespace crosscheck {

int run_as_program(int argc, char** argv, const std::function<Engine(const std::vector<std::string>&)>& engine_of) {
  try {
    if (argc != 3) throw InputError("expected: PROGRAM scene.json OUTDIR");
    const EngineTask task = read_scene_json(argv[1]);
    const std::filesystem::path folder = argv[2];
    Recorder recorder;
    // end a diverged run here, as for built-in engines, instead of stepping the engine through non-finite states
    DivergenceMonitor monitor(task.scene, task.run);
    MonitoredObservers observers(monitor, {&recorder});
    const Outcome out = engine_of(task.options)(task.scene, task.run, observers);
    write_file(folder / "trajectory.npy", npy_bytes(recorder.trajectory.x));
    write_file(folder / "velocities.npy", npy_bytes(recorder.trajectory.v));
    write_file(folder / "run.json", run_json(out));
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

}  // namespace crosscheck
