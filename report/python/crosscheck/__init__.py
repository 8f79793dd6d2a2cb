"""Crosscheck from Python: runs, comparisons, advice and checks of mass-spring and cloth engines, as NumPy arrays.

    import crosscheck
    result = crosscheck.run("cloth-hang", method="leapfrog")
    result.plot()

Scenes are given by name, as the path of a TOML file, or as a Scene built here. Methods are given by name or as an
`@engine` function. SI units throughout. Errors of the program are raised as Error, with its one-line message.
`find_program` locates the program; this package calls it and reads its files, and contains no compiled code.
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
