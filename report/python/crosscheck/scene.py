"""Scenes built in Python, written as the TOML files that crosscheck reads."""
import json
import re
from pathlib import Path

import numpy as np

from . import program
from .program import Error


class Scene(dict):
    """A scene: a dict with the keys of a scene file (see experiments/scenes/README.md), in SI units.

    name      of the scene and its file
    duration  simulated time, s;  step: of the default method, s;  samples: frames after the first one
    Further keyword arguments go into [time]: window (s), tolerance (m), method.

    >>> s = Scene("two", duration=1.0, step=1e-3)
    >>> a, b = s.particle([0, 0, 0], mass=1), s.particle([0, -1, 0], mass=0.5)
    >>> s.spring(a, b, stiffness=80)
    >>> s.pin(a)
    >>> s["gravity"] = {"acceleration": [0, -9.81, 0]}
    >>> print(s.toml()[s.toml().index("[pins]"):])
    [pins]
    particles = [0]
    <BLANKLINE>
    [gravity]
    acceleration = [0, -9.81, 0]
    <BLANKLINE>
    """

    def __init__(self, name="scene", duration=1.0, step=1e-3, samples=50, **time):
        super().__init__()
        self.name = name
        self["question"] = time.pop("question", "What does it do?")
        self["parameters"] = time.pop("parameters", "Set in Python.")
        self["time"] = {"duration": duration, "step": step, "samples": samples, "window": duration, "tolerance": 1e-3,
                        "method": "leapfrog", **time}

    @classmethod
    def read(cls, scene):
        """Reads a file, or a shipped scene by name.

        Needs Python 3.11 or later, whose library reads TOML."""
        import tomllib
        path = Path(scene) if str(scene).endswith(".toml") else shipped(scene)
        out = cls(path.stem)
        out.clear()
        try:
            out.update(tomllib.loads(path.read_text(encoding="utf-8")))
        except (OSError, tomllib.TOMLDecodeError) as error:
            raise Error(f"{path}: {error}") from None
        return out

    def particle(self, position, mass, velocity=None):
        """Adds a particle (position m, mass kg, velocity m/s) and returns its number, from 0."""
        row = {"position": position, "mass": mass}
        if velocity is not None:
            row["velocity"] = velocity
        self.setdefault("particle", []).append(row)
        return len(self["particle"]) - 1

    def spring(self, a, b, stiffness, rest=None, dashpot=None):
        """Joins two particles: stiffness N/m, rest length m (None: initial distance), dashpot N s/m along it."""
        row = {"ends": [a, b], "stiffness": stiffness, "rest": rest, "dashpot": dashpot}
        self.setdefault("spring", []).append({key: value for key, value in row.items() if value is not None})

    def pin(self, *particles):
        """Fixes these particles at their initial positions."""
        self.setdefault("pins", {}).setdefault("particles", []).extend(particles)

    def toml(self):
        """Text of the scene file."""
        return toml(self)

    def write(self, path):
        """Writes the scene's file and returns its path."""
        Path(path).write_text(self.toml(), encoding="utf-8")
        return Path(path)


def shipped(name):
    """File of a shipped scene, in the source tree or the installation."""
    roots = [Path(program.find_program()).resolve().parent]
    roots += roots[0].parents
    for root in roots:
        for folder in (root / "experiments" / "scenes", root / "share" / "crosscheck"):
            for path in folder.rglob(f"{name}.toml"):
                return path
    raise Error(f"no scene {name} is shipped; crosscheck.scenes() has their names")


def value_of(value, key):
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(value_of(part, key) for part in value) + "]"
    raise Error(f"scene: {key}: expected a number, a text or a list, got {type(value).__name__}")


def key_of(key):
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key)


def is_table(value):
    return isinstance(value, dict) or (isinstance(value, (list, tuple)) and len(value) > 0
                                       and all(isinstance(part, dict) for part in value))


def toml(scene, prefix=""):
    """Writes a dict as TOML: plain values first, then tables; lists of dicts are arrays of tables.

    >>> print(toml({"a": [1, 2.5], "b": {"c": "x"}, "d": [{"e": 1}, {"e": 2}]}))
    a = [1, 2.5]
    <BLANKLINE>
    [b]
    c = "x"
    <BLANKLINE>
    [[d]]
    e = 1
    <BLANKLINE>
    [[d]]
    e = 2
    <BLANKLINE>
    """
    out = "".join(f"{key_of(key)} = {value_of(value, prefix + key)}\n"
                  for key, value in scene.items() if not is_table(value))
    for key, value in scene.items():
        if not is_table(value):
            continue
        path, twice = prefix + key_of(key), not isinstance(value, dict)
        for part in value if twice else [value]:
            out += f"\n{'[[' if twice else '['}{path}{']]' if twice else ']'}\n" + toml(part, path + ".")
    return out


def scene_word(scene, folder):
    """Name or path of a scene for the command line; a Scene is written into the folder."""
    if isinstance(scene, dict):
        name = getattr(scene, "name", "scene")
        if not re.fullmatch(r"[A-Za-z0-9._=-]+", name):
            raise Error(f"scene {name!r}: expected a name of letters, digits and . _ = -")
        path = Path(folder) / f"{name}.toml"
        path.write_text(toml(scene), encoding="utf-8")
        return str(path)
    return str(scene)
