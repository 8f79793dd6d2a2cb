"""Gravity and drag."""


def gravity_force(mass, g):
    return mass * g


def drag_force(drag, v):
    return -drag * v
