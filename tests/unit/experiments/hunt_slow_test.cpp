// The hunter detects an engine with a single defect, and reduces the scene that shows the defect.

#include <ctime>

#include "tests/hunt/hunt.h"
#include "tests/unit/experiments/defects.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

struct Mutant {
  const char* what;
  const char* kind;  // part of the expected kind of the smallest scene
  const char* base;
  ChangeScene wrong;
  const char* beside;
};

const Mutant mutants[] = {
    {"friction of contacts a fifth too low", "sphere", "leapfrog",
     [](Scene& s, const crosscheck::Run&) {
       if (auto* spheres = s.model.find<Spheres>())
         for (Sphere& ball : spheres->list) ball.friction *= 0.8;
     },
     "symplectic-euler"},
    {"contacts a hundredth of the radius too far out", "sphere", "symplectic-euler",
     [](Scene& s, const crosscheck::Run&) {
       if (auto* spheres = s.model.find<Spheres>())
         for (Sphere& ball : spheres->list) ball.radius *= 1.01;
     },
     "rk4"},
    {"rest lengths of shear springs a hundredth too long", "springs", "leapfrog",
     [](Scene& s, const crosscheck::Run&) {
       if (auto* springs = s.model.find<Springs>())
         for (Spring& e : springs->list)
           if (e.family == Family::shear) e.rest *= 1.01;
     },
     "rk4"},
    {"gravity of Bullet a hundredth too strong", "gravity", "bullet/deformable-explicit",
     [](Scene& s, const crosscheck::Run&) { multiply_gravity(s, 1.01); }, "symplectic-euler"},
};

TEST(Mutants, AreFoundWithinAMinuteOnAtMostFourParticles) {
  for (const Mutant& mutant : mutants) {
    SCOPED_TRACE(mutant.what);
    const Hunt hunt{{with_defect(mutant.base, mutant.wrong), find_method(mutant.beside)},
                    read_known_breaks(shipped_known_breaks())};
    const std::clock_t begin = std::clock();
    const auto seconds = [&] { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; };
    std::vector<Break> broken;
    long index = 0;
    for (int answers = 0; broken.empty() && seconds() < 60; ++index) broken = breaks_of(hunt, index, answers);
    EXPECT_LT(seconds(), 60);
    ASSERT_FALSE(broken.empty());
    for (const auto& [answer, smallest] : broken) {
      fmt::print("{}: case {}, {:.1f} s: {} {}: {} particles, {} trials: {}\n", mutant.what, index - 1, seconds(),
                 answer.relation->name, answer.method, smallest.draft.size(), smallest.trials, answer.sentence());
      EXPECT_LE(smallest.draft.size(), 4) << smallest.draft.text();
      EXPECT_TRUE(contains(smallest.draft.kind(), mutant.kind)) << smallest.draft.text();
    }
  }
}

}  // namespace
}  // namespace crosscheck
