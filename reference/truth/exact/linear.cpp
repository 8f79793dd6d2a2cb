#include "reference/truth/exact/linear.h"

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <unsupported/Eigen/MatrixFunctions>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "mysim/eigenvalues.h"
#include "mysim/model/system.h"
#include "reference/truth/exact/exact.h"

namespace crosscheck {
namespace {

using Complex = std::complex<double>;
using Matrix8 = Eigen::Matrix<Complex, 8, 8>;
using Vector8 = Eigen::Matrix<Complex, 8, 1>;
constexpr Complex imaginary(0, 1);

/// State at the start: u = u' = 0; of the six functions, that with j = 0 is 1, and the others are 0.
Vector8 at_start() { return Vector8::Unit(2); }

}  // namespace

DrivenMotion::DrivenMotion(double omega2, double drag, double dashpot, double amplitude, const Motion& motion)
    : omega2_(omega2),
      drag_(drag),
      dashpot_(dashpot),
      amplitude_(amplitude),
      omega_(2 * std::numbers::pi * motion.frequency),
      ramp_(motion.ramp),
      z_(amplitude * (omega2 + imaginary * omega_ * dashpot) /
         (omega2 - omega_ * omega_ + imaginary * omega_ * (drag + dashpot))) {
  const Eigen::Vector2d left = during_ramp(ramp_) - steady_state(ramp_);
  after_ramp_ = {omega2, drag + dashpot, left[0], left[1]};
}

Matrix8 DrivenMotion::generator() const {
  const double w = std::sqrt(omega2_);
  Matrix8 m = Matrix8::Zero();
  m(0, 1) = w, m(1, 0) = -w, m(1, 1) = -(drag_ + dashpot_);
  for (int j = 0; j < 6; ++j) {
    m(2 + j, 2 + j) = imaginary * omega_;
    if (j > 0) m(2 + j, 1 + j) = j / ramp_;
  }
  // u'/w is driven by (w2 d + dashpot d') / w
  const double r[6] = {0, 0, 0, 10, -15, 6}, slope[6] = {0, 0, 30, -60, 30, 0};
  for (int j = 0; j < 6; ++j)
    m(1, 2 + j) = amplitude_ / w * ((omega2_ + imaginary * omega_ * dashpot_) * r[j] + dashpot_ * slope[j] / ramp_);
  return m;
}

Eigen::Vector2d DrivenMotion::during_ramp(double t) const {
  const Vector8 y = (t * generator()).exp() * at_start();
  return {y[0].imag(), std::sqrt(omega2_) * y[1].imag()};
}

Eigen::Vector2d DrivenMotion::steady_state(double t) const {
  const Complex z = z_ * std::exp(imaginary * omega_ * t);
  return {z.imag(), (imaginary * omega_ * z).imag()};
}

double DrivenMotion::position(double t) const {
  return t < ramp_ ? during_ramp(t)[0] : steady_state(t)[0] + after_ramp_.position(t - ramp_);
}

double DrivenMotion::velocity(double t) const {
  return t < ramp_ ? during_ramp(t)[1] : steady_state(t)[1] + after_ramp_.velocity(t - ramp_);
}

double DrivenMotion::amplitude_bound() const {
  // sqrt(u^2 + u'^2/w2) grows per unit time by at most the forcing / w, which is little between two evaluations
  const double w = std::sqrt(omega2_), size = std::abs(amplitude_);
  const double forcing =
      size * (std::hypot(omega2_, omega_ * dashpot_) + 1.875 * dashpot_ / ramp_);  // m/s^2, see max_speed
  const int pieces = 1 + static_cast<int>(ramp_ * forcing / (0.05 * w * size));
  const double dt = ramp_ / pieces;
  const Matrix8 forward = (dt * generator()).exp();
  double most = 0;
  Vector8 y = at_start();
  for (int piece = 0; piece < pieces; ++piece) {
    y = forward * y;
    most = std::max(most, std::hypot(y[0].imag(), y[1].imag()));
  }
  return std::max(most + dt * forcing / w, std::abs(z_) + after_ramp_.amplitude_bound());
}

namespace {

/// The line through the particles, and their positions and speeds along it.
struct Line {
  Vec3 direction;
  Eigen::VectorXd along, speed;  // n, m, m/s
};

std::optional<Line> line_through(const Scene& scene, const Vec3& acceleration) {
  const Points &x = scene.start.x, &v = scene.start.v;
  Eigen::Index farthest = 0;
  const double length = (x.colwise() - x.col(0)).colwise().norm().maxCoeff(&farthest);
  if (!(length > 0)) return std::nullopt;
  const Vec3 n = (x.col(farthest) - x.col(0)) / length;
  // deviations from the line must be below the rounding of the scene's numbers
  auto across = [&](const Vec3& p, double size) { return (p - p.dot(n) * n).norm() > 1e-14 * size; };
  for (int i = 0; i < x.cols(); ++i)
    if (across(x.col(i) - x.col(0), length) || across(v.col(i), v.col(i).norm())) return std::nullopt;
  if (across(acceleration, acceleration.norm())) return std::nullopt;
  if (const auto& move = scene.model.particles.move; move && across(move->amplitude, move->amplitude.norm()))
    return std::nullopt;
  return Line{n, (x.colwise() - x.col(0)).transpose() * n, v.transpose() * n};
}

/// Weighted graph Laplacian: row i of its product with x is the sum over pairs p = (i, j) of value(p) * (x_i - x_j).
template <class Pairs, class Value>
Eigen::MatrixXd laplacian(const Pairs& pairs, int n, Value value) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
  for (const auto& p : pairs) {
    const double c = value(p);
    m(p.a, p.a) += c, m(p.b, p.b) += c, m(p.a, p.b) -= c, m(p.b, p.a) -= c;
  }
  return m;
}

LinearScene free_flight(const Scene& scene, const Vec3& acceleration, double drag) {
  LinearScene linear{scene.start.x, {}};
  for (int axis = 0; axis < 3; ++axis)
    linear.modes.push_back({0, drag, 0, acceleration[axis], 0, 0, scene.start.v(axis, 0), Vec3::Unit(axis)});
  return linear;
}

}  // namespace

double LinearScene::shortest_spring_length(const Model& model, const std::vector<double>& centre,
                                           const std::vector<double>& amplitude) const {
  double smallest = std::numeric_limits<double>::infinity();
  const auto* springs = model.find<Springs>();
  if (!springs) return smallest;
  for (const Spring& s : springs->list) {
    Vec3 d = rest.col(s.a) - rest.col(s.b);
    const Vec3 n = d.normalized();
    double swing = model.particles.pinned[s.a] != model.particles.pinned[s.b] ? base_amplitude : 0;
    for (size_t i = 0; i < modes.size(); ++i) {
      const Vec3 difference = modes[i].shape.col(s.a) - modes[i].shape.col(s.b);
      d += centre[i] * difference;
      swing += amplitude[i] * difference.norm();
    }
    smallest = std::min(smallest, d.dot(n) - swing);
  }
  return smallest;
}

std::optional<LinearScene> linear_scene(const Scene& scene) {
  const Model& model = scene.model;
  const Particles& particles = model.particles;
  const auto a = steady_acceleration(model);
  const auto drag = uniform_drag_rate(model);
  if (!a || !drag) return std::nullopt;
  if (particles.size() == 1 && particles.pins.empty() && has_only<Gravity, Wind, Drag>(model))
    return free_flight(scene, *a, *drag);
  const auto* springs = model.find<Springs>();
  if (!springs || springs->law != SpringLaw::hooke || !has_only<Springs, Dashpots, Gravity, Drag, Wind>(model))
    return std::nullopt;
  const auto line = line_through(scene, *a);
  if (!line) return std::nullopt;

  // M xi'' = f - K xi - C xi' - drag M xi' + M a for the displacement xi of free particles from the start
  const int n = particles.size();
  std::vector<int> free;
  for (int i = 0; i < n; ++i)
    if (!particles.pinned[i]) free.push_back(i);
  const Eigen::MatrixXd k = laplacian(springs->list, n, [](const Spring& s) { return s.k; })(free, free);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(n);
  for (const Spring& s : springs->list) {
    const double d = line->along[s.a] - line->along[s.b];
    const double pull = s.k * (std::abs(d) - s.rest) * (d > 0 ? 1 : -1);  // exact difference near the rest length
    all[s.a] -= pull, all[s.b] += pull;
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(k);
  if (factor.info() != Eigen::Success) return std::nullopt;  // a part floats freely
  const Eigen::VectorXd mass = particles.mass(free), rest = factor.solve(all(free));
  double beta = 0;  // s, ratio of dashpots to stiffness
  if (const auto* dashpots = model.find<Dashpots>()) {
    const Eigen::MatrixXd c = laplacian(dashpots->list, n, [](const auto& d) { return d.c; })(free, free);
    beta = c.trace() / k.trace();
    // the dashpots must be proportional to the stiffnesses, up to the rounding of the scene's numbers
    if (!((c - beta * k).norm() <= 1e-14 * c.norm())) return std::nullopt;
  }

  LinearScene linear{scene.start.x, {}};
  for (size_t i = 0; i < free.size(); ++i) linear.rest.col(free[i]) += rest[static_cast<int>(i)] * line->direction;
  if (particles.move) linear.base_amplitude = particles.move->amplitude.dot(line->direction);
  const Eigen::VectorXd inverse_root = mass.cwiseSqrt().cwiseInverse();
  const Eigensystem vibrations = symmetric_eigensystem(inverse_root.asDiagonal() * k * inverse_root.asDiagonal());
  for (int i = 0; i < static_cast<int>(free.size()); ++i) {
    Eigen::VectorXd shape = inverse_root.asDiagonal() * vibrations.vectors.col(i);
    const double largest = shape.cwiseAbs().maxCoeff();
    // dual of the shape, including the masses, so that the product of shape and dual is 1
    const Eigen::VectorXd dual = largest * mass.asDiagonal() * shape;
    shape /= largest;
    const double omega2 = vibrations.values[i];
    Mode mode{omega2,
              *drag,
              beta * omega2,
              a->dot(line->direction) * dual.sum(),
              dual.sum(),
              -dual.dot(rest),
              dual.dot(line->speed(free).eval()),
              Points::Zero(3, n)};
    for (size_t j = 0; j < free.size(); ++j) mode.shape.col(free[j]) = shape[static_cast<int>(j)] * line->direction;
    linear.modes.push_back(std::move(mode));
  }
  return linear;
}

namespace {

/// A mode about its equilibrium.
struct DrivenOscillator {
  Oscillator free;
  std::optional<DrivenMotion> driven;

  double position(double t) const { return free.position(t) + (driven ? driven->position(t) : 0); }
  double velocity(double t) const { return free.velocity(t) + (driven ? driven->velocity(t) : 0); }
  double amplitude_bound() const { return free.amplitude_bound() + (driven ? driven->amplitude_bound() : 0); }
};

}  // namespace

std::optional<ExactSolution> normal_modes(const Scene& scene) {
  const Particles& particles = scene.model.particles;
  const auto linear = linear_scene(scene);
  if (!linear || !scene.model.find<Springs>()) return std::nullopt;

  std::vector<DrivenOscillator> oscillators;
  std::vector<double> centre, amplitude;
  for (const Mode& m : linear->modes) {
    centre.push_back(m.forcing / m.omega2);
    DrivenOscillator v{{m.omega2, m.drag + m.dashpot, m.u0 - centre.back(), m.v0}, {}};
    if (particles.move)
      v.driven.emplace(m.omega2, m.drag, m.dashpot, m.participation * linear->base_amplitude, *particles.move);
    amplitude.push_back(v.amplitude_bound());
    oscillators.push_back(std::move(v));
  }
  if (!(linear->shortest_spring_length(scene.model, centre, amplitude) > 0)) return std::nullopt;
  return ExactSolution{
      fmt::format("{}{}",
                  linear->modes.size() == 1 ? "damped harmonic oscillator about the hanging length"
                                            : "sum of the normal modes of springs and masses on a line",
                  particles.move ? ", driven by the pins" : ""),
      [start = scene.start, particles, modes = linear->modes, oscillators](double t) {
        State s = start;
        s.t = t;
        s.v.setZero();
        for (size_t i = 0; i < modes.size(); ++i) {
          s.x += (oscillators[i].position(t) - oscillators[i].free.u0) * modes[i].shape;
          s.v += oscillators[i].velocity(t) * modes[i].shape;
        }
        particles.place_pins(s);
        return s;
      }};
}

}  // namespace crosscheck
