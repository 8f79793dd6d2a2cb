#include "reference/which_rule.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/hash.h"
#include "mysim/base/installation.h"
#include "mysim/base/json.h"
#include "mysim/base/random.h"
#include "mysim/model/system.h"
#include "reference/truth/cache.h"

namespace crosscheck {
namespace {

constexpr int steps = 50;
constexpr double infinity = std::numeric_limits<double>::infinity();

using Path = std::vector<Points>;  // positions after each step, m

/// A rule, and the name of its drag.
struct Candidate {
  std::string name, like;
  std::function<void(System&, State&, double h, Workspace&)> step;
  std::string drag;
  bool solves = false;      // solves an equation in each step
  bool one_by_one = false;  // processes one spring after the other
};

std::vector<Candidate> candidates() {
  std::vector<Candidate> list;
  for (const Stepper& s : steppers()) {
    if (s.adaptive) continue;
    const bool solves = s.evaluations == 0 || s.hard_constraints;
    const std::string name(s.name), drag = solves                                         ? "implicit"
                                           : s.composition && !s.composition().kick_first ? "time-symmetric"
                                                                                          : "explicit";
    list.push_back({name, name, s.step, drag, solves, s.hard_constraints});
    if (s.linear) list.push_back({name + "+linear", name, s.linear, drag, true});
  }
  list.push_back({"velocity-verlet", "leapfrog",
                  [](System& f, State& s, double h, Workspace& w) {
                    Points& a = w[0].x;
                    f.acceleration(s, a);
                    s.v += h / 2 * a, s.x += h * s.v, s.t += h;
                    f.acceleration(s, a);
                    s.v += h / 2 * a;
                  },
                  "explicit"});
  list.push_back({"symplectic-euler, positions first", "symplectic-euler",
                  [](System& f, State& s, double h, Workspace& w) {
                    Points& a = w[0].x;
                    s.x += h * s.v, s.t += h;
                    f.acceleration(s, a);
                    s.v += h * a;
                  },
                  "explicit"});
  return list;
}

/// Drag that is separate from a rule: a factor on the velocity before or after the step, or (kick) after the kick of
/// symplectic Euler.
struct DragForm {
  std::string name;
  enum { before, after, kick } where;
  double (*factor)(double z);  // z = gamma h
};

std::vector<DragForm> drag_forms() {
  std::vector<DragForm> forms;
  for (const auto where : {DragForm::before, DragForm::after, DragForm::kick}) {
    forms.push_back({"exact", where, [](double z) { return std::exp(-z); }});
    forms.push_back({"implicit", where, [](double z) { return 1 / (1 + z); }});
    forms.push_back({"explicit", where, [](double z) { return 1 - z; }});
  }
  return forms;
}

constexpr double gamma = 4;  // 1/s

/// Five particles with eight springs or, if `one_spring`, two particles with the first spring; initial and rest lengths
/// differ by up to a fifth.
Scene net(bool held, bool pulled, bool one_spring = false) {
  std::string text =
      "question = \"Which rule is it?\"\nparameters = \"A small net.\"\n[time]\nduration = 1\nsamples = 50\nstep = "
      "0.01\n"
      "window = 1\ntolerance = 1e-3\nmethod = \"leapfrog\"\n";
  const double particles[5][7] = {{0, 0, 0, 0.3, 0.3, 0.2, -0.1},
                                  {0.5, 0, 0.1, 0.2, -0.2, 0.1, 0.4},
                                  {0.1, -0.5, 0, 0.25, 0.1, -0.3, 0.2},
                                  {0.6, -0.45, 0.2, 0.3, 0.4, 0.2, -0.3},
                                  {0.3, -0.9, -0.1, 0.2, -0.1, 0.2, 0.1}};
  for (int i = 0; i < (one_spring ? 2 : 5); ++i) {
    const auto& p = particles[i];
    text += fmt::format("[[particle]]\nposition = [{}, {}, {}]\nmass = {}\n", p[0], p[1], p[2], p[3]);
    if (i > 0 || !held) text += fmt::format("velocity = [{}, {}, {}]\n", p[4], p[5], p[6]);
  }
  const double springs[8][4] = {{0, 1, 40, 0.45}, {0, 2, 50, 0.58}, {1, 3, 60, 0.41}, {2, 3, 45, 0.6},
                                {1, 2, 40, 0.7},  {3, 4, 50, 0.52}, {2, 4, 55, 0.5},  {0, 3, 40, 0.66}};
  for (const auto& s : std::span(springs).first(one_spring ? 1 : 8))
    text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\nrest = {}\n", s[0], s[1], s[2], s[3]);
  if (held) text += "[pins]\nparticles = [0]\n";
  if (pulled) text += "[gravity]\nacceleration = [0, -9.81, 0]\n";
  return parse_scene(text, "which-rule");
}

Scene with_drag(Scene scene) {
  scene.model.terms.emplace_back(Drag{gamma * scene.model.particles.mass});
  scene.hash = hash_of(scene);
  return scene;
}

/// The rule's path; empty if it finds no solution.
Path path_of(const Candidate& rule, const Scene& scene, const State& start, double h, int n,
             const DragForm* form = nullptr) {
  System f(scene.model);
  Workspace w(start);
  State s = start;
  Path path{s.x};
  const double factor = form ? form->factor(gamma * h) : 1;
  try {
    for (int i = 1; i <= n; ++i) {
      const Points from = s.x;
      if (form && form->where == DragForm::before) s.v *= factor;
      rule.step(f, s, h, w);
      if (form && form->where != DragForm::before) s.v *= factor;
      if (form && form->where == DragForm::kick) s.x = from + h * s.v;
      s.t = i * h;
      path.push_back(s.x);
    }
  } catch (const SolverFailure&) {
    return {};
  }
  return path;
}

double distance(const Points& a, const Points& b) { return largest_column(a - b); }

double distance(const Path& a, const Path& b) {
  double most = 0;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, distance(a[i], b[i]));
  return std::isfinite(most) ? most : infinity;
}

Path every_second(const Path& path) {
  Path some;
  for (size_t i = 0; i < path.size(); i += 2) some.push_back(path[i]);
  return some;
}

/// Runs of a method on one net, at two steps.
struct Runs {
  double h[2];  // s, the second is half the first
  Path path[2];
  double u = 0x1p-53;  // unit round-off of the engine
  bool own_steps = false;
};

/// Throws Unsupported, or InputError if a run failed.
Runs runs_of(const Method& method, const Scene& scene) {
  Runs runs;
  bool single = true;
  for (int k = 0; k < 2; ++k) {
    // h omega is a quarter to a half: rules of order 4 differ by 1e-4 of the motion, and explicit Euler grows 100-fold
    runs.h[k] = std::exp2(std::floor(std::log2(0.5 / highest_frequency(scene.model, scene.start))) - k);
    Run run{runs.h[k], steps * runs.h[k], steps};
    run.timed = false;
    Recorder recorder;
    const Outcome out = method.engine(scene, run, recorder);
    if (out.verdict != Verdict::ok || recorder.trajectory.frames() != steps + 1)
      throw InputError(fmt::format("a run failed: {}", out.reason.empty() ? in_words(out.verdict) : out.reason));
    runs.path[k] = std::move(recorder.trajectory.x);
    runs.own_steps |=
        out.adaptive || std::abs(out.step - runs.h[k]) > 1e-6 * runs.h[k] || (out.steps > 0 && out.steps != steps);
    for (const Points& x : runs.path[k])
      single = single && std::ranges::all_of(x.reshaped(), [](double a) { return double(float(a)) == a; });
    single = single || (out.readback && out.readback->precision == "single");
  }
  if (single || method.family().single_precision) runs.u = 0x1p-24;
  return runs;
}

/// Largest distance between the rule's path and the method's over the samples, divided by the bound of rounding and
/// solver error (`ratio`), by the bound of rounding alone (`rounding`), and by the size of the net (`distance`).
/// Infinite if no sample is conclusive.
struct Match {
  double ratio = 0, rounding = 0, distance = 0;
};
Match match_of(const Candidate& rule, const Scene& scene, const Runs& runs, int k, const DragForm* form = nullptr) {
  const Path path = path_of(rule, scene, scene.start, runs.h[k], steps, form);
  if (path.empty()) return {infinity, infinity, infinity};
  const double size = scene.size(), floor = 10 * runs.u * 2 * size * std::sqrt(double(steps)),
               solved = rule.solves ? 1e-8 * size : 0;
  std::vector<double> noise(path.size(), 3 * floor);
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::mt19937_64 engine(seed);
    State start = scene.start;
    for (int i = 0; i < start.x.cols(); ++i)
      for (int axis = 0; axis < 3 && !scene.model.particles.pinned[i]; ++axis) {
        start.x(axis, i) += floor * (2 * uniform(engine) - 1);
        start.v(axis, i) += floor / runs.h[k] / steps * (2 * uniform(engine) - 1);
      }
    const Path moved = path_of(rule, scene, start, runs.h[k], steps, form);
    double most = 0;
    for (size_t i = 0; i < std::min(moved.size(), path.size()); ++i)
      noise[i] = std::max(noise[i], 3 * (most = std::max(most, distance(moved[i], path[i]))));
  }
  Match match;
  for (size_t i = 0; i < path.size(); ++i) {
    const double off = distance(path[i], runs.path[k][i]);
    if (!std::isfinite(off)) return {infinity, infinity, infinity};
    match.distance = std::max(match.distance, off / size);
    const bool tells = noise[i] + solved < 1e-3 * size;
    match.ratio = std::max(match.ratio, tells ? off / (noise[i] + solved) : i < 10 ? infinity : 0);
    // an equation is solved to rounding times its condition number, here about 1e4 at most
    const double solving = rule.solves ? 1e4 * runs.u * size : 0;
    match.rounding = std::max(match.rounding, tells ? off / (noise[i] + solving) : 0);
  }
  return match;
}

Match match_of(const Candidate& rule, const Scene& scene, const Runs& runs, const DragForm* form = nullptr) {
  const Match a = match_of(rule, scene, runs, 0, form), b = match_of(rule, scene, runs, 1, form);
  return {std::max(a.ratio, b.ratio), std::max(a.rounding, b.rounding), std::max(a.distance, b.distance)};
}

/// The rule that matches best; null if no rule agrees with the runs.
const Candidate* same_as(const std::vector<Candidate>& rules, const Scene& scene, const Runs& runs, Match& best) {
  const Candidate* same = nullptr;
  best = {infinity, infinity, infinity};
  for (const Candidate& rule : rules)
    if (const Match match = match_of(rule, scene, runs); match.ratio <= 1 && match.ratio < best.ratio)
      best = match, same = &rule;
  return same;
}

/// `own_steps` if the two runs differ by less than a hundredth of the difference for any rule, and their error is
/// smaller than that difference and does not fall with a high power of the step. `ignores_step` if only the error is
/// larger; else `nearest`.
FoundRule::Kind kind_by_steps(const Scene& scene, const Runs& runs, const std::vector<Candidate>& rules) {
  const auto rk4 = std::ranges::find(rules, "rk4", &Candidate::name);
  Path truth;
  const Path fine = path_of(*rk4, scene, scene.start, runs.h[1] / 32, 32 * steps);
  for (size_t i = 0; i < fine.size(); i += 64) truth.push_back(fine[i]);
  const Path half = every_second(runs.path[1]);
  double least = infinity;
  for (const Candidate& rule : rules)
    least = std::min(least, distance(path_of(rule, scene, scene.start, runs.h[0], steps),
                                     every_second(path_of(rule, scene, scene.start, runs.h[1], steps))));
  const double coarse = distance(runs.path[0], truth), fine_error = distance(half, truth);
  if (distance(runs.path[0], half) >= 0.01 * least || fine_error < coarse / 8) return FoundRule::nearest;
  return fine_error < least ? FoundRule::own_steps : FoundRule::ignores_step;
}

/// Finds the form of the drag from runs with drag. Without drag, `rule` agrees with the method.
void find_drag(const Method& method, const Candidate& rule, const Scene& plain, FoundRule& found) {
  const Scene dragged = with_drag(plain);
  try {
    const Runs runs = runs_of(method, dragged);
    found.tried += ", drag";
    if (match_of(rule, dragged, runs).ratio <= 1) {
      found.drag = rule.drag, found.own_drag = true;
      return;
    }
    for (const DragForm& form : drag_forms())
      if ((form.where != DragForm::kick || rule.name == "symplectic-euler") &&
          match_of(rule, plain, runs, &form).ratio <= 1) {
        found.drag = form.name;
        return;
      }
    found.reason = "its drag is neither explicit nor implicit nor exact";
  } catch (const std::runtime_error& refusal) {
    found.reason = fmt::format("its drag is unknown: {}", refusal.what());
  }
}

constexpr std::pair<const char*, std::string FoundRule::*> texts[] = {
    {"rule", &FoundRule::rule},   {"like", &FoundRule::like},     {"drag", &FoundRule::drag},
    {"tried", &FoundRule::tried}, {"reason", &FoundRule::reason}, {"on_one_spring", &FoundRule::on_one_spring}};
constexpr std::pair<const char*, bool FoundRule::*> flags[] = {
    {"own_drag", &FoundRule::own_drag}, {"exact", &FoundRule::exact}, {"single", &FoundRule::single}};

}  // namespace

FoundRule find_rule(const Method& method) {
  FoundRule found;
  struct Net {
    bool held, pulled;
    const char* ingredients;
  };
  for (const Net& each :
       {Net{true, true, "springs, gravity, pins"}, {false, true, "springs, gravity"}, {false, false, "springs"}}) {
    const Scene scene = net(each.held, each.pulled);
    found.tried = each.ingredients;
    if (method.adaptive) {
      found.kind = FoundRule::own_steps;
      return found;
    }
    Runs runs;
    try {
      runs = runs_of(method, scene);
    } catch (const Unsupported& refusal) {
      if (found.reason.empty()) found.reason = refusal.what();
      continue;
    } catch (const InputError& failure) {
      found.reason = failure.what();
      return found;
    }
    found.reason.clear();
    std::vector<Candidate> rules = candidates();
    found.single = runs.u > 0x1p-53;
    Match match;
    if (const Candidate* same = same_as(rules, scene, runs, match)) {
      found.kind = FoundRule::same, found.rule = same->name, found.distance = match.distance;
      found.exact = match.rounding <= 1;
      if (found.exact) found.like = same->like;
      find_drag(method, *same, scene, found);
      return found;
    }
    found.kind = runs.own_steps ? FoundRule::own_steps : kind_by_steps(scene, runs, rules);
    found.distance = infinity;
    for (const Candidate& rule : rules)
      if (const double off = match_of(rule, scene, runs, 1).distance; off < found.distance)
        found.distance = off, found.rule = rule.name;
    if (found.kind == FoundRule::nearest) try {
        std::erase_if(rules, [](const Candidate& rule) { return !rule.one_by_one; });
        const Scene one = net(each.held, each.pulled, true);
        if (const Candidate* same = same_as(rules, one, runs_of(method, one), match)) found.on_one_spring = same->name;
      } catch (const std::runtime_error&) {  // its rule on one spring stays unknown
      }
    return found;
  }
  return found;
}

std::string sentence_of(const FoundRule& found) {
  const std::string more = found.reason.empty() ? "" : "; " + found.reason;
  switch (found.kind) {
    case FoundRule::same:
      return fmt::format("{} on a net of {}{}: largest difference {:.1e} of the net's size{}", found.rule, found.tried,
                         found.drag.empty() ? "" : fmt::format(" ({} drag)", found.drag), found.distance, more);
    case FoundRule::nearest:
      return fmt::format("none of mysim's; the nearest is {}, at a distance of {:.1e} of the size of a net of {}{}{}",
                         found.rule, found.distance, found.tried,
                         found.on_one_spring.empty() ? "" : fmt::format("; {} on one spring", found.on_one_spring),
                         more);
    case FoundRule::own_steps:
      return "unknown: it chooses its own steps";
    case FoundRule::ignores_step:
      return "unknown: it ignores the requested step";
    case FoundRule::unknown:
      break;
  }
  return "unknown" + more;
}

std::string name_of(const FoundRule& found) {
  std::string name = found.kind == FoundRule::same ? found.rule
                     : found.on_one_spring.empty() ? ""
                                                   : found.on_one_spring + " on one spring";
  if (found.kind == FoundRule::same && !found.exact) name += ", solver above rounding";
  return name.empty() || !found.single ? name : name + ", single precision";
}

FoundRule cached_rule(const Method& method) {
  const auto folder = cache_folder();
  if (!folder || method.fingerprint.empty()) return find_rule(method);
  const std::string key = fmt::format("{} {} {}", build_id(), method.name, method.fingerprint);
  const auto file = *folder / fmt::format("rule-{:016x}.json", Fnv1a::of(key));
  if (const auto content = try_read_file(file)) try {
      const JsonField stored = JsonField::parse(*content, file.string());
      if (stored["key"].text() == key) {
        FoundRule found;
        found.kind = static_cast<FoundRule::Kind>(stored["kind"].whole_number(0, 4));
        found.distance = stored["distance"].number();
        for (const auto& [name, member] : flags) found.*member = stored[name].boolean();
        for (const auto& [name, member] : texts) found.*member = stored[name].text();
        return found;
      }
    } catch (const InputError&) {  // damaged: identify again
    }
  const FoundRule found = find_rule(method);
  Json json{{"key", key},
            {"kind", static_cast<int>(found.kind)},
            {"distance", std::isfinite(found.distance) ? found.distance : -1}};
  for (const auto& [name, member] : flags) json[name] = found.*member;
  for (const auto& [name, member] : texts) json[name] = found.*member;
  try {
    write_file(file, dump(json, 1) + "\n");
  } catch (const InputError&) {
    // disk full or read-only: the next run identifies it again
  }
  return found;
}

void identify_by_runs(Method& method) {
  method.identify = [method, found = std::make_shared<std::optional<FoundRule>>()]() -> const FoundRule& {
    if (!*found) *found = cached_rule(method);
    return **found;
  };
}

}  // namespace crosscheck
