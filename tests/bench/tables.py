#!/usr/bin/env python3
"""The tables of docs that show the rows of docs/bench/*.json.

usage: tables.py [--write] [ROOT]

Compares them, or writes them anew. A table begins after a line <!-- tables.py NAME --> and ends at the next empty line; what has
no row is -. Exit code 0 only if all tables are those of the rows, or were written.
"""
import json
import re
import sys
from pathlib import Path

PAGES = ["docs/bench/README.md", "docs/bench/worlds.md", "docs/bench/web.md", "docs/toi_methods.md"]
MARK = re.compile(r"<!-- tables\.py (\w+) -->\n\n(.*?\n)\n", re.DOTALL)

BULLET_TURNING, BULLET_LINEAR = "btContinuousConvexCollision", "btSubsimplexConvexCast"
TOI_SETS = [
    ("1 mixed, turning", "1 rotating"), ("1 mixed, linear", "1 linear"), ("2 paper, linear", "2"),
    ("3 rods, 0.5 to 3 rad", "3"), ("4 grazing, turning", "4 rotating"), ("4 grazing, linear", "4 linear"),
    ("5 at 1 and 10 km, turning", "5 rotating"), ("6 of 1 mm, 100 m, 1:1000, turning", "6 rotating"),
    ("7 starting close, turning", "7 rotating"), ("8 hulls, turning", "8 rotating"), ("8 hulls, linear", "8 linear"),
    ("9 rods, 3.2 to 12 rad", "9"), ("11 triangles, turning", "11 rotating"), ("11 triangles, linear", "11 linear"),
    ("game hulls, turning", "game rotating"), ("1c with cylinders and cones, turning", "1c rotating"),
    ("3c rods, cylinders and cones", "3c"),
]
METHODS = ["paper", "first_order", "second_order", "corotating", "world_space", "constant_angular_velocity", "mirtich", "baraff",
           "feature_pairs", "redon", "canny"]
POLYTOPE_SETS = [
    ("1 turning", "1 rotating polytopes"), ("1 linear", "1 linear polytopes"), ("3", "3 rotating polytopes"),
    ("9", "9 rotating polytopes"), ("8 turning", "8 rotating"), ("8 linear", "8 linear"), ("11 turning", "11 rotating"),
    ("11 linear", "11 linear"),
]


def number(value):
    return f"{value:.2f}" if value < 10 else f"{value:.1f}"


def micro(row):
    return ", ".join(number(row[key] / 1000) for key in ("ns_mean", "ns_p99", "ns_max"))


def small(value):
    return "0" if value == 0 else f"{value:.1e}"


def worst(row):
    return small(max(row["early_max"], row["late_max"]))


def table(head, lines):
    shown = ["| " + " | ".join(line) + " |" for line in [head] + lines]
    return "\n".join([shown[0], "|" + "---|" * len(head)] + shown[1:]) + "\n"


class Rows:
    def __init__(self, path):
        self.rows = {(row["set"], row["method"], row["config"]): row for row in json.loads(path.read_text())}

    def get(self, of_set, method, config="fx64"):
        return self.rows.get((of_set, method, config))


def toi(rows):
    head = ["set", "hits", "Detent `fx64`, us: mean, p99, max", "GJK calls: mean, max", "missed, false, late", "early, of size",
            "Bullet (double): us", "missed, false", "early", "ratio: mean, p99"]
    lines = []
    for name, of_set in TOI_SETS:
        own = rows.get(of_set, "default")
        turns = rows.get(of_set, BULLET_LINEAR, "bullet-double") is None
        bullet = rows.get(of_set, BULLET_TURNING if turns else BULLET_LINEAR, "bullet-double")
        if own is None or bullet is None:
            continue
        lines.append([name, str(own["hits"]), micro(own), f'{own["gjk_mean"]:.2f}, {own["gjk_max"]:.0f}',
                      f'{own["fn"]}, {own["fp"]}, {small(own["late_max"])}', small(own["early_max"]),
                      number(bullet["ns_mean"] / 1000), f'{bullet["fn"]}, {bullet["fp"]}', small(bullet["early_max"]),
                      ", ".join(f"{own[key] / bullet[key]:.2f}" for key in ("ns_mean", "ns_p99"))])
    return table(head, lines)


def methods(rows):
    """Of every shape, on the rods."""
    lines = []
    for method in METHODS:
        pair = [rows.get(of_set, method) for of_set in ("3", "9")]
        if None not in pair:
            lines.append([f"`{method}`", ", ".join(f'{row["gjk_mean"]:.1f}' for row in pair),
                          ", ".join(number(row["ns_mean"] / 1000) for row in pair), ", ".join(str(row["fn"]) for row in pair)])
    return table(["method, set 3 and 9", "GJK calls", "us", "missed"], lines)


def by_polytopes(rows, cell):
    lines = [[f"`{method}`"] + [cell(row) if row else "-" for row in (rows.get(of_set, method) for _, of_set in POLYTOPE_SETS)]
             for method in METHODS]
    return table(["method"] + [name for name, _ in POLYTOPE_SETS], lines)


def methods_time(rows):
    return by_polytopes(rows, lambda row: ", ".join(number(row[key] / 1000) for key in ("ns_mean", "ns_p99")))


def methods_wrong(rows):
    def cell(row):
        wrong = [row["fn"], row["fp"]]
        return f'{wrong[0]}, {wrong[1]}, {small(row["late_max"])}' if any(wrong) or row["late_max"] else "0"
    return by_polytopes(rows, cell)


def methods_early(rows):
    return by_polytopes(rows, lambda row: small(row["early_max"]))


def triangles(rows):
    lines = []
    for name, of_set in (("11, turning", "11 rotating"), ("11, linear", "11 linear")):
        pair = [rows.get(of_set, method) for method in ("constant_angular_velocity", "feature_pairs")]
        known = None not in pair
        lines.append([name] + [micro(row) if row else "-" for row in pair] +
                     [", ".join(f"{pair[1][key] / pair[0][key]:.1f}" for key in ("ns_mean", "ns_p99")) if known else "-"])
    return table(["set", "`constant_angular_velocity`, us: mean, p99, max", "`feature_pairs`", "times as long: mean, p99"], lines)


def distance(rows):
    lines = []
    for of_set in ("1", "6", "7", "8", "10", "game"):
        own, bullet = rows.get(of_set, "closest_points"), rows.get(of_set, "btGjkPairDetector", "bullet-double")
        if own and bullet:
            lines.append([of_set, ", ".join(f"{own[key]:.0f}" for key in ("ns_mean", "ns_p99", "ns_max")), small(own["error_max"]),
                          f'{bullet["ns_mean"]:.0f}', small(bullet["error_max"]), f'{own["ns_mean"] / bullet["ns_mean"]:.2f}'])
    return table(["set", "Detent `fx64`, ns: mean, p99, max", "error, of size", "Bullet (double), ns", "error", "ratio"], lines)


WHOLE_STEP = [("`fx64`", "fx64"), ("`f32`", "f32"), ("Bullet double", "bullet double"), ("Bullet float", "bullet float"),
              ("ODE double", "ode double")]
STUDIED = [entry for entry in WHOLE_STEP if entry[1] != "bullet float"]


class StepRows:
    """Rows of whole steps, by scene, ground and engine; of a study those at each engine's default, and all settings beside."""

    def __init__(self, path):
        self.rows, self.settings = {}, {}
        for row in json.loads(path.read_text()):
            name = row["config"] if row["engine"] == "detent" else f'{row["engine"]} {row["config"]}'
            key = (row["scene"], row["ground"])
            if not row.get("substeps") and not row.get("iterations"):
                self.rows.setdefault(key, {})[name] = row
            self.settings.setdefault(key, {}).setdefault(name, []).append(row)


def three(value):
    return f"{value:.3g}" if value < 100 else f"{value:,.0f}"


def ratio(row, other):
    value = row["us_median"] / other["us_median"]
    return f"{value:.2f}" if value >= 0.01 else f"{value:.0e}"


def world(rows):
    lines = []
    for (scene, ground), of in rows.rows.items():
        bullet = of["bullet double"]
        lines.append([scene, ground] + [", ".join(three(of[name][key]) for key in ("us_median", "us_p99", "us_max")) for _, name in WHOLE_STEP] +
                     [", ".join(ratio(of[name], bullet) for name in ("fx64", "f32", "ode double"))])
    return table(["scene", "ground"] + [title for title, _ in WHOLE_STEP] + ["`fx64`, `f32`, ODE / Bullet"], lines)


def world_stages(rows):
    stages = next(list(of["fx64"]["stages"]) for of in rows.rows.values() if "stages" in of["fx64"])
    return table(["scene", "ground"] + [f"`{stage}`" for stage in stages],
                 [[scene, ground] + [f'{100 * of["fx64"]["stages"][stage]:.0f}' for stage in stages]
                  for (scene, ground), of in rows.rows.items() if "stages" in of["fx64"]])


def study(rows):
    lines = []
    for (scene, _), of in rows.rows.items():
        known = 1e3 * of["fx64"]["measures"]["reference"]
        lines.append([scene] + [f'{three(of[name]["us_median"])}, {three(1e3 * of[name]["measures"]["error"])}' for _, name in STUDIED] +
                     [f"{known:.2g}" if known else "exact"])
    return table(["scene"] + [f"{title}: us, mm" for title, _ in STUDIED] + ["known to, mm"], lines)


def study_equal(rows):
    """The fastest setting whose error is no greater than that of fx64 at its default."""
    lines = []
    for (scene, ground), of in rows.rows.items():
        bound = of["fx64"]["measures"]["error"] * 1.01
        cells = []
        for _, name in STUDIED:
            good = [row for row in rows.settings[scene, ground][name] if row["measures"]["error"] <= bound]
            if not good:
                cells.append("-")
                continue
            best = min(good, key=lambda row: row["us_median"])
            if abs(best["us_median"] / of[name]["us_median"] - 1) < 0.1 and of[name] in good:
                best = of[name]  # the same setting, named otherwise
            setting = (f'{best["substeps"]} substeps' if best["substeps"] else
                       f'{best["iterations"]} iterations' if best["iterations"] else "default")
            cells.append(f'{three(best["us_median"])} ({setting})')
        lines.append([scene, three(bound / 1.01 * 1e3)] + cells)
    return table(["scene", "error, mm"] + [title for title, _ in STUDIED], lines)


def growth(rows):
    titles = [entry for entry in STUDIED if any(entry[1] in of for of in rows.rows.values())]
    lines = {}
    for (scene, _), of in rows.rows.items():
        falling = scene.endswith("-falling")
        line = lines.setdefault(scene.removesuffix("-falling"), {})
        line[falling] = [f'{of["fx64"]["bodies"]:,}'] + [f'{1e3 * of[name]["us_median"] / of[name]["bodies"]:,.0f}' for _, name in titles]
    return table(["bodies"] + [f"{title}, {part}" for part in ("falling", "heap") for title, _ in titles],
                 [line[True] + line[False][1:] for line in lines.values()])


def named(row):
    return f'{row["bodies"]}, `{row["config"]}`'


def kilobytes(count):
    return f"{count / 1e3:,.1f}" if count < 1e5 else f"{count / 1e3:,.0f}"


def worlds_memory(rows):
    return table(["bodies", "awake", "world, KB", "snapshot, KB", "difference, KB", "1,000 worlds, MB", "1,000 differences, MB"],
                 [[named(row), f'{row["awake"]:.0f}'] + [kilobytes(row[key]) for key in ("world_bytes", "snapshot_bytes", "difference_bytes")] +
                  [f'{row[key] / 1e3:.1f}' for key in ("world_bytes", "difference_bytes")] for row in rows])


def worlds_start(rows):
    return table(["bodies", "create, us", "60 ticks, us", "restore, us", "times as fast", "difference: write, restore, us", "tree from the root / by edges"],
                 [[named(row), three(row["create_us"]), three(row["simulate_us"]), three(row["restore_us"]),
                   f'{row["simulate_us"] / row["restore_us"]:,.0f}', f'{three(row["difference_us"])}, {three(row["undo_us"])}',
                   f'{row["tree_from_root_us"] / row["tree_us"]:.2f}'] for row in rows])


def worlds_steps(rows):
    head = [f'{step["threads"]} thread{"s" if step["threads"] > 1 else ""}, {step["alive"]:,}' for step in rows[0]["steps"]]
    return table(["bodies", "ticks"] + head,
                 [[named(row), str(row["ticks"])] + [f'{step["ticks_per_cpu_second"]:,.0f}' for step in row["steps"]] for row in rows])


def worlds_verify(rows):
    jobs = [one["jobs"] for one in rows[0]["verify"]]
    cell = lambda all: [f'{one["matches_per_cpu_second"]:.1f}' for one in all] or ["-"] * len(jobs)
    ticks = lambda row: row["match_ticks"] * row["verify"][0]["matches_per_cpu_second"]
    return table(["bodies", "ticks of a match", "recording, KB", "ticks", "worlds at 60 Hz"] + [f'{job} thread{"s" if job > 1 else ""}' for job in jobs] +
                 [f'{job} process{"es" if job > 1 else ""}' for job in jobs],
                 [[named(row), str(row["match_ticks"]), kilobytes(row["recording_bytes"]), f"{ticks(row):,.0f}", f"{ticks(row) / 60:,.0f}"] + cell(row["verify"]) + cell(row["tool"])
                  for row in rows])


WEB = ["fx64", "f32", "fx64.small", "f32.small", "rapier", "rapier-simd", "jolt"]


def by_scene(rows):
    scenes = {}
    for row in rows:
        scenes.setdefault(row["scene"], {})[row["engine"]] = row
    return scenes


def web(rows):
    return table(["scene", "bodies"] + [f"`{name}`" for name in WEB],
                 [[scene, str(of["fx64"]["bodies"])] + [f'{three(of[name]["us_median"])}, {three(of[name]["us_p99"])}' for name in WEB]
                  for scene, of in by_scene(rows).items()])


def web_ratios(rows):
    return table(["scene"] + [f"`{own}` / {peer}" for peer in ("Rapier", "Rapier SIMD", "Jolt") for own in ("fx64", "f32")],
                 [[scene] + [ratio(of[own], of[peer]) for peer in ("rapier", "rapier-simd", "jolt") for own in ("fx64", "f32")]
                  for scene, of in by_scene(rows).items()])


def web_errors(rows):
    names = ["fx64", "f32", "rapier", "rapier-simd", "jolt"]  # the small modules have the same results
    lines = []
    for scene, of in by_scene(rows).items():
        for error in of["fx64"]["errors"]:
            line = [error] + [f'{of[name]["errors"][error]:.3g}' for name in names]
            if not lines or [scene.split(",")[0]] + line not in lines:
                lines.append([scene.split(",")[0]] + line)
    return table(["scene", "error"] + [f"`{name}`" for name in names], lines)


SOURCES = {"worlds": lambda path: json.loads(path.read_text()), "web": lambda path: json.loads(path.read_text()), "toi": Rows, "distance": Rows, "world": StepRows, "world-study": StepRows, "world-growth": StepRows}
TABLES = {make.__name__: (make, source) for make, source in
          [(toi, "toi"), (methods, "toi"), (methods_time, "toi"), (methods_wrong, "toi"), (methods_early, "toi"),
           (triangles, "toi"), (distance, "distance"), (world, "world"), (world_stages, "world"), (study, "world-study"),
           (study_equal, "world-study"), (growth, "world-growth"), (worlds_memory, "worlds"), (worlds_start, "worlds"),
           (worlds_steps, "worlds"), (worlds_verify, "worlds"), (web, "web"), (web_ratios, "web"), (web_errors, "web")]}


def main():
    arguments = sys.argv[1:]
    write = "--write" in arguments
    if write:
        arguments.remove("--write")
    if len(arguments) > 1 or any(argument.startswith("-") for argument in arguments):
        sys.exit(__doc__)
    root = Path(arguments[0]) if arguments else Path(__file__).parents[2]
    rows = {}  # read where a page shows them
    count, faults = 0, []
    for page in PAGES:
        path = root / page
        text = path.read_text() if path.exists() else ""

        def renewed(match):
            nonlocal count
            make, source = TABLES[match[1]]
            if source not in rows:
                rows[source] = SOURCES[source](root / "docs/bench" / f"{source}.json")
            made = make(rows[source])
            count += 1
            if made != match[2]:
                shown = set(match[2].splitlines())
                missing = [line for line in made.splitlines() if line not in shown]
                faults.append(f"{page}, {match[1]}: the rows say\n" + "\n".join(missing))
            return f"<!-- tables.py {match[1]} -->\n\n{made}\n"

        new = MARK.sub(renewed, text)
        if len(MARK.findall(text)) != text.count("<!-- tables.py"):
            faults.append(f"{page}: a table has no empty line before or after it, or no line")
        if write and new != text:
            path.write_text(new)
    print(f"{count} tables, {len(faults)} stale")
    if write:
        return
    if faults or count == 0:
        sys.exit("\n".join(faults + ["tests/bench/tables.py --write writes them anew"]))


if __name__ == "__main__":
    main()
