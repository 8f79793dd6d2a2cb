"""The calls that check.py makes of forces, derivatives and the step. The numbers are in the same order as in C++."""
from types import SimpleNamespace

import numpy as np


def forces(call, take, student, as_array):
    force = student("spring" if call == "spring" else "gravity_drag", call + "_force")
    for _ in range(int(take())):
        if call == "spring":
            stiffness, rest, a, b = take(), take(), take(3), take(3)
            yield as_array("the force", force(a, b, stiffness, rest), 3)
            yield as_array("the force", force(b, a, stiffness, rest), 3)
        else:
            yield as_array("the force", force(take(), take(3)), 3)


def derivatives(call, take, student, as_array):
    part = call.split(".")[0]
    derivative = student(part, part + "_derivative")
    n = int(take()) if part == "chain" else 2
    sizes = [(n,), (n - 1,), (n - 1,)] if part == "chain" else [(), (), ()]
    system = SimpleNamespace(gravity=take(3), drag=take())
    system.mass, system.stiffness, system.rest = (take(*size) for size in sizes)
    a = take(2 * n, 3)
    yield as_array("the derivative", derivative(system, a), -1, 3)
    if call.endswith(".twice"):
        yield as_array("the derivative", derivative(system, take(2 * n, 3)), -1, 3)
        yield as_array("the derivative", derivative(system, a), -1, 3)
        yield a


def steps(call, take, student, as_array):
    step, out = student("symplectic", "symplectic_step"), []
    n, count, h = int(take()), int(take()), take()
    k, c, g, state = take(n, n), take(), take(3), take(2 * n, 3)

    def f(at):
        at = as_array("the state given to f", at, 2 * n, 3)
        if call == "symplectic.points":
            out.append(at)
        rates = np.empty_like(at)
        rates[0::2], rates[1::2] = at[1::2], g - c * at[1::2] - k @ at[0::2]
        return rates

    if call != "symplectic":
        as_array("the new state", step(f, state, h), -1, 3)
        return out if call == "symplectic.points" else [state]
    for _ in range(count):
        state = as_array("the new state", step(f, state, h), 2 * n, 3)
        out.append(state.copy())
    return out


def answer(call, take, student, as_array):
    """Returns the answer to a call: numbers and arrays."""
    kinds = {"gravity": forces, "drag": forces, "spring": forces, "symplectic": steps}
    return kinds.get(call.split(".")[0], derivatives)(call, take, student, as_array)
