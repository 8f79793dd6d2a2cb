// The Dormand-Prince pair with error estimate and interpolant, and its fifth-order rule at a fixed step.
#include "mysim/steppers/steppers.h"

#include <cassert>

namespace crosscheck {
namespace {

constexpr double node[7] = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
constexpr double weight[7][6] = {
    {},
    {1. / 5},
    {3. / 40, 9. / 40},
    {44. / 45, -56. / 15, 32. / 9},
    {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
    {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
    {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84},
};
// fifth-order weights minus fourth-order weights
constexpr double error_weight[7] = {71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};
// correction to the cubic through both ends and their slopes
constexpr double dense_weight[7] = {-12715105075. / 11282082432,  0,
                                    87487479700. / 32700410799,   -10690763975. / 1880347072,
                                    701980252875. / 199316789632, -1453857185. / 822651844,
                                    69997945. / 29380423};

/// out = sum of weights[j] k[j].
template <size_t N>
void combine(const std::array<State, 7>& k, const double (&weights)[N], State& out) {
  out.x.setZero();
  out.v.setZero();
  for (size_t j = 0; j < N; ++j) {
    if (weights[j] == 0) continue;
    out.x += weights[j] * k[j].x;
    out.v += weights[j] * k[j].v;
  }
}

}  // namespace

void DormandPrince::attempt(System& f, State& s, double h) {
  if (!first_known_) f.derivative(s, k_[0]);
  first_known_ = true;
  for (int i = 1; i < 7; ++i) {
    State& stage = i == 6 ? next_ : stage_;
    combine(k_, weight[i], stage);
    stage.t = s.t + node[i] * h;
    stage.x = s.x + h * stage.x;
    stage.v = s.v + h * stage.v;
    f.derivative(stage, k_[i]);
  }
  stage_.t = h;
}

const State& DormandPrince::error() {
  const double h = stage_.t;
  combine(k_, error_weight, stage_);
  stage_.x *= h;
  stage_.v *= h;
  return stage_;
}

void DormandPrince::interpolate(const State& s, double h, double theta, State& out) const {
  assert(h > 0 && -1e-9 <= theta && theta <= 1 + 1e-9);
  out.t = s.t + theta * h;
  auto curve = [&](const Points& from, const Points& to, const Points& slope0, const Points& slope1, Points& result) {
    const Points rise = to - from, c = h * slope0 - rise, d = rise - h * slope1 - c;
    result = from + theta * (rise + (1 - theta) * (c + theta * (d + (1 - theta) * h * result)));
  };
  combine(k_, dense_weight, out);
  curve(s.x, next_.x, k_[0].x, k_[6].x, out.x);
  curve(s.v, next_.v, k_[0].v, k_[6].v, out.v);
}

void dopri5(System& f, State& s, double h, Workspace& w) {
  DormandPrince& pair = w.own<DormandPrince>(s);
  pair.forget();  // pins and contacts may have changed the state
  pair.attempt(f, s, h);
  s.x = pair.next().x;
  s.v = pair.next().v;
}

}  // namespace crosscheck
