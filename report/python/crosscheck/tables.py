"""Tables of crosscheck as structured arrays with units."""
import csv
import re
from pathlib import Path

import numpy as np

from .program import Error


class Table(np.ndarray):
    """A structured array with one field per column; a field has the column's name without its unit.

    units       dict: column -> unit, such as "m" or "s"; "1" for dimensionless columns
    provenance  dict: the file's provenance: command, commit, cpu, date, scene, ...

    Numbers are float64, nan for an empty cell (not applicable); all other columns are text.

    >>> t = table_of("method [1],error [m]\\nrk4,1e-6\\nbullet/pbd,\\n")
    >>> t["error"]
    array([1.e-06,    nan])
    >>> t.units["error"]
    'm'
    >>> str(t[t["method"] == "rk4"]["method"][0])
    'rk4'
    """

    def __array_finalize__(self, other):
        self.units = getattr(other, "units", {})
        self.provenance = getattr(other, "provenance", {})

    def __getitem__(self, key):
        part = super().__getitem__(key)
        return np.asarray(part) if isinstance(key, str) else part

    def to_pandas(self):
        """A pandas.DataFrame with heads `name [unit]`, as in the file; raises Error if pandas is not installed."""
        try:
            import pandas
        except ImportError:
            raise Error("to_pandas: pandas is not installed (Debian: python3-pandas; pip: pandas)") from None
        return pandas.DataFrame({f"{name} [{self.units[name]}]": self[name] for name in self.dtype.names})

    def _repr_html_(self):
        """HTML table with at most 40 rows."""
        if self.dtype.names is None or self.ndim != 1:
            return None

        def text(value):
            if isinstance(value, float):
                return f"{value:.0f}" if value.is_integer() and abs(value) < 1e15 else f"{value:.4g}"
            return escape(str(value))

        heads = "".join(f"<th>{escape(n)}{'' if self.units.get(n, '1') == '1' else f' / {escape(self.units[n])}'}</th>"
                        for n in self.dtype.names)
        rows = "".join("<tr>" + "".join(f"<td>{text(v)}</td>" for v in row) + "</tr>" for row in self[:40].tolist())
        more = f"<caption>the first 40 of {len(self)} rows</caption>" if len(self) > 40 else ""
        return f"<table>{more}<tr>{heads}</tr>{rows}</table>"


def escape(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def column(cells):
    """The cells as an array: float64 if all are numbers or empty, otherwise text."""
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells], dtype=float)
    except ValueError:
        return np.array(cells, dtype=str)


def table_of(text, name="table"):
    """Parses the text of a CSV file of crosscheck; raises Error with the line number if it is not a table."""
    lines = text.splitlines(keepends=True)
    count = next((i for i, line in enumerate(lines) if not line.startswith("#")), len(lines))
    provenance = dict(re.match(r"# ?([^:]*):? ?(.*)", line).groups() for line in lines[:count])
    rows = list(csv.reader(lines[count:]))
    if not rows:
        raise Error(f"{name}: expected a line of heads `name [unit]`, got none")
    heads = []
    for head in rows[0]:
        match = re.fullmatch(r"(.*) \[([^][]*)\]", head)
        if not match:
            raise Error(f"{name}:{count + 1}: expected heads `name [unit]`, got {head!r}")
        heads.append(match.groups())
    for i, row in enumerate(rows[1:]):
        if len(row) != len(heads):
            raise Error(f"{name}:{count + 2 + i}: expected {len(heads)} cells, got {len(row)}")
    columns = [column(cells) for cells in zip(*rows[1:])] if len(rows) > 1 else [np.empty(0) for _ in heads]
    names = [n for n, _ in heads]
    if len(set(names)) < len(names):  # a quantity occurs in two units
        names = rows[0]
    out = np.empty(len(rows) - 1, dtype=[(n, c.dtype) for n, c in zip(names, columns)]).view(Table)
    for n, c in zip(names, columns):
        out[n] = c
    out.units, out.provenance = dict(zip(names, (unit for _, unit in heads))), provenance
    return out


def table(path):
    """Reads a CSV file that crosscheck wrote, such as data/*.csv of a report; raises Error if it is not a table.

    >>> table("nowhere.csv")
    Traceback (most recent call last):
    crosscheck.Error: nowhere.csv: no such file
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise Error(f"{path}: no such file") from None
    except (OSError, UnicodeDecodeError) as error:
        raise Error(f"{path}: {error}") from None
    return table_of(text, str(path))
