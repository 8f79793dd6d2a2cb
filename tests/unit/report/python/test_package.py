"""The package crosscheck: `python3 -m unittest` in this folder, with the package in PYTHONPATH."""
import doctest
import importlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

import crosscheck
import crosscheck.program
import crosscheck.tables

package = pathlib.Path(os.environ["CROSSCHECK_PYTHON"])  # the folder that contains pyproject.toml
factor = 0.5


def small_scene():
    s = crosscheck.Scene("two", duration=0.2, step=1e-3, samples=10)
    a, b = s.particle([0, 0, 0], mass=1), s.particle(np.array([0.6, -0.8, 0]), mass=np.float64(0.5), velocity=[0, 0, 1])
    s.spring(a, b, stiffness=80, rest=0.9, dashpot=0.1)
    s.pin(a)
    s["gravity"] = {"acceleration": [0, -9.81, 0]}
    return s


class Documentation(unittest.TestCase):
    def test_examples_are_true(self):
        tried = 0
        for name in ("commands", "engines", "program", "scene", "tables"):
            result = doctest.testmod(importlib.import_module("crosscheck." + name))
            self.assertEqual(result.failed, 0, name)
            tried += result.attempted
        self.assertGreater(tried, 20)

    def test_everything_public_has_a_docstring(self):
        for name in crosscheck.__all__:
            self.assertTrue(getattr(crosscheck, name).__doc__, name)


class Tables(unittest.TestCase):
    def test_what_is_no_table_names_file_and_line(self):
        for text, said in (("", ":? expected a line of heads"),
                           ("a,b [m]\n", ":1: expected heads `name .unit.`, got 'a'"),
                           ("# c: d\na [m],b [s]\n1,2\n1\n", ":4: expected 2 cells, got 1")):
            with self.assertRaisesRegex(crosscheck.Error, "t.csv" + said):
                crosscheck.tables.table_of(text, "t.csv")

    def test_empty_cells_failed_rows_and_provenance(self):
        t = crosscheck.tables.table_of("# scene: chain abc: d\nname [1],x [m]\n\"a,b\",\nc,inf\nd,nan\n")
        self.assertEqual(t.provenance, {"scene": "chain abc: d"})
        self.assertEqual(list(t["name"]), ["a,b", "c", "d"])
        self.assertEqual(list(np.isnan(t["x"])), [True, False, True])
        self.assertEqual(t[1:].units, {"name": "1", "x": "m"})
        self.assertIn("<th>x / m</th>", t._repr_html_())
        self.assertEqual(len(crosscheck.tables.table_of("x [m]\n")), 0)

    def test_pandas_is_optional(self):
        t = crosscheck.tables.table_of("x [m]\n1\n")
        with mock.patch.dict(sys.modules, {"pandas": None}):
            with self.assertRaisesRegex(crosscheck.Error, "pandas is not installed .Debian: python3-pandas"):
                t.to_pandas()


class Runs(unittest.TestCase):
    def test_a_scene_of_python_moves_as_it_should(self):
        s = small_scene()
        s["time"]["method"] = "rk4"
        del s["spring"][0]["dashpot"]
        r = crosscheck.run(s)
        self.assertEqual((r.scene, r.method, r.verdict), ("two", "mysim/rk4", "ok"))
        self.assertEqual(r.positions.shape, (11, 2, 3))
        self.assertIsInstance(r.positions, np.memmap)
        self.assertIsInstance(r.velocities, np.memmap)
        self.assertEqual(len(r.times), 11)
        total = sum(r.energies[n] for n in ("kinetic", "elastic", "gravitational"))
        # in each of 200 steps, rk4 loses a fraction (h omega)^5 of the energy (about 10 J), with h omega = 0.013
        np.testing.assert_allclose(total, total[0], atol=1e-6)
        np.testing.assert_array_equal(r.positions[0], [[0, 0, 0], [0.6, -0.8, 0]])

    def test_what_is_read_is_what_was_written(self):
        with tempfile.TemporaryDirectory() as folder:
            s = small_scene()
            self.assertEqual(crosscheck.run(s.write(pathlib.Path(folder) / "two.toml")).info["scene_hash"],
                             crosscheck.run(s).info["scene_hash"])
            self.assertEqual(dict(crosscheck.Scene.read(pathlib.Path(folder) / "two.toml"))["spring"], s["spring"])
        self.assertEqual(crosscheck.run(crosscheck.Scene.read("chain"), duration=0.1).info["scene_hash"],
                         crosscheck.run("chain", duration=0.1).info["scene_hash"])

    def test_a_run_that_fails_is_a_result(self):
        r = crosscheck.run("chain", method="leapfrog", step=0.02)  # s; the limit is 0.0111 s
        self.assertEqual(r.verdict, "energy")
        self.assertLess(len(r.times), 151)
        self.assertEqual(len(r.positions), len(r.times))

    def test_errors_are_the_programs_one_line(self):
        wrong = small_scene()
        wrong["gravity"]["acceleraton"] = 1
        listed = small_scene()
        listed["gravity"]["acceleration"] = {1, 2}
        named = small_scene()
        named.name = "a b"
        for ask, said in ((lambda: crosscheck.run(wrong), r"two\.toml:\d+: gravity\.acceleraton: unknown key"),
                          (lambda: crosscheck.run(listed), "gravity.acceleration: expected a number, a text or a list"),
                          (lambda: crosscheck.run(named), "scene 'a b': expected a name of letters"),
                          (lambda: crosscheck.run("chain", method="rk"), "^unknown method 'rk'.*did you mean 'rk4'"),
                          (lambda: crosscheck.run("rod", method="rk4"), "cannot run rod: the scene has hard distances"),
                          (lambda: crosscheck.compare("chain", ["rk4"], step=-1), "--step: expected a finite number"),
                          (lambda: crosscheck.check("leapfrog", "nowhere.toml"), "nowhere.toml"),
                          (lambda: crosscheck.experiment("ordr"), "ordr"),
                          (lambda: crosscheck.report("chian"), "unknown scene 'chian'"),
                          (lambda: crosscheck.run("chain").plot("sound"), "expected \"shape\" or \"energies\"")):
            with self.assertRaisesRegex(crosscheck.Error, said) as caught:
                ask()
            self.assertEqual(str(caught.exception).count("\n"), 0)

    def test_a_comparison_is_a_table_in_a_notebook(self):
        html = crosscheck.compare("chain", ["rk4", "leapfrog"])._repr_html_()
        self.assertIn("<th>method</th><th>verdict</th><th>largest error / m</th>", html)
        self.assertIn("<td>mysim/rk4</td><td>ok</td><td>4.001e-09</td>", html)
        self.assertIn("<td>12000</td>", html)

    def test_advice_that_cannot_be_given_says_why(self):
        a = crosscheck.advise("chain", tolerance=1e-30, methods="leapfrog")
        self.assertFalse(a)
        self.assertRegex(a.reason, "no guaranteed advice for chain: .* 1e-30 m is requested")
        self.assertIsNone(a.method)

    def test_the_program_is_looked_for_in_a_stated_order(self):
        with mock.patch.object(crosscheck.program, "path", "/nowhere/crosscheck"):
            with self.assertRaisesRegex(crosscheck.Error, "^crosscheck.program.path: expected .*/nowhere/crosscheck"):
                crosscheck.run("chain")
        with mock.patch.dict(os.environ, {"CROSSCHECK": "/nowhere"}):
            with self.assertRaisesRegex(crosscheck.Error, "^the variable CROSSCHECK: expected the path"):
                crosscheck.run("chain")
        program = os.environ["CROSSCHECK"]
        with tempfile.TemporaryDirectory() as prefix:
            bin_folder = pathlib.Path(prefix, "bin")
            stands = pathlib.Path(prefix, "lib/python3/dist-packages/crosscheck/program.py")
            bin_folder.mkdir()
            (bin_folder / "crosscheck").symlink_to(program)
            with mock.patch.dict(os.environ), mock.patch.object(crosscheck.program, "__file__", str(stands)):
                del os.environ["CROSSCHECK"]
                self.assertEqual(crosscheck.find_program(), str(bin_folder / "crosscheck"))
                (bin_folder / "crosscheck").unlink()
                os.environ["PATH"] = prefix
                with self.assertRaisesRegex(crosscheck.Error, "not in PATH: set the variable CROSSCHECK"):
                    crosscheck.find_program()


class Engines(unittest.TestCase):
    def test_a_closure_is_the_rule_that_it_writes(self):
        def acceleration(x, v, scene):
            return scene.force(x, v) / scene.mass[:, None]

        @crosscheck.engine
        def euler(x, v, scene, h):
            v = v + factor * 2 * h * acceleration(x, v, scene)
            return x + h * v, v

        s = small_scene()
        s["drag"] = {"gamma": 0.5}
        s["pins"]["motion"] = {"amplitude": [0.1, 0, 0], "frequency": 1.0, "ramp": 0.1}
        mine, theirs = (crosscheck.run(s, method=m) for m in (euler, "symplectic-euler"))
        self.assertEqual(mine.verdict, "ok")
        # Only the summation order differs, which causes round-off of 1e-16 m in each of 200 steps.
        np.testing.assert_allclose(mine.positions, theirs.positions, atol=1e-12)
        self.assertEqual(mine.info["force_evaluations"], 200)
        link = crosscheck.Scene.read("chain-link")
        self.assertIn('law = "bullet-link"', link.toml())
        mine, theirs = (crosscheck.run(link, method=m, duration=0.1) for m in (euler, "symplectic-euler"))
        np.testing.assert_allclose(mine.positions, theirs.positions, atol=1e-12)

    def test_what_goes_wrong_has_its_reason(self):
        @crosscheck.engine(terms=["gravity"])
        def falls(x, v, scene, h):
            return x, v

        @crosscheck.engine
        def turned(x, v, scene, h):
            return x.T, v

        @crosscheck.engine
        def lost(x, v, scene, h):
            return x

        with self.assertRaisesRegex(crosscheck.Error, "falls has no dashpots, springs"):
            crosscheck.run(small_scene(), method=falls)
        with self.assertRaisesRegex(crosscheck.Error, "falls has no rotation"):
            crosscheck.run("circle", method=falls)
        falls.terms = ("springs", "gravity", "drag")
        with self.assertRaisesRegex(crosscheck.Error, "falls has no bullet-link"):
            crosscheck.run("chain-link", method=falls)
        for engine, said in ((turned, r"turned: expected x of shape \(2, 3\) from a step, got \(3, 2\)"),
                             (lost, r"lost: expected a step to return \(x, v\), got ndarray")):
            r = crosscheck.run(small_scene(), method=engine)
            self.assertEqual(r.verdict, "crash")
            self.assertRegex(r.reason, said)

    def test_what_cannot_be_handed_over_is_said_at_once(self):
        lock = open(os.devnull)
        self.addCleanup(lock.close)

        @crosscheck.engine
        def locked(x, v, scene, h):
            lock.read()
            return x, v

        with self.assertRaisesRegex(crosscheck.Error, "cannot be passed on: .*TextIOWrapper"):
            locked.path

    def test_a_saved_engine_is_a_program(self):
        @crosscheck.engine
        def still(x, v, scene, h):
            return x, v

        with tempfile.TemporaryDirectory() as folder:
            path = still.save(pathlib.Path(folder) / "still")
            words = ["run", "chain", "--duration", "0.04", "--method", f"exec:{path}", "--out", f"{folder}/out"]
            out = subprocess.run([os.environ["CROSSCHECK"], *words], cwd="/", env={"PATH": "/usr/bin:/bin"},
                                 capture_output=True, text=True)
            self.assertRegex(out.stdout, "^chain by exec:.*/still: froze", out.stderr)

    def test_the_numpy_engine_of_the_examples_goes_through_check(self):
        example = package / "examples" / "numpy_engine.py"
        lines = [line for line in example.read_text().splitlines() if line.strip()]
        self.assertLessEqual(len(lines), 25)
        with tempfile.TemporaryDirectory() as folder:
            s = small_scene()
            del s["spring"][0]["dashpot"]
            scene = s.write(pathlib.Path(folder) / "two.toml")
            out = subprocess.run([sys.executable, example, scene], capture_output=True, text=True)
        self.assertEqual(out.returncode, 0, out.stdout + out.stderr)
        self.assertRegex(out.stdout, r"^<passed: \d+ holds")


class Plots(unittest.TestCase):
    def test_without_matplotlib_the_package_is_named(self):
        r = crosscheck.run("chain", duration=0.1)
        with mock.patch.dict(sys.modules, {"matplotlib": None, "matplotlib.pyplot": None}):
            for what in ("shape", "energies"):
                with self.assertRaisesRegex(crosscheck.Error, "not installed .Debian: python3-matplotlib"):
                    r.plot(what)


class Drawn(unittest.TestCase):
    """Needs matplotlib."""

    def test_the_curves_hold_the_numbers(self):
        r = crosscheck.run("chain", duration=0.2)
        axes = r.plot("energies")
        drawn = {line.get_label(): line.get_ydata() for line in axes.lines}
        np.testing.assert_array_equal(drawn["kinetic"], r.energies["kinetic"])
        self.assertNotIn("wind work", drawn)
        self.assertEqual(axes.get_ylabel(), "energy / J")
        axes = r.plot(times=[0, 0.2])
        self.assertEqual([len(c.get_segments()) for c in axes.collections], [3, 3])
        np.testing.assert_allclose(axes.collections[1].get_segments()[2][1], r.positions[-1][3][:2])

    def test_the_notebook_runs_and_draws_the_main_chart(self):
        notebook = json.loads((package / "examples" / "speed-accuracy.ipynb").read_text(encoding="utf-8"))
        cells = ["".join(c["source"]) for c in notebook["cells"] if c["cell_type"] == "code"]
        self.assertTrue(all(not c["outputs"] for c in notebook["cells"] if c["cell_type"] == "code"))
        before, names = os.getcwd(), {}
        with tempfile.TemporaryDirectory() as folder:
            self.addCleanup(os.chdir, before)
            os.chdir(folder)
            for cell in cells:
                # run fewer methods, because this test is about the notebook, not about the measurement
                cell = cell.replace('"leapfrog", "rk4", "suzuki4", "implicit-midpoint", ', '"leapfrog", ')
                exec(compile(cell, "cell", "exec"), names)
            kept = os.environ.get("CROSSCHECK_KEPT_PICTURE")
            if kept:
                pathlib.Path(kept).write_bytes(pathlib.Path("speed-accuracy.png").read_bytes())
            self.assertGreater(pathlib.Path("speed-accuracy.png").stat().st_size, 10000)
            os.chdir(before)
        runs, axes = names["runs"], names["axes"]
        self.assertEqual(len(set(runs["method"])), 3)
        for line, method in zip((l for l in axes.lines if l.get_label() in set(runs["method"])), set(runs["method"])):
            good = (runs["method"] == line.get_label()) & (runs["verdict"] == "ok")
            np.testing.assert_array_equal(line.get_ydata(), runs["largest error"][good])
        self.assertEqual(axes.get_xscale() + axes.get_yscale(), "loglog")

    def test_the_readme_is_true(self):
        blocks = (package / "README.md").read_text(encoding="utf-8").split("```python\n")[1:]
        names = {}
        for block in blocks:
            exec(compile(block.split("```")[0], "README.md", "exec"), names)
        self.assertEqual(len(blocks), 3)
        self.assertEqual(crosscheck.run(names["s"]).verdict, "ok")
