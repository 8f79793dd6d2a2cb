"""Gravity and drag. Vectors are NumPy arrays of three numbers; units: m, kg, s, N."""
import numpy as np


def gravity_force(mass, g):
    """Force of gravity (N) on a particle of this mass; g is the acceleration of free fall, a vector (m/s^2)."""
    return np.zeros(3)  # yours


def drag_force(drag, v):
    """Force of viscous drag (N) on a particle of velocity v: -drag v. `drag` is in N s/m."""
    return np.zeros(3)  # yours
