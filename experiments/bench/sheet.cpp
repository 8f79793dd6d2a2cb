#include "experiments/bench/sheet.h"

#include <fmt/format.h>

#include <cmath>

namespace crosscheck {

Scene sheet(int n) {
  // 0.72 of the explicit limit: omega^2 = 8 (400 + 200 + 20) N/m over the mass of a particle, at most
  const double step = 0.72 * 2 / std::sqrt(8 * 620 * n * n / 0.25);
  return parse_scene(
      fmt::format("question = \"What does the same accuracy cost?\"\nparameters = \"a sheet hung by two corners\"\n"
                  "[time]\nduration = 1\nsamples = 10\nstep = {1:.17g}\nwindow = 1\ntolerance = 1e-3\n"
                  "method = \"leapfrog\"\n[grid]\nsize = [{0}, {0}]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\n"
                  "v = [0, 0, 1]\nmass = 0.25\n[grid.stiffness]\nstructural = 400\nshear = 200\nbend = 20\n"
                  "[pins]\nparticles = [0, {2}]\n[gravity]\nacceleration = [0, -9.81, 0]\n[drag]\ngamma = 5\n",
                  n, step, n - 1),
      fmt::format("sheet-{0}x{0}", n));
}

}  // namespace crosscheck
