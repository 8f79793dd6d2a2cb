// Known disagreements of the engines that `engine NAME` builds.

#include <fmt/format.h>

#include "experiments/disagreements/disagreements.h"
#include "experiments/disagreements/effects.h"

namespace crosscheck {
namespace {

constexpr auto differs = Condition::Kind::apart, agrees = Condition::Kind::within;

/// Example: "Rapier, 4 sub-steps is up to 0.0134 m from symplectic Euler, mysim; Rapier, 1 sub-step up to 2e-06 m."
std::string distances(const std::vector<Series>& all) {
  std::string text;
  for (size_t i = 1; i < all.size(); ++i)
    text += fmt::format("{}{} {}up to {:.2g} m{}", i > 1 ? "; " : "", all[i].variant.label, i == 1 ? "is " : "",
                        most_apart(all[i], all[0]), i == 1 ? " from " + all[0].variant.label : "");
  return text + ".";
}

}  // namespace

std::vector<Disagreement> engine_disagreements() {
  // The error of single precision after 500 steps is 2e-6 m for lengths of a metre; the bound of 1e-4 m is far above
  // that and far below each effect. In double precision the same rule agrees to 1e-13 m, and the bound is 1e-9 m.
  return with_texts({
      {.name = "constant-forces",
       .world = "engine:rapier",
       .quantity = "length",
       .unit = "m",
       .variants = {{"symplectic Euler, mysim", "mysim/symplectic-euler"},
                    {"Rapier, forces in 4 sub-steps", "engine:rapier+springs=forces+n=4"},
                    {"Rapier, forces in 1 sub-step", "engine:rapier+springs=forces+n=1"}},
       .value = effects::length,
       .effect = distances,
       .symptom = {{differs, 1, 0, 5e-3}},
       .cause_removed = {{agrees, 2, 0, 1e-4}},
       .scene = "undamped-spring"},
      {.name = "zero-becomes-one",
       .world = "engine:cannon",
       .quantity = "length",
       .unit = "m",
       .variants = {{"symplectic Euler, mysim", "mysim/symplectic-euler"},
                    {"cannon-es, damping: 0 as written", "engine:cannon+damping=as-written"},
                    {"cannon-es, damping set to 0 afterwards", "engine:cannon"}},
       .value = effects::length,
       .effect = distances,
       .symptom = {{differs, 1, 0, 0.05}},
       .cause_removed = {{agrees, 2, 0, 1e-9}},
       .scene = "undamped-spring"},
      {.name = "implicit-drag",
       .world = "engine:mujoco",
       .quantity = "length",
       .unit = "m",
       .variants = {{"symplectic Euler, mysim", "mysim/symplectic-euler"},
                    {"MuJoCo, damping of joints", "engine:mujoco"},
                    {"MuJoCo, drag by callback", "engine:mujoco+drag=callback"}},
       .value = effects::length,
       .effect = distances,
       .symptom = {{differs, 1, 0, 1e-4}},
       .cause_removed = {{agrees, 2, 0, 1e-9}}},
      {.name = "explicit-springs",
       .world = "engine:mujoco",
       .quantity = "length",
       .unit = "m",
       .variants = {{"implicit Euler, mysim", "mysim/implicit-euler"},
                    {"MuJoCo, integrator implicit", "engine:mujoco+integrator=implicit"},
                    {"symplectic Euler, mysim", "mysim/symplectic-euler"}},
       .value = effects::length,
       .effect = distances,
       .symptom = {{differs, 1, 0, 0.01}, {agrees, 1, 2, 1e-9}},
       .scene = "undamped-spring"},
      {.name = "implicit-joints",
       .world = "engine:ode",
       .quantity = "length",
       .unit = "m",
       .variants = {{"symplectic Euler, mysim", "mysim/symplectic-euler"},
                    {"ODE, distance joint with ERP and CFM", "engine:ode+springs=dball"},
                    {"implicit Euler, mysim", "mysim/implicit-euler"}},
       .value = effects::length,
       .effect = distances,
       .symptom = {{differs, 1, 0, 0.01}},
       .cause_removed = {{agrees, 1, 2, 1e-6}},
       .scene = "undamped-spring"},
      {.name = "shortest-joint",
       .world = "engine:box3d",
       .quantity = "length",
       .unit = "m",
       .variants = {{"leapfrog, mysim", "mysim/leapfrog"},
                    {"Box3D, distance joint", "engine:box3d"},
                    {"Box3D, own force", "engine:box3d+springs=forces+n=1"}},
       .value = effects::length,
       .effect = distances,
       .symptom = {{differs, 1, 0, 1e-3}},
       .cause_removed = {{agrees, 2, 0, 5e-4}}},
  });
}

}  // namespace crosscheck
