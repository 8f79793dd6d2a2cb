// Plain loops that the compiler vectorises.
#include "experiments/cost/roofline.h"

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
  constexpr int lanes = 64, deep = 16, rounds = 20000;
  auto a = std::make_shared<std::array<double, lanes>>();
  a->fill(1);
  return {2. * lanes * deep * rounds, 0, [a] {
            CpuClock clock;
            double* x = a->data();
            clock.start();
            for (int round = 0; round < rounds; ++round) {
              for (int i = 0; i < lanes; ++i) {
                double y = x[i];
                // a fixed point at 1: neither overflow nor denormal numbers, which are slow
                for (int j = 0; j < deep; ++j) y = y * 0.5 + 0.5;
                x[i] = y;
              }
              keep(x);
            }
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
