"""NumPy step functions as engines: programs that crosscheck calls like any other external engine.

Each program is a self-contained file. It holds the function and everything the function uses: other functions of the
same notebook or module, numbers, arrays, and modules by name. It does not need the process that wrote it.
"""
import atexit
import dis
import json
import marshal
import os
import pickle
import shutil
import stat
import sys
import tempfile
import time
import types
from pathlib import Path

import numpy as np

from .program import Error

knows = ("springs", "bullet-link", "dashpots", "gravity", "drag")
"""Terms that EngineScene.force models; bullet-link is the alternative law of springs."""


class Springs:
    """A scene's springs as arrays: a, b (particles), stiffness (N/m), rest_length (m); law: "hooke", "bullet-link"."""

    def __init__(self, term):
        rows = term.get("list", [])
        self.law = term.get("law", "hooke")
        self.a, self.b = (np.array([row[end] for row in rows], dtype=int) for end in "ab")
        self.stiffness, self.rest_length = (np.array([row[key] for row in rows], dtype=float)
                                            for key in ("stiffness", "rest_length"))


class EngineScene:
    """The scene as a step function sees it, in SI units; arrays have one row per particle.

    mass     (n,) kg                        pinned   (n,) bool
    springs  a Springs                      gravity  (3,) m/s^2, zero where the scene has none
    drag     (n,) N s/m: force -drag v      t        s, at the start of the step
    options  list of the options in the method's name, without "+"
    json     the whole scene as crosscheck passes it (reference/protocol/PROTOCOL.md)
    """

    def __init__(self, task):
        particles = task["particles"]
        self.json, self.options, self.t = task, task.get("options", []), 0.0
        self.terms = {term["type"]: term for term in task["terms"]}
        self.mass = np.array(particles.get("mass", np.ones(particles["count"])), dtype=float)
        self.pinned = np.array(particles.get("pinned", np.zeros(particles["count"])), dtype=bool)
        self.springs = Springs(self.terms.get("springs", {}))
        self.gravity = np.array(self.terms["gravity"]["acceleration"]) if "gravity" in self.terms else np.zeros(3)
        self.drag = np.array(self.terms["drag"]["coefficient"]) if "drag" in self.terms else np.zeros(len(self.mass))
        dashpots = self.terms.get("dashpots", {}).get("list", [])
        self._dashpots = [np.array([row[key] for row in dashpots], dtype=kind)
                          for key, kind in (("a", int), ("b", int), ("coefficient", float))]
        self.evaluations = 0

    def force(self, x, v):
        """Forces of springs, dashpots, gravity and drag, (n, 3) in N; each call counts as one evaluation."""
        self.evaluations += 1
        f = self.mass[:, None] * self.gravity - self.drag[:, None] * v
        s = self.springs
        d = x[s.a] - x[s.b]
        length = np.linalg.norm(d, axis=1)
        pull = s.stiffness * (length - s.rest_length)
        if s.law == "bullet-link":
            squares = length**2 + s.rest_length**2
            pull = s.stiffness * length * (length**2 - s.rest_length**2) / np.where(squares > 0, squares, 1)
        self._add(f, s.a, s.b, d, np.divide(pull, length, out=np.zeros_like(pull), where=length > 0))
        a, b, c = self._dashpots
        if len(a):
            d = x[a] - x[b]
            square = np.sum(d * d, axis=1)
            rate = c * np.sum((v[a] - v[b]) * d, axis=1)
            self._add(f, a, b, d, np.divide(rate, square, out=np.zeros_like(rate), where=square > 0))
        return f

    @staticmethod
    def _add(f, a, b, d, factor):
        np.add.at(f, a, -factor[:, None] * d)
        np.add.at(f, b, factor[:, None] * d)

    def pins(self, t):
        """Positions and velocities of the pinned particles at t, in the order of json["pins"]["particles"]."""
        pins = self.json["pins"]
        home = np.array(pins["home"])
        if "motion" not in pins:
            return home, np.zeros_like(home)
        move = pins["motion"]
        s, omega = min(t / move["ramp"], 1), 2 * np.pi * move["frequency"]
        r, slope = s**3 * (10 + s * (6 * s - 15)), 30 * s**2 * (1 - s) ** 2 / move["ramp"]
        amplitude = np.array(move["amplitude"])
        speed = amplitude * (slope * np.sin(omega * t) + r * omega * np.cos(omega * t))
        return home + amplitude * r * np.sin(omega * t), speed + np.zeros_like(home)


class Engine:
    """A step function (x, v, scene, h) -> (x, v) as a method: pass it wherever a method is expected.

    x, v: (n, 3) arrays, m and m/s; scene: an EngineScene; h: the time step, s. After each step, pinned particles are
    reset to the positions that the scene prescribes. `terms`: the terms of the protocol that the function models, by
    default those of `scene.force`. "springs" means Hooke's law, and "bullet-link" the other law of springs. Scenes with
    other terms are refused.

    >>> @engine(terms=["gravity"])
    ... def fall(x, v, scene, h):
    ...     v = v + h * scene.gravity
    ...     return x + h * v, v
    >>> fall.method.startswith("exec:/") and fall.path.name
    'fall'
    """

    def __init__(self, step, terms):
        self.step, self.terms, self.__doc__ = step, tuple(terms), step.__doc__
        self.name = "".join(c if c.isalnum() or c in "._-" else "-" for c in step.__name__).strip("-") or "engine"
        self._folder = None

    def __call__(self, x, v, scene, h):
        return self.step(x, v, scene, h)

    def save(self, path):
        """Writes the program to this path, for use as `exec:PATH` on the command line; returns the path."""
        path = Path(path).absolute()
        task = pickle.dumps((encoded(self.step, {}), self.terms, self.name))
        if "," in str(path):
            raise Error(f"engine {self.name}: expected a path without a comma, got {path}")
        text = program_text.format(python=sys.executable, paths=[str(Path(__file__).resolve().parents[1]), *sys.path],
                                   task=task, name=self.name)
        part = path.with_name(path.name + ".part")
        part.write_text(text, encoding="utf-8")
        part.chmod(part.stat().st_mode | stat.S_IXUSR)
        part.replace(path)
        return path

    @property
    def path(self):
        """The program's file, rewritten with current values at each access; deleted when this process ends."""
        if self._folder is None:
            self._folder = tempfile.mkdtemp(prefix="crosscheck-engine-")
            atexit.register(shutil.rmtree, self._folder, ignore_errors=True)
        return self.save(Path(self._folder) / self.name)

    @property
    def method(self):
        """exec:PATH"""
        return f"exec:{self.path}"


def engine(step=None, *, terms=knows):
    """Turns a step function (x, v, scene, h) -> (x, v) into an Engine; as `@engine` or `@engine(terms=[...])`."""
    if step is None:
        return lambda function: Engine(function, terms)
    return Engine(step, terms)


program_text = """#!{python}
# The engine {name}, written by crosscheck's @engine. Called as: {name} scene.json OUTDIR
import sys
sys.path[:] = {paths!r}
from crosscheck.engines import main
main({task!r})
"""


def encoded(value, seen):
    """Prepares a value for pickle: functions by code, modules by name, other values unchanged."""
    if isinstance(value, Engine):
        value = value.step
    if isinstance(value, types.ModuleType):
        return ("module", value.__name__)
    if isinstance(value, types.FunctionType) and is_own(value):
        if id(value) in seen:
            return ("again", id(value))
        seen[id(value)] = value
        names = names_in(value.__code__)
        used = {name: encoded(value.__globals__[name], seen) for name in sorted(names) if name in value.__globals__}
        cells = [encoded(cell.cell_contents, seen) for cell in value.__closure__ or ()]
        return ("function", id(value), marshal.dumps(value.__code__), value.__name__, value.__defaults__,
                value.__kwdefaults__, used, cells)
    try:
        dump = pickle.dumps(value)
    except Exception as error:
        raise Error(f"engine: an object that the function uses cannot be passed on: {error}") from None
    if b"__main__" in dump:
        raise Error(f"engine: {value!r} is of a class of the notebook, which cannot be passed on: "
                    "move the class into a module, or pass its numbers")
    return ("value", dump)


def is_own(function):
    """True for a function of a notebook or of the user's files, False for one of an installed package."""
    module = sys.modules.get(function.__module__)
    file = getattr(module, "__file__", None) if function.__module__ != "__main__" else None
    return file is None or not any(part in ("site-packages", "dist-packages") or part.startswith("python3")
                                   for part in Path(file).parts)


def names_in(code):
    names = {word.argval for word in dis.get_instructions(code) if word.opname in ("LOAD_GLOBAL", "LOAD_NAME")}
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            names |= names_in(constant)
    return names


def decoded(value, seen):
    if value[0] == "module":
        __import__(value[1])
        return sys.modules[value[1]]
    if value[0] == "value":
        return pickle.loads(value[1])
    if value[0] == "again":
        return seen[value[1]]
    _, key, code, name, defaults, kwdefaults, used, cells = value
    scope = {"__builtins__": __builtins__, "__name__": "engine"}
    contents = tuple(types.CellType() for _ in cells)
    function = types.FunctionType(marshal.loads(code), scope, name, defaults, contents)
    function.__kwdefaults__ = kwdefaults
    seen[key] = function
    for cell, content in zip(contents, cells):
        cell.cell_contents = decoded(content, seen)
    scope.update({name: decoded(part, seen) for name, part in used.items()})
    return function


class Refused(Exception):
    """An ingredient that the engine does not model; the exit status is 3."""


def main(dump):
    """Runs the scene in the arguments or, with --serve, a scene per line of stdin."""
    if sys.argv[1:] == ["--serve"]:
        answers, sys.stdout = sys.stdout, sys.stderr  # the step function may print
        for line in sys.stdin:
            request = json.loads(line)
            print(json.dumps(answer(dump, request["scene"], request["out"])), file=answers, flush=True)
        return
    if len(sys.argv) != 3:
        sys.exit(f"usage: {sys.argv[0]} scene.json OUTDIR")
    try:
        run_scene(dump, *sys.argv[1:])
    except Refused as reason:
        print(reason, file=sys.stderr)
        sys.exit(3)


def answer(dump, scene, out):
    try:
        run_scene(dump, scene, out)
        return {"status": 0}
    except Refused as reason:
        return {"status": 3, "reason": str(reason)}
    except SystemExit as end:
        return {"status": 1, "reason": str(end.code)}
    except Exception as error:
        return {"status": 1, "reason": f"{type(error).__name__}: {error}"}


def run_scene(dump, scene_file, out):
    """Reads scene.json, steps, and writes trajectory.npy, velocities.npy and run.json into the folder out."""
    step_task, terms, name = pickle.loads(dump)
    with open(scene_file, encoding="utf-8") as file:
        task = json.load(file)
    asked = {term["type"] for term in task["terms"]}
    asked |= {term["law"] for term in task["terms"] if term.get("law", "hooke") != "hooke"}
    lacking = sorted(asked - set(terms))
    if lacking:
        raise Refused(f"{name} has no {', '.join(lacking)}")
    if task["first_order"]:
        raise Refused(f"{name} supports second-order scenes only")
    step, scene = decoded(step_task, {}), EngineScene(task)
    times, steps, speeds, seconds = run(name, step, scene)
    np.save(os.path.join(out, "trajectory.npy"), times)
    np.save(os.path.join(out, "velocities.npy"), speeds)
    told = {"cpu_seconds": seconds, "steps": steps, "serves": True}
    if scene.evaluations:
        told["force_evaluations"] = scene.evaluations
    with open(os.path.join(out, "run.json"), "w", encoding="utf-8") as file:
        json.dump(told, file)


def run(name, step, scene):
    """Returns frames of positions, the number of steps, frames of velocities, and the CPU time of stepping (s)."""
    task = scene.json
    h, per_sample, samples = (task["run"][key] for key in ("step", "steps_per_sample", "samples"))
    x, v = (np.array(task["particles"][key], dtype=float) for key in ("x", "v"))
    shape, held = x.shape, np.array(task.get("pins", {}).get("particles", []), dtype=int)
    frames, speeds = [x.copy()], [v.copy()]
    start = time.process_time()
    with np.errstate(all="ignore"):  # overflows show in the frames, and need no warnings
        for i in range(samples * per_sample):
            scene.t = i * h
            answer = step(x, v, scene, h)
            if not isinstance(answer, tuple) or len(answer) != 2:
                sys.exit(f"{name}: expected a step to return (x, v), got {type(answer).__name__}")
            x, v = (np.array(part, dtype=float) for part in answer)
            for part, letter in ((x, "x"), (v, "v")):
                if part.shape != shape:
                    sys.exit(f"{name}: expected {letter} of shape {shape} from a step, got {part.shape}")
            if len(held):
                x[held], v[held] = scene.pins((i + 1) * h)
            if (i + 1) % per_sample == 0:
                frames.append(x.copy())
                speeds.append(v.copy())
    return np.array(frames), samples * per_sample, np.array(speeds), time.process_time() - start
