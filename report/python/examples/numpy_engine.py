"""A user-written engine in NumPy, tested with `check`: symplectic Euler on springs, gravity and drag."""
import sys

import numpy as np

import crosscheck


@crosscheck.engine(terms=["springs", "gravity", "drag"])
def my_euler(x, v, scene, h):
    s, f = scene.springs, np.zeros_like(x)
    d = x[s.a] - x[s.b]
    length = np.linalg.norm(d, axis=1, keepdims=True)
    pull = s.stiffness[:, None] * (length - s.rest_length[:, None]) * d / length
    np.add.at(f, s.a, -pull)
    np.add.at(f, s.b, pull)
    f += scene.mass[:, None] * scene.gravity - scene.drag[:, None] * v
    v = v + h * f / scene.mass[:, None]
    return x + h * v, v


result = crosscheck.check(my_euler, sys.argv[1:])  # default: the smallest scene of each relation
print(result)
sys.exit(not result)
