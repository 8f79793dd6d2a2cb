"""Particles in a row: forces first, rates afterwards."""
import numpy as np

from gravity_drag import drag_force, gravity_force
from spring import spring_force


def chain_derivative(chain, state):
    x, v = state[0::2], state[1::2]
    force = np.array([gravity_force(m, chain.gravity) + drag_force(chain.drag, u) for m, u in zip(chain.mass, v)])
    for i, (stiffness, rest) in enumerate(zip(chain.stiffness, chain.rest)):
        pull = spring_force(x[i], x[i + 1], stiffness, rest)
        force[i] += pull
        force[i + 1] -= pull
    rates = np.zeros_like(state)
    rates[2::2] = v[1:]
    rates[3::2] = force[1:] / chain.mass[1:, np.newaxis]
    return rates
