#include "experiments/scenes/ingredients.h"

#include <algorithm>
#include <set>

namespace crosscheck {
namespace {

template <class T>
bool has(const Model& model) {
  return model.find<T>() != nullptr;
}
template <class T>
void drop(Model& model) {
  std::erase_if(model.terms, [](const Term& t) { return std::holds_alternative<T>(t); });
}

/// True if the model has springs of this family and of other families.
template <Family family>
bool has_family(const Model& model) {
  const auto* springs = model.find<Springs>();
  if (!springs) return false;
  const auto of_it =
      std::count_if(springs->list.begin(), springs->list.end(), [](const Spring& s) { return s.family == family; });
  return of_it > 0 && of_it < std::ssize(springs->list);
}
/// Removes a family of springs, and the dashpots between the same pairs of particles.
template <Family family>
void drop_family(Model& model) {
  std::set<std::pair<int, int>> pairs;
  std::erase_if(model.find<Springs>()->list, [&](const Spring& s) {
    if (s.family != family) return false;
    pairs.emplace(s.a, s.b);
    return true;
  });
  if (auto* dashpots = model.find<Dashpots>())
    std::erase_if(dashpots->list, [&](const auto& d) { return pairs.contains({d.a, d.b}); });
}

bool has_gusts(const Model& model) {
  const auto* wind = model.find<Wind>();
  const auto* air = model.find<Aerodynamics>();
  return (wind && wind->acceleration.gusts) || (air && air->velocity.gusts);
}
void drop_gusts(Model& model) {
  if (auto* wind = model.find<Wind>()) wind->acceleration.gusts.reset();
  if (auto* air = model.find<Aerodynamics>()) air->velocity.gusts.reset();
}

bool has_pins(const Model& model) { return !model.particles.pins.empty(); }
void drop_pins(Model& model) {
  Particles& p = model.particles;
  p.pins.clear();
  p.pinned.assign(p.pinned.size(), 0);
  p.pin_home.resize(3, 0);
  p.move.reset();
}

bool has_friction(const Model& model) {
  return std::ranges::any_of(surfaces_of(model), [](const Surface& s) { return s.friction > 0; });
}
bool has_restitution(const Model& model) {
  return std::ranges::any_of(surfaces_of(model), [](const Surface& s) { return s.restitution > 0; });
}
template <class Change>
void each_solid(Model& model, Change change) {
  for (Term& term : model.terms)
    std::visit(Overloaded{[&](OneOf<Spheres, Planes> auto& solids) { std::ranges::for_each(solids.list, change); },
                          [](auto&) {}},
               term);
}

struct IngredientRow {
  Ingredient ingredient;
  bool (*present)(const Model&);
};

const std::vector<IngredientRow>& table() {
  static const std::vector<IngredientRow> rows{
      {{"rotation", {}, drop<Rotation>}, has<Rotation>},  // without rotation nothing moves; no file can express this
      {{"gravity", {"gravity"}, drop<Gravity>}, has<Gravity>},
      // structural springs are required in a grid's file
      {{"structural springs", {}, drop_family<Family::structural>}, has_family<Family::structural>},
      {{"shear springs", {"grid.stiffness.shear"}, drop_family<Family::shear>}, has_family<Family::shear>},
      {{"bend springs", {"grid.stiffness.bend"}, drop_family<Family::bend>}, has_family<Family::bend>},
      {{"single springs", {"spring"}, drop_family<Family::single>}, has_family<Family::single>},
      {{"all springs", {}, drop<Springs>}, has<Springs>},
      {{"bending", {"grid.bending"}, drop<Bending>}, has<Bending>},
      {{"dashpots", {"grid.dashpot", "spring[].dashpot"}, drop<Dashpots>}, has<Dashpots>},
      {{"hard distances", {}, drop<Constraints>}, has<Constraints>},
      {{"drag", {"drag"}, drop<Drag>}, has<Drag>},
      {{"wind", {"wind"}, drop<Wind>}, has<Wind>},
      {{"air", {"aerodynamics"}, drop<Aerodynamics>}, has<Aerodynamics>},
      {{"gusts", {"wind.gusts", "aerodynamics.gusts"}, drop_gusts}, has_gusts},
      {{"contact", {"sphere"}, drop<Spheres>}, has<Spheres>},
      {{"planes", {"plane"}, drop<Planes>}, has<Planes>},
      {{"friction",
        {"sphere[].friction", "plane[].friction"},
        [](Model& m) { each_solid(m, [](auto& s) { s.friction = 0; }); }},
       has_friction},
      {{"restitution",
        {"sphere[].restitution", "plane[].restitution"},
        [](Model& m) { each_solid(m, [](auto& s) { s.restitution = 0; }); }},
       has_restitution},
      {{"motion of the sphere",
        {"sphere[].motion"},
        [](Model& m) {
          for (Sphere& s : m.find<Spheres>()->list) s.motion.reset();
        }},
       [](const Model& m) { return has<Spheres>(m) && m.find<Spheres>()->moving(); }},
      {{"motion of the plane",
        {"plane[].velocity"},
        [](Model& m) {
          for (Plane& p : m.find<Planes>()->list) p.velocity.reset();
        }},
       [](const Model& m) { return has<Planes>(m) && m.find<Planes>()->moving(); }},
      {{"motion of the pins", {"pins.motion"}, [](Model& m) { m.particles.move.reset(); }},
       [](const Model& m) { return m.particles.move.has_value(); }},
      // a file cannot express this: without pins, the hard distances between them would reappear
      {{"pins", {}, drop_pins}, has_pins},
  };
  return rows;
}

}  // namespace

std::vector<Ingredient> ingredients_of(const Scene& scene) {
  std::vector<Ingredient> list;
  for (const IngredientRow& row : table())
    if (row.present(scene.model)) list.push_back(row.ingredient);
  return list;
}

Scene without(const Scene& scene, const Ingredient& ingredient) {
  Scene less = scene;
  ingredient.remove(less.model);
  less.hash = hash_of(less);
  return less;
}

long springs_of(const Model& model) {
  const auto* springs = model.find<Springs>();
  const auto* constraints = model.find<Constraints>();
  return std::max<long>(1,
                        (springs ? std::ssize(springs->list) : 0) + (constraints ? std::ssize(constraints->list) : 0));
}

}  // namespace crosscheck
