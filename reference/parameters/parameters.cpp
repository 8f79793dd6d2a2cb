#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mysim/base/errors.h"
#include "mysim/model/system.h"
#include "reference/bullet/parameters.h"
#include "reference/parameters/parameters.h"

namespace crosscheck {

std::vector<double> values_of(const Scene& scene, SceneNumber quantity) {
  const Particles& particles = scene.model.particles;
  std::vector<double> values;
  const auto of_free = [&](auto value) {
    for (int i = 0; i < particles.size(); ++i)
      if (!particles.pinned[i]) values.push_back(value(i));
  };
  if (quantity == SceneNumber::mass) of_free([&](int i) { return particles.mass[i]; });
  // engines have no numbers for other terms; the certificates state how these are treated
  const Overloaded take{
      [&](const Springs& springs) {
        if (quantity == SceneNumber::stiffness)
          for (const Spring& s : springs.list) values.push_back(s.k);
      },
      [&](const Dashpots& dashpots) {
        if (quantity == SceneNumber::dashpot)
          for (const auto& d : dashpots.list) values.push_back(d.c);
      },
      [&](const Drag& drag) {
        if (quantity != SceneNumber::drag) return;
        if (const auto rate = uniform_drag_rate(scene.model))
          values.push_back(*rate);
        else
          of_free([&](int i) { return drag.c[i] / particles.mass[i]; });
      },
      [&](const Gravity& gravity) {
        if (quantity == SceneNumber::gravity) values.push_back(gravity.acceleration.norm());
      },
      [&](const OneOf<Spheres, Planes> auto& surfaces) {
        if (quantity == SceneNumber::friction)
          for (const auto& s : surfaces.list) values.push_back(s.friction);
      },
      [](const OneOf<Rotation, Bending, Constraints, Wind, Aerodynamics> auto&) {},
  };
  for (const Term& term : scene.model.terms) std::visit(take, term);
  return values;
}

namespace {

using Gather = NumberRule::Gather;

void set_values(Scene& scene, SceneNumber quantity, std::span<const double> values) {
  Particles& particles = scene.model.particles;
  size_t next = 0;
  const auto value = [&] { return values.size() == 1 ? values[0] : values[next++]; };
  if (quantity == SceneNumber::mass)
    for (int i = 0; i < particles.size(); ++i)
      if (!particles.pinned[i]) particles.mass[i] = value();
  if (quantity == SceneNumber::drag) {
    auto& c = scene.model.find<Drag>()->c;
    for (int i = 0; i < particles.size(); ++i)
      if (!particles.pinned[i] || values.size() == 1) c[i] = value() * particles.mass[i];
  }
  if (quantity == SceneNumber::stiffness)
    for (Spring& s : scene.model.find<Springs>()->list) s.k = value();
  if (quantity == SceneNumber::dashpot)
    for (auto& d : scene.model.find<Dashpots>()->list) d.c = value();
  if (quantity == SceneNumber::gravity) {
    Vec3& g = scene.model.find<Gravity>()->acceleration;
    if (g.norm() > 0) g *= value() / g.norm();
  }
  if (quantity != SceneNumber::friction) return;
  const Overloaded set{[&](OneOf<Spheres, Planes> auto& surfaces) {
                         for (auto& s : surfaces.list) s.friction = value();
                       },
                       [](auto&) {}};
  for (Term& term : scene.model.terms) std::visit(set, term);
}

NumberContext context_of(const Scene& scene, SceneNumber quantity, size_t which, double h, int n) {
  NumberContext at{h, n, uniform_drag_rate(scene.model).value_or(0), 0, scene.model.particles.size()};
  if (quantity == SceneNumber::stiffness)
    at.mu = bullet::pair_mass(scene.model.particles, scene.model.find<Springs>()->list[which]);
  const auto* springs = scene.model.find<Springs>();
  if (quantity == SceneNumber::dashpot && springs)
    for (const Spring& s : springs->list)
      if (const auto& d = scene.model.find<Dashpots>()->list[which]; s.a == d.a && s.b == d.b)
        at.mu = bullet::pair_mass(scene.model.particles, s), at.k = s.k;
  return at;
}

std::string range_text(std::span<const double> values) {
  const auto [low, high] = std::ranges::minmax(values);
  return low == high ? fmt::format("{:.4g}", low) : fmt::format("{:.4g} to {:.4g}", low, high);
}

/// True for a link between two pins. Neither end moves, so the engine's value is 1 for any stiffness, and the stiffness
/// cannot be recovered from it.
bool lies_between_pins(const NumberRule& rule, const NumberContext& at) {
  return rule.quantity == SceneNumber::stiffness && std::isinf(at.mu) && rule.condition;
}

/// `at`: the context of each of the scene's values.
std::vector<double> engine_values(const NumberRule& rule, const TranslationTarget& target,
                                  const std::vector<double>& scene, const std::vector<NumberContext>& at) {
  if (rule.gather == Gather::same && std::ranges::any_of(scene, [&](double v) { return v != scene[0]; }))
    throw Unsupported(fmt::format("{} has one {} for the whole body; the scene's {} is {} {}", target.numbers->title,
                                  rule.name, name_of(rule.quantity), range_text(scene), unit_of(rule.quantity)));
  std::vector<double> values;
  const auto add = [&](double value) {
    values.push_back(target.single_precision ? static_cast<double>(static_cast<float>(value)) : value);
  };
  if (rule.gather == Gather::mean) {
    double sum = 0;
    for (const double v : scene) sum += v;
    add(rule.to(sum / static_cast<double>(scene.size()), at[0]));
  } else {
    for (size_t i = 0; i < scene.size(); ++i) add(rule.to(scene[i], at[i]));
  }
  const auto infinite = [&](size_t i) { return lies_between_pins(rule, at[i]); };
  const auto good = [&](double v) { return rule.valid ? rule.valid(v) : v >= 0 && std::isfinite(v); };
  for (size_t i = 0; i < values.size(); ++i)
    if (!infinite(i) && !good(values[i]))
      throw Unsupported(fmt::format("{} {} becomes {} = {:.17g}{}; expected {}", name_of(rule.quantity), scene[i],
                                    rule.name, values[i], target.single_precision ? " in single precision" : "",
                                    rule.expected.empty() ? "a finite number" : rule.expected));
  if (rule.gather == Gather::median) {
    std::vector<double> of_some;
    for (size_t i = 0; i < values.size(); ++i)
      if (!infinite(i)) of_some.push_back(values[i]);
    if (of_some.empty()) of_some = values;
    std::ranges::nth_element(of_some, of_some.begin() + of_some.size() / 2);
    return {of_some[of_some.size() / 2]};
  }
  return values;
}

/// Relative rounding error of converting a number and back: half an ulp of the engine's number plus about four rounding
/// errors in each direction (8 eps), all multiplied by the condition number of converting back.
double rounding_of(const NumberRule& rule, double engine, bool single, const NumberContext& at) {
  constexpr double eps = std::numeric_limits<double>::epsilon(), eps_single = std::numeric_limits<float>::epsilon();
  return (0.5 * (single ? eps_single : eps) + 8 * eps) *
         (rule.condition ? std::max(1.0, rule.condition(engine, at)) : 1);
}

/// Largest relative error of converting the scene's numbers and back: rounding, plus, if one number stands for several,
/// its exactly known difference from each of them.
double stated_error(const NumberRule& rule, const TranslatedNumber& number, bool single,
                    const std::vector<NumberContext>& at) {
  double most = 0;
  for (size_t i = 0; i < number.scene.size(); ++i) {
    if (lies_between_pins(rule, at[i])) continue;
    const double rounding = rounding_of(rule, number.engine[number.engine.size() == 1 ? 0 : i], single, at[i]);
    const bool gathered = rule.gather == Gather::median || rule.gather == Gather::mean;
    const double off = gathered && number.scene[i] > 0 ? std::abs(number.back[i] / number.scene[i] - 1) : 0;
    most = std::max(most, rounding + off);
  }
  return most;
}

std::string range_here(const Scene& scene, const NumberRule& rule, const Translation& t,
                       const std::vector<NumberContext>& at) {
  if (!rule.one_by_one) {
    const Stepper* stepper = t.target.runs ? stepper_of(*t.target.runs) : nullptr;
    const double omega = highest_frequency(scene.model, scene.start);
    const auto gamma = uniform_drag_rate(scene.model);
    if (!stepper || stepper->adaptive || !(omega > 0) || !gamma) return "";
    const double limit = stepper->limit(omega, *gamma);
    if (std::isinf(limit)) return "stable at every step";
    if (limit == 0) return "stable at no step";
    return fmt::format(
        "the critical step is {:.3g} s here, {}", limit,
        t.h < limit ? fmt::format("the step {:.2g} of it", t.h / limit) : "below the step: the run will blow up");
  }
  const double h = t.target.numbers->sub_steps ? t.h / t.target.iterations : t.h;
  std::vector<double> all;
  for (size_t i = 0; i < at.size(); ++i)
    if (std::isfinite(at[i].mu)) all.push_back(scene.model.find<Springs>()->list[i].k * h * h / at[i].mu);
  if (all.empty()) return "all springs lie between pins";
  return fmt::format("k h^2 / mu is {} here, {}", range_text(all),
                     std::ranges::max(all) <= sequential_limit ? "inside"
                     : at.size() == 1                          ? "on a single link"
                                                               : "outside: expect a softer net");
}

}  // namespace

Scene scene_of(const Scene& scene, const EngineNumbers& engine, const NumbersFile& file) {
  Scene changed = scene;
  // in the table's order, so that values on which a formula depends come first
  for (const NumberRule& rule : engine.rules)
    for (const auto& [of, engine_values] : file.numbers) {
      if (of != &rule) continue;
      std::vector<double> values = values_of(scene, rule.quantity);
      for (size_t i = 0; i < values.size(); ++i) {
        const NumberContext at = context_of(changed, rule.quantity, i, file.h, file.iterations);
        if (lies_between_pins(rule, at)) continue;
        values[i] = rule.from(engine_values[engine_values.size() == 1 ? 0 : i], at);
      }
      set_values(changed, rule.quantity, values);
    }
  changed.hash = hash_of(changed);
  return changed;
}

double rounding_of(const Scene& changed, const TranslationTarget& target, const NumbersFile& file) {
  double most = 0;
  for (const auto& [rule, engine] : file.numbers)
    for (size_t i = 0; i < values_of(changed, rule->quantity).size(); ++i)
      if (const NumberContext at = context_of(changed, rule->quantity, i, file.h, file.iterations);
          !lies_between_pins(*rule, at))
        most = std::max(most, rounding_of(*rule, engine[engine.size() == 1 ? 0 : i], target.single_precision, at));
  return most;
}

Translation translate(const Scene& scene, const TranslationTarget& target, double h) {
  if (scene.model.first_order()) throw Unsupported("a first-order scene has no stiffness, damping or masses");
  Translation t{target, h, {}, {}, scene};
  NumbersFile file{h, target.iterations, {}};
  std::vector<std::vector<NumberContext>> contexts;
  for (const NumberRule& rule : target.numbers->rules) {
    std::vector<double> values = values_of(scene, rule.quantity);
    if (values.empty()) continue;
    if (!rule.to) {
      t.lost.push_back(fmt::format("{}: {}", name_of(rule.quantity), rule.formula));
      if (rule.quantity == SceneNumber::dashpot)
        std::erase_if(t.back.model.terms, [](const Term& term) { return std::holds_alternative<Dashpots>(term); });
      continue;
    }
    std::vector<NumberContext>& at = contexts.emplace_back();
    for (size_t i = 0; i < values.size(); ++i) at.push_back(context_of(scene, rule.quantity, i, h, target.iterations));
    std::vector<double> engine = engine_values(rule, target, values, at);
    file.numbers.emplace_back(&rule, engine);
    t.numbers.push_back({&rule, std::move(values), std::move(engine), {}});
  }
  t.back = scene_of(t.back, *target.numbers, file);
  for (size_t i = 0; i < t.numbers.size(); ++i) {
    TranslatedNumber& number = t.numbers[i];
    number.back = values_of(t.back, number.rule->quantity);
    number.stated = stated_error(*number.rule, number, target.single_precision, contexts[i]);
    if (number.rule->quantity == SceneNumber::stiffness) number.here = range_here(scene, *number.rule, t, contexts[i]);
  }
  return t;
}

}  // namespace crosscheck
