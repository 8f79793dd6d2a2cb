// Writes the recipe at size n and reads it as a scene.
#include "experiments/cost/sized_cloth.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace crosscheck {

Scene sized_cloth(int n, bool sphere) {
  std::string text = fmt::format(
      "question = \"What does a step of {0} x {0} particles cost?\"\nparameters = \"cloth-hang at another size\"\n"
      "[time]\nduration = 3\nsamples = 90\nstep = {1}\nwindow = 3\ntolerance = 5e-4\nmethod = \"leapfrog\"\n"
      "[grid]\nsize = [{0}, {0}]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\nmass = 0.25\n"
      "[grid.stiffness]\nstructural = 200\nshear = 200\nbend = 200\n[pins]\nparticles = [0, {2}]\n"
      "[gravity]\nacceleration = [0, -9.81, 0]\n[drag]\ngamma = 4\n",
      n, 1e-2 / n, n - 1);
  if (sphere) text += "[sphere]\ncentre = [0, -0.33, 0.5]\nradius = 0.3\nmargin = 0.005\nfriction = 0.3\n";
  Scene scene = parse_scene(text, fmt::format("cloth-{0}x{0}", n));
  constexpr double pi = std::numbers::pi;
  for (int i = 0; i < scene.start.x.cols(); ++i)
    scene.start.x(1, i) += 0.05 * std::sin(3 * pi * scene.start.x(0, i)) * std::sin(2 * pi * scene.start.x(2, i));
  // pins stay: the corners at x = -0.5, z = 0 are at sin(2 pi 0) = 0
  return scene;
}

}  // namespace crosscheck
