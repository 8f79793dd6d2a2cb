"""Runs a part of a student's Python code: calls its functions on request, over descriptors 4 (in) and 5 (out).

python3 -I -B loader.py serve|import PART FUNCTIONS OFFICIAL FOLDER...
FUNCTIONS: names of the part's functions, separated by commas. OFFICIAL: earlier parts and their official functions, as
in "spring=spring_force;...". FOLDER: a folder of the student's modules; the part's folder comes first. `import` only
imports the part and reports the outcome on descriptor 3.

Tests, answers, f and official functions are in the process at the other end. remote.h describes the messages.
"""
import os
import sys

os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")  # each thread would reserve some of the limited memory

import importlib.machinery
import importlib.util
import linecache
import re
import tokenize  # some versions of linecache import it late, when the student's folders are on the path
import traceback
import types

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from drawing_stubs import DrawingFinder

del sys.modules["drawing_stubs"]  # the student may have a module with this name


class Remote:
    """A function of the process at the other end."""

    def __init__(self, name):
        self.__name__ = name

    def __call__(self, *values):
        send("call", self.__name__, *map(encoded, values))
        return reply()


class Official(types.ModuleType):
    """An earlier part: it has the official functions; all other names are those of the student's own file."""

    def __init__(self, name, functions):
        super().__init__(name)
        vars(self).update((function, Remote(function)) for function in functions)

    def __getattr__(self, name):
        if name.startswith("__") and name != "__all__":
            raise AttributeError(name)
        if "own" not in vars(self):
            spec = importlib.machinery.PathFinder.find_spec(self.__name__, folders)
            own = importlib.util.module_from_spec(spec) if spec else types.ModuleType(self.__name__)
            vars(self)["own"] = own
            if spec:
                spec.loader.exec_module(own)
            vars(own).update((key, value) for key, value in vars(self).items() if isinstance(value, Remote))
        own = vars(self)["own"]
        return [each for each in dir(own) if each[0] != "_"] if name == "__all__" else getattr(own, name)


lent = []  # functions of the student's that were passed to the other end


def encoded(value):
    """Returns a number, an array, an object or a function as words. Raises TypeError for anything else."""
    if callable(value):
        lent.append(value)
        return f"f {len(lent) - 1}"
    if isinstance(value, types.SimpleNamespace):
        return " ".join(["o", str(len(vars(value))), *(f"{key} {encoded(each)}" for key, each in vars(value).items())])
    if value is None or isinstance(value, (str, bytes, dict, set)) or np.iscomplexobj(value):
        raise TypeError(f"expected numbers, got {value if value is None else type(value).__name__}")
    array = np.asarray(value, dtype=float)
    return " ".join(["a", str(array.ndim), *map(str, array.shape), *map(float.hex, array.ravel().tolist())])


def decoded(kind, words):
    """Returns a value: `kind` is its first word, and `words` yields the others."""
    count = int(next(words))
    if kind == "f":
        return Remote(f"f{count}")
    if kind == "o":
        return types.SimpleNamespace(**{next(words): decoded(next(words), words) for _ in range(count)})
    shape = [int(next(words)) for _ in range(count)]
    numbers = [float.fromhex(next(words)) for _ in range(int(np.prod(shape)))]
    return np.array(numbers).reshape(shape) if shape else numbers[0]


def send(*words):
    line = (" ".join(words) + "\n").encode()
    while line:
        line = line[os.write(5, line):]


def reply():
    """Returns the other end's reply to our call. Until the reply arrives, serves calls of the other end."""
    while line := inbox.readline().decode():
        kind, *rest = line.split()
        words = iter(rest)
        if kind == "call":
            serve(next(words), words)
        elif kind == "return":
            return decoded(next(words), words)
        else:
            raise TypeError("the function does not take such arguments")
    os._exit(0)  # the other end has finished


def serve(name, words):
    """Calls a function of the student's, and sends its value and the arguments that it has changed."""
    values = [decoded(kind, words) for kind in words]
    before = [value.tobytes() if isinstance(value, np.ndarray) else None for value in values]
    function = functions[name] if name in functions else lent[int(name[1:])]
    try:
        result = function(*values)
    except BaseException as error:  # SystemExit, too
        return send("threw", told(error))
    try:
        changed = [f"changed {i} {encoded(value)}" for i, value in enumerate(values)
                   if before[i] is not None and value.tobytes() != before[i]]
        send("return", encoded(result), *changed)
    except BaseException as error:
        code = getattr(function, "__code__", None)
        place = f"{os.path.basename(code.co_filename)}, line {code.co_firstlineno}: " if code else ""
        what = f"{type(error).__name__}: {name} returned something unusable: {safely(str, error)}"
        send("threw", one_line(place + what))


def safely(function, *values):
    """Returns the text function(*values), or an empty text if it raises, as a student's __str__ may."""
    try:
        return function(*values)
    except BaseException:
        return ""


def told(error):
    """Describes an exception: file and line of the innermost call in the student's files, and the line's variables."""
    what = ": ".join(filter(None, (type(error).__name__, safely(str, error))))
    if isinstance(error, SyntaxError) and str(error.filename).startswith(tuple(folders)):
        return one_line(f"{os.path.basename(error.filename)}, line {error.lineno}: {type(error).__name__}: {error.msg}")
    calls = [(frame, line) for frame, line in traceback.walk_tb(error.__traceback__)
             if frame.f_code.co_filename.startswith(tuple(folders))]
    if not calls:
        return one_line(what)
    frame, line = calls[-1]
    file, values = frame.f_code.co_filename, ""
    for name in dict.fromkeys(re.findall(r"[A-Za-z_]\w*", linecache.getline(file, line))):
        values += safely(shown, name, frame.f_locals.get(name))
    return one_line(f"{os.path.basename(file)}, line {line}: {what}{values}")


def shown(name, value):
    """Describes a variable, if it is a number, a text or a list."""
    if not isinstance(value, (int, float, str, list, tuple, np.ndarray, np.generic)):
        return ""
    text = str(value) if isinstance(value, (np.ndarray, np.generic)) else repr(value)
    return f"; {name} = {text}" if len(text) <= 60 else f"; len({name}) = {len(value)}"


def one_line(text):
    return " ".join(text.split()).encode(errors="replace").decode()


def load():
    """Imports the part, and returns a dictionary of its functions by name."""
    module = importlib.import_module(part)
    return {name: getattr(module, name) for name in names if callable(getattr(module, name, None))}


def outcome():
    """Imports the part, and returns the outcome for the grader."""
    try:
        missing = [name for name in names if name not in load()]
        return f"undefined {missing[0]}" if missing else "good"
    except BaseException as error:
        module = isinstance(error, ModuleNotFoundError) and error.name
        return f"module {module}" if module else f"import {told(error)}"


mode, part, names, official, *folders = sys.argv[1:]
names = names.split(",")
# NumPy has been imported; other installed packages must not be
sys.path[:] = folders + [path for path in sys.path[1:] if not path.endswith("-packages")]
sys.meta_path.insert(0, DrawingFinder)
for earlier, _, theirs in (each.partition("=") for each in official.split(";") if each):
    sys.modules[earlier] = Official(earlier, theirs.split(","))
if mode == "import":
    os.write(3, (outcome() + "\n").encode())
    os._exit(0)
inbox = os.fdopen(4, "rb")
functions = load()
reply()
