#!/usr/bin/env python3
"""An engine for crosscheck in NumPy: symplectic Euler with springs, drag, gravity, moved pins and planes. See PROTOCOL.md."""
import json
import sys
import time

import numpy as np

task = json.load(open(sys.argv[1]))
terms = {term["type"]: term for term in task["terms"]}
lacking = set(terms) - {"springs", "drag", "gravity", "plane"}
if lacking:
    print("this example has no " + ", ".join(sorted(lacking)), file=sys.stderr)
    sys.exit(3)

h, per_sample = task["run"]["step"], task["run"]["steps_per_sample"]
x, v = np.array(task["particles"]["x"]), np.array(task["particles"]["v"])
mass = np.array(task["particles"]["mass"])[:, None]
pins = task.get("pins", {"particles": [], "home": np.empty((0, 3))})
held, home = np.array(pins["particles"], int), np.array(pins["home"])
springs = terms.get("springs", {"law": "hooke", "list": []})
a, b, k, rest = (np.array([s[key] for s in springs["list"]]) for key in ("a", "b", "stiffness", "rest_length"))
a, b = a.astype(int), b.astype(int)
drag = np.array(terms["drag"]["coefficient"])[:, None] if "drag" in terms else 0
gravity = np.array(terms["gravity"]["acceleration"]) if "gravity" in terms else 0
planes = [{key: np.array(value) for key, value in plane.items()} for plane in terms.get("plane", {"list": []})["list"]]
free = ~np.isin(np.arange(len(x)), held)


def pins_at(t):
    """Positions and velocities of the pins: d(t) = amplitude r(t / ramp) sin(2 pi frequency t)."""
    if "motion" not in pins:
        return home, 0
    move = pins["motion"]
    s, omega = min(t / move["ramp"], 1), 2 * np.pi * move["frequency"]
    r, slope = s**3 * (10 + s * (6 * s - 15)), 30 * s**2 * (1 - s) ** 2 / move["ramp"]
    amplitude = np.array(move["amplitude"])
    return home + amplitude * r * np.sin(omega * t), amplitude * (slope * np.sin(omega * t) + r * omega * np.cos(omega * t))


def spring_force(x):
    f = np.zeros_like(x)
    d = x[a] - x[b]
    length = np.linalg.norm(d, axis=1)
    pull = k * (length - rest)
    if springs["law"] == "bullet-link":
        pull = k * length * (length**2 - rest**2) / (length**2 + rest**2)
    on_a = -(np.divide(pull, length, out=np.zeros_like(pull), where=length > 0))[:, None] * d
    np.add.at(f, a, on_a)
    np.add.at(f, b, -on_a)
    return f


def face_at(plane, t):
    """A point of the face that particles touch, and its velocity."""
    velocity = plane.get("velocity", np.zeros(3))
    return plane["point"] + plane["margin"] * plane["normal"] + t * velocity, velocity


def shortened(vectors, by):
    length = np.linalg.norm(vectors, axis=1)
    return vectors * np.maximum(0, 1 - np.divide(by, length, out=np.ones_like(length), where=length > 0))[:, None]


def touch(plane, before, t):
    """Puts particles on the plane, with Coulomb friction on their displacement and velocity relative to the plane."""
    (point, velocity), n, mu = face_at(plane, t), plane["normal"], plane["friction"]
    i = np.flatnonzero(((x - point) @ n < 0) & free)
    push = -(x[i] - point) @ n
    start = before[i] + h * velocity
    moved = x[i] + push[:, None] * n - start
    up = (moved @ n)[:, None] * n
    x[i] = start + up + shortened(moved - up, mu * push)
    w = v[i] - velocity
    inward = np.minimum(w @ n, 0)
    change = -(1 + plane["restitution"]) * inward
    v[i] = velocity + shortened(w - inward[:, None] * n, mu * change) + (inward + change)[:, None] * n


def readback(end):
    """The scene as simulated, for the certificate: this engine has no dashpots, wind and spheres."""
    start, speed = np.array(task["particles"]["x"]), np.array(task["particles"]["v"])
    stretched, none = start, np.zeros_like(start)
    for factor in np.arange(1.1, 3, 0.1):  # until no spring is within a hundredth of its rest length
        stretched = factor * start
        length = np.linalg.norm(stretched[a] - stretched[b], axis=1)
        if np.all((length == 0) | (abs(length - rest) > 0.01 * rest)):
            break
    probe = {"x": stretched, "v": none, "springs": spring_force(stretched), "dashpots": none, "wind": none}
    return {
        "precision": "double", "mass": mass[:, 0].tolist(), "pinned": np.isin(np.arange(len(x)), held).astype(int).tolist(),
        "links": [{"a": int(i), "b": int(j), "stiffness": s, "rest_length": r} for i, j, s, r in zip(a, b, k, rest)],
        "gravity": (gravity + np.zeros(3)).tolist(), "drag": (drag / mass * np.ones_like(mass))[:, 0].tolist(),
        "spheres": [], "may_sleep": False, "step": h, "start": {"x": start.tolist(), "v": speed.tolist()},
        "later": {"t": end, "pins": x[held].tolist(), "centres": [], "points": [face_at(p, end)[0].tolist() for p in planes]},
        "planes": [{"point": face_at(p, 0)[0].tolist(), **{key: p[key].tolist() for key in ("normal", "friction", "restitution")}}
                   for p in planes],
        "probe": {"t": 0, **{name: part.tolist() for name, part in probe.items()}}}


frames, speeds, start = [x.copy()], [v.copy()], time.process_time()
for step in range(1, task["run"]["samples"] * per_sample + 1):
    v += h * (spring_force(x) + mass * gravity - drag * v) / mass
    before = x.copy()
    x += h * v
    for plane in planes:
        touch(plane, before, step * h)
    x[held], v[held] = pins_at(step * h)
    if step % per_sample == 0:
        frames.append(x.copy())
        speeds.append(v.copy())
cpu_seconds = time.process_time() - start
steps = task["run"]["samples"] * per_sample
np.save(sys.argv[2] + "/trajectory.npy", np.array(frames))
np.save(sys.argv[2] + "/velocities.npy", np.array(speeds))
json.dump({"cpu_seconds": cpu_seconds, "steps": steps, "force_evaluations": steps, "readback": readback(steps * h)},
          open(sys.argv[2] + "/run.json", "w"))
