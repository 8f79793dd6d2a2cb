#include "experiments/disagreements/disagreements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "experiments/scenes/scenes.h"
#include "experiments/tables/disagreements.h"
#include "mysim/base/errors.h"
#include "mysim/run/observers.h"
#include "reference/engines/engines.h"
#include "reference/method.h"

namespace crosscheck {

std::vector<DirectionError> direction_errors(const std::string& method, Scene scene,
                                             const std::vector<double>& angles) {
  Sphere& ball = scene.model.find<Spheres>()->list.at(0);
  ball.friction = 0;
  const Vec3 g = scene.model.find<Gravity>()->acceleration;
  const Method chosen = find_method(method);
  constexpr double duration = 4e-3, step = 2e-4;  // s
  constexpr double inside = 1.2e-4;  // m: the surface of a grid of 20 mm is up to a^2 / 4R = 0.1 mm too low

  std::vector<DirectionError> errors;
  for (const double angle : angles) {
    const Vec3 normal(std::sin(angle), std::cos(angle), 0), down(std::cos(angle), -std::sin(angle), 0);
    scene.start.x.col(0) = ball.centre + (ball.contact_radius() - inside) * normal;
    scene.start.v.setZero();
    auto pushed = [&](double h) {
      Recorder recorder;
      const Outcome out = run_method(chosen, scene, {h, duration, 1}, {&recorder});
      if (out.verdict != Verdict::ok) throw std::runtime_error(method + ": " + out.reason);
      const Vec3 impulse = recorder.trajectory.v.back().col(0) - g * duration;
      return Vec3(std::atan2(impulse.dot(down), impulse.dot(normal)), std::atan2(impulse.z(), impulse.dot(normal)), 0);
    };
    const Vec3 found = 2 * pushed(step / 2) - pushed(step);
    errors.push_back({angle, found[0], found[1]});
  }
  return errors;
}

Scene scene_of(const Disagreement& disagreement) {
  return read_scene(file_of_disagreement(disagreement.scene.empty() ? disagreement.name : disagreement.scene));
}

namespace {

/// The method of a row: for "engine:NAME+option", the kept program with this option; otherwise the name itself.
std::string method_named(const std::string& name) {
  if (!name.starts_with(engine_prefix)) return name;
  const size_t end = name.find('+');
  const std::string engine = name.substr(engine_prefix.size(), end - engine_prefix.size());
  return std::string(program_prefix) + kept_program(engine).string() + (end == name.npos ? "" : name.substr(end));
}

}  // namespace

std::vector<Series> run_variants(const Disagreement& disagreement, const Scene& scene) {
  std::vector<Series> all;
  Trajectory first;
  for (const Variant& variant : disagreement.variants) {
    Scene own = scene;
    if (auto* springs = own.model.find<Springs>()) springs->law = variant.law;
    if (variant.change) variant.change(own);
    Run run = default_run(own);
    if (variant.step > 0) run.step = variant.step;
    Recorder recorder;
    Series series{variant, run_method(find_method(method_named(variant.method)), own, run, {&recorder}), {}};
    const Trajectory& path = recorder.trajectory;
    if (all.empty()) first = path;
    auto value = [&](const State& s, const Points& of_first) {
      return disagreement.value ? disagreement.value(own, s) : largest_column(s.x - of_first);
    };
    for (int i = 0; i < path.frames() && i < first.frames(); ++i)
      series.points.emplace_back(path.t[i], value({path.t[i], path.x[i], path.v[i]}, first.x[i]));
    if (series.points.empty() && series.outcome.verdict == Verdict::timeout)
      series.points.emplace_back(0, value(own.start, own.start.x));
    all.push_back(std::move(series));
  }
  return all;
}

Disagreement with_worlds_of(Disagreement disagreement, const std::string& program) {
  auto of_program = [&](const std::string& method) {
    const MethodFamily& family = family_of(method);
    if (family.role != Role::peer) return method;
    const std::string rest = method.substr(std::min(method.size(), family.name.size() + 1));
    return rest.empty() ? program : fmt::format("{}+world={}", program, rest);
  };
  disagreement.world = of_program(disagreement.world);
  for (Variant& variant : disagreement.variants) variant.method = of_program(variant.method);
  return disagreement;
}

std::string_view name_of(TroubleState state) {
  switch (state) {
    case TroubleState::explained:
      return "explained";
    case TroubleState::reproduced:
      return "reproduced";
    case TroubleState::not_reproduced:
      return "not reproduced";
    case TroubleState::not_asked:
      break;
  }
  return "not asked";
}

double most_apart(const Series& a, const Series& b, double until) {
  double most = 0;
  for (size_t i = 0; i < std::min(a.points.size(), b.points.size()) && a.points[i].first < until; ++i)
    if (const double apart = std::abs(a.points[i].second - b.points[i].second); !(apart <= most))
      most = std::isnan(apart) ? INFINITY : apart;
  return most;
}

bool holds(const Condition& c, const std::vector<Series>& all) {
  const Series &a = all.at(c.a), &b = all.at(c.b);
  if (c.kind == Condition::Kind::hangs)
    return a.outcome.verdict == Verdict::timeout && b.outcome.verdict == Verdict::ok &&
           a.outcome.process_seconds > c.by * b.outcome.process_seconds;
  const double most = most_apart(a, b, c.until);
  if (c.kind == Condition::Kind::apart) return most > c.by;
  return most <= c.by && a.outcome.verdict == Verdict::ok && b.outcome.verdict == Verdict::ok;
}

namespace {

bool all_hold(const std::vector<Condition>& conditions, const std::vector<Series>& all) {
  return std::ranges::all_of(conditions, [&](const Condition& c) { return holds(c, all); });
}

}  // namespace

std::string why_not_asked(const Disagreement& disagreement, const std::vector<Series>& all) {
  const auto why = [](const Series& s) {
    return fmt::format("{} ({}): {}", s.variant.label, s.variant.method,
                       s.outcome.reason.empty() ? in_words(s.outcome.verdict) : s.outcome.reason);
  };
  for (const Series& s : all)
    if (s.points.empty() || s.outcome.verdict == Verdict::unsupported) return why(s);
  if (all_hold(disagreement.symptom, all)) return "";
  for (const Series& s : all)
    if (s.outcome.verdict != Verdict::ok) return fmt::format("{}, {}", why(s), in_words(s.outcome.verdict));
  return "";
}

TroubleState state_of(const Disagreement& disagreement, const std::vector<Series>& all) {
  if (!why_not_asked(disagreement, all).empty()) return TroubleState::not_asked;
  if (!all_hold(disagreement.symptom, all)) return TroubleState::not_reproduced;
  const auto& cause = disagreement.cause_removed;
  return !cause.empty() && all_hold(cause, all) ? TroubleState::explained : TroubleState::reproduced;
}

std::string criterion_of(const Disagreement& d) {
  auto in_words = [&](const std::vector<Condition>& conditions) {
    std::string text;
    for (const Condition& c : conditions) {
      const std::string &a = d.variants.at(c.a).label, &b = d.variants.at(c.b).label,
                        until = std::isinf(c.until) ? "" : fmt::format(" before {:g} s", c.until);
      text += text.empty() ? "" : "; ";
      if (c.kind == Condition::Kind::hangs)
        text += fmt::format("\"{}\" takes more than {:g} times the CPU time of \"{}\" and does not end", a, c.by, b);
      else
        text += fmt::format("\"{}\" is {} {:g} {} {} \"{}\"{}", a,
                            c.kind == Condition::Kind::apart ? "more than" : "within", c.by, d.unit,
                            c.kind == Condition::Kind::apart ? "from" : "of", b, until);
    }
    return text;
  };
  return "reproduced: " + in_words(d.symptom) +
         (d.cause_removed.empty() ? "" : ". Explained: " + in_words(d.cause_removed));
}

namespace {

/// Fingerprint of the kept program to which a row refers, if it is among the methods.
std::optional<std::string> fingerprint_of(const Disagreement& row, const Request& request) {
  const std::string program = method_named(row.world);
  for (const Method& method : request.methods)
    if (method.name == program || method.name.starts_with(program + "+")) return method.fingerprint;
  return std::nullopt;
}

}  // namespace

std::vector<Point> disagreements_points(const Request& request) {
  std::string program, fingerprint;
  for (const Method& method : request.methods)
    // programs with Bullet's worlds have the option +world
    if (const size_t at = method.name.find("+world=");
        method.name.starts_with(program_prefix) && at != method.name.npos) {
      if (!program.empty() && program != method.name.substr(0, at))
        throw InputError(fmt::format("disagreements: expected one program with +world=, got {} and {}", program,
                                     method.name.substr(0, at)));
      program = method.name.substr(0, at), fingerprint = method.fingerprint;
    }
  std::vector<Point> points;
  const auto add_point = [&](const Disagreement& row, const std::string& content) {
    points.push_back(
        {"disagreement: " + row.name, fmt::format("{} {}", scene_of(row).hash, content), [d = row](TableSet& tables) {
           const Scene scene = scene_of(d);
           const std::vector<Series> all = run_variants(d, scene);
           const TroubleState state = state_of(d, all);
           Table table = table_of<DisagreementCurveRow>(d.name + "-disagreement");
           table.columns.back() = {d.quantity, d.unit};
           for (const Series& s : all)
             for (const auto& [t, value] : s.points)
               add(table, DisagreementCurveRow{s.variant.label, s.variant.method, s.outcome.step, s.outcome.verdict, t,
                                               value});
           Table summary = table_of<DisagreementRow>();
           const bool asked = state != TroubleState::not_asked;
           std::string effect = asked ? d.effect(all) : why_not_asked(d, all);
           if (asked && d.measured) {
             const TableWithSentence more = d.measured(d);
             tables.add(more.table);
             effect += " " + more.sentence;
           }
           add(summary, DisagreementRow{d.name, d.world, d.what, d.cause, effect, d.threads,
                                        std::string(name_of(state)), criterion_of(d), scene.hash});
           tables.add(table);
           tables.add(summary);
         }});
  };
  if (!request.scenes_only)
    for (const Disagreement& each : disagreements())
      add_point(program.empty() ? each : with_worlds_of(each, program), program + " " + fingerprint);
  for (const Disagreement& each : engine_disagreements())
    if (const auto of_engine = fingerprint_of(each, request)) add_point(each, *of_engine);
  return points;
}

}  // namespace crosscheck
