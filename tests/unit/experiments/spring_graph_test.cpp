// The DIA and COO kernels for general springs, compared with the plain loop over springs, on every instruction set.

#include <cstdlib>
#include <set>

#include "experiments/timing/instruction_sets.h"
#include "mysim/simd/spring_graph/spring_kernel.h"
#include "mysim/simd/spring_graph/spring_layout.h"
#include "tests/unit/mysim/networks.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
using simd::InstructionSet;
using spring_graph::Costs;

struct SpringGraph {
  Springs springs;
  Points x;
};

/// Costs with which the plain loop is so expensive that it gets no springs, and DIA is either free or too expensive.
constexpr Costs into_dia{.coefficient_row = 0, .tile = 0, .coo_spring = 1, .coo_particle = 0, .plain = 1e9, .call = 0};
constexpr Costs into_coo{
    .coefficient_row = 1e9, .tile = 0, .coo_spring = 1, .coo_particle = 0, .plain = 1e9, .call = 0};

/// Like SpringKernel, but with a given instruction set and given costs.
struct PartitionedSprings {
  spring_graph::SpringPartition partition;
  spring_graph::Kernels kernels;
  SpringLaw law;
  std::optional<spring_graph::DiaStorage> dia;
  std::optional<spring_graph::CooStorage> coo;

  PartitionedSprings(const SpringGraph& net, InstructionSet isa, const Costs& costs)
      : partition(spring_graph::partition_springs(net.springs.list, static_cast<int>(net.x.cols()), costs)),
        kernels(spring_graph::kernels(isa, net.springs.law)),
        law(net.springs.law) {
    if (!partition.dia.empty()) dia.emplace(partition.dia, net.x.cols());
    if (!partition.coo.empty()) coo.emplace(partition.coo, net.x.cols());
  }
  Forces forces(const Points& x) {
    Forces sum{Points::Zero(3, x.cols())};
    if (dia && kernels.dia(dia->view(), x.data(), sum.f.data())) sum.degenerate_springs += dia->degenerate_springs();
    if (coo && kernels.coo(coo->view(), x.data(), sum.f.data())) sum.degenerate_springs += coo->degenerate_springs();
    add_force({partition.plain, law}, x, sum);
    return sum;
  }
};

Spring random_spring(Random& random, int a, int b) {
  if (random.between(0, 1) < 0.5) std::swap(a, b);
  const double k = std::pow(10, random.between(-1, 5)), rest = random.between(-0.3, 1);
  return {a, b, k, std::max(0.0, rest), Family::single};
}

SpringGraph random_points(Random& random, int particles, SpringLaw law) {
  SpringGraph net{{{}, law}, Points(3, particles)};
  for (int i = 0; i < particles; ++i) net.x.col(i) = random.vector();
  return net;
}

int whole(Random& random, int end) { return std::min(end - 1, static_cast<int>(random.between(0, end))); }

/// Random springs between few particles. The last particle has no springs, springs repeat, and some springs have
/// coincident ends.
SpringGraph tangle(unsigned seed, int springs, SpringLaw law) {
  Random random(seed);
  const int n = 3 + springs / 3;
  SpringGraph net = random_points(random, n, law);
  net.x.col(1) = net.x.col(0);
  while (static_cast<int>(net.springs.list.size()) < springs) {
    const int a = whole(random, n - 1), b = whole(random, n - 1);
    if (a != b) net.springs.list.push_back(random_spring(random, a, b));
  }
  return net;
}

/// Particles with 1, 2, 3 ... 40 springs, which lead to many other particles.
SpringGraph hubs(unsigned seed, SpringLaw law) {
  Random random(seed);
  const int n = 200;
  SpringGraph net = random_points(random, n, law);
  for (int hub = 0; hub < 40; ++hub)
    for (int i = 0; i <= hub; ++i)
      net.springs.list.push_back(random_spring(random, hub, 40 + (hub * 13 + i * 7) % 160));
  return net;
}

/// Springs between particles whose indices differ by the given offsets. One in five springs is missing, and one in
/// twenty is duplicated. Springs with the last offset start late and end early. Some neighbouring particles coincide.
SpringGraph strands(unsigned seed, int particles, const std::vector<int>& offsets, SpringLaw law) {
  Random random(seed);
  SpringGraph net = random_points(random, particles, law);
  for (int i = 5; i + 1 < particles; i += 17) net.x.col(i + 1) = net.x.col(i);
  for (const int offset : offsets)
    for (int i = 0; i + offset < particles; ++i) {
      if (offset == offsets.back() && (i < particles / 4 || i > particles / 2)) continue;
      if (random.between(0, 1) < 0.2) continue;
      const Spring s = random_spring(random, i, i + offset);
      net.springs.list.push_back(s);
      if (random.between(0, 1) < 0.05) net.springs.list.push_back(s);
    }
  return net;
}

std::vector<std::pair<std::string, SpringGraph>> networks(SpringLaw law) {
  std::vector<std::pair<std::string, SpringGraph>> all;
  for (int springs = 0; springs <= 70; ++springs)
    all.emplace_back(fmt::format("tangle of {}", springs), tangle(springs + 1, springs, law));
  all.emplace_back("tangle of 1000", tangle(7, 1000, law));
  for (unsigned seed = 1; seed <= 5; ++seed) all.emplace_back(fmt::format("hubs {}", seed), hubs(seed, law));
  for (int particles = 2; particles <= 70; ++particles)
    all.emplace_back(fmt::format("strands of {}", particles), strands(particles, particles, {1, 2, 3, 8, 21}, law));
  // ring buffers of minimal length, and offsets close to tile sizes
  for (unsigned seed = 1; seed <= 5; ++seed)
    all.emplace_back(fmt::format("strands far apart {}", seed),
                     strands(seed, 700, {1, 7, 8, 9, 39, 40, 41, 103, 104, 232, 233, 5}, law));
  return all;
}

/// Each spring's force is that of the plain loop, bit for bit. Sums may differ by one rounding error per spring.
void expect_close(const SpringGraph& net, const Forces& fast, const Forces& plain) {
  const int n = static_cast<int>(net.x.cols());
  Eigen::ArrayXd sizes = Eigen::ArrayXd::Zero(n);
  Eigen::ArrayXi springs = Eigen::ArrayXi::Zero(n);
  for (const Spring& s : net.springs.list) {
    const double size = std::abs(tension_of(s, net.springs.law, (net.x.col(s.a) - net.x.col(s.b)).norm()).force);
    for (const int end : {s.a, s.b})
      if (std::isfinite(size)) sizes[end] += size, ++springs[end];
  }
  EXPECT_EQ(fast.degenerate_springs, plain.degenerate_springs);
  for (int i = 0; i < n; ++i) {
    if (springs[i] <= 1) {
      EXPECT_EQ(fast.f.col(i), plain.f.col(i)) << i;
    }
    EXPECT_LE((fast.f.col(i) - plain.f.col(i)).norm(), springs[i] * eps * sizes[i]) << i;
  }
}

TEST(SpringGraph, DiaAndCooAreTheEdgeLoopButForTheOrderOfTheSum) {
  long degenerate_springs = 0;
  for (const SpringLaw law : {SpringLaw::hooke, SpringLaw::bullet_link})
    for (const auto& [name, net] : networks(law)) {
      Forces plain{Points::Zero(3, net.x.cols())};
      add_force(net.springs, net.x, plain);
      degenerate_springs += plain.degenerate_springs;
      for (const InstructionSet isa : simd::supported_instruction_sets())
        for (const Costs& costs : {into_dia, into_coo}) {
          SCOPED_TRACE(fmt::format("{}, {}, {}", name_of(law), name, name_of(isa)));
          PartitionedSprings sorted(net, isa, costs);
          EXPECT_TRUE(sorted.partition.plain.empty());
          const Forces fast = sorted.forces(net.x);
          expect_close(net, fast, plain);
          EXPECT_EQ(sorted.forces(net.x).f, fast.f) << "repeated evaluation";
          // an evaluation of another state in between has no effect
          sorted.forces(2 * net.x.rowwise().reverse());
          EXPECT_EQ(sorted.forces(net.x).f, fast.f);
        }
    }
  EXPECT_GE(degenerate_springs, 100);  // includes coincident ends
}

TEST(SpringGraph, InstructionsGiveTheSameBits) {
  for (const SpringLaw law : {SpringLaw::hooke, SpringLaw::bullet_link})
    for (const auto& [name, net] : networks(law))
      for (const Costs& costs : {into_dia, into_coo, Costs{}})
        for (const InstructionSet isa : simd::supported_instruction_sets()) {
          PartitionedSprings least(net, InstructionSet::baseline, costs), other(net, isa, costs);
          EXPECT_EQ(least.forces(net.x).f, other.forces(net.x).f)
              << name_of(law) << ", " << name << ", " << name_of(isa);
        }
}

/// Forces near the rest length are small differences of large numbers; at rest they are exactly 0.
TEST(SpringGraph, SpringsAtRestPullAtNothing) {
  Random random(3);
  SpringGraph net = random_points(random, 100, SpringLaw::hooke);
  for (const int offset : {1, 3, 10})
    for (int i = 0; i + offset < 100; ++i)
      net.springs.list.push_back({i, i + offset, 1e9, (net.x.col(i) - net.x.col(i + offset)).norm(), Family::single});
  for (const InstructionSet isa : simd::supported_instruction_sets())
    for (const Costs& costs : {into_dia, into_coo})
      EXPECT_TRUE(PartitionedSprings(net, isa, costs).forces(net.x).f.isZero(0)) << name_of(isa);
}

TEST(SpringGraph, PartitionsAtTheLeastCost) {
  Random random(4);
  const auto partition = [](const SpringGraph& net) {
    return spring_graph::partition_springs(net.springs.list, static_cast<int>(net.x.cols()), {});
  };
  // pendulums and short chains are too small for SIMD lanes
  EXPECT_EQ(partition(strands(1, 2, {1}, SpringLaw::hooke)).plain.size(), 1u);
  EXPECT_EQ(partition(strands(1, 8, {1}, SpringLaw::hooke)).dia.size(), 0u);
  // if springs are numbered row by row, they go to DIA, except duplicates and a few long springs
  SpringGraph net = strands(1, 400, {1, 2, 20, 21, 19, 40}, SpringLaw::hooke);
  net.springs.list.push_back({3, 350, 1, 1, Family::single});
  const spring_graph::SpringPartition parts = partition(net);
  EXPECT_EQ(parts.dia.size(), 6u);
  EXPECT_LT(parts.plain.size() + parts.coo.size(), net.springs.list.size() / 10);
  EXPECT_EQ(partition(tangle(1, 1000, SpringLaw::hooke)).coo.size(), 1000u);
}

TEST(SpringGraph, EachLawAndInstructionSetHasLoopsOfItsOwn) {
  std::set<bool (*)(const spring_graph::DiaSprings&, const double*, double*)> dia;
  std::set<bool (*)(const spring_graph::CooSprings&, const double*, double*)> coo;
  for (const SpringLaw law : {SpringLaw::hooke, SpringLaw::bullet_link})
    for (const InstructionSet isa : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
      EXPECT_TRUE(dia.insert(spring_graph::kernels(isa, law).dia).second) << name_of(isa);
      EXPECT_TRUE(coo.insert(spring_graph::kernels(isa, law).coo).second) << name_of(isa);
    }
}

TEST(SpringGraph, SpringKernelRunsOnTheRequestedInstructions) {
  const SpringGraph net = strands(9, 300, {1, 2, 17, 18, 34}, SpringLaw::hooke);
  Forces plain{Points::Zero(3, 300)};
  add_force(net.springs, net.x, plain);
  for (const InstructionSet isa : simd::supported_instruction_sets()) {
    const ScopedInstructionSet only(isa);
    Forces fast{Points::Zero(3, 300)};
    SpringKernel kernel(net.springs, 300);
    EXPECT_EQ(kernel.isa(), isa);
    kernel.add_force(net.x, fast);
    expect_close(net, fast, plain);
  }
  const ScopedInstructionSet any_set(InstructionSet::baseline);  // the destructor restores the instruction set
  unsetenv("CROSSCHECK_INSTRUCTIONS");
  EXPECT_EQ(SpringKernel(net.springs, 300).isa(), simd::supported_instruction_sets().back());
}

}  // namespace
}  // namespace crosscheck
