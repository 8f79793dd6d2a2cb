// Trials of `crosscheck advise`, not part of the suite: five shipped scenes and thirty random ones, three tolerances
// each. Prints every case; exits 1 when fewer than 95 % of the promised ones meet their tolerance, or something that
// was tried meets it at less than 0.8 of the advised cost.
#include <cstdio>

#include "tests/unit/advise_case.h"

using namespace crosscheck;
using namespace crosscheck::testing_tools;

int main() {
  std::vector<Scene> scenes;
  for (const auto name : {"circle", "pendulum", "chain", "cloth-student", "cloth-hang"})
    scenes.push_back(load_scene(name));
  for (unsigned seed = 1; seed <= 15; ++seed) scenes.push_back(random_contact_free_scene(seed));
  for (unsigned seed = 1; seed <= 15; ++seed) scenes.push_back(random_exact_scene(seed));
  int cases = 0, promised = 0, met = 0, cheaper = 0;
  for (const Scene& scene : scenes)
    for (const double part : {0.1, 0.01, 0.001}) {
      const AdviseCase c = advise_case(scene, part);
      ++cases, promised += c.promised, met += c.met, cheaper += c.cheaper;
      fmt::print("{:24} asked {:9.3g} m: {}\n", scene.name, c.tolerance,
                 c.promised ? fmt::format("{} errs by {:.3g} m, {}{}", c.method, c.error, c.met ? "met" : "NOT MET",
                                          c.cheaper ? ", SOMETHING CHEAPER MET IT" : "")
                            : "cannot promise: " + c.why);
      std::fflush(stdout);
    }
  fmt::print("{} cases, {} promised, {} of them met ({:.1f} %), {} with something cheaper\n", cases, promised, met,
             promised ? 100. * met / promised : 0, cheaper);
  return promised > 0 && met >= 0.95 * promised && cheaper == 0 ? 0 : 1;
}
