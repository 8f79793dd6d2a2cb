// Loops with a known amount of work.
#include "experiments/cost/roofline.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "mysim/clock.h"
#include "mysim/strip/kernels.h"

namespace crosscheck {
namespace {

/// Tells the compiler that somebody reads it, so that the work is not left out.
void keep(const double* data) { asm volatile("" : : "r"(data) : "memory"); }

/// Compiled for each instruction set; the best that the machine has is taken.
#if defined(__SANITIZE_ADDRESS__)
// what chooses among them runs before the sanitizer is ready
#else
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void triad(double* __restrict a, const double* __restrict b, const double* __restrict c, size_t n) {
  for (size_t i = 0; i < n; ++i) a[i] = b[i] + 0.5 * c[i];
}

}  // namespace

Kernel multiply_add_kernel() {
  constexpr long rounds = 400000;
  const strip::Kernel<double> kernel = strip::kernel<double>(strip::chosen(), false);
  double none = 0;
  const int each = kernel.multiply_and_add(0, &none);
  return {static_cast<double>(each) * rounds, 0, [kernel, sum = std::make_shared<double>(0)] {
            CpuClock clock;
            clock.start();
            kernel.multiply_and_add(rounds, sum.get());
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
            double* a = arrays->a.data();
            const double *b = arrays->b.data(), *c = arrays->c.data();
            clock.start();
            for (int round = 0; round < rounds; ++round) {
              triad(a, b, c, n);
              keep(a);
            }
            clock.stop();
            return clock.seconds();
          }};
}

}  // namespace crosscheck
