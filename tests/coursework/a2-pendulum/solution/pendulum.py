"""One particle that hangs on a fixed one."""
import numpy as np

from gravity_drag import drag_force, gravity_force
from spring import spring_force


def pendulum_derivative(pendulum, state):
    anchor, _, x, v = state
    force = gravity_force(pendulum.mass, pendulum.gravity) + drag_force(pendulum.drag, v)
    force = force + spring_force(x, anchor, pendulum.stiffness, pendulum.rest)
    return np.array([np.zeros(3), np.zeros(3), v, force / pendulum.mass])
