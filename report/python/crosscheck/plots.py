"""Plots of results with matplotlib, which is optional."""
import numpy as np

from .program import Error

# curves of the same colour differ in dash
colours = ("#111111", "#2A6FB0", "#D66A08", "#3A9A6A", "#A05AA8", "#8A8A8A")
dashes = ("-", "--", "-.", ":", (0, (8, 2, 2, 2)), (0, (3, 1, 1, 1, 1, 1)))


def pyplot():
    try:
        import matplotlib.pyplot
    except ImportError:
        raise Error("plots: matplotlib is not installed (Debian: python3-matplotlib; pip: matplotlib)") from None
    return matplotlib.pyplot


def look(i):
    """Look of curve i, from 0."""
    return {"color": colours[i % 6], "linestyle": dashes[(i + i // 6) % 6]}


def finish(axes, **words):
    axes.set(**words)
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False, fontsize="small")
    return axes


def axes_or_new(axes, **size):
    if axes is not None:
        return axes
    _, axes = pyplot().subplots(layout="constrained", **size)
    return axes


def short(method):
    """Shortens a program to its file name, for legends."""
    return method.rsplit("/", 1)[-1] if method.startswith("exec:") else str(method)


def is_plane(x):
    return bool(np.ptp(x[..., 2]) <= 1e-9 * max(np.ptp(x[..., 0]), np.ptp(x[..., 1])))


def projected(x, plane):
    """Coordinates in the picture, m: front view of a planar scene, otherwise from the right and above."""
    if plane:
        return x[..., :2]
    azimuth, height = np.radians(30), np.radians(20)
    right = np.array([np.cos(azimuth), 0, -np.sin(azimuth)])
    up = np.array([-np.sin(azimuth) * np.sin(height), np.cos(height), -np.cos(azimuth) * np.sin(height)])
    return np.stack([x @ right, x @ up], axis=-1)


def shapes(result, scene, axes, times):
    """Draws the springs of a run, one shade per time."""
    pyplot()
    from matplotlib.collections import LineCollection

    x = np.asarray(result.positions)
    x = x[np.isfinite(x).all(axis=(1, 2))]  # omits frames after the failure
    plane = is_plane(x)
    if times is None:
        frames = np.unique(np.linspace(0, len(x) - 1, 5).round().astype(int))
    else:
        frames = np.array([np.argmin(abs(result.times[:len(x)] - t)) for t in np.atleast_1d(times)])
    flat = projected(x[frames], plane)
    ends = [(s["a"], s["b"]) for term in scene["terms"] if term["type"] in ("springs", "constraints")
            for s in term["list"] if s.get("family") not in ("shear", "bend")]
    axes = axes_or_new(axes, figsize=(6.4, 4.8))
    if not ends:
        axes.plot(*np.moveaxis(projected(x, plane), 2, 0), color="0.8", linewidth=0.8)
    for i, frame in enumerate(frames):
        shade = str(0.75 - 0.75 * (i + 1) / len(frames))
        label = f"{result.times[frame]:.3g} s"
        if ends:
            axes.add_collection(LineCollection(flat[i][np.array(ends)], colors=shade, linewidths=0.8, label=label))
        if not ends or flat.shape[1] <= 30:
            axes.plot(*flat[i].T, "o", color=shade, markersize=3, label=None if ends else label)
    axes.set_aspect("equal", adjustable="datalim")
    axes.autoscale_view()
    return finish(axes, xlabel="x / m" if plane else "m, seen from 30° to the right and 20° above",
                  ylabel="y / m" if plane else "m", title=f"{result.scene} by {short(result.method)}")


def energies(result, axes):
    """Omits energies that are always zero."""
    table = result.energies
    if table is None:
        raise Error(f"plot: {result.scene} has no energies")
    axes = axes_or_new(axes, figsize=(6.4, 4))
    names = [n for n in table.dtype.names if table.units[n] == "J" and np.any(np.nan_to_num(table[n]) != 0)]
    for i, name in enumerate(names):
        axes.plot(table["t"], table[name], **look(i), label=name)
    return finish(axes, xlabel="t / s", ylabel="energy / J", title=f"{result.scene} by {short(result.method)}")


def over_time(comparison, axes):
    """Distances from the truth if there is one, otherwise from one of the methods."""
    table = comparison.over_time
    if table is None:
        raise Error("plot: no method has a result")
    known = np.any(np.isfinite(table["error"]))
    what = "error" if known else "difference"
    axes = axes_or_new(axes, figsize=(6.4, 4))
    for i, method in enumerate(dict.fromkeys(table["method"])):
        rows = table[table["method"] == method]
        y = np.where(rows[what] > 0, rows[what], np.nan)
        axes.semilogy(rows["t"], y, **look(i), label=short(method))
    return finish(axes, xlabel="t / s", ylabel=f"RMS position {what} / m", title=str(comparison.rows["scene"][0]))
