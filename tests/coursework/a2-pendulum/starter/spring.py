"""A spring."""
import numpy as np


def spring_force(a, b, stiffness, rest):
    """Force (N) of a spring on the particle at a; the spring's other end is at b.

    With d = a - b and L = |d|, the force is -stiffness (L - rest) d / L. If the ends coincide, it is zero.
    """
    return np.zeros(3)  # yours
