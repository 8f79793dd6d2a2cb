// Scenes with a single change, each of which the parity certificate must detect.
#pragma once

#include <functional>
#include <set>

#include "tests/unit/helpers.h"

namespace crosscheck::testing_tools {

/// A 6 x 6 cloth over a ball with dashpots, drag and gusts.
inline Scene draped() {
  return small_scene(std::string("[grid]\nsize = [6, 6]\norigin = [-0.5, 1.1, -0.5]\nu = [1, 0, 0]\nv = [0, 0, 1]\n"
                                 "mass = 0.5\ndashpot = 0.01\n[grid.stiffness]\nstructural = 60\nshear = 40\n"
                                 "bend = 20\n[pins]\nparticles = [0, 5]\n[drag]\ngamma = 2\n[wind]\n"
                                 "acceleration = [0, 0, 2]\n[sphere]\ncentre = [0, 0, 0]\nradius = 1\nmargin = 0.02\n"
                                 "friction = 0.5\n") +
                         gravity_text,
                     1, 1e-3, 10);
}
/// A free 4 x 4 cloth in air, with bending.
inline Scene in_air() {
  return small_scene(std::string("[grid]\nsize = [4, 4]\norigin = [0, 0, 0]\nu = [0.5, 0, 0]\nv = [0, 0.5, 0]\n"
                                 "mass = 0.1\nbending = 0.01\n[grid.stiffness]\nstructural = 20\nshear = 20\nbend = 5\n"
                                 "[aerodynamics]\nvelocity = [1, 0, 3]\ndensity = 1.2\ncoefficient = 1\n") +
                         gravity_text,
                     1, 1e-3, 10);
}

inline Springs& springs(Scene& s) { return *s.model.find<Springs>(); }
inline Sphere& ball(Scene& s) { return s.model.find<Spheres>()->list[0]; }
template <class T>
void drop(Scene& s) {
  std::erase_if(s.model.terms, [](const Term& t) { return std::holds_alternative<T>(t); });
}
inline void free_pin(Scene& s) {
  Particles& p = s.model.particles;
  p.pinned[5] = 0, p.pins = {0};
  p.pin_home = s.start.x.col(0);
}
inline void add_pin(Scene& s) {
  Particles& p = s.model.particles;
  p.pinned[30] = 1, p.pins = {0, 5, 30};
  p.pin_home.conservativeResize(3, 3);
  p.pin_home.col(2) = s.start.x.col(30);
}

struct Mutation {
  std::string what;
  std::function<void(Scene&)> mutate;
  std::set<std::string> quantities;  // certificate rows that may show the change, by prefix
  std::set<std::string> blind = {};  // worlds that cannot report the change
};

inline const Mutation of_the_drape[] = {
    {"one rest length",
     [](Scene& s) { springs(s).list[40].rest *= 1 + 1e-6; },
     {"shear springs: rest", "structural springs: rest", "spring law"}},
    {"all rest lengths",
     [](Scene& s) {
       for (Spring& e : springs(s).list) e.rest *= 0.9;
     },
     {"structural springs: rest"}},
    {"a pin less", free_pin, {"pins"}},
    {"a pin more", add_pin, {"pins"}},
    {"one mass",
     [](Scene& s) { s.model.particles.mass[14] *= 1 + 1e-6, s.model.find<Drag>()->c[14] *= 1 + 1e-6; },
     {"masses"}},
    {"gravity twice", [](Scene& s) { s.model.find<Gravity>()->acceleration *= 2; }, {"gravity"}},
    {"gravity of Bullet's default",
     [](Scene& s) {
       s.model.find<Gravity>()->acceleration = {0, -10, 0};
     },
     {"gravity"}},
    {"no gravity", drop<Gravity>, {"gravity"}},
    {"a missing link", [](Scene& s) { springs(s).list.erase(springs(s).list.begin() + 40); }, {"links"}},
    {"an extra link",
     [](Scene& s) {
       springs(s).list.push_back({0, 35, 20, 1.4, Family::bend});
     },
     {"links"}},
    {"another end",
     [](Scene& s) { springs(s).list[40].b = springs(s).list[40].a == 30 ? 31 : 30; },
     {"structural springs", "shear springs"}},
    {"ends swapped between two links",
     [](Scene& s) { std::swap(springs(s).list[3].b, springs(s).list[9].b); },
     {"structural springs", "shear springs"}},
    {"another spring law", [](Scene& s) { springs(s).law = SpringLaw::bullet_link; }, {"spring law"}, {"bullet/pbd"}},
    {"one stiffness",
     [](Scene& s) { springs(s).list[40].k *= 1 + 1e-6; },
     {"spring law", "shear springs: stiffness", "structural springs: stiffness"}},
    {"drag twice", [](Scene& s) { s.model.find<Drag>()->c *= 2; }, {"drag"}},
    {"no drag", drop<Drag>, {"drag"}},
    {"one dashpot", [](Scene& s) { s.model.find<Dashpots>()->list[40].c *= 1.001; }, {"dashpots"}},
    {"no dashpots", drop<Dashpots>, {"dashpots"}},
    {"wind stronger", [](Scene& s) { s.model.find<Wind>()->acceleration.mean *= 1.001; }, {"wind"}},
    {"no wind", drop<Wind>, {"wind"}},
    {"friction", [](Scene& s) { ball(s).friction = 0.45; }, {"friction"}},
    {"sphere's radius", [](Scene& s) { ball(s).radius += 1e-6; }, {"contact radius"}},
    {"sphere's centre", [](Scene& s) { ball(s).centre.x() += 1e-6; }, {"centre"}},
    {"margin", [](Scene& s) { ball(s).margin = 0.025; }, {"margin", "contact radius"}},
    {"margin against radius", [](Scene& s) { ball(s).margin = 0.03, ball(s).radius -= 0.01; }, {"margin"}},
    {"no sphere", drop<Spheres>, {"spheres"}},
    {"another sphere",
     [](Scene& s) {
       s.model.find<Spheres>()->list.push_back({{3, 0, 0}, 0.5, 0.02, 0.5, 0, {}});
     },
     {"spheres"}},
    {"one start position", [](Scene& s) { s.start.x(1, 14) += 1e-6; }, {"start positions"}},
    {"one start velocity", [](Scene& s) { s.start.v(1, 14) += 1e-6; }, {"start velocities"}},
};
inline const Mutation of_the_swing[] = {
    {"pins moved farther", [](Scene& s) { s.model.particles.move->amplitude *= 1.001; }, {"motion of pins"}},
    {"pins moved faster", [](Scene& s) { s.model.particles.move->frequency *= 1.001; }, {"motion of pins"}},
    {"pins left alone", [](Scene& s) { s.model.particles.move.reset(); }, {"motion of pins"}},
    {"gusts of another seed",
     [](Scene& s) {
       auto& g = *s.model.find<Wind>()->acceleration.gusts;
       g = {g.variation, g.side, 4, Gust(4, 1), Gust(4, 2)};
     },
     {"wind"}},
};
inline const Mutation of_the_carried[] = {
    {"sphere moved farther", [](Scene& s) { ball(s).motion->amplitude *= 1.001; }, {"motion of the sphere"}},
    {"sphere left alone", [](Scene& s) { ball(s).motion.reset(); }, {"motion of the sphere"}},
};
inline const Mutation of_a_still_one[] = {
    {"pins led",
     [](Scene& s) {
       s.model.particles.move = Motion{{0.1, 0, 0}, 1, 0.5};
     },
     {"motion of pins"}},
    {"sphere led",
     [](Scene& s) {
       ball(s).motion = Motion{{0.1, 0, 0}, 1, 0.5};
     },
     {"motion of the sphere"}},
};
inline const Mutation of_the_cloth_in_air[] = {
    {"air denser", [](Scene& s) { s.model.find<Aerodynamics>()->density *= 1.001; }, {"wind"}},
    {"another coefficient", [](Scene& s) { s.model.find<Aerodynamics>()->coefficient = 1.1; }, {"wind"}},
    {"air faster", [](Scene& s) { s.model.find<Aerodynamics>()->velocity.mean.z() *= 1.001; }, {"wind"}},
    {"a triangle less", [](Scene& s) { s.model.find<Aerodynamics>()->triangles.pop_back(); }, {"wind"}},
    {"one stencil", [](Scene& s) { s.model.find<Bending>()->list[5].k *= 1.001; }, {"bending"}},
    {"a stencil less", [](Scene& s) { s.model.find<Bending>()->list.pop_back(); }, {"bending"}},
    {"bending without effect",
     [](Scene& s) {
       for (auto& stencil : s.model.find<Bending>()->list) stencil.k = 0;
     },
     {"bending"}},
    {"still air", drop<Aerodynamics>, {"wind"}},
    {"drag that nobody asked for", [](Scene& s) { s = with_drag(s, 0.5); }, {"drag"}},
};

}  // namespace crosscheck::testing_tools
