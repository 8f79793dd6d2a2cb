// The fast spring kernel equals the plain edge loop on any network, up to round-off due to a different summation order.
// tests/unit/experiments/spring_graph_test.cpp tests its SIMD variants one by one.

#include <cstring>

#include "mysim/simd/spring_graph/spring_kernel.h"
#include "tests/unit/mysim/networks.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

struct Loose {
  Springs springs;
  Particles particles;
  State state;
};

/// Springs between random pairs, some of them repeated, with stiffness over six decades, some zero rest lengths, some
/// coincident ends, and two particles without springs.
Loose random_springs(unsigned seed, int springs, SpringLaw law) {
  Random random(seed);
  const int n = 2 + std::max(2, springs / 4);
  Loose net{{{}, law}, {}, {0, Points::Zero(3, n), Points::Zero(3, n)}};
  net.particles.mass = Eigen::VectorXd::Ones(n);
  net.particles.pinned.assign(n, 0);
  for (int i = 0; i < n; ++i) net.state.x.col(i) = random.vector();
  if (n > 6) {  // coincident ends
    net.state.x.col(3) = net.state.x.col(4);
    net.springs.list.push_back({3, 4, 100, 0.5, Family::single});
    net.springs.list.push_back({4, 3, 100, 0, Family::single});
  }
  while (static_cast<int>(net.springs.list.size()) < springs) {
    const int a = static_cast<int>(random.between(2, n)), b = static_cast<int>(random.between(2, n));
    if (a == b) continue;
    const double k = std::pow(10, random.between(-1, 5)), rest = random.between(-0.3, 1);
    net.springs.list.push_back({a, b, k, std::max(0.0, rest), Family::single});
  }
  return net;
}

constexpr int sizes[] = {0, 1, 2, 63, 64, 65, 129, 500};

TEST(SpringKernel, IsTheEdgeLoopButForTheOrderOfTheSum) {
  long degenerate_springs = 0;
  for (const SpringLaw law : {SpringLaw::hooke, SpringLaw::bullet_link})
    for (const int size : sizes)
      for (unsigned seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(fmt::format("{} {} springs, seed {}", name_of(law), size, seed));
        const Loose net = random_springs(seed, size, law);
        const int n = net.particles.size();
        Forces plain{Points::Zero(3, n)}, fast{Points::Zero(3, n)};
        add_force(net.springs, net.particles, net.state, plain);
        SpringKernel kernel(net.springs, n);
        kernel.add_force(net.state.x, fast);
        EXPECT_EQ(fast.degenerate_springs, plain.degenerate_springs);
        degenerate_springs += plain.degenerate_springs;

        // Each force has up to 8 roundings in both variants together, and each sum has one per spring, relative to the
        // sum of all magnitudes. The magnitude of a Hooke force is k (L + r), because the difference of lengths
        // contains their rounding errors.
        Eigen::ArrayXd sizes_at = Eigen::ArrayXd::Zero(n);
        Eigen::ArrayXi springs_at = Eigen::ArrayXi::Zero(n);
        for (const Spring& s : net.springs.list)
          for (int end : {s.a, s.b}) {
            sizes_at[end] += s.k * ((net.state.x.col(s.a) - net.state.x.col(s.b)).norm() + s.rest);
            ++springs_at[end];
          }
        for (int i = 0; i < n; ++i) {
          EXPECT_LE((fast.f.col(i) - plain.f.col(i)).norm(), (8 + springs_at[i]) * eps * sizes_at[i]) << i;
          if (springs_at[i] == 0) {
            EXPECT_TRUE(fast.f.col(i).isZero(0));
          }
        }
      }
  EXPECT_GE(degenerate_springs, 100);  // includes coincident ends
}

TEST(SpringKernel, GivesTheSameBitsTwiceAndAddsToWhatIsThere) {
  for (const SpringLaw law : {SpringLaw::hooke, SpringLaw::bullet_link})
    for (const int size : sizes) {
      const Loose net = random_springs(5, size, law);
      const int n = net.particles.size();
      Forces once{Points::Zero(3, n)}, again{Points::Zero(3, n)}, onto{Points::Constant(3, n, 1e6)};
      SpringKernel kernel(net.springs, n), other(net.springs, n);
      kernel.add_force(net.state.x, once);
      kernel.add_force(net.state.x, onto);
      other.add_force(net.state.x, again);
      EXPECT_EQ(once.f, again.f);
      // at most one rounding per spring, of the magnitude of the existing value
      const double most = 1e6 + once.f.cwiseAbs().maxCoeff() * size;
      EXPECT_LE((onto.f.array() - once.f.array() - 1e6).abs().maxCoeff(), (size + 1) * eps * most);
      again.f.setZero();
      kernel.add_force(net.state.x, again);
      EXPECT_EQ(once.f, again.f);
    }
}

TEST(SpringKernel, EndsThatMeetGetNoForceAndAreCounted) {
  for (const SpringLaw law : {SpringLaw::hooke, SpringLaw::bullet_link})
    for (const double rest : {0.0, 0.5}) {
      SpringKernel kernel({{{0, 1, 100, rest, Family::single}}, law}, 2);
      Forces forces{Points::Zero(3, 2)};
      kernel.add_force(Points::Ones(3, 2), forces);
      EXPECT_TRUE(forces.f.isZero(0));
      EXPECT_EQ(forces.degenerate_springs, rest > 0 ? 1 : 0);
    }
}

}  // namespace
}  // namespace crosscheck
