#!/usr/bin/env python3
"""tests/bench/summary.py KIND ROWS.json: what ./bench KIND measured, in 20 lines at most.

A line a set or scene: the library's default in fx64 and f32 beside the fastest peer of the run; of other kinds the first rows.
"""
import json
import sys

LINES_MAX = 20


def show(head, lines):
    if len(lines) > LINES_MAX - 2:
        lines = lines[: LINES_MAX - 2] + [[f"... {len(lines) - LINES_MAX + 2} more in the table"]]
    rows = [head] + lines
    widths = [max(len(row[i]) for row in rows if i < len(row) and len(row) > 1) for i in range(len(head))]
    for row in rows:
        print("  ".join(cell.ljust(widths[i]) if i == 0 or len(row) == 1 else cell.rjust(widths[i]) for i, cell in enumerate(row)).rstrip())


def by(rows, *keys):
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return groups


def compared(rows, names, time, unit, own, wrong):
    """`names`: what tells lines apart; `own`(row): the library's; `wrong`: what a row counts as answered wrongly, if anything."""
    lines = []
    for key, group in by(rows, *names).items():
        of = ", ".join(part for part in key if part != "own")
        mine = {row["config"]: row for row in group if own(row)}
        peers = [row for row in group if not own(row) and row.get("method", "peer") not in METHODS]
        if not mine:
            continue
        fastest = min(peers, key=lambda row: row[time]) if peers else None
        line = [of] + [f"{mine[config][time] * unit:.2f}" if config in mine else "-" for config in ("fx64", "f32")]
        line += [f"{fastest[time] * unit:.2f}", fastest["config"] if "engine" not in fastest else f"{fastest['engine']} {fastest['config']}",
                 f"{mine.get('fx64', next(iter(mine.values())))[time] / fastest[time]:.2f}"] if fastest else ["-", "-", "-"]
        if wrong:
            line += [str(sum(row.get(key, 0) for key in wrong for row in mine.values())),
                     str(sum(fastest.get(key, 0) for key in wrong)) if fastest else "-"]
        lines.append(line)
    show([names[0], "fx64, us", "f32, us", "fastest peer, us", "which", "fx64 over it"] + (["wrong", "its wrong"] if wrong else []), lines)


METHODS = ("paper", "first_order", "second_order", "corotating", "world_space", "constant_angular_velocity", "mirtich", "baraff", "feature_pairs",
           "redon", "canny")


def main():
    kind, path = sys.argv[1:]
    with open(path) as file:
        rows = json.load(file)
    if kind in ("toi", "distance"):
        whole = [row for row in rows if " " not in row["set"]]  # the other rows are parts of these sets
        rows = whole or rows
        compared(rows, ("set",), "ns_mean", 1e-3, lambda row: row["method"] in ("default", "closest_points"), ("fn", "fp") if kind == "toi" else ())
    elif kind == "world":
        at_default = [row for row in rows if row.get("substeps", 0) == 0 and row.get("iterations", 0) == 0]
        compared(at_default, ("scene", "ground"), "us_median", 1.0, lambda row: row["engine"] == "detent", ())
    else:
        # A table of the rows of each kind: of those that have the same columns.
        tables = {}
        for row in rows:
            keys = tuple(key for key, value in row.items() if isinstance(value, (str, int, float)))[:8]
            tables.setdefault(keys, []).append(row)
        for keys, group in tables.items():
            show(list(keys), [[f"{row[key]:.3g}" if isinstance(row[key], float) else str(row[key]) for key in keys] for row in group])


main()
