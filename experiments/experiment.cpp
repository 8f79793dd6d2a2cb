// The table of experiments.
#include "experiments/experiment.h"

#include <fmt/format.h>

#include "experiments/disagreements/disagreements.h"
#include "mysim/errors.h"

namespace crosscheck {
namespace {

int one_per_scene(const Request& request) { return static_cast<int>(request.scenes.size()); }
int one_per_run(const Request& request) {
  int runs = 0;
  for (const Scene& scene : request.scenes) runs += static_cast<int>(methods_of(request, scene).size());
  return runs;
}

int three_steps_and_two_iterations(const Request&) { return 3 + 2; }
int one_per_disagreement(const Request&) { return static_cast<int>(disagreements().size()); }

}  // namespace

std::span<const Experiment> experiments() {
  static constexpr Experiment table[] = {
      {"order", "How fast does the error fall when the step is made smaller?", order_experiment, one_per_scene},
      {"energy", "Where does the energy go, and what does not add up?", energy_experiment, one_per_run},
      {"engines", "Do mysim and Bullet agree on the same scene, and at what cost?", engines_experiment, one_per_run},
      {"stiffness", "How stiff is a position-based link, against the formula that hands it over?", stiffness_experiment,
       three_steps_and_two_iterations},
      {"disagreements", "Where does Bullet answer otherwise than it is asked, and by how much?",
       disagreements_experiment, one_per_disagreement},
  };
  return table;
}

const Experiment& find_experiment(const std::string& name) {
  std::string known;
  for (const Experiment& e : experiments()) {
    if (e.name == name) return e;
    known += (known.empty() ? "" : ", ") + std::string(e.name);
  }
  throw InputError(fmt::format("unknown experiment '{}'; expected one of: {}", name, known));
}

std::vector<Method> methods_of(const Request& request, const Scene& scene) {
  if (!request.methods.empty()) return request.methods;
  std::vector<Method> methods;
  // truth is what the others are held against, integrators of others are no engines, and single precision doubles the
  // work where few scenes ask about it: these run when they are named
  for (Method& method : all_methods())
    if (method.name.starts_with("mysim/") || method.name.starts_with("bullet/")) methods.push_back(std::move(method));
  if (scene.model.find<Spheres>()) methods.push_back(find_method("mysim/symplectic-euler+sticky"));
  return methods;
}

Run run_of(const Request& request, const Scene& scene) {
  Run run = default_run(scene);
  if (request.step > 0) run.step = request.step;
  return run;
}

Answer& answer_of(const Request& request, const Scene& scene, const Method& method, Result& result) {
  for (Answer& a : result.answers)
    if (a.scene == scene.name && a.method == method.name) return a;
  Recorder recorder;
  std::vector<Observer*> observers{&recorder};
  Ledger ledger(scene.model, method.contact);
  if (!scene.model.first_order()) observers.push_back(&ledger);
  Outcome out = run_method(method, scene, run_of(request, scene), observers);
  const bool unsupported = out.verdict == Verdict::unsupported;  // found out during the run, perhaps
  if (unsupported) recorder.trajectory = {};
  return result.answers.emplace_back(Answer{scene.name, method.name, std::move(out), std::move(recorder.trajectory),
                                            unsupported ? std::vector<LedgerRow>() : ledger.rows(),
                                            ledger.contact_inferred()});
}

const Table* Result::table(const std::string& name) const {
  for (const Table& t : tables)
    if (t.name == name) return &t;
  return nullptr;
}

}  // namespace crosscheck
