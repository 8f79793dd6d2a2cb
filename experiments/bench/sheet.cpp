#include "experiments/bench/sheet.h"

#include <fmt/format.h>

#include <cmath>

namespace crosscheck {

Scene sheet(int n, const Threads& threads) {
  constexpr double mass = 0.25;  // kg
  // omega^2 is at most 8 times the sum of the stiffnesses over the mass of a particle; leapfrog is stable up to 2/omega
  const double omega = std::sqrt(8 * (threads.structural + threads.shear + threads.bend) * n * n / mass);
  return parse_scene(
      fmt::format("question = \"What does the same accuracy cost?\"\nparameters = \"a sheet hung by two corners\"\n"
                  "[time]\nduration = 1\nsamples = 10\nstep = {1:.17g}\nwindow = 1\ntolerance = 1e-3\n"
                  "method = \"leapfrog\"\n[grid]\nsize = [{0}, {0}]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\n"
                  "v = [0, 0, 1]\nmass = {6}\n[grid.stiffness]\nstructural = {3}\nshear = {4}\nbend = {5}\n"
                  "[pins]\nparticles = [0, {2}]\n[gravity]\nacceleration = [0, -9.81, 0]\n[drag]\ngamma = 5\n",
                  n, 0.72 * 2 / omega, n - 1, threads.structural, threads.shear, threads.bend, mass),
      fmt::format("sheet-{0}x{0}", n));
}

Scene sheet_of_two_stiffnesses(int n) {
  Scene scene = sheet(n, {400, 400, 20});
  scene.name += "-two-stiffnesses";
  return scene;
}

Scene sheet_of_links(int n) {
  Scene scene = sheet(n);
  scene.name += "-link-law";
  scene.model.find<Springs>()->law = SpringLaw::bullet_link;
  scene.hash = hash_of(scene);
  return scene;
}

}  // namespace crosscheck
