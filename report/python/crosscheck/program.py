"""Locates and calls the program; its error messages are raised as Error."""
import json
import os
import re
import shutil
import subprocess
from pathlib import Path

path = None
"""Path of the program, which you may set (`crosscheck.program.path = ...`); None: `find_program` searches for it."""


class Error(Exception):
    """The program's one-line error message; it names the file and the key."""

    __module__ = "crosscheck"  # the name that tracebacks show


def find_program():
    """Path of the program. Tries, in this order: `crosscheck.program.path`, the variable CROSSCHECK, the source tree
    of this package, the folder bin/ of the prefix that it was installed to, and PATH."""
    for where, named in (("crosscheck.program.path", path), ("the variable CROSSCHECK", os.environ.get("CROSSCHECK"))):
        if named:
            found = shutil.which(str(named))
            if found is None:
                raise Error(f"{where}: expected the path of the program crosscheck, got {named}")
            return os.path.abspath(found)
    here = Path(__file__).resolve().parents
    places = []
    if len(here) > 3 and (here[3] / "mysim").is_dir():
        places.append(here[3] / "crosscheck")
    places += [folder / "bin" / "crosscheck" for folder in here[2:5]]
    for place in places:
        if os.access(place, os.X_OK) and place.is_file():
            return str(place)
    found = shutil.which("crosscheck")
    if found is None:
        raise Error("the program crosscheck is not in PATH: set the variable CROSSCHECK to its path, "
                    "such as CROSSCHECK=/path/to/the/tree/crosscheck")
    return found


def call(words, answers=(0,)):
    """Runs the program with these words and returns (exit status, stdout, last error message).

    Raises Error for a status that is not in `answers`: 0 is done, 1 is a negative answer, 2 is bad use or bad input."""
    with subprocess.Popen([find_program(), *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, encoding="utf-8", errors="replace") as process:
        try:
            out, err = process.communicate()
        except BaseException:  # also for an interrupt in a notebook; files written so far stay valid
            process.terminate()
            raise
    lines = [line for line in (err.strip() or out.strip()).splitlines() if line.strip()]
    # progress messages are in brackets; an error message begins with the program's name
    complaints = [line for line in lines if line.startswith("crosscheck: ")] or lines
    said = re.sub(r"^crosscheck: ", "", complaints[-1]) if complaints else "no message"
    if process.returncode in answers:
        return process.returncode, out, said
    if process.returncode < 0 or process.returncode > 2:
        said = f"crosscheck {words[0]} ended with status {process.returncode}: {said}"
    raise Error(said)


def answer(words, answers=(0,)):
    """Calls with --json; returns (exit status, object)."""
    status, out, _ = call([*words, "--json"], answers)
    try:
        return status, json.loads(out)
    except ValueError:
        raise Error(f"crosscheck {' '.join(map(str, words))} --json printed no JSON: {out.strip()[:200]}") from None
