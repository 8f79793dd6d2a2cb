"""The explicit trapezoidal rule."""


def trapezoidal_step(f, t, x, h):
    """The state at t + h: f0 = f(t, x), f1 = f(t + h, x + h f0), x + h/2 (f0 + f1). Calls f twice."""
    return x  # yours
