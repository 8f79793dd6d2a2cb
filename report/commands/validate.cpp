#include <map>
#include <numbers>
#include <set>

#include "mysim/base/this_process.h"
#include "mysim/model/moduli.h"
#include "mysim/model/pieces.h"
#include "mysim/model/system.h"
#include "report/commands/command_line.h"

namespace crosscheck {
namespace {

struct SceneSummary {
  Scene scene;
  std::string given;
  std::map<Family, long> springs;
  double omega = 0;                                      // rad/s
  std::optional<double> gamma;                           // drag rate (1/s), if all particles have the same
  std::vector<std::pair<std::string, double>> critical;  // critical step (s) of each explicit rule; 0: unstable at all
                                                         // steps
  ResourceEstimate demand{};
  NetModuli net;
  std::optional<BendingLength> bending;
  std::vector<std::string> warnings;
  int pieces = 0, free_pieces = 0;  // connected pieces: all, and those without a pin
  std::vector<std::pair<int, int>> coincident;
  std::optional<double> mass_per_area;  // kg/m^2, if the scene is a sheet
};

/// Mass / area of a sheet. Returns nullopt for the closed surface of a block: its V particles have 2 V - 4 triangles,
/// more than any sheet.
std::optional<double> mass_per_area_of(const Scene& scene) {
  std::set<int> particles;
  double area = 0, mass = 0;
  for (const auto& [a, b, c] : scene.triangles) {
    const Vec3 origin = scene.start.x.col(a), u = scene.start.x.col(b) - origin, v = scene.start.x.col(c) - origin;
    area += u.cross(v).norm() / 2;
    particles.insert({a, b, c});
  }
  if (!(area > 0) || scene.triangles.size() + 4 >= 2 * particles.size()) return std::nullopt;
  for (const int i : particles) mass += scene.model.particles.mass[i];
  return mass / area;
}

void add_pieces(SceneSummary& summary) {
  const Model& model = summary.scene.model;
  const std::vector<int> piece = pieces_of(model);
  summary.pieces = std::ranges::max(piece) + 1;
  std::vector<char> held(summary.pieces, 0);
  for (const int pin : model.particles.pins) held[piece[pin]] = 1;
  summary.free_pieces = static_cast<int>(std::ranges::count(held, 0));
  // tolerance for the rounding of decimal numbers
  summary.coincident = coincident_pairs(summary.scene.start.x, 1e-9 * summary.scene.size());
  for (const auto& [a, b] : summary.coincident)
    if (piece[a] != piece[b]) {
      summary.warnings.push_back(
          fmt::format("particles {} and {} start at the same place, but no spring joins their pieces{}", a, b,
                      held[piece[a]] && held[piece[b]] ? "" : ", one of which has no pin"));
      break;
    }
  summary.mass_per_area = mass_per_area_of(summary.scene);
}

SceneSummary summary_of(const std::string& given) {
  SceneSummary summary{.scene = load_scene(given), .given = given};
  const Scene& scene = summary.scene;
  const Model& model = scene.model;
  if (const auto* springs = model.find<Springs>())
    for (const Spring& spring : springs->list) ++summary.springs[spring.family];
  if (!model.first_order()) summary.omega = highest_frequency(model, scene.start);
  summary.gamma = uniform_drag_rate(model);
  const Method method = find_method(scene.method);
  summary.demand = resource_estimate_of(method, scene, default_run(scene));
  const auto warn = [&](std::string text) {
    if (!text.empty()) summary.warnings.push_back(std::move(text));
  };
  for (const Stepper& rule : steppers()) {
    // omit implicit rules (stable at every step) and adaptive ones (they choose their own step)
    if (rule.evaluations == 0 || rule.adaptive || !summary.gamma || (summary.omega == 0 && *summary.gamma == 0))
      continue;
    const double limit = rule.limit(summary.omega, *summary.gamma);
    if (!std::isfinite(limit)) continue;
    summary.critical.emplace_back(rule.name, limit);
    if (const Stepper* own = stepper_of(method); own && own->name == rule.name && scene.step > limit)
      warn(limit > 0 ? fmt::format("the step of {:.3g} s is above {}'s critical step of {:.3g} s: the run will blow up",
                                   scene.step, rule.name, limit)
                     : fmt::format("{} has no stable step without drag: its energy grows", rule.name));
  }
  summary.bending = bending_length_of(model, scene.start);
  if (summary.bending) warn(coarse_grid_warning(*summary.bending));
  summary.net = moduli_of(model, scene.start);
  if (summary.net.moduli) warn(skip_one_warning(*summary.net.moduli));
  add_pieces(summary);
  return summary;
}

template <class T>
std::size_t length_of_term(const Model& model) {
  const T* term = model.find<T>();
  return term ? term->list.size() : 0;
}

void print(const SceneSummary& s) {
  const Scene& scene = s.scene;
  const Model& model = scene.model;
  const auto line = [](const char* name, const std::string& text) { fmt::print("  {:<16} {}\n", name, text); };
  fmt::print("{}: a valid scene\n", s.given);
  line("particles", fmt::format("{}, {} of them pinned{}", model.particles.size(), model.particles.pins.size(),
                                model.particles.move ? " and moved" : ""));
  std::vector<std::string> families, terms;
  for (const auto& [family, count] : s.springs) families.push_back(fmt::format("{} {}", count, name_of(family)));
  line("springs",
       families.empty() ? "0" : fmt::format("{} ({})", length_of_term<Springs>(model), fmt::join(families, ", ")));
  if (!model.first_order()) {
    const Eigen::VectorXd& mass = model.particles.mass;
    const double least = mass.minCoeff(), most = mass.maxCoeff();
    line("masses",
         fmt::format("{} kg each, {:.6g} kg in total{}",
                     least == most ? fmt::format("{:.6g}", most) : fmt::format("{:.6g} to {:.6g}", least, most),
                     mass.sum(), s.mass_per_area ? fmt::format(", {:.4g} kg/m^2 of triangles", *s.mass_per_area) : ""));
  }
  line("pieces", fmt::format("{}, {} of them without a pin", s.pieces, s.free_pieces));
  if (!s.coincident.empty())
    line("coincident", fmt::format("{} pair{} of particles at the same place, the first {} and {}", s.coincident.size(),
                                   s.coincident.size() > 1 ? "s" : "", s.coincident[0].first, s.coincident[0].second));
  const std::pair<const char*, std::size_t> lists[] = {{"dashpots", length_of_term<Dashpots>(model)},
                                                       {"hard distances", length_of_term<Constraints>(model)},
                                                       {"spheres", length_of_term<Spheres>(model)},
                                                       {"planes", length_of_term<Planes>(model)}};
  for (const auto& [name, count] : lists)
    if (count > 0) line(name, std::to_string(count));
  for (const Term& term : model.terms)
    if (!std::holds_alternative<Springs>(term)) terms.emplace_back(name_of(term));
  line("ingredients", terms.empty() ? model.find<Springs>() ? "springs only" : "none: nothing acts on the particles"
                                    : fmt::format("{}", fmt::join(terms, ", ")));
  line("largest omega", model.first_order() ? "none: a first-order scene"
                        : s.omega > 0
                            ? fmt::format("{:.4g} rad/s (period {:.3g} s), at the initial stiffness with fixed pins",
                                          s.omega, 2 * std::numbers::pi / s.omega)
                            : "0: nothing vibrates");
  if (s.critical.empty())
    line("critical steps", s.gamma ? "none: nothing vibrates" : "unknown: the particles' drag rates differ");
  for (const char* title = "critical steps"; const auto& [name, limit] : s.critical)
    line(std::exchange(title, ""),
         fmt::format("{:<18} {}", name, limit > 0 ? fmt::format("{:.4g} s", limit) : "no stable step without drag"));
  if (!s.critical.empty())
    line("",
         fmt::format("from omega{}; {}omega changes as springs stretch",
                     *s.gamma > 0 ? fmt::format(" and the drag rate of {:.3g} 1/s", *s.gamma) : "",
                     length_of_term<Dashpots>(model) > 0 ? "dashpots, which would shorten them, are ignored; " : ""));
  if (s.bending) line("bending", sentence_of(*s.bending));
  if (s.net.moduli)
    line("moduli", fmt::format("{}", fmt::join(sentences_of(*s.net.moduli), fmt::format("\n{:19}", ""))));
  else if (!s.springs.empty())
    line("moduli", "unknown: " + s.net.why_not);
  line("default run", fmt::format("{}, {:.6g} s in {}, {} samples", scene.method, scene.duration,
                                  find_method(scene.method).adaptive
                                      ? "steps of its own choice"
                                      : fmt::format("{:.0f} steps of at most {:.4g} s", s.demand.steps, scene.step),
                                  scene.samples));
  line("  memory", fmt::format("about {}; {} are free", format_bytes(s.demand.memory), format_bytes(free_memory())));
  line("  disk", fmt::format("{} of frames", format_bytes(s.demand.frames)));
  line("  time", fmt::format("about {:.2g} s of CPU time, accurate to a factor of 3", s.demand.seconds));
  for (const std::string& warning : s.warnings) line("warning", warning);
}

Json json_of(const NetModuli& net) {
  if (!net.moduli) return {{"why_not", net.why_not}};
  const Moduli& m = *net.moduli;
  Json json = {{"dimension", m.dimension}, {"unit", std::string(unit_of_moduli(m.dimension))}, {"c11", m.c11}};
  if (m.dimension == 1) return json;
  json.update({{"c22", m.c22}, {"c12", m.c12}, {"c66", m.c66}});
  if (m.dimension == 2) {
    const auto [least, largest] = m.young_range();
    json.update({{"c16", m.c16}, {"c26", m.c26}, {"young_least", least}, {"young_largest", largest}});
  }
  json.update({{"young", m.young()},
               {"poisson", m.poisson()},
               {"anisotropy", m.anisotropy()},
               {"c11_of_skip_one_springs", m.c11_of_bend}});
  return json;
}

Json json_of(const SceneSummary& s) {
  const Model& model = s.scene.model;
  Json masses, bending;
  if (const Eigen::VectorXd& mass = model.particles.mass; !model.first_order())
    masses = {{"least", mass.minCoeff()},
              {"largest", mass.maxCoeff()},
              {"total", mass.sum()},
              {"per_area", s.mass_per_area ? Json(*s.mass_per_area) : Json()}};
  if (s.bending) bending = {{"rigidity", s.bending->rigidity}, {"spacing", s.bending->spacing}};
  if (s.bending && std::isfinite(s.bending->length))
    bending.update({{"length", s.bending->length}, {"spacings", s.bending->spacings()}});
  Json families = Json::object(), critical = Json::object();
  for (const auto& [family, count] : s.springs) families[name_of(family)] = count;
  for (const auto& [name, limit] : s.critical) critical[name] = limit;
  return {{"scene", s.given},
          {"valid", true},
          {"hash", s.scene.hash},
          {"particles", model.particles.size()},
          {"pins", model.particles.pins.size()},
          {"masses", std::move(masses)},
          {"pieces", s.pieces},
          {"free_pieces", s.free_pieces},
          {"coincident", s.coincident},
          {"springs", std::move(families)},
          {"dashpots", length_of_term<Dashpots>(model)},
          {"constraints", length_of_term<Constraints>(model)},
          {"spheres", length_of_term<Spheres>(model)},
          {"planes", length_of_term<Planes>(model)},
          {"largest_omega", s.omega},
          {"critical_steps", std::move(critical)},
          {"method", s.scene.method},
          {"step", s.scene.step},
          {"steps", std::llround(s.demand.steps)},
          {"memory_bytes", std::llround(s.demand.memory)},
          {"disk_bytes", std::llround(s.demand.frames)},
          {"cpu_seconds", s.demand.seconds},
          {"moduli", json_of(s.net)},
          {"bending", std::move(bending)},
          {"warning", s.warnings.empty() ? Json() : Json(fmt::format("{}", fmt::join(s.warnings, "; ")))}};
}

/// Tries one step with the scene's own method, unless that is an external program. Throws InputError if the method
/// refuses the scene.
void require_accepted(const Scene& scene, const std::string& given) {
  const Method method = find_method(scene.method);
  if (method.family().role == Role::outside) return;
  const Outcome out = run_method(method, scene, {scene.step, scene.step, 1, 1e-3, false}, {});
  if (out.verdict == Verdict::unsupported)
    throw InputError(fmt::format("{}: time.method: expected a method that can run it; {} cannot: {}", given,
                                 method.name, out.reason));
}

struct ValidateOptions {
  std::vector<std::string> scenes;
  bool json = false;
};

/// Prints faults on stderr. Returns 2 if there was one, otherwise 0.
int validate_command(const ValidateOptions& options) {
  int status = 0;
  Json entries = Json::array();
  Progress progress(static_cast<int>(options.scenes.size()));
  for (const std::string& given : options.scenes) {
    progress.begin("checking " + given);
    try {
      const SceneSummary summary = summary_of(given);
      require_accepted(summary.scene, given);
      progress.done();
      if (options.json)
        entries.push_back(json_of(summary));
      else
        print(summary);
    } catch (...) {
      const std::string fault = in_words(std::current_exception());
      progress.done();
      fmt::print(stderr, "crosscheck: {}\n", fault);
      entries.push_back({{"scene", given}, {"valid", false}, {"fault", fault}});
      status = 2;
    }
  }
  if (options.json) fmt::print("{}\n", dump(Json{{"format", 1}, {"scenes", std::move(entries)}}, 2));
  return status;
}

}  // namespace

void add_validate(CLI::App& app, Invocation& call) {
  auto [validate, options] =
      add_command(app, call, "validate", "checks and describes scene files without running them", validate_command);
  validate.add_option("SCENE", options.scenes, "shipped scenes or TOML files")->required();
  validate.add_flag("--json", options.json, "prints JSON");
}

}  // namespace crosscheck
