"""The calls that check.py makes of the steppers. The numbers are in the same order as in C++."""
import math

import numpy as np


def answer(call, take, student, as_array):
    """Returns the answer to a call: numbers and arrays."""
    part, kind = call.split(".")
    step = student(part, part + "_step")
    n, steps, t, h = int(take()), int(take()), take(), take()
    start, out = take(n), []
    if kind == "circle":
        omega = take()
        rates = lambda t, x: np.array([-omega * x[1], omega * x[0]])
    elif kind == "cosine":
        a, w, p = take(n), take(n), take(n)
        rates = lambda t, x: a * np.cos(w * t + p)
    else:
        a, b, c = take(n, n), take(n), take(n)
        rates = lambda t, x: a @ x + b + c * t

    def f(t, x):
        x = as_array("the state given to f", x, n)
        if kind == "points":
            out.extend([t, x])
        return rates(float(t), x)

    def moved(t, x, h):
        return as_array("the new state", step(f, t, x, h), -1 if kind == "points" else n)

    if kind == "points":
        moved(t, start, h)
    elif kind == "twice":
        argument = start.copy()
        out += [moved(t, argument, h), argument]
        moved(t + 1, 1 - 2 * start, h / 2)
        out.append(moved(t, start, h))
    else:
        x = start
        for k in range(steps):
            radius = math.hypot(x[0], x[-1])
            x = moved(t + k * h, x, h)
            out += [x.copy(), math.hypot(*x) / radius] if kind == "circle" else [x.copy()]
    return out
