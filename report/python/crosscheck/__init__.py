"""Crosscheck from Python: runs, comparisons, advice and checks of mass-spring and cloth engines, as NumPy arrays.

    import crosscheck
    result = crosscheck.run("cloth-hang", method="leapfrog")
    result.plot()

Everything takes a scene by its name, as the path of a TOML file, or as a Scene built here, and a method by its name or
as an `@engine` function. SI units throughout. What the program complains of is an Error with its one line.
The program is found as `find_program` says; this package calls it and reads its files, and has nothing compiled.
"""
try:
    import numpy  # noqa: F401
except ImportError:
    raise ImportError("crosscheck needs NumPy: install python3-numpy (Debian), or numpy with pip") from None

from .commands import (advise, check, compare, expanded, experiment, experiments, methods, report,  # noqa: F401,E402
                       run, scenes)
from .engines import engine  # noqa: F401,E402
from .program import Error, find_program  # noqa: F401,E402
from .scene import Scene  # noqa: F401,E402
from .tables import table  # noqa: F401,E402

__all__ = ["Error", "Scene", "advise", "check", "compare", "engine", "expanded", "experiment", "experiments",
           "find_program", "methods", "report", "run", "scenes", "table"]
