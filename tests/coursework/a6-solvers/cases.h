// Nets, and cases of the passes. The expected answers are computed from mysim's forces, eigenvalues and closed forms.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "tests/coursework/grader/vectors.h"

namespace coursework::a6 {

/// A net and its state.
struct Scene {
  double mass = 1, stiffness = 1, h = 1;
  crosscheck::Vec3 gravity = crosscheck::Vec3::Zero();
  std::vector<crosscheck::Spring> springs;  // their own stiffness is ignored
  std::vector<int> held;                    // 0 or 1 each
  crosscheck::Points x, v;

  double slope() const { return mass / (h * h) + 4 * stiffness; }  // N/m
  /// Matrix of a plain pass for small errors at this state: I - (m/h^2 + K) / (m/h^2 + 4 k). K is the matrix -dF/dx of
  /// the springs, without the rows and columns of held particles.
  Eigen::MatrixXd iteration() const;
};

/// Fraction of an error that remains after n passes: T_n(mu / rho) / T_n(1 / rho), or mu^n if rho is 0.
double left_over(double mu, double rho, int passes);

/// Advances the scene by one step with the given number of accelerated passes.
void step(Scene& scene, int passes, double rho);

/// The largest |z| of the roots of z^2 - sum z + product = 0.
double growth(double sum, double product);
/// step_growth: factor by which each step of the given number of passes multiplies a deviation from rest, in the long
/// run. grows: true if one of several deviations grows. diverges_from: the smallest rho at which one grows, 1 if none.
double step_growth(double mu, double inertia, double rho, int passes);
bool grows(const Eigen::VectorXd& mu, double inertia, double rho, int passes);
double diverges_from(const Eigen::VectorXd& mu, double inertia, int passes);

/// side x side particles in a plane, with one diagonal in each cell and two held corners; rest lengths are
/// `rest_of_length` times the lengths in the flat net.
Scene square(int side, double width, double rest_of_length);

using Cases = std::vector<Case>(Random&);
Cases gradients, inertia_alone, passes, steps, falling_errors, rest_by_passes, course_net, averages, averaged_steps,
    rest_by_averaging;

}  // namespace coursework::a6
