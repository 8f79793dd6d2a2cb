#include "experiments/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/hash.h"
#include "mysim/base/text.h"
#include "mysim/run/crossings.h"
#include "reference/engines/engines.h"
#include "reference/truth/cache.h"

namespace crosscheck {

const Table* TableSet::table(const std::string& name) const {
  for (const Table& t : tables)
    if (t.name == name) return &t;
  return nullptr;
}

void TableSet::add(const Table& table) {
  for (Table& t : tables) {
    if (t.name != table.name) continue;
    if (t.columns != table.columns) throw std::logic_error(fmt::format("table {}: its columns differ", t.name));
    t.rows.insert(t.rows.end(), table.rows.begin(), table.rows.end());
    return;
  }
  tables.push_back(table);
}

void TableSet::append(const TableSet& other) {
  for (const Table& t : other.tables) add(t);
  certificates.insert(certificates.end(), other.certificates.begin(), other.certificates.end());
  for (const std::string& note : other.notes)
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

std::string Point::hash() const {
  return fmt::format("{:016x}", Fnv1a::of(fmt::format("{}\n{}\n{}", build_id(), name, content)));
}

Point timed_after(const Point& first, std::string name, std::function<void(const TableSet&, TableSet&)> compute_from) {
  Point point{std::move(name), first.content, {}, true};
  point.after = std::make_shared<const Point>(first);
  point.compute = [after = point.after, compute_from](TableSet& tables) {
    TableSet rows;
    after->compute(rows);
    compute_from(rows, tables);
  };
  point.compute_from = std::move(compute_from);
  return point;
}

std::string content_of(const Scene& scene) {
  return fmt::format("{} {} duration={} samples={} step={} window={} tolerance={} method={}", scene.name, scene.hash,
                     exact_text(scene.duration), scene.samples, exact_text(scene.step), exact_text(scene.window),
                     exact_text(scene.tolerance), scene.method);
}

std::span<const Experiment> experiments() {
  // scenes without damping, in which the numerical damping of a rule is visible
  static constexpr std::string_view long_runs[] = {"spring", "pendulum"};
  // particles on balls; cloths would show more, but the experiment has its own probes with cloths
  static constexpr std::string_view on_balls[] = {"slide", "bounce"};
  // all scenes but the slowest, which are a cloth of hard lengths and a cloth on a ball
  static constexpr std::string_view timed_scenes[] = {"circle",   "projectile", "spring",        "normal-modes",
                                                      "pendulum", "chain",      "chain-link",    "rod",
                                                      "slide",    "bounce",     "cloth-student", "cloth-hang"};
  // moving scenes from small to large; the last one is also charted by the other experiments
  static constexpr std::string_view speed_charts[] = {"pendulum", "chain", "cloth-hang"};
  // includes the hanging cloth, whose rest on a coarse grid is another example of how stiffness scales with the grid
  static constexpr std::string_view all_and_swing[] = {"circle",
                                                       "projectile",
                                                       "spring",
                                                       "normal-modes",
                                                       "pendulum",
                                                       "chain",
                                                       "chain-link",
                                                       "rod",
                                                       "slide",
                                                       "bounce",
                                                       "cloth-student",
                                                       "cloth-hang",
                                                       "cloth-inextensible",
                                                       "cloth-swing",
                                                       "cloth-sphere"};
  // scenes with ingredients that can be removed, or with several families of springs to compare
  static constexpr std::string_view cloths[] = {"cloth-student", "cloth-hang", "cloth-inextensible", "cloth-swing",
                                                "cloth-sphere"};
  static constexpr std::string_view stability_scenes[] = {"spring", "normal-modes", "cloth-hang"};
  static constexpr Experiment table[] = {
      {"engines", "Do mysim and Bullet agree on the same scene, and at what cost?", engines_points},
      {"speed-accuracy", "How large is the error of each method, at what cost, and where does it fail?",
       speed_accuracy_points, timed_scenes, conclude_speed_accuracy, speed_charts},
      // near the front, because its longest points take longer than all others
      {"adequacy", "How little model is enough for a scene?", adequacy_points, all_and_swing, conclude_adequacy,
       cloths},
      {"order", "How fast does the error fall when the step is made smaller?", order_points},
      {"stability",
       "What is the critical time step of each method, measured and predicted, and how do runs fail beyond it?",
       stability_points, stability_scenes},
      {"energy", "Where does the energy go, how large is the energy residual, and how strong is numerical damping?",
       energy_points, long_runs},
      {"contact", "How do friction, rebound and penetration depth on balls and planes compare with theory?",
       contact_points, on_balls},
      {"cost", "What does a time step cost, by size of the cloth, and how near is it to the machine's peak?",
       cost_points},
      {"stiffness",
       "How stiff are position-based links and nets of them, as measured and by the formula that maps stiffness?",
       stiffness_points},
      {"disagreements", "Where does Bullet solve another problem than the scene states, and by how much?",
       disagreements_points},
      {"relations", "Which invariants does each engine satisfy (no reference solution is needed)?", relations_points},
      {"fabric", "Does a cloth of given bending rigidity hang and vibrate like the elastica and a beam, on any grid?",
       fabric_points},
      {"matrix",
       "Which integration rule does each engine use, how strongly does it damp, and what does it cost?",
       matrix_points,
       {},
       conclude_matrix},
  };
  return table;
}

const Experiment* experiment_named(std::string_view name) {
  if (name == "sphere") name = "contact";  // former name, used before the experiment covered planes
  const auto all = experiments();
  const auto found = std::ranges::find(all, name, &Experiment::name);
  return found == all.end() ? nullptr : &*found;
}

const Experiment& find_experiment(const std::string& name) {
  if (const Experiment* found = experiment_named(name)) return *found;
  std::vector<std::string> known;
  for (const Experiment& e : experiments()) known.emplace_back(e.name);
  throw InputError(unknown_name("experiment", name, known, "crosscheck list experiments"));
}

std::vector<Scene> scenes_for(const Experiment& experiment, const std::vector<std::string>& names, bool full,
                              const std::string& methods) {
  if (!names.empty() || full) return load_scenes(names, methods);
  if (experiment.quick_scenes.empty()) return load_scenes(quick_scenes());
  return load_scenes({experiment.quick_scenes.begin(), experiment.quick_scenes.end()});
}

bool has_own_charts(const std::string& experiment, const std::string& scene, bool all) {
  const auto few = find_experiment(experiment).quick_charts;
  return all || few.empty() || std::find(few.begin(), few.end(), scene) != few.end();
}

void add_missing(std::vector<Scene>& all, const std::vector<Scene>& more) {
  for (const Scene& scene : more)
    if (std::none_of(all.begin(), all.end(), [&](const Scene& s) { return s.name == scene.name; }))
      all.push_back(scene);
}

std::vector<Method> default_methods() {
  std::vector<Method> methods = all_methods();
  std::erase_if(methods, [](const Method& method) { return !method.family().by_default(); });
  return methods;
}

bool is_left_out(const Request& request, const Method& method, const Scene& scene) {
  if (!request.all_engines || scene.model.particles.size() <= 100) return false;
  const auto engine = kept_engine_of(method.name);
  return engine && !engine->is_native();
}

std::vector<Method> methods_of(const Request& request, const Scene& scene) {
  if (!request.methods.empty()) {
    std::vector<Method> named = request.methods;
    std::erase_if(named, [&](const Method& method) { return is_left_out(request, method, scene); });
    return named;
  }
  std::vector<Method> methods = default_methods();
  if (has_contact(scene.model)) methods.push_back(find_method(sticky_method()));
  return methods;
}

Run run_of(const Request& request, const Scene& scene) {
  Run run = default_run(scene);
  if (request.step > 0) run.step = request.step;
  return run;
}

MethodResult& result_of(const Request& request, const Scene& scene, const Method& method, MethodResults& results) {
  for (MethodResult& result : results)
    if (result.scene == scene.name && result.method == method.name) return result;
  Recorder recorder;
  const Run run = run_of(request, scene);
  CrossingObserver crossings(scene, run.samples);
  std::vector<Observer*> observers{&recorder, &crossings};
  Ledger ledger(scene.model, method.contact);
  if (!scene.model.first_order()) observers.push_back(&ledger);
  Outcome out = run_method(method, scene, run, observers);
  crossings.note(out);
  const bool unsupported = out.verdict == Verdict::unsupported;  // the method may discover this only during the run
  if (unsupported) recorder.trajectory = {};
  return results.emplace_back(MethodResult{scene.name, method.name, std::move(out), std::move(recorder.trajectory),
                                           unsupported ? std::vector<LedgerRow>() : ledger.rows(),
                                           ledger.contact_inferred()});
}

MethodResult recorded_result(const Method& method, const Scene& scene, const Run& run) {
  Recorder recorder;
  Outcome out = run_method(method, scene, run, {&recorder});
  return {scene.name, method.name, std::move(out), std::move(recorder.trajectory)};
}

std::string content_of(const Request& request, const Scene& scene) {
  std::string text = fmt::format("{} full={} step={}", content_of(scene), request.full, exact_text(request.step));
  for (const Method& method : methods_of(request, scene))
    text += fmt::format(" {} {}", method.name, method.fingerprint);
  return text;
}

std::vector<Point> one_point_per_scene(const Request& request, const std::string& experiment,
                                       void (*compute)(const Request&, const Scene&, TableSet&)) {
  std::vector<Point> points;
  for (const Scene& scene : request.scenes) {
    Request alone = request;
    alone.scenes = {scene};
    points.push_back(
        {fmt::format("{}: {}", experiment, scene.name), content_of(request, scene),
         [alone = std::move(alone), compute](TableSet& tables) { compute(alone, alone.scenes[0], tables); }});
  }
  return points;
}

}  // namespace crosscheck
