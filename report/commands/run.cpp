// run: one method on one scene; writes trajectory.npy, velocities.npy, energy.csv, run.json.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "experiments/experiment.h"
#include "experiments/scenes.h"
#include "mysim/errors.h"
#include "mysim/files.h"
#include "reference/frame_files.h"
#include "report/commands/commands.h"
#include "report/provenance.h"

namespace crosscheck {
namespace {

std::string run_json(const Scene& scene, const Method& method, const Outcome& out, const std::vector<double>& times) {
  nlohmann::ordered_json json{{"scene", scene.name},
                              {"scene_hash", scene.hash},
                              {"method", method.name},
                              {"step", out.step},
                              {"tolerance", out.tolerance > 0 ? nlohmann::ordered_json(out.tolerance) : nullptr},
                              {"times", times},
                              {"verdict", name_of(out.verdict)},
                              {"reason", out.reason},
                              {"end", out.end},
                              {"steps", out.steps},
                              {"force_evaluations", out.evaluations},
                              {"coincident_springs", out.coincident},
                              {"cpu_seconds", out.cpu_seconds},
                              {"process_seconds", out.process_seconds},
                              {"remark", out.remark},
                              {"different_law", out.different_law}};
  return json.dump(1) + "\n";
}

}  // namespace

int run_command(const RunOptions& options) {
  const Scene scene = load_scene(options.scene);
  const Method method = find_method(options.method.empty() ? scene.method : options.method);
  const bool adaptive = method.adaptive;
  if (options.tolerance > 0 && !adaptive)
    throw InputError(fmt::format("--tol: {} is a fixed-step method; expected --step (s)", method.name));
  if (options.step > 0 && adaptive)
    throw InputError(fmt::format("--step: {} chooses its own steps; expected --tol (relative)", method.name));
  Run run = default_run(scene);
  if (options.step > 0) run.step = options.step;
  if (options.tolerance > 0) run.tolerance = options.tolerance;
  if (options.duration > 0) {
    // the sampling interval stays near the scene's own
    run.samples = std::max(1, static_cast<int>(std::lround(scene.samples * options.duration / scene.duration)));
    run.duration = options.duration;
  }
  if (run.step > run.duration)
    throw InputError(fmt::format("--step: expected at most the duration of {} s, got {}", run.duration, run.step));
  require_writable(options.out);

  FrameFiles frames(options.out);
  Ledger ledger(scene.model, method.contact);
  std::vector<Observer*> observers{&frames};
  if (!scene.model.first_order()) observers.push_back(&ledger);
  const Outcome out = run_method(method, scene, run, observers);
  if (out.verdict == Verdict::unsupported) {
    fmt::print(stderr, "crosscheck: {} cannot run {}: {}\n", method.name, scene.name, out.reason);
    return 1;
  }

  frames.finish();
  if (!ledger.rows().empty()) {  // none without velocities
    Table energy = ledger_table("energy");
    add_ledger(energy, method.name, ledger.rows(), ledger.contact_inferred());
    write_csv(energy, with_scene(provenance(options.command_line), scene), options.out);
  }
  write_file(options.out / "run.json", run_json(scene, method, out, frames.times()));
  fmt::print("{} by {}: {}{}\n", scene.name, method.name, in_words(out.verdict),
             out.reason.empty() ? "" : ", " + out.reason);
  fmt::print("  {} steps of {:.6g} s{}, {} force evaluations, {:.3g} s of CPU time, {} frames\n", out.steps, out.step,
             adaptive ? fmt::format(" in the mean (relative tolerance {:.3g})", out.tolerance) : "", out.evaluations,
             out.cpu_seconds, frames.times().size());
  if (!out.remark.empty()) fmt::print("  {}\n", out.remark);
  if (out.coincident > 0) fmt::print("  springs met at zero length {} times and got no force there\n", out.coincident);
  fmt::print("  {}\n", options.out.string());
  return 0;
}

}  // namespace crosscheck
