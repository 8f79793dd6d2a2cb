"""The explicit trapezoidal rule: the mean of the slope at the start and of the slope where Euler would land."""


def trapezoidal_step(f, t, x, h):
    f0 = f(t, x)
    f1 = f(t + h, x + h * f0)
    return x + h / 2 * (f0 + f1)
