#!/usr/bin/env python3
"""Draws the rows of a benchmark (./bench --json) as SVG: time against error for each set, the scenes of a world, or motions.

usage: plot.py ROWS.json FOLDER
"""
import json
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "detent"  # the same drawing for the same rows
matplotlib.rcParams["svg.fonttype"] = "none"  # text as text
matplotlib.rcParams["font.size"] = 8
import matplotlib.pyplot as plt
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

from plot_motions import draw_motions
from plot_world import draw_world

FLOOR = 1e-9  # of size; smaller errors are drawn here
COLOURS = {"fx64": "tab:blue", "fx32": "tab:cyan", "f32": "tab:olive", "f64": "tab:green", "bullet-double": "tab:red",
           "bullet-float": "tab:orange", "fcl": "tab:purple"}
METHOD_COLOURS = [matplotlib.colormaps["tab20b"](i) for i in (0, 2, 3, 4, 6, 8, 10, 12, 14, 16, 18, 19)]  # beside the default
MARKERS = "os^vDP*Xph<>8d"


def error_of(row):
    """The worst error of the answers that are not plainly wrong, in units of size."""
    if "error_max" in row:
        return row["error_max"]
    return max(row["early_max"], row["late_max"])


def is_wrong(row):
    return row.get("fn", 0) + row.get("fp", 0) > 0 or row.get("late_max", 0) > 0


def drawn_of(rows):
    """The library's default in every configuration, its other methods in the first one alone (in the others their answers are the
    same but for their input's rounding), and all of the peers."""
    own = list(dict.fromkeys(row["config"] for row in rows if row["method"] == "default"))
    return [row for row in rows if row["config"] not in own or row["method"] == "default" or row["config"] == own[0]]


def colour_of(row, methods):
    of_config = COLOURS.get(row["config"], "black")
    if row["method"] == "default" or "default" not in methods.get(row["config"], ()):
        return of_config
    return METHOD_COLOURS[methods[row["config"]].index(row["method"]) % len(METHOD_COLOURS)]


def draw(name, rows, methods, path):
    """`methods`: those of each configuration, in the order of the file: so they look the same in every set."""
    figure, axes = plt.subplots(figsize=(9, 5.5))
    for row in sorted(drawn_of(rows), key=lambda row: row["ns_mean"]):
        colour = colour_of(row, methods)
        time = row["ns_mean"] / 1000
        label = f'{time:.3g} us  {row["config"]} {row["method"]}'
        if is_wrong(row):
            label += f' (FN {row["fn"]}, FP {row["fp"]}, late {row["late_max"]:.1g})'
        axes.errorbar([max(error_of(row), FLOOR)], [time], yerr=[[0], [max(row["ns_p99"] / 1000 - time, 0)]], color=colour,
                      marker=MARKERS[methods[row["config"]].index(row["method"]) % len(MARKERS)], linestyle="none",
                      linewidth=0.6, markerfacecolor="none" if is_wrong(row) else colour, label=label)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter(FormatStrFormatter("%g"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel("greatest error of an answer, of size (hollow: it also misses hits, reports false ones or is late)")
    axes.set_ylabel("time of a query, us: mean, and up to the 99th percentile")
    axes.set_title(f"Set {name}, {max(row['queries'] for row in rows)} queries")
    axes.grid(True, which="both", linewidth=0.2)
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=6, frameon=False)
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    rows = json.loads(Path(sys.argv[1]).read_text())
    folder = Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    if "scene" in rows[0]:
        draw_world(rows, folder)
        return
    if "motion" in rows[0]:
        draw_motions(rows, folder / "motions.svg")
        return
    methods = {}
    for row in rows:
        of_config = methods.setdefault(row["config"], [])
        if row["method"] not in of_config:
            of_config.append(row["method"])
    for name in dict.fromkeys(row["set"] for row in rows):
        of_set = [row for row in rows if row["set"] == name]
        kind = "distance" if "error_max" in of_set[0] else "toi"
        draw(name, of_set, methods, folder / f"{kind}-{re.sub('[^0-9a-z]+', '-', name)}.svg")


if __name__ == "__main__":
    main()
