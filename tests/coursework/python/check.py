"""Runs the public tests on your functions, and prints the expected numbers next to yours.

python3 check.py                all tests
python3 check.py 2 3.1          tests whose number begins with 2 or 3.1; the name of a part selects its tests
python3 check.py --lang zh      in another language

Only the grader finds causes of mistakes and runs hidden tests. Needs Python 3.8 or newer and NumPy.
"""
import os
import sys

HERE = os.path.dirname(os.path.realpath(__file__))
# main() adds the student's folder, so that a random.py in it does not replace the one that we and NumPy import
sys.path[:] = [os.path.join(HERE, "check")] + [path for path in sys.path if os.path.realpath(path) != HERE]

import argparse
import importlib
import math
import tokenize  # some versions of traceback import it late
import traceback

try:
    import numpy as np
except ModuleNotFoundError:
    sys.exit("check.py needs NumPy. Debian and Ubuntu: apt install python3-numpy; elsewhere: pip install numpy")
import calls
from drawing_stubs import DrawingFinder

del sys.modules["calls"], sys.modules["drawing_stubs"]  # the student may have modules with these names

MOST_SHOWN = 12  # numbers of a case that are printed


def reader(numbers):
    """Returns a function: take() returns the next number, take(2, 3) the next array of this shape."""
    rest = iter(numbers)

    def take(*shape):
        return np.array([next(rest) for _ in range(math.prod(shape))]).reshape(shape) if shape else next(rest)
    return take


def as_array(what, value, *shape):
    """Returns the value as an array of this shape; -1 stands for any length. Raises TypeError for anything else."""
    if value is None or isinstance(value, (str, bytes, dict, set)) or callable(value) or np.iscomplexobj(value):
        raise TypeError(f"{what}: expected numbers, got {value if value is None else type(value).__name__}")
    array = np.array(value, dtype=float)
    if array.ndim != len(shape) or any(wanted not in (-1, size) for wanted, size in zip(shape, array.shape)):
        wanted = str(shape).replace("-1", "n")
        raise TypeError(f"{what}: expected an array of shape {wanted}, got {array.shape}")
    return array


def student(part, name):
    return getattr(importlib.import_module(part), name)


def read_texts(language):
    texts = {}
    for name in ("common", "texts"):
        with open(os.path.join(HERE, "check", f"{name}.{language}.txt"), encoding="utf-8") as file:
            for paragraph in ("\n" + file.read()).split("\n[")[1:]:
                key, _, text = paragraph.partition("]\n")
                texts[key] = "\n".join(line for line in text.split("\n") if not line.startswith("#")).strip()
    return texts


def read_tests():
    """Returns the public tests and the number of hidden tests. Skips small cases, which only the C++ check uses."""
    tests, hidden, case = [], 0, {}
    with open(os.path.join(HERE, "check", "public_cases.txt"), encoding="utf-8") as file:
        for word, _, rest in (line.strip().partition(" ") for line in file):
            if word == "hidden":
                hidden = int(rest)
            elif word == "test":
                tests.append(dict(zip(("id", "part", "points"), rest.split()), cases=[]))
            elif word == "read":
                tests[-1][word] = rest
            elif word in ("case", "small"):
                case = {"call": rest}
                tests[-1]["cases"] += [case] if word == "case" else []
            else:
                case[word] = [float(each) for each in rest.split()[1:]] if word in ("in", "expected") else rest
    return [test for test in tests if test["cases"]], hidden


def wrong_numbers(case, got):
    return [i for i, (number, right) in enumerate(zip(got, case["expected"]))
            if not abs(number - right) <= float(case["tolerance"])]


def table(texts, case, got):
    """Expected numbers next to the student's, from the first row that differs."""
    expected, columns = case["expected"], int(case["columns"])
    name = texts.get("column." + case["column"], case["column"])
    if len(got) != len(expected):
        return texts["size"].format(len(expected), len(got))
    begin, end = (name.find("("), name.rfind(")")) if "(" in name else (len(name), len(name))
    numbered = [f"[{i}]" if columns > 1 else "" for i in range(columns)]
    items = name[begin + 1:end].split(", ") if begin < end else numbered
    wrong = wrong_numbers(case, got)
    first = max(0, min(wrong[0] - wrong[0] % columns, len(got) - MOST_SHOWN))
    lines = [f"{'':24} {texts['table.expected']:>20} {texts['table.got']:>20}"]
    for i in range(first, min(first + MOST_SHOWN, len(got))):
        item, number = items[i % columns % len(items)], str(i % columns // len(items))
        place = texts["place"].format(texts.get("row." + case["row"], case["row"]),
                                      int(texts.get(f"row.{case['row']}.first", 0)) + i // columns,
                                      name[:begin] + item + name[end + 1:].replace("#", number))
        lines.append(f"{place:24} {expected[i]:20.10g} {got[i]:20.10g}  {texts['table.differs'] if i in wrong else ''}")
    return "\n".join(line.rstrip() for line in lines)


def described(error):
    """Type and text of an exception, below the last of the student's lines that led to it."""
    try:
        text = str(error).encode(errors="replace").decode()
    except BaseException:  # raised by __str__ of the student's class
        text = ""
    places = [(call.filename, call.lineno, call.line) for call in traceback.extract_tb(error.__traceback__)]
    if isinstance(error, SyntaxError):
        places.append((str(error.filename), error.lineno, (error.text or "").strip()))
    ours = tuple(os.path.join(HERE, "check" + end) for end in (".py", os.sep))
    own = [f"{os.path.basename(file)}, line {line}: {code}\n" for file, line, code in places
           if file.startswith(HERE + os.sep) and not file.startswith(ours) and "-packages" not in file[len(HERE):]]
    return "".join(own[-1:]) + type(error).__name__ + (f": {text}" if text else "")


def run(test, texts):
    """Describes the first case that fails; returns an empty string if all cases pass."""
    for number, case in enumerate(test["cases"], 1):
        try:
            parts = calls.answer(case["call"], reader(case["in"]), student, as_array)
            got = [float(each) for part in parts for each in np.ravel(part)]
            if len(got) == len(case["expected"]) and not wrong_numbers(case, got):
                continue
            said = table(texts, case, got)
        except (Exception, SystemExit) as error:
            said = described(error)
        hint = texts.get(test["id"] + ".hint")
        return "\n".join([texts["which"].format(number, len(test["cases"])) + " " + case["call"], said,
                          *([texts["hint"].format(hint)] if hint else []), texts["read"].format(test["read"])])
    return ""


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--lang", default="en")
    options.add_argument("which", nargs="*", metavar="NUMBER_OR_PART")
    options = options.parse_args()
    sys.meta_path.insert(0, DrawingFinder)
    sys.path[0] = HERE
    not_yours = set(sys.modules)  # imported when the interpreter started, and by this file
    texts = read_texts(options.lang)
    tests, hidden = read_tests()
    tests = [test for test in tests if not options.which or test["part"] in options.which
             or test["id"].startswith(tuple(options.which))]
    earned, passed, part = 0, 0, ""
    for test in tests:
        if test["part"] != part:
            part = test["part"]
            print("\n" + texts.get(part + ".title", part))
        said = run(test, texts)
        points = 0 if said else int(test["points"])
        passed, earned = passed + (not said), earned + points
        verdict, title = texts["failed" if said else "passed"], texts.get(test["id"] + ".title", "")
        print(f"  {test['id']}   {verdict}   {title}  ({texts['points'].format(points, test['points'])})", flush=True)
        if said:
            print("\n".join("      " + line for line in said.split("\n")))
    print("\n" + texts["total"].format(earned, sum(int(test["points"]) for test in tests)))
    everything = passed == len(tests) and not options.which
    print(texts["public_done"].format(hidden) if everything else texts["public_now"].format(passed, len(tests), hidden))
    for name, module in list(sys.modules.items()):
        if name not in not_yours and "." not in name and "-packages" in str(getattr(module, "__file__", "")):
            print(f"The grader refuses the module {name}: use NumPy and the standard library.")
    return passed < len(tests)


if __name__ == "__main__":
    sys.exit(main())
