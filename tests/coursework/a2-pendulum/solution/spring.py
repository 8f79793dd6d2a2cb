"""A spring, without force if its ends coincide."""
import numpy as np


def spring_force(a, b, stiffness, rest):
    d = a - b
    length = np.linalg.norm(d)
    return -stiffness * (length - rest) * d / length if length > 0 else np.zeros(3)
