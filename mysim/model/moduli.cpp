// Stiffness tensor of a regular network, from the springs of one inner particle (its star).
#include "mysim/model/moduli.h"

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace crosscheck {
namespace {

constexpr double round_off = 1e-9;  // relative; positions in a scene file are rounded to 1e-16 of the scene's size

struct Arm {
  Vec3 to;   // m, from the particle to the spring's other end
  double k;  // N/m, tangent stiffness at the spring's length
  Family family;
};
using Star = std::vector<Arm>;

bool are_equal(const Arm& a, const Arm& b, double sign) {
  return (a.to - sign * b.to).norm() <= round_off * a.to.norm() && std::abs(a.k - b.k) <= round_off * a.k;
}

bool holds(const Star& star, const Arm& arm, double sign) {
  return std::any_of(star.begin(), star.end(), [&](const Arm& own) { return are_equal(own, arm, sign); });
}

/// The shortest linearly independent displacements from a particle to others, one per dimension spanned.
std::vector<Vec3> lattice_vectors(const Points& x, int from) {
  std::vector<Vec3> all, basis;
  for (int i = 0; i < x.cols(); ++i)
    if (const Vec3 d = x.col(i) - x.col(from); d.norm() > 0)
      all.push_back(d);  // coincident particles carry no information
  if (all.empty()) return basis;
  double shortest = INFINITY;
  for (const Vec3& d : all) shortest = std::min(shortest, d.norm());
  // lengths are rounded, so that displacements of equal length stay in the order of the particles
  const auto length = [&](const Vec3& d) { return std::round(d.norm() / (round_off * shortest)); };
  std::stable_sort(all.begin(), all.end(), [&](const Vec3& a, const Vec3& b) { return length(a) < length(b); });
  for (const Vec3& d : all) {
    Vec3 rest = d;
    std::vector<Vec3> orthogonal;
    for (Vec3 b : basis) {
      for (const Vec3& o : orthogonal) b -= b.dot(o) * o;
      orthogonal.push_back(b.normalized());
    }
    for (const Vec3& o : orthogonal) rest -= rest.dot(o) * o;
    if (rest.norm() > 1e-6 * d.norm()) basis.push_back(d);
    if (basis.size() == 3) break;
  }
  return basis;
}

double measure_of_cell(const std::vector<Vec3>& basis) {
  if (basis.size() == 1) return basis[0].norm();
  const Vec3 normal = basis[0].cross(basis[1]);
  return basis.size() == 2 ? normal.norm() : std::abs(normal.dot(basis[2]));
}

}  // namespace

namespace {

/// Strain (e11, e22, 2 e12) of a sheet under a unit pull at an angle (rad) from axis 1; nothing if the network does not
/// resist it.
std::optional<Eigen::Vector3d> strain_under_pull(const Moduli& m, double angle) {
  const Eigen::Matrix3d c{{m.c11, m.c12, m.c16}, {m.c12, m.c22, m.c26}, {m.c16, m.c26, m.c66}};
  const double along = std::cos(angle), across = std::sin(angle);
  const Eigen::Vector3d pull(along * along, across * across, along * across);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(c);
  Eigen::Vector3d strain = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d mode = modes.eigenvectors().col(i);
    const double part = mode.dot(pull), stiffness = modes.eigenvalues()[i];
    if (stiffness > round_off * modes.eigenvalues()[2])
      strain += part / stiffness * mode;
    else if (part * part > round_off)
      return std::nullopt;
  }
  return strain;
}

}  // namespace

double Moduli::anisotropy() const {
  if (dimension == 1 || (dimension == 3 && !cubic)) return 0;
  if (cubic) return 2 * c66 / (c11 - c12);
  const auto [least, largest] = young_range();
  return least / largest;
}

double Moduli::poisson() const {
  if (dimension == 1) return 0;
  if (dimension == 3) return c12 / (c11 + c12);
  const auto strain = strain_under_pull(*this, 0);
  return strain ? -(*strain)[1] / (*strain)[0] : 0;
}

double Moduli::young() const {
  if (dimension == 1) return c11;
  return dimension == 2 ? young_at(0) : (c11 - c12) * (c11 + 2 * c12) / (c11 + c12);
}

double Moduli::young_at(double angle) const {
  const auto strain = strain_under_pull(*this, angle);
  if (!strain) return 0;
  const double along = std::cos(angle), across = std::sin(angle);
  return 1 / (along * along * (*strain)[0] + across * across * (*strain)[1] + along * across * (*strain)[2]);
}

std::pair<double, double> Moduli::young_range() const {
  std::pair<double, double> range{INFINITY, 0};
  constexpr int angles = 720;  // the modulus is smooth: an extremum between two angles is missed by at most 1e-5
  for (int i = 0; i < angles; ++i) {
    const double at = young_at(std::numbers::pi * i / angles);
    range = {std::min(range.first, at), std::max(range.second, at)};
  }
  return range;
}

std::string_view unit_of_moduli(int dimension) { return dimension == 1 ? "N" : dimension == 2 ? "N/m" : "Pa"; }

std::vector<std::string> sentences_of(const Moduli& m) {
  const std::string_view unit = unit_of_moduli(m.dimension);
  if (m.dimension == 1) return {fmt::format("EA = {:.4g} N: force over strain of the line", m.c11)};
  const bool coupled = std::max(std::abs(m.c16), std::abs(m.c26)) > 1e-6 * m.c11;
  std::vector<std::string> sentences{
      fmt::format("C11 = {:.4g} {}{}, C12 = C66 = {:.4g} {}{}", m.c11, unit,
                  m.cubic || m.dimension == 3 ? "" : fmt::format(", C22 = {:.4g} {}", m.c22, unit), m.c12, unit,
                  coupled ? fmt::format(", C16 = {:.4g} {}, C26 = {:.4g} {}", m.c16, unit, m.c26, unit) : "")};
  if (m.cubic) {
    sentences.push_back(fmt::format(
        "Young's modulus {:.4g} {} along an axis, Poisson's ratio {:.3g}; anisotropy 2 C66 / (C11 - C12) = {:.3g}{}",
        m.young(), unit, m.poisson(), m.anisotropy(),
        std::abs(m.anisotropy() - 1) < 5e-4 ? ": isotropic" : ", 1 is isotropic"));
  } else if (m.dimension == 2) {
    const auto [least, largest] = m.young_range();
    sentences.push_back(
        fmt::format("Young's modulus {:.4g} {} along axis 1, Poisson's ratio {:.3g}; {:.4g} to {:.4g} {} over all "
                    "directions: not isotropic",
                    m.young(), unit, m.poisson(), least, largest, unit));
  } else {
    sentences.emplace_back("its axes differ or stretch and shear are coupled: not isotropic");
  }
  return sentences;
}

std::string skip_one_warning(const Moduli& m) {
  if (!(m.c11_of_bend > 0.5 * m.c11) || m.dimension != 2) return "";
  return fmt::format(
      "skip-one springs (bend) contribute {:.0f} % of the in-plane stiffness, but no bending rigidity of a flat sheet",
      100 * m.c11_of_bend / m.c11);
}

NetModuli moduli_of(const Model& model, const State& start) {
  const auto* springs = model.find<Springs>();
  if (!springs || springs->list.empty()) return {{}, "no springs"};
  if (model.find<Constraints>()) return {{}, "hard distances"};
  const Points& x = start.x;
  std::vector<Star> stars(static_cast<size_t>(x.cols()));
  for (const Spring& s : springs->list) {
    const Vec3 d = x.col(s.b) - x.col(s.a);
    if (std::abs(d.norm() - s.rest) > round_off * s.rest) return {{}, "its springs are not at rest at the start"};
    const double k = tension_of(s, springs->law, d.norm()).slope;
    stars[static_cast<size_t>(s.a)].push_back({d, k, s.family});
    stars[static_cast<size_t>(s.b)].push_back({-d, k, s.family});
  }

  // Considers only particles whose springs form opposite pairs; prefers more springs, then a place near the middle.
  const Vec3 middle = x.rowwise().mean();
  int inside = -1;
  for (int i = 0; i < x.cols(); ++i) {
    const Star& star = stars[static_cast<size_t>(i)];
    if (star.empty() || !std::all_of(star.begin(), star.end(), [&](const Arm& arm) { return holds(star, arm, -1); }))
      continue;
    const auto better = [&](int a, int b) {
      const size_t size_a = stars[static_cast<size_t>(a)].size(), size_b = stars[static_cast<size_t>(b)].size();
      return size_a != size_b ? size_a > size_b : (x.col(a) - middle).norm() < (x.col(b) - middle).norm();
    };
    if (inside < 0 || better(i, inside)) inside = i;
  }
  if (inside < 0) return {{}, "no particle has springs on all sides"};
  const Star& star = stars[static_cast<size_t>(inside)];
  for (const Star& other : stars)
    for (const Arm& arm : other)
      if (!holds(star, arm, 1)) return {{}, "its springs differ from place to place"};

  const std::vector<Vec3> basis = lattice_vectors(x, inside);
  Eigen::Matrix3Xd arms(3, star.size());
  for (size_t i = 0; i < star.size(); ++i) arms.col(static_cast<long>(i)) = star[i].to;
  if (Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(arms).setThreshold(1e-6).rank() != std::ssize(basis))
    return {{}, "its springs do not span its dimensions"};
  const Vec3 e1 = basis[0].normalized();
  const Vec3 e2 = basis.size() > 1 ? (basis[1] - basis[1].dot(e1) * e1).normalized() : Vec3::Zero();
  Moduli m;
  m.dimension = static_cast<int>(basis.size());
  const double cell = measure_of_cell(basis);
  Eigen::Matrix<double, 6, 6> whole = Eigen::Matrix<double, 6, 6>::Zero();  // tensor in Voigt notation
  for (const Arm& arm : star) {
    const double n1 = arm.to.normalized().dot(e1), n2 = arm.to.normalized().dot(e2),
                 weight = arm.k * arm.to.squaredNorm() / (2 * cell);
    m.c11 += weight * n1 * n1 * n1 * n1;
    m.c22 += weight * n2 * n2 * n2 * n2;
    m.c12 += weight * n1 * n1 * n2 * n2;
    m.c16 += weight * n1 * n1 * n1 * n2;
    m.c26 += weight * n1 * n2 * n2 * n2;
    const double n3 = m.dimension == 3 ? arm.to.normalized().dot(e1.cross(e2)) : 0;
    const Vec3 squares(n1 * n1, n2 * n2, n3 * n3);
    Eigen::Matrix<double, 6, 1> n;
    n << squares, n2 * n3, n1 * n3, n1 * n2;
    whole += weight * n * n.transpose();
    if (arm.family == Family::bend) m.c11_of_bend += weight * n1 * n1 * n1 * n1;
  }
  // Cauchy's relation, which holds for central forces if each particle is a centre of symmetry
  m.c66 = m.c12;
  Eigen::Matrix<double, 6, 6> cubic = Eigen::Matrix<double, 6, 6>::Zero();
  for (int i = 0; i < m.dimension; ++i)
    for (int j = 0; j < m.dimension; ++j) cubic(i, j) = i == j ? m.c11 : m.c12;
  for (int i = m.dimension == 2 ? 5 : 3; i < 6; ++i) cubic(i, i) = m.c12;
  m.cubic = m.dimension == 1 || (whole - cubic).cwiseAbs().maxCoeff() <= 1e-6 * m.c11;
  return {m, ""};
}

std::optional<BendingLength> bending_length_of(const Model& model, const State& start) {
  const auto* bending = model.find<Bending>();
  if (!bending) return std::nullopt;
  BendingLength found{bending->rigidity, INFINITY, 0};
  double area = 0, mass = 0;
  std::vector<char> counted(static_cast<size_t>(model.particles.size()), 0);
  for (const Bending::Stencil& s : bending->list) {
    const auto side = [&](int i) -> Vec3 { return start.x.col(s.particle[i]) - start.x.col(s.particle[0]); };
    found.spacing = std::max(found.spacing, side(1).norm());
    if (s.size == 4) area += side(1).cross(side(2)).norm();
    for (int i = 0; i < s.size; ++i)
      if (!std::exchange(counted[static_cast<size_t>(s.particle[i])], 1)) mass += model.particles.mass[s.particle[i]];
  }
  if (const auto* gravity = model.find<Gravity>(); gravity && area > 0)
    if (const double weight = mass * gravity->acceleration.norm() / area; weight > 0)
      found.length = std::cbrt(found.rigidity / weight);
  return found;
}

std::string sentence_of(const BendingLength& bending) {
  const std::string rigidity = fmt::format("B = {:.4g} N m, Poisson's ratio 0", bending.rigidity);
  if (std::isinf(bending.length)) return rigidity;
  return fmt::format("{}; under its weight it folds at the length (B/w)^(1/3) = {:.3g} m, {:.3g} spacings of the grid",
                     rigidity, bending.length, bending.spacings());
}

std::string coarse_grid_warning(const BendingLength& bending) {
  // resolving a fold requires at least one particle on each side of it
  if (!(bending.spacings() < 2)) return "";
  return fmt::format(
      "folds of {:.3g} m, as bending and weight produce them, are finer than two grid spacings of {:.3g} m",
      bending.length, bending.spacing);
}

}  // namespace crosscheck
