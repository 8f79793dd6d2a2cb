"""Particles in a row, the first one fixed."""
import numpy as np


def chain_derivative(chain, state):
    """Derivative of a state of n particles in a row: particle 0 is fixed, the others have gravity, drag and springs.

    `chain` has the fields gravity (a vector, m/s^2), drag (of each particle, N s/m) and the arrays mass (n, kg; the
    fixed particle's mass does not matter), stiffness (n - 1, N/m; spring i joins particles i and i + 1) and rest
    (n - 1, m).
    """
    return np.zeros_like(state)  # yours
