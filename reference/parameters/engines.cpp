// One row per engine, with a rule for each parameter of a scene; and the look-up by name.
#include "reference/parameters/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "reference/bullet/parameters.h"

namespace crosscheck {

namespace {

struct NumberWords {
  std::string_view name, unit, holder;
};
constexpr NumberWords number_words[] = {
    {"mass m", "kg", "free particle"},       {"drag rate gamma", "1/s", "free particle"},
    {"spring stiffness k", "N/m", "spring"}, {"dashpot c", "N s/m", "dashpot"},
    {"gravity g", "m/s^2", "scene"},         {"friction mu", "1", "sphere"}};  // in the order of SceneNumber
static_assert(std::size(number_words) == static_cast<size_t>(SceneNumber::friction) + 1);

const NumberWords& words_of(SceneNumber quantity) { return number_words[static_cast<size_t>(quantity)]; }

}  // namespace

std::string_view name_of(SceneNumber quantity) { return words_of(quantity).name; }
std::string_view unit_of(SceneNumber quantity) { return words_of(quantity).unit; }
std::string_view holder_of(SceneNumber quantity) { return words_of(quantity).holder; }

namespace {

using Context = NumberContext;
using Gather = NumberRule::Gather;

double as_it_is(double value, const Context&) { return value; }
double inverse(double value, const Context&) { return 1 / value; }
bool above_zero(double value) { return value > 0 && std::isfinite(value); }
bool below_one(double value) { return value >= 0 && value < 1; }
bool between_zero_and_one(double value) { return value > 0 && value < 1; }

constexpr std::string_view a_positive = "a number above zero", a_share = "a number from 0 to below 1",
                           a_link =
                               "a number above 0 and below 1 (a link is rigid at 1, over-relaxes above 1, and "
                               "explodes from 2 on, without a stiffness)",
                           always = "everywhere", coulomb = "everywhere: Coulomb's law, without restitution",
                           // 0.03 is sequential_limit
    in_nets = "on one link at small strain; in a net up to k h^2 / mu of about 0.03, above which the net is too soft";

NumberRule plain(SceneNumber quantity, std::string_view name, std::string_view how = "unchanged",
                 std::string_view holds = always) {
  return {quantity, name, unit_of(quantity), how, how, holds, as_it_is, as_it_is};
}
NumberRule mass_as_it_is() {
  NumberRule rule = plain(SceneNumber::mass, "mass");
  rule.expected = a_positive, rule.valid = above_zero;
  return rule;
}
NumberRule nothing(SceneNumber quantity, std::string_view why) { return {quantity, "", "", why, why, "nowhere"}; }

/// kLST, called `name` in the engine.
NumberRule link(std::string_view name, Gather gather) {
  return {.quantity = SceneNumber::stiffness,
          .name = name,
          .unit = "1",
          .formula = "1 - (1 + k h^2 / mu)^(-1/n), mu = 1 / (1/m_a + 1/m_b), with 1/m = 0 for pins",
          .inverse = "k = mu / h^2 ((1 - value)^-n - 1)",
          .holds = in_nets,
          .to = [](double k, const Context& at) { return bullet::link_stiffness(k, at.mu, at.h, at.n); },
          .from = [](double kLST, const Context& at) { return bullet::newton_per_metre(kLST, at.mu, at.h, at.n); },
          .gather = gather,
          .expected = a_link,
          .valid = between_zero_and_one,
          // masses in mu are rounded as well
          .condition = [](double kLST, const Context& at) { return 1 + bullet::link_condition(kLST, at.n); },
          .one_by_one = true};
}

/// kDP, called `name` in the engine.
NumberRule step_damping(std::string_view name) {
  return {.quantity = SceneNumber::drag,
          .name = name,
          .unit = "1",
          .formula = "1 - exp(-gamma h)",
          .inverse = "gamma = -ln(1 - value) / h",
          .holds = "where all drag rates are the same",
          .to = [](double gamma, const Context& at) { return bullet::damping_of_drag(gamma, at.h); },
          .from = [](double kDP, const Context& at) { return bullet::drag_of_damping(kDP, at.h); },
          .gather = Gather::same,
          .expected = a_share,
          .valid = below_one,
          .condition = [](double kDP, const Context&) { return bullet::damping_condition(kDP); }};
}

NumberRule compliance(std::string_view name, std::string_view formula) {
  return {.quantity = SceneNumber::stiffness,
          .name = name,
          .unit = "m/N",
          .formula = formula,
          .inverse = "k = 1 / value",
          .holds = in_nets,
          .to = inverse,
          .from = inverse,
          .expected = a_positive,
          .valid = above_zero,
          .one_by_one = true};
}

/// Frequency of a spring as a soft constraint (E. Catto, Soft Constraints, GDC 2011).
NumberRule frequency(std::string_view name) {
  constexpr double turn = 2 * std::numbers::pi;
  return {.quantity = SceneNumber::stiffness,
          .name = name,
          .unit = "Hz",
          .formula = "sqrt(k / mu) / 2 pi, mu = 1 / (1/m_a + 1/m_b), with 1/m = 0 for pins",
          .inverse = "k = mu (2 pi value)^2",
          .holds = "for short sub-steps h / n: the rule damps along the line like a dashpot of k h / n",
          .to = [](double k, const Context& at) { return std::sqrt(k / at.mu) / turn; },
          .from = [](double f, const Context& at) { return at.mu * turn * turn * f * f; },
          .condition = [](double, const Context&) { return 3.; }};  // twice the frequency's error plus the masses'
}
/// Damping ratio of a soft constraint, from the dashpot between the same ends as the spring.
NumberRule damping_ratio(std::string_view name) {
  return {.quantity = SceneNumber::dashpot,
          .name = name,
          .unit = "1",
          .formula = "c / (2 sqrt(k mu)), k of the spring between the same ends",
          .inverse = "c = 2 value sqrt(k mu)",
          .holds = "parallel to a spring; the rule adds pi f h / n",
          .to = [](double c, const Context& at) { return c / (2 * std::sqrt(at.k * at.mu)); },
          .from = [](double ratio, const Context& at) { return 2 * ratio * std::sqrt(at.k * at.mu); },
          .condition = [](double, const Context&) { return 3.; }};  // k and the masses are rounded as well
}
/// Damping as a divisor of the velocity in each sub-step.
NumberRule dividing_damping(std::string_view name) {
  return {.quantity = SceneNumber::drag,
          .name = name,
          .unit = "1/s",
          .formula = "n / h (exp(gamma h / n) - 1)",
          .inverse = "gamma = n / h ln(1 + value h / n)",
          .holds = always,
          .to = [](double gamma, const Context& at) { return at.n / at.h * std::expm1(gamma * at.h / at.n); },
          .from = [](double value, const Context& at) { return at.n / at.h * std::log1p(value * at.h / at.n); }};
}

std::vector<EngineNumbers> make_table() {
  NumberRule inverse_mass{SceneNumber::mass, "mInvMass", "1/kg",    "1 / m, and 0 for pins",
                          "m = 1 / value",   always,     inverse,   inverse,
                          Gather::each,      a_positive, above_zero};
  NumberRule total_mass{.quantity = SceneNumber::mass,
                        .name = "total_mass",
                        .unit = "kg",
                        .formula = "m times the number of particles, including pins: all masses are equal",
                        .inverse = "m = value / number of particles",
                        .holds = "where all masses are the same",
                        .to = [](double m, const Context& at) { return m * at.particles; },
                        .from = [](double total, const Context& at) { return total / at.particles; },
                        .gather = Gather::mean,
                        .expected = a_positive,
                        .valid = above_zero};
  NumberRule factor{.quantity = SceneNumber::drag,
                    .name = "drag",
                    .unit = "1",
                    .formula = "h gamma (m_cfg.drag)",
                    .inverse = "gamma = value / h",
                    .holds = "h gamma < 1, where all drag rates are the same",
                    .to = [](double gamma, const Context& at) { return bullet::drag_factor(gamma, at.h); },
                    .from = [](double value, const Context& at) { return bullet::drag_of_factor(value, at.h); },
                    .gather = Gather::same,
                    .expected = a_share,
                    .valid = below_one};
  const auto undragged = [](SceneNumber quantity, std::string_view name, std::string_view formula,
                            std::string_view back, std::string_view holds) {
    const auto to = [](double value, const Context& at) {
      return bullet::before_drag(value, bullet::drag_factor(at.gamma, at.h));
    };
    const auto from = [](double value, const Context& at) { return value * (1 - bullet::drag_factor(at.gamma, at.h)); };
    return NumberRule{.quantity = quantity,
                      .name = name,
                      .unit = unit_of(quantity),
                      .formula = formula,
                      .inverse = back,
                      .holds = holds,
                      .to = to,
                      .from = from,
                      // gamma itself is rounded as well
                      .condition = [](double, const Context& at) { return 1 / (1 - at.h * at.gamma); }};
  };
  // each of Jolt's n sub-steps multiplies velocities by 1 - value h / n; all n sub-steps together give exp(-gamma h)
  NumberRule jolt_damping{
      .quantity = SceneNumber::drag,
      .name = "mLinearDamping",
      .unit = "1/s",
      .formula = "n / h (1 - exp(-gamma h / n))",
      .inverse = "gamma = -n / h ln(1 - value h / n)",
      .holds = "where all drag rates are the same",
      .to = [](double gamma, const Context& at) { return bullet::damping_of_drag(gamma, at.h / at.n) * at.n / at.h; },
      .from = [](double value, const Context& at) { return bullet::drag_of_damping(value * at.h / at.n, at.h / at.n); },
      .gather = Gather::same,
      .condition = [](double value, const Context& at) { return bullet::damping_condition(value * at.h / at.n); }};
  constexpr std::string_view stays = "k is unchanged; dashpots of springs are omitted";
  return {
      {.title = "the scene's own numbers",
       .iterations = "",
       .of =
           [](const Method& m) {
             return m.family().is_engine() && !m.position_based && (m.implicit || m.family().is_subject());
           },
       .rules = {mass_as_it_is(), plain(SceneNumber::drag, "gamma"), plain(SceneNumber::stiffness, "k"),
                 plain(SceneNumber::dashpot, "c"), plain(SceneNumber::friction, "friction", "unchanged", coulomb)}},
      {.title = "XPBD, one pass over the springs per step",
       .iterations = "",
       .of = [](const Method& m) { return m.position_based && m.spring_law == SpringLaw::hooke; },
       .rules = {mass_as_it_is(),
                 plain(SceneNumber::drag, "gamma",
                       "unchanged: v / (1 + h gamma), which also applies to what a constraint adds to v"),
                 compliance("compliance", "1 / k; a step adds compliance / h^2 to the inverse masses"),
                 plain(SceneNumber::dashpot, "c", "unchanged, implicit along the line"),
                 plain(SceneNumber::friction, "friction", "unchanged", coulomb)}},
      {.title = "Bullet's position-based links",
       .iterations = "piterations",
       .of = [](const Method& m) { return m.position_based && m.spring_law == SpringLaw::bullet_link; },
       .deaf = "demo",
       .source = "Bullet 3.24, btSoftBody::PSolve_Links",
       .rules = {mass_as_it_is(), step_damping("kDP"), link("kLST", Gather::each),
                 plain(SceneNumber::dashpot, "c", "unchanged, as forces added to the nodes at x_n, v_n"),
                 plain(SceneNumber::friction, "friction", "kDF = 1 times the ball's friction",
                       "only Coulomb's cone: a node sticks if friction is at least tan(slope), and creeps otherwise")}},
      {.title = "Bullet's explicit deformable world",
       .iterations = "",
       .of = [](const Method& m) { return m.family().role == Role::peer && !m.position_based && !m.implicit; },
       .source = "Bullet 3.24, btDeformableMassSpringForce",
       .rules = {mass_as_it_is(), factor,
                 undragged(SceneNumber::stiffness, "stiffness", "k / (1 - h gamma)", "k = value (1 - h gamma)",
                           "h below the critical step, 2 / omega without drag"),
                 plain(SceneNumber::dashpot, "c", "unchanged, solved implicitly after the step"),
                 undragged(SceneNumber::gravity, "gravity", "g / (1 - h gamma)", "g = value (1 - h gamma)", always),
                 plain(SceneNumber::friction, "friction", "kDF = 1 times the ball's friction", coulomb)}},
      {.name = "jolt",
       .title = "Jolt's soft bodies",
       .iterations = "mNumIterations",
       .usual_iterations = 5,
       .sub_steps = true,
       .single_precision = true,
       .source = "Jolt, SoftBodyMotionProperties::ApplyEdgeConstraints and IntegratePositions",
       .rules = {inverse_mass, jolt_damping,
                 compliance("mCompliance",
                            "1 / k; a sub-step of h / n adds compliance n^2 / h^2 to the inverse masses"),
                 nothing(SceneNumber::dashpot, stays),
                 plain(SceneNumber::friction, "mFriction", "mu on body and ball; Jolt uses their geometric mean",
                       coulomb)}},
      {.name = "rapier",
       .title = "Rapier's soft bodies",
       .iterations = "numSolverIterations",
       .usual_iterations = 4,
       .sub_steps = true,
       .single_precision = true,
       .source = "Rapier 0.21, soft body edges",
       .rules = {mass_as_it_is(), dividing_damping("linearDamping"), frequency("naturalFrequency"),
                 damping_ratio("dampingRatio"), plain(SceneNumber::friction, "friction", "unchanged", coulomb)}},
      {.name = "box3d",
       .title = "Box3D's distance joints",
       .iterations = "subStepCount",
       .usual_iterations = 4,
       .sub_steps = true,
       .single_precision = true,
       .source = "Box3D v0.1, distance joint",
       .rules = {mass_as_it_is(), dividing_damping("linearDamping"), frequency("hertz"), damping_ratio("dampingRatio"),
                 plain(SceneNumber::friction, "friction", "unchanged", coulomb)}},
      {.name = "mujoco",
       .title = "MuJoCo's tendons",
       .source = "MuJoCo, spatial tendons",
       .rules = {mass_as_it_is(),
                 plain(SceneNumber::drag, "damping_per_mass",
                       "unchanged: each slide joint's damping is gamma m, implicit unless eulerdamp is disabled"),
                 plain(SceneNumber::stiffness, "stiffness", "unchanged, of a spatial tendon with springlength"),
                 plain(SceneNumber::dashpot, "damping", "unchanged, of the same tendon"),
                 plain(SceneNumber::friction, "friction", "unchanged",
                       "as a soft constraint, with an elliptic or pyramidal cone")}},
      {.name = "godot",
       .title = "GodotPhysics' SoftBody3D",
       .iterations = "simulation_precision",
       .usual_iterations = 5,
       .single_precision = true,
       .stand_in = "bullet/pbd",
       .source = "Godot 4, godot_soft_body_3d.cpp, \"based on Bullet soft body\"",
       .rules = {total_mass, step_damping("damping_coefficient"), link("linear_stiffness", Gather::median),
                 nothing(SceneNumber::dashpot, stays),
                 plain(SceneNumber::friction, "friction", "the ball's own friction alone", coulomb)}}};
}

}  // namespace

std::span<const EngineNumbers> engine_numbers() {
  static const std::vector<EngineNumbers> table = make_table();
  return table;
}

namespace {

/// N in "n=N".
std::optional<int> iterations_in(const std::string& option) {
  int n = 0;
  const char *begin = option.data() + 2, *end = option.data() + option.size();
  if (!option.starts_with("n=") || std::from_chars(begin, end, n).ptr != end || n < 1 || n > 1000) return std::nullopt;
  return n;
}

std::string with_iterations(std::string name, int said, int wanted) {
  if (wanted == 0 || said == wanted) return name;
  if (said != 0) throw InputError(fmt::format("--iterations {} contradicts {}", wanted, name));
  return fmt::format("{}+n={}", name, wanted);
}

}  // namespace

TranslationTarget find_target(const std::string& name, int iterations) {
  const std::vector<std::string> parts = split(name, '+');
  int said = 0;
  for (size_t i = 1; i < parts.size(); ++i)
    if (const auto n = iterations_in(parts[i])) said = *n;
  std::vector<std::string> engines;
  for (const EngineNumbers& engine : engine_numbers()) {
    if (engine.name.empty()) continue;
    engines.emplace_back(engine.name);
    if (parts[0] != engine.name) continue;
    for (size_t i = 1; i < parts.size(); ++i)
      if (!iterations_in(parts[i]))
        refuse_option(std::string(engine.name), parts[i],
                      fmt::format("+n=1 to +n=1000 ({}) or none", engine.iterations));
    const bool given = said + iterations > 0;
    TranslationTarget target{with_iterations(name, said, iterations), &engine,
                             given ? std::max(said, iterations) : engine.usual_iterations, given,
                             engine.single_precision};
    if (!engine.stand_in.empty()) {
      target.runs = find_method(fmt::format("{}+n={}", engine.stand_in, target.iterations));
      target.stand_in = true;
    }
    return target;
  }
  Method method;
  try {
    method = find_method(name);
  } catch (const InputError& unknown) {
    throw InputError(fmt::format("{}; translate also knows {}{}", unknown.what(), fmt::join(engines, ", "),
                                 did_you_mean(parts[0], engines)));
  }
  for (const EngineNumbers& engine : engine_numbers()) {
    if (!engine.of || !engine.of(method) || (!engine.deaf.empty() && std::ranges::count(parts, engine.deaf) > 0))
      continue;
    if (iterations > 0 && engine.iterations.empty())
      throw InputError(
          fmt::format("--iterations: {} always takes one pass per step; choose --step instead", method.name));
    if (const std::string full = with_iterations(name, said, iterations); full != name) method = find_method(full);
    const bool single = method.family().single_precision || engine.single_precision;
    const int n = std::max({1, said, iterations});
    std::string full_name = method.name;
    return {std::move(full_name), &engine, n, said + iterations > 0, single, std::move(method)};
  }
  throw InputError(fmt::format(
      "{}: no known parameters; expected a method of mysim or Bullet that uses the scene's stiffness, or one of: {}",
      method.name, fmt::join(engines, ", ")));
}

}  // namespace crosscheck
