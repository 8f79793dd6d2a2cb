// Plain loops that the compiler vectorises.
#include "experiments/cost/roofline.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "mysim/clock.h"

namespace crosscheck {
namespace {

/// Tells the compiler that somebody reads it, so that the work is not left out.
void keep(const double* data) { asm volatile("" : : "r"(data) : "memory"); }

}  // namespace

Kernel multiply_add_kernel() {
  // 24 doubles are 12 vectors of SSE2: enough to fill two pipes for each operation while every chain waits for its last
  // result, and few enough to stay in 16 registers
  constexpr int chains = 24, rounds = 800000;
  auto last = std::make_shared<std::array<double, chains>>();
  last->fill(1);
  return {2. * chains * rounds, 0, [last] {
            CpuClock clock;
            double y[chains];
            for (int i = 0; i < chains; ++i) y[i] = (*last)[i];
            clock.start();
            // a fixed point at 1: neither overflow nor denormal numbers, which are slow
            for (int round = 0; round < rounds; ++round)
              for (int i = 0; i < chains; ++i) y[i] = y[i] * 0.5 + 0.5;
            // each last value is used, or its chain would be left out
            for (int i = 0; i < chains; ++i) (*last)[i] = y[i];
            keep(last->data());
            clock.stop();
            return clock.seconds();
          }};
}

Kernel triad_kernel(double bytes) {
  const auto n = static_cast<size_t>(bytes / 24);
  const int rounds = std::max(1, static_cast<int>(32e6 / bytes));
  struct Arrays {
    std::vector<double> a, b, c;
  };
  auto arrays =
      std::make_shared<Arrays>(Arrays{std::vector<double>(n, 1), std::vector<double>(n, 2), std::vector<double>(n, 3)});
  return {2. * static_cast<double>(n) * rounds, 24. * static_cast<double>(n) * rounds, [arrays, n, rounds] {
            CpuClock clock;
            double* __restrict a = arrays->a.data();
            const double* __restrict b = arrays->b.data(), * __restrict c = arrays->c.data();
            clock.start();
            for (int round = 0; round < rounds; ++round) {
              for (size_t i = 0; i < n; ++i) a[i] = b[i] + 0.5 * c[i];
              keep(a);
            }
            clock.stop();
            return clock.seconds();
          }};
}

}  // namespace crosscheck
