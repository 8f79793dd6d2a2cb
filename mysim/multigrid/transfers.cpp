// From a sheet to the next coarser one and back. Compiled once for each instruction set, CROSSCHECK_ISA naming it.
#include "mysim/multigrid/rows.h"

namespace crosscheck::multigrid {
namespace {

using F = L<float>;
using Vf = V<float>;

/// What the fine row below an even one takes of the coarse row, and of the next.
ALWAYS float down(const Transfer& t, int coarse_row) { return coarse_row + 1 < t.coarse_rows ? 0.5f : 1; }

/// Along a fine row: what coarse particles are given of it.
ALWAYS Vf gathered(const Transfer& t, const float* fine, int block, int lane, int c) {
  const float* at = fine + 2L * block * line<3> + c * lanes + lane;
  const Vf right = F::load(t.right + block * lanes + lane), left = F::load(t.left + block * lanes + lane);
  return F::fma(right, F::load(at + line<3>), F::fma(left, F::load(at - line<3>), F::load(at)));
}

void to_coarse(const Transfer& t, const float* r, float* b) {
  const int fine_blocks = 2 * t.coarse_blocks;
  for (int row = 0; row < t.coarse_rows; ++row) {
    float* to = row_of(b, t.coarse_blocks, row);
    const float* here = row_of(r, fine_blocks, 2 * row);
    const long length = row_length(fine_blocks, 3);
    const bool above = row > 0, below = 2 * row + 1 < t.fine_rows;
    for (int i = 0; i < t.coarse_blocks; ++i)
      for (int c = 0; c < 3; ++c)
        for (int lane = 0; lane < lanes; lane += F::width) {
          Vf sum = gathered(t, here, i, lane, c);
          if (above) sum = F::fma(F::all(0.5f), gathered(t, here - length, i, lane, c), sum);
          if (below) sum = F::fma(F::all(down(t, row)), gathered(t, here + length, i, lane, c), sum);
          F::store(to + i * line<3> + c * lanes + lane, sum);
        }
  }
}

/// Adds to a fine row `one` times a coarse row and `two` times the next.
ALWAYS void spread(const Transfer& t, const float* coarse, float one, float two, const float* free, float* fine) {
  const long next_row = two == 0 ? 0 : row_length(t.coarse_blocks, 3);
  const auto between = [&](const float* at) __attribute__((always_inline)) {
    return F::fma(F::all(two), F::load(at + next_row), F::all(one) * F::load(at));
  };
  const auto add = [](float* to, Vf open, Vf more) __attribute__((always_inline)) {
    F::store(to, F::fma(open, more, F::load(to)));
  };
  for (int i = 0; i < t.coarse_blocks; ++i)
    for (int lane = 0; lane < lanes; lane += F::width) {
      const Vf own = F::load(t.right + i * lanes + lane), other = F::all(1) - own;
      const Vf open = F::load(free + 2L * i * lanes + lane), open_next = F::load(free + (2L * i + 1) * lanes + lane);
      for (int c = 0; c < 3; ++c) {
        const float* at = coarse + i * line<3> + c * lanes + lane;
        const Vf here = between(at), there = between(at + line<3>);
        float* to = fine + 2L * i * line<3> + c * lanes + lane;
        add(to, open, here);
        add(to + line<3>, open_next, F::fma(own, here, other * there));
      }
    }
  copy_ends<line<3>>(fine, 2 * t.coarse_blocks);
}

void to_fine(const Transfer& t, const float* coarse, const float* free, float* x) {
  const int fine_blocks = 2 * t.coarse_blocks;
  for (int row = 0; row < t.fine_rows; ++row) {
    const float* from = row_of(coarse, t.coarse_blocks, row / 2);
    const float one = row % 2 == 0 ? 1 : down(t, row / 2), two = 1 - one;
    spread(t, from, one, two, free + static_cast<long>(row) * fine_blocks * lanes, row_of(x, fine_blocks, row));
  }
}

}  // namespace

namespace CROSSCHECK_ISA {

void set_transfers(Functions& f) { f.to_coarse = to_coarse, f.to_fine = to_fine; }

}  // namespace CROSSCHECK_ISA
}  // namespace crosscheck::multigrid
