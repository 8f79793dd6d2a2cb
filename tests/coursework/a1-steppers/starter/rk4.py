"""The classic Runge-Kutta rule of order 4."""


def rk4_step(f, t, x, h):
    """The state at t + h. Calls f four times."""
    return x  # yours
