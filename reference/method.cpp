#include "reference/method.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "mysim/run/observers.h"
#include "reference/which_rule.h"

namespace crosscheck {
namespace {

std::vector<MethodRow> all_rows() {
  std::vector<MethodRow> rows;
  for (const MethodFamily& family : method_families())
    if (family.methods)
      for (MethodRow& row : family.methods()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace

std::span<const MethodFamily> method_families() {
  static constexpr std::string_view clamped = "Bullet clamps speeds to the body's diagonal over the step";
  static constexpr MethodFamily table[] = {
      {.name = "mysim",
       .title = "mysim",
       .role = Role::subject,
       .representative = "mysim/symplectic-euler",
       .build = Build::here,
       .build_text = "this build",
       .call = 100e-9,
       .element = 5e-9,
       .grid_kernel = true,
       .methods = mysim_methods},
      {.name = "bullet",
       .title = "Bullet",
       .role = Role::peer,
       .representative = "bullet/deformable-explicit",
       .representative_title = "Bullet's explicit deformable world",
       .noun = "world",
       .build = Build::debian,
       .build_text = "Debian's library (generic x86-64, -O2), called from this build",
       .call = 2e-6,
       .element = 40e-9,
       .highest_order = 1,
       .departure = clamped,
       .methods = bullet_methods},
      {.name = "bullet32",
       .title = "Bullet in single precision",
       .role = Role::peer,
       .representative = "bullet32/deformable-explicit",
       .noun = "world",
       .variant_of = "bullet",
       .build = Build::own_program,
       .call = 2e-6,
       .element = 40e-9,
       .start = 0.2,
       .single_precision = true,
       .highest_order = 1,
       .departure = clamped,
       .methods = bullet32_methods},
      {.name = "odeint",
       .title = "Boost odeint",
       .role = Role::integrator,
       .representative = "odeint/dopri5",
       .build = Build::here,
       .build_text = "headers of the library, compiled in this build",
       .methods = odeint_methods},
      {.name = "sundials",
       .title = "SUNDIALS",
       .role = Role::integrator,
       .representative = "sundials/arkode",
       .build = Build::debian,
       .build_text = "Debian's library (generic x86-64, -O2), with a right-hand side of this build",
       .methods = sundials_methods},
      {.name = "truth", .title = "truth", .role = Role::truth, .methods = truth_methods},
      {.name = "file", .title = "a trajectory", .role = Role::outside},
      {.name = "exec", .title = "a program", .role = Role::outside, .build = Build::own_program}};
  return table;
}

const MethodFamily& subject() { return *std::ranges::find_if(method_families(), &MethodFamily::is_subject); }

std::vector<const MethodFamily*> default_peers() {
  std::vector<const MethodFamily*> peers;
  for (const MethodFamily& family : method_families())
    if (family.is_default_peer()) peers.push_back(&family);
  return peers;
}

bool is_first_peer(const MethodFamily& family) { return &family == default_peers().front(); }

const MethodFamily& family_of(std::string_view name) {
  const std::string_view prefix = name.substr(0, name.find_first_of("/:"));
  const auto families = method_families();
  const auto found = std::ranges::find(families, prefix, &MethodFamily::name);
  return found == families.end() ? families.back() : *found;
}

std::string short_name(const std::string& method) {
  return family_of(method).is_subject() ? method.substr(method.find('/') + 1) : method;
}

std::string program_title(const std::string& method, std::span<const std::string> beside) {
  const auto title = [](const std::string& name, size_t folders) {
    std::vector<std::string> parts = split(name.substr(name.find(':') + 1), '+');
    std::filesystem::path file = std::filesystem::path(parts[0]).lexically_normal(), shown = file.stem();
    for (file = file.parent_path(); folders > 0 && !file.filename().empty(); --folders, file = file.parent_path())
      shown = file.filename() / shown;
    parts[0] = shown.string();
    return fmt::format("{}", fmt::join(parts, ", "));
  };
  for (size_t folders = 0; folders <= static_cast<size_t>(std::ranges::count(method, '/')); ++folders)
    if (std::ranges::none_of(beside, [&](const std::string& other) {
          return other != method && family_of(other).role == Role::outside &&
                 title(other, folders) == title(method, folders);
        }))
      return title(method, folders);
  return method.substr(method.find(':') + 1);
}

std::string sticky_method() { return std::string(subject().representative) + "+sticky"; }

std::span<const Method> builtin_methods() {
  static const std::vector<Method> all = all_methods();
  return all;
}

const Method* builtin_method(std::string_view name) {
  const auto all = builtin_methods();
  const auto found = std::ranges::find(all, name, &Method::name);
  return found == all.end() ? nullptr : &*found;
}

const Method* builtin_without_options(std::string_view name) {
  const Method* with_its_choice = builtin_method(name);
  return with_its_choice ? with_its_choice : builtin_method(name.substr(0, name.find('+')));
}

std::string subject_method(const std::function<bool(const Stepper&)>& asked) {
  for (const Method& method : builtin_methods())
    if (method.family().is_subject() && method.stepper && asked(*method.stepper)) return method.name;
  return "";
}

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const MethodRow& row : all_rows())
    for (const std::string& name : row.full_names()) methods.push_back(find_method(name));
  return methods;
}

Method find_method(const std::string& text) {
  if (text.starts_with(program_prefix)) return exec_method(text.substr(program_prefix.size()));
  const std::vector<std::string> parts = split(text, '+');
  const std::string name =
      parts[0].find('/') == std::string::npos ? fmt::format("{}/{}", subject().name, parts[0]) : parts[0];
  std::vector<std::string> known;
  for (const MethodRow& row : all_rows()) {
    if (row.name == name) {
      Method method = row.make({parts.begin() + 1, parts.end()});
      for (size_t i = 1; i < parts.size(); ++i) method.name += "+" + parts[i];
      return method;
    }
    for (const std::string& full : row.full_names()) known.push_back(full);
  }
  // compares short names with text that has no prefix: "leapfrg" is closer to "leapfrog" than to "mysim/leapfrog"
  std::vector<std::string> names = known;
  if (parts[0].find('/') == std::string::npos)
    for (std::string& full : names) full = short_name(full);
  std::error_code unreadable;
  if (std::filesystem::is_regular_file(text, unreadable))
    throw InputError(
        fmt::format("unknown method: {0} is a file; to run it as a program, write {1}{0}", text, program_prefix));
  throw InputError(unknown_name("method", parts[0], names, "crosscheck list methods"));
}

const Stepper* stepper_of(const Method& method) {
  if (method.stepper) return method.stepper;
  const std::string name = method.identify                          ? method.identify().like
                           : method.rule == "implicit-euler+linear" ? "implicit-euler"
                                                                    : method.rule;
  for (const Stepper& rule : steppers())
    if (rule.name == name) return &rule;
  return nullptr;
}

std::string rule_of(const Method& method) { return method.identify ? name_of(method.identify()) : method.rule; }

std::optional<bool> same_rule(const Method& a, const Method& b, const Model& model) {
  const auto* springs = model.find<Springs>();
  const bool drag = model.find<Drag>();
  std::string rules[2];
  bool known = true;
  for (int i = 0; i < 2; ++i) {
    const Method& method = i == 0 ? a : b;
    rules[i] = method.rule;
    if (!method.identify) continue;
    const FoundRule& found = method.identify();
    if (found.kind != FoundRule::same) {
      if (found.kind == FoundRule::unknown) return std::nullopt;
      return false;
    }
    if (drag && !found.drag.empty() && !found.own_drag) return false;
    rules[i] = found.rule;
    const auto tried = [&](const char* ingredient) { return found.tried.find(ingredient) != std::string::npos; };
    known = known && found.exact && (!drag || found.own_drag) && !model.first_order() &&
            (method.family().is_engine() ||
             (!model.particles.move && (model.particles.pins.empty() || tried("pins")) &&
              (!springs || springs->law == SpringLaw::hooke) && std::ranges::all_of(model.terms, [&](const Term& term) {
                return std::holds_alternative<Springs>(term) || std::holds_alternative<Drag>(term) ||
                       (std::holds_alternative<Gravity>(term) && tried("gravity"));
              })));
  }
  if (rules[0].empty() || rules[1].empty()) return std::nullopt;
  if (rules[0] != rules[1]) return false;
  return known ? std::optional(true) : std::nullopt;
}

std::vector<Method> find_methods(const std::string& list) {
  std::vector<Method> methods;
  for (const std::string& name : split(list, ',')) methods.push_back(find_method(name));
  return methods;
}

namespace {

/// Observes free particles in more states than those on which verdicts are based.
///
/// Records the largest speed. The verdict's speeds are differences over two states, which cannot show a vibration that
/// reverses in every step. If the step is near the rule's limit, such a vibration may be stable, and is not a failure.
///
/// Counts passages through a sphere. In a passage, both ends of a step are outside, and the chord between them reaches
/// deeper into the sphere than the path can deviate from the chord. If the velocity changes by dv within a time tau, at
/// one instant or evenly, this deviation is at most tau |dv| / 4.
class StepObserver : public Observer {
 public:
  explicit StepObserver(const Scene& scene)
      : particles_(scene.model.particles), spheres_(scene.model.find<Spheres>()) {}
  bool between_samples() const override { return true; }
  Verdict observe(const State& state, bool) override {
    for (int i = 0; last_.x.cols() > 0 && state.t > last_.t && i < particles_.size(); ++i) {
      if (particles_.pinned[i]) continue;
      peak = std::max(peak, (state.x.col(i) - last_.x.col(i)).norm() / (state.t - last_.t));
      if (spheres_ && std::min(state.v.cols(), last_.v.cols()) == state.x.cols())
        for (const Sphere& sphere : spheres_->list) find_passage(sphere, state, i);
    }
    last_ = state;
    return Verdict::ok;
  }
  double peak = 0;           // m/s
  long passages = 0;         // through spheres
  double first_passage = 0;  // s

 private:
  void find_passage(const Sphere& sphere, const State& state, int i) {
    const double radius = sphere.contact_radius(), span = state.t - last_.t;
    const Vec3 from = last_.x.col(i) - sphere.centre_at(last_.t), to = state.x.col(i) - sphere.centre_at(state.t),
               way = to - from;
    const double closest = -from.dot(way) / way.squaredNorm();  // as a fraction of the chord
    if (!(closest > 0 && closest < 1)) return;
    const auto seen = [&](const State& s) {  // m/s, relative to the sphere
      return sphere.motion ? Vec3(s.v.col(i) - velocity_at(*sphere.motion, s.t)) : Vec3(s.v.col(i));
    };
    const double bend = span / 4 * (seen(state) - seen(last_)).norm();
    // positions on the surface that were rounded to single precision count as outside; a particle that was pushed out
    // on the near side has touched the sphere, but has not passed through it
    const double outside = radius * (1 - 1e-6);
    if (!(from.norm() > outside && to.norm() > outside && to.dot(seen(last_)) > 0 &&
          (from + closest * way).norm() + bend < outside))
      return;
    if (passages++ == 0) first_passage = last_.t + closest * span;
  }

  const Particles& particles_;
  const Spheres* spheres_;
  State last_{};
};

void add_remark(Outcome& out, const std::string& remark) { out.remark += (out.remark.empty() ? "" : "; ") + remark; }

}  // namespace

/// mysim's methods are run by simulate() (mysim/run/engine.cpp).
Outcome run_method(const Method& method, const Scene& scene, const Run& run, std::vector<Observer*> observers,
                   const MotionBoundsFunction& bounds) {
  DivergenceMonitor monitor(scene, run, bounds);
  StepObserver seen(scene);
  observers.push_back(&seen);
  MonitoredObservers all(monitor, std::move(observers));
  try {
    Outcome out = method.engine(scene, run, all);
    if (out.verdict != Verdict::ok) return out;
    if (seen.passages > 0)
      add_remark(out, fmt::format("a particle passed through a sphere between two steps at t = {:.4g} s{}: "
                                  "shorter steps would detect the contact",
                                  seen.first_passage,
                                  seen.passages > 1 ? fmt::format(", the first of {} passages", seen.passages) : ""));
    if (monitor.largest_ratio() <= DivergenceMonitor::ratio_in_order) return out;
    if (const auto known = bounds(scene, run); known && seen.peak > DivergenceMonitor::allowed * known->speed)
      add_remark(out, fmt::format("from one step to the next a particle moved up to {:.3g} times as fast as in the "
                                  "reference solution; the step is at or above its stability limit",
                                  seen.peak / known->speed));
    return out;
  } catch (const Unsupported& refusal) {
    Outcome out;
    out.verdict = Verdict::unsupported;
    out.reason = refusal.what();
    return out;
  }
}

}  // namespace crosscheck
