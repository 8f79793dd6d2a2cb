"""Explicit Euler: the slope at the start, for the whole step."""


def euler_step(f, t, x, h):
    return x + h * f(t, x)
