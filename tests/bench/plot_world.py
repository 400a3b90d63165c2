"""Draws the rows of `./bench world --json`: times of the scenes, of a study time against error, and the growth with the bodies."""
import matplotlib.pyplot as plt

COLOURS = {"fx64": "tab:blue", "f32": "tab:olive", "f64": "tab:green", "fx32": "tab:cyan", "bullet double": "tab:red",
           "bullet float": "tab:orange", "ode double": "tab:purple"}
MEASURES = {"error": "error of the motion, m", "penetration_mean": "mean penetration of overlapping pairs, m", "drift": "greatest drift, m",
            "stretch_max": "stretch at most, of the length", "stretch_late": "stretch late, of the length",
            "energy": "energy gained or lost, J/kg", "speed_mean": "mean speed, m/s"}
FLOOR = 1e-7  # smaller errors are drawn here
SHADES = {"half-space": 0.55, "box": 1.0, "own": 1.0}


def name_of(row):
    return row["config"] if row["engine"] == "detent" else f'{row["engine"]} {row["config"]}'


def grid_of(count, width, height):
    columns = min(3, count)
    figure, grid = plt.subplots(-(-count // columns), columns, squeeze=False, layout="constrained",
                                figsize=(width * columns, height * -(-count // columns)))
    for axes in grid.flat[count:]:
        axes.set_visible(False)
    return figure, grid


def save(figure, path):
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)


def draw_scenes(rows, path):
    """A panel for each scene: bars of the median, whiskers up to the 99th percentile; a pair of bars for two grounds."""
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    figure, grid = grid_of(len(scenes), 3.6, 2.9)
    for axes, scene in zip(grid.flat, scenes):
        of_scene = [row for row in rows if row["scene"] == scene]
        names = [name for name in COLOURS if any(name_of(row) == name for row in of_scene)]
        grounds = list(dict.fromkeys(row["ground"] for row in of_scene))
        reference = {row["ground"]: row["us_median"] for row in of_scene if name_of(row) == "bullet double"}
        top = max(row["us_p99"] for row in of_scene)
        logarithmic = top > 50 * min(row["us_median"] for row in of_scene)
        width = 0.8 / len(grounds)
        for row in of_scene:
            x = names.index(name_of(row)) + (grounds.index(row["ground"]) - (len(grounds) - 1) / 2) * width
            median = row["us_median"]
            axes.bar(x, median, color=COLOURS[name_of(row)], alpha=SHADES[row["ground"]], width=width)
            axes.errorbar(x, median, yerr=[[0], [row["us_p99"] - median]], color="black", linewidth=0.7, capsize=1.5)
            if row["ground"] != grounds[-1]:
                continue
            text = f'{median:.3g}' if median < 1000 else f'{median:.0f}'
            if row["ground"] in reference:
                ratio = median / reference[row["ground"]]
                text += f'\n{ratio:.2f}x' if ratio >= 0.01 else f'\n1/{1 / ratio:.0f}'
            highest = max(other["us_p99"] for other in of_scene if name_of(other) == name_of(row))
            axes.annotate(text, (names.index(name_of(row)), highest), (0, 2), textcoords="offset points", ha="center", va="bottom", fontsize=6)
        if logarithmic:
            axes.set_yscale("log")
        axes.set_ylim(top=top * (20 if logarithmic else 1.2))
        axes.set_xticks(range(len(names)), [name.replace(" ", "\n") for name in names], fontsize=6)
        axes.set_title(scene + (" (pale: on a half-space; figures: on a box)" if len(grounds) > 1 else ""), fontsize=7)
        axes.grid(True, axis="y", linewidth=0.2)
        axes.set_axisbelow(True)
    for axes in grid[:, 0]:
        axes.set_ylabel("us a step: median, up to p99")
    save(figure, path)


def knob_of(row):
    return next((knob for knob in ("substeps", "iterations", "penetration") if row[knob]), "default")


KNOBS = {"default": ("*", "none"), "substeps": ("o", "-"), "iterations": ("s", "--"), "penetration": ("d", ":")}


def draw_study(scene, rows, path):
    """A panel for each error: a line for each configuration and knob."""
    measures = [measure for measure in MEASURES if measure in rows[0]["measures"]]
    figure, grid = plt.subplots(-(-len(measures) // 2), min(2, len(measures)), squeeze=False, layout="constrained", sharey=True,
                                figsize=(5.5 * min(2, len(measures)), 4 * -(-len(measures) // 2)))
    for axes in grid.flat[len(measures):]:
        axes.set_visible(False)
    labels = {}
    for axes, measure in zip(grid.flat, measures):
        lines = {}
        for row in rows:
            lines.setdefault((name_of(row), knob_of(row)), []).append(row)
        for (name, knob), points in lines.items():
            points.sort(key=lambda row: row.get(knob, 0))
            x = [max(abs(row["measures"][measure]), FLOOR) for row in points]
            y = [row["us_median"] for row in points]
            marker, style = KNOBS[knob]
            default = knob == "default"
            line, = axes.plot(x, y, color=COLOURS.get(name, "black"), marker=marker, linestyle=style, linewidth=0.8,
                              markersize=11 if default else 3.5, markeredgecolor="black" if default else None,
                              markeredgewidth=0.5, zorder=3 if default else 2)
            labels.setdefault(f"{name}, {knob}", line)
            if name in ("fx64", "bullet double", "ode double") and not default:
                for row, at in zip(points, zip(x, y)):
                    axes.annotate(f"1/{row[knob]}" if knob == "penetration" else str(row[knob]), at, (3, 3), textcoords="offset points",
                                  fontsize=6, color=COLOURS[name])
        if measure == "error" and rows[0]["measures"].get("reference", 0) > FLOOR:
            axes.axvline(rows[0]["measures"]["reference"], color="black", linewidth=0.7, linestyle=":")
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel(MEASURES[measure])
        axes.grid(True, which="both", linewidth=0.2)
    for axes in grid[:, 0]:
        axes.set_ylabel("us a step, median")
    figure.suptitle(f"{scene}: time against error. Numbers: substeps, iterations or resting penetration. Dotted: how well the exact motion is known", fontsize=8)
    figure.legend(labels.values(), labels.keys(), loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=7, frameon=False)
    save(figure, path)


def draw_growth(rows, path):
    """A panel for each part of the scene: the time of a body over the number of bodies."""
    parts = {"falling": [row for row in rows if row["scene"].endswith("-falling")],
             "in a heap, after 4 s": [row for row in rows if not row["scene"].endswith("-falling")]}
    figure, grid = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained", sharey=True)
    for axes, (part, of_part) in zip(grid, parts.items()):
        for name in COLOURS:
            for ground in dict.fromkeys(row["ground"] for row in of_part):
                line = sorted((row["bodies"], 1e3 * row["us_median"] / row["bodies"]) for row in of_part
                              if name_of(row) == name and row["ground"] == ground)
                if line:
                    axes.plot(*zip(*line), color=COLOURS[name], marker="o", markersize=3.5, linewidth=0.8, alpha=SHADES[ground], label=name)
        axes.set_xscale("log")
        sizes = sorted({row["bodies"] for row in of_part})
        axes.set_xticks(sizes, [f"{size:,}" for size in sizes], fontsize=7)
        axes.minorticks_off()
        axes.set_title(part)
        axes.set_xlabel("bodies")
        axes.grid(True, linewidth=0.2)
    grid[0].set_ylim(bottom=0)  # of both, once all is drawn
    grid[0].set_ylabel("ns a body and step, median")
    grid[1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=7, frameon=False)
    save(figure, path)


def draw_world(rows, folder):
    if "substeps" in rows[0]:
        for scene in dict.fromkeys(row["scene"] for row in rows):
            draw_study(scene, [row for row in rows if row["scene"] == scene], folder / f"world-study-{scene}.svg")
    elif not rows[0]["measures"]:
        draw_growth(rows, folder / "world-growth.svg")
    else:
        draw_scenes(rows, folder / "world.svg")
