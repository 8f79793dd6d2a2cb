#include "experiments/stability/margin.h"
#include "experiments/tables/energy.h"
#include "mysim/run/crossings.h"
#include "reference/protocol/trajectory_files.h"
#include "report/base/mesh_files.h"
#include "report/commands/command_line.h"

namespace crosscheck {
namespace {

struct RunOptions {
  std::string scene, method, meshes;             // empty `meshes`: none
  double step = 0, tolerance = 0, duration = 0;  // 0: as in the scene
  std::filesystem::path out = "out/run";
  std::string command_line;
};

std::string run_json(const Scene& scene, const Method& method, const Outcome& out, const std::vector<double>& times) {
  Json json{{"scene", scene.name},
            {"scene_hash", scene.hash},
            {"method", method.name},
            {"step", out.step},
            {"tolerance", out.tolerance > 0 ? Json(out.tolerance) : Json()},
            {"times", times},
            {"verdict", name_of(out.verdict)},
            {"reason", out.reason},
            {"end", out.end},
            {"steps", out.steps},
            {"force_evaluations", out.evaluations},
            {"coincident_springs", out.degenerate_springs},
            {"cpu_seconds", out.cpu_seconds},
            {"process_seconds", out.process_seconds},
            {"remark", out.remark},
            {"different_law", out.different_law}};
  return dump(json, 1) + "\n";
}

int run_command(const RunOptions& options) {
  const Scene scene = load_scene(options.scene, options.method);
  const Method method = find_method(options.method.empty() ? scene.method : options.method);
  const bool adaptive = method.adaptive;
  if (options.tolerance > 0 && !adaptive)
    throw InputError(fmt::format("--tol: {} is a fixed-step method; expected --step (s)", method.name));
  if (options.step > 0 && adaptive)
    throw InputError(fmt::format("--step: {} chooses its own steps; expected --tol (relative)", method.name));
  Run run = default_run(scene);
  if (options.step > 0) run.step = options.step;
  if (options.tolerance > 0) run.tolerance = options.tolerance;
  if (options.duration > 0) run = with_duration(method, scene, run, options.duration);
  if (run.step > run.duration && options.step > 0)
    throw InputError(fmt::format("--step: expected at most the duration of {} s, got {}", run.duration, run.step));
  if (run.step > run.duration && !adaptive)
    throw InputError(
        fmt::format("--duration: expected at least one step of {} s, which is {}'s own, got {} s; --step "
                    "gives a shorter one",
                    run.step, scene.name, run.duration));
  require_resources_to_write(method, scene, run, options.out);
  OutputFolder folder(options.out, "run");
  std::optional<MeshWriter> meshes;
  if (!options.meshes.empty()) meshes.emplace(folder.path() / "meshes", scene, options.meshes);

  TrajectoryWriter frames(folder.path());
  Ledger ledger(scene.model, method.contact);
  CrossingObserver crossings(scene, run.samples);
  std::vector<Observer*> observers{&frames, &crossings};
  if (!scene.model.first_order()) observers.push_back(&ledger);
  if (meshes) observers.push_back(&*meshes);
  Progress progress(1);
  Outcome out = run_method(with_progress(method, progress), scene, run, observers);
  progress.done();
  if (out.verdict == Verdict::unsupported) {
    fmt::print(stderr, "crosscheck: {} cannot run {}: {}\n", method.name, scene.name, out.reason);
    return 1;
  }

  frames.finish();
  crossings.note(out);
  if (out.verdict == Verdict::ok)
    if (const std::string outlook = stability_warning(method, scene, out.step); !outlook.empty())
      out.remark += (out.remark.empty() ? "" : "; ") + outlook;
  if (!ledger.rows().empty()) {  // there are no energies if velocities are missing
    Table energy = table_of<SceneEnergyRow>("energy");
    add_ledger(energy, method.name, ledger.rows(), ledger.contact_inferred());
    write_csv(energy, with_scene(provenance(options.command_line), scene), folder.path());
  }
  write_file(folder.path() / "run.json", run_json(scene, method, out, frames.times()));
  folder.finish();
  fmt::print("{} by {}: {}{}\n", scene.name, method.name, in_words(out.verdict),
             out.reason.empty() ? "" : ", " + out.reason);
  // an external program that does not report a count has 0 here
  const bool outside = out.process_seconds > 0;
  const auto counted = [&](long count, const char* what) {
    return count > 0 || !outside ? fmt::format("{} {}", count, what) : fmt::format("{} (number not reported)", what);
  };
  fmt::print("  {} of {:.6g} s{}, {}, {}, {} frames\n", counted(out.steps, "steps"), out.step,
             adaptive ? fmt::format(" on average (relative tolerance {:.3g})", out.tolerance) : "",
             counted(out.evaluations, "force evaluations"),
             out.cpu_seconds > 0 || !outside
                 ? fmt::format("{:.3g} s of CPU time", out.cpu_seconds)
                 : fmt::format("{:.3g} s of CPU time including its start", out.process_seconds),
             frames.times().size());
  if (!out.remark.empty()) fmt::print("  {}\n", out.remark);
  if (out.degenerate_springs > 0)
    fmt::print("  springs had zero length, and thus no force, {} times\n", out.degenerate_springs);
  if (meshes) fmt::print("  {} meshes, from meshes/frame-0001.{} on\n", meshes->frames(), options.meshes);
  fmt::print("  {}\n", options.out.string());
  return 0;
}

}  // namespace

void add_run(CLI::App& app, Invocation& call) {
  auto [run, options] = add_command(
      app, call, "run", "runs one method on a scene and writes trajectory, energies and verdict", run_command);
  run.add_option("SCENE", options.scene, "a shipped scene or a TOML file")->required();
  run.add_option("--method", options.method, "the method (default: the scene's own)");
  run.add_option("--step", options.step, "time step of fixed-step methods, s")->transform(time_above_zero());
  run.add_option("--tol", options.tolerance, "relative tolerance of adaptive methods")->transform(above_zero());
  run.add_option("--duration", options.duration, "simulated time, s")->transform(time_above_zero());
  run.add_option("--meshes", options.meshes,
                 "obj or ply: writes each sample as a file in DIR/meshes: triangles of cloths, lines of springs, and "
                 "spheres");
  run.add_option("--out", options.out, "folder (out/run)");
}

}  // namespace crosscheck
