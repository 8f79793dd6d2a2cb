// Largest stable steps on the damped oscillator u'' = -omega^2 u - gamma u', rule by rule (rad/s, 1/s -> s): the theory
// beside which the steppers are tested. Sources: the eigenvalues of each rule's 2 x 2 step matrix.
#pragma once

namespace crosscheck::limits {

double explicit_euler(double omega, double gamma);
double trapezoidal(double omega, double gamma);
double rk4(double omega, double gamma);
double dopri5(double omega, double gamma);  // of its rule at a fixed step
double symplectic_euler(double omega, double gamma);
double leapfrog(double omega, double gamma);
double suzuki4(double omega, double gamma);
double none(double omega, double gamma);  // infinite: stable at every step

}  // namespace crosscheck::limits
