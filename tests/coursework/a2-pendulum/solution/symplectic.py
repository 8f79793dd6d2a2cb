"""Symplectic Euler: velocities first, then positions with the new velocities."""


def symplectic_step(f, state, h):
    following = state.copy()
    following[1::2] += h * f(state)[1::2]
    following[0::2] += h * following[1::2]
    return following
