"""One particle that hangs on a fixed one."""
import numpy as np


def pendulum_derivative(pendulum, state):
    """Derivative of a state of two particles, in the same layout: an array of four rows.

    Particle 0 is fixed: both its rates are zero, whatever the state says. Particle 1 hangs on it by a spring, with
    gravity and drag. `pendulum` has the fields gravity (a vector, m/s^2), drag (N s/m), mass (of particle 1, kg),
    stiffness (N/m) and rest (rest length, m).
    """
    return np.zeros_like(state)  # yours
