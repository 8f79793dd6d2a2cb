"""The commands of crosscheck as functions; they return objects with arrays and tables."""
import json
import os
import shutil
import tempfile
import weakref
from pathlib import Path

import numpy as np

from . import plots
from .engines import Engine
from .program import Error, answer, call
from .scene import scene_word
from .tables import escape, table


class Answer:
    """Result of a command: `folder` holds its files (a temporary folder lasts as long as this object)."""

    def __init__(self, out=None):
        self._temporary = tempfile.mkdtemp(prefix="crosscheck-")
        weakref.finalize(self, shutil.rmtree, self._temporary, ignore_errors=True)
        self.folder = Path(out) if out is not None else Path(self._temporary) / "out"

    def scene_word(self, scene):
        return scene_word(scene, self._temporary)

    def call(self, words, answers=(0,)):
        return call([*words, "--out", self.folder], answers)


def method_word(method):
    """Accepts a name, an Engine, or the path of a program."""
    if isinstance(method, Engine):
        return method.method
    return f"exec:{method}" if isinstance(method, os.PathLike) else str(method)


def method_words(methods):
    if isinstance(methods, (str, Engine, os.PathLike)):
        methods = [methods]
    return ",".join(method_word(method) for method in methods)


def option(name, value):
    return [] if value is None else [name, value]


class Result(Answer):
    """One run. Arrays are memory-mapped: data are read on first access.

    times       (frames,) s                      step         s, as used
    positions   (frames, particles, 3) m         cpu_seconds  s, CPU time of stepping alone
    velocities  the same shape, m/s, or None     verdict      "ok", "energy", "nan", "stretch", ...; `reason` says more
    energies    Table: t, kinetic, elastic, gravitational, drag, ... in J, or None in first-order scenes
    info        dict: the content of run.json (method, end, force_evaluations, remark, ...)
    """

    def __init__(self, scene, words, out):
        super().__init__(out)
        self._scene = self.scene_word(scene)
        self.call(["run", self._scene, *words])
        with open(self.folder / "run.json", encoding="utf-8") as file:
            self.info = json.load(file)
        self.scene, self.method = self.info["scene"], self.info["method"]
        self.verdict, self.reason = self.info["verdict"], self.info["reason"]
        self.step, self.cpu_seconds = self.info["step"], self.info["cpu_seconds"]
        self.times = np.array(self.info["times"])

    def _mapped(self, name):
        return np.load(self.folder / name, mmap_mode="r") if (self.folder / name).is_file() else None

    @property
    def positions(self):
        return self._mapped("trajectory.npy")

    @property
    def velocities(self):
        return self._mapped("velocities.npy")

    @property
    def energies(self):
        return table(self.folder / "energy.csv") if (self.folder / "energy.csv").is_file() else None

    def __repr__(self):
        return f"<{self.scene} by {self.method}: {self.verdict}, {len(self.times)} frames, step {self.step:.4g} s>"

    def plot(self, what="shape", axes=None, times=None):
        """Draws the run and returns the axes (matplotlib).

        what   "shape": the springs at five times, or at `times` (s); "energies": over time
        Raises Error if matplotlib is not installed."""
        if what == "shape":
            return plots.shapes(self, expanded(self._scene), axes, times)
        if what == "energies":
            return plots.energies(self, axes)
        raise Error(f"plot: expected \"shape\" or \"energies\", got {what!r}")


def run(scene, method=None, step=None, tol=None, duration=None, out=None):
    """Runs one method on a scene and returns a Result; a failed run is a Result too, with its verdict.

    scene     a shipped name, the path of a TOML file, or a Scene
    method    a name such as "leapfrog" or "bullet/pbd+n=10", an `@engine` function; None: the scene's own
    step      s, for fixed-step methods;  tol: relative tolerance, for adaptive ones;  duration: s
    out       folder for the files; None: a temporary one
    Raises Error if the scene or the method is invalid, or if the method refuses the scene.

    >>> r = run("chain", method="rk4", duration=0.1)
    >>> r
    <chain by mysim/rk4: ok, 6 frames, step 0.001 s>
    >>> r.positions.shape
    (6, 4, 3)
    >>> r.energies.units["kinetic"]
    'J'
    >>> run("chain", step=-1)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    crosscheck.Error: run: --step: expected a finite number above zero (s), as in 0.001, 1ms or 1/1000, got '-1' ...
    """
    words = [*option("--method", None if method is None else method_word(method)), *option("--step", step),
             *option("--tol", tol), *option("--duration", duration)]
    return Result(scene, words, out)


class Comparison(Answer):
    """Methods side by side on one scene.

    rows          Table, one row per method: verdict, largest error (m), step (s), ...
    cost          Table: CPU times (s)
    over_time     Table: error and difference (m) at the sampling times
    certificates  dict: method -> "match", "mismatch" or "not attested" (was it given the same scene?)
    agreed        False on a mismatch, if methods of the same rule differ by more than round-off, or if all failed
    text          printed output
    """

    def __init__(self, scene, words, out):
        super().__init__(out)
        status, self.text, said = self.call(["compare", self.scene_word(scene), *words], (0, 1))
        self.agreed = status == 0
        if not (self.folder / "engines.csv").is_file():
            raise Error(said)
        self.rows, self.cost = table(self.folder / "engines.csv"), table(self.folder / "engines-cost.csv")
        files = sorted(self.folder.glob("*-engines.csv"))
        self.over_time = table(files[0]) if files else None
        told = [json.loads(file.read_text(encoding="utf-8")) for file in sorted(self.folder.glob("certificate-*.json"))]
        self.certificates = {one["method"]: one["verdict"] for one in told}

    def _repr_html_(self):
        shown = ["method", "verdict", "largest error", "largest difference", "step", "evaluations"]
        return self.rows[shown]._repr_html_()

    def plot(self, axes=None):
        """Draws error or difference over time, one curve per method, and returns the axes (matplotlib)."""
        return plots.over_time(self, axes)


def compare(scene, methods=None, step=None, out=None):
    """Checks that methods run the same scene, and compares their results; returns a Comparison.

    >>> c = compare("chain", ["leapfrog", "bullet/deformable-explicit"])
    >>> c.agreed, c.certificates
    (True, {'bullet/deformable-explicit': 'match'})
    >>> bool(c.rows["largest error"][0] < 1e-5)  # m
    True
    """
    words = [*option("--methods", None if methods is None else method_words(methods)), *option("--step", step)]
    return Comparison(scene, words, out)


class Advice(Answer):
    """The cheapest method within a tolerance.

    method, step     recommended method and step (s); for an adaptive method step is None and `tol` its tolerance
    error            m, measured;  force_evaluations: cost of that run
    scene            file of the scene with the recommended settings: run(a.scene) runs it
    tried            Table: all runs
    found            False if no method meets the tolerance; then `reason` says why, and all others are None
    info             dict: content of advice.json
    """

    def __init__(self, scene, words, out):
        super().__init__(out)
        status, self.text, self.reason = self.call(["advise", self.scene_word(scene), *words], (0, 1))
        self.found, told, tried = status == 0, self.folder / "advice.json", self.folder / "advice.csv"
        self.info = json.loads(told.read_text(encoding="utf-8")) if told.is_file() else None
        self.tried = table(tried) if tried.is_file() else None
        advised = self.info["advised"] if self.found else {}
        self.method, self.error = advised.get("method"), advised.get("error")
        self.tol = advised.get("relative_tolerance")
        self.step = advised.get("step") if self.tol is None else None
        self.force_evaluations = advised.get("force_evaluations")
        self.scene = self.folder / "advice.toml" if self.found else None

    def __bool__(self):
        return self.found

    def __repr__(self):
        if not self.found:
            return f"<{self.reason}>"
        at = f"a step of {self.step:.4g} s" if self.step is not None else f"a tolerance of {self.tol:.4g}"
        return f"<{self.method} at {at}: error {self.error:.2g} m>"


def advise(scene, tolerance, methods=None, out=None):
    """Finds the cheapest method and step whose RMS position error stays within `tolerance` (m, or a fraction of
    the motion such as "1%"); returns an Advice.

    >>> advise("chain", tolerance=1e-3)
    <mysim/leapfrog at a step of 0.01 s: error 0.00083 m>
    """
    words = ["--tolerance", tolerance, *option("--methods", None if methods is None else method_words(methods))]
    return Advice(scene, words, out)


class Check:
    """Relations tested on methods.

    passed     False if a method violates a relation without a known reason, or if no relation applies
    relations  list of dicts: method, relation, says, scene, mark ("holds", "broken", ...), measured, tolerance, unit
    """

    def __init__(self, words):
        status, self.info = answer(words, (0, 1))
        self.passed, self.relations = status == 0, self.info["relations"]

    def __bool__(self):
        return self.passed

    def __repr__(self):
        marks = [row["mark"] for row in self.relations]
        counts = ", ".join(f"{marks.count(mark)} {mark}" for mark in sorted(set(marks), key=marks.index))
        return f"<{'passed' if self.passed else 'not passed'}: {counts}>"

    def _repr_html_(self):
        rows = "".join(f"<tr><td>{escape(r['method'])}</td><td>{escape(r['says'])}</td><td>{escape(r['scene'])}</td>"
                       f"<td>{escape(r['mark'])}</td></tr>" for r in self.relations)
        return f"<table><tr><th>method</th><th>relation</th><th>scene</th><th>mark</th></tr>{rows}</table>"


def check(methods, scenes=()):
    """Tests relations between runs of a method (symmetries, conservation, order), which need no truth. Returns a Check.

    scenes: by default the smallest scene of each relation.

    >>> check("leapfrog", "spring").passed
    True
    """
    if isinstance(methods, (str, Engine, os.PathLike)):
        methods = [methods]
    if isinstance(scenes, (str, dict, os.PathLike)):
        scenes = [scenes]
    with tempfile.TemporaryDirectory(prefix="crosscheck-") as folder:
        return Check(["check", *map(method_word, methods), *(scene_word(scene, folder) for scene in scenes)])


def experiment(name, scenes=(), methods=None, out=None, full=False):
    """Runs an experiment (see experiments()) and returns its tables: dict of name -> Table.

    `speed-accuracy` takes minutes; `order` and `stability` take seconds per scene."""
    place = Answer(out)
    scenes = [scenes] if isinstance(scenes, (str, dict, os.PathLike)) else scenes
    place.call(["experiment", name, *map(place.scene_word, scenes), "--full" if full else "--quick",
                *option("--methods", None if methods is None else method_words(methods))])
    return {file.stem: table(file) for file in sorted(place.folder.glob("*.csv"))}


class Page(type(Path())):
    """The path of a report's page; a notebook shows the page itself."""

    def _repr_html_(self):
        name = escape(os.path.relpath(self)).replace('"', "&quot;")
        return f'<a href="{name}">{name}</a><br><iframe src="{name}" width="100%" height="640"></iframe>'


def report(scenes=(), methods=None, out="out/report", full=False):
    """Makes the report of these scenes (default: a representative set), which takes minutes. Returns the path of
    its page, which a notebook shows. Its tables: table(page.parent / "data" / "engines.csv")."""
    scenes = [scenes] if isinstance(scenes, (str, dict, os.PathLike)) else scenes
    place = Answer(out)
    place.call(["report", *map(place.scene_word, scenes), "--full" if full else "--quick",
                *option("--methods", None if methods is None else method_words(methods))])
    return Page(place.folder / "index.html")


def listed(what):
    return {row["name"]: row["what"] for row in answer(["list", what])[1]}


def scenes():
    """The shipped scenes: dict of name -> the question that the scene answers."""
    return listed("scenes")


def methods():
    """The built-in methods: dict of name -> description. Any external program is a method, too: "exec:PATH".

    >>> "mysim/leapfrog" in methods()
    True
    """
    return listed("methods")


def experiments():
    """The experiments: dict of name -> the question that the experiment answers."""
    return listed("experiments")


copy_program = """#!/bin/sh
cp "$1" '{to}' && echo copied >&2
exit 3
"""


def expanded(scene):
    """The scene as engines receive it, with every particle and spring: the dict of scene.json
    (reference/protocol/PROTOCOL.md describes its keys).

    >>> expanded("chain")["particles"]["mass"]
    [0.1, 0.1, 0.1, 0.1]
    """
    with tempfile.TemporaryDirectory(prefix="crosscheck-") as folder:
        to, copier = Path(folder) / "scene.json", Path(folder) / "copier"
        copier.write_text(copy_program.format(to=to), encoding="utf-8")
        copier.chmod(0o700)
        try:
            call(["run", scene_word(scene, folder), "--method", f"exec:{copier}", "--out", Path(folder) / "out"])
        except Error:
            if not to.is_file():
                raise
        return json.loads(to.read_text(encoding="utf-8"))
