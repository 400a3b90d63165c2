"""Draws the rows of `./bench world --json`: times of the scenes, and of a study time against error."""
import matplotlib.pyplot as plt

COLOURS = {"fx64": "tab:blue", "f32": "tab:olive", "f64": "tab:green", "fx32": "tab:cyan", "bullet double": "tab:red",
           "bullet float": "tab:orange", "ode double": "tab:purple"}
MARKERS = {0: "*", 1: "o", 2: "s", 4: "^"}
ERRORS = {"penetration_mean": "mean penetration of overlapping pairs, m", "drift": "greatest drift, m",
          "stretch_max": "stretch at most, of the length", "stretch_late": "stretch late, of the length",
          "energy": "energy gained or lost, J/kg", "speed_mean": "mean speed, m/s"}
FLOOR = 1e-7  # smaller errors are drawn here


def name_of(row):
    return row["config"] if row["engine"] == "detent" else f'{row["engine"]} {row["config"]}'


def draw_scenes(rows, path):
    """A panel for each scene: bars of the median, whiskers up to the 99th percentile."""
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    columns = min(3, len(scenes))
    figure, grid = plt.subplots(-(-len(scenes) // columns), columns, squeeze=False, layout="constrained",
                                figsize=(3.4 * columns, 2.9 * -(-len(scenes) // columns)))
    for axes in grid.flat[len(scenes):]:
        axes.set_visible(False)
    for axes, scene in zip(grid.flat, scenes):
        of_scene = [row for row in rows if row["scene"] == scene]
        bars = [row for name in COLOURS for row in of_scene if name_of(row) == name]
        reference = next((row["us_median"] for row in bars if name_of(row) == "bullet double"), None)
        top = max(row["us_p99"] for row in bars)
        logarithmic = top > 50 * min(row["us_median"] for row in bars)
        for x, row in enumerate(bars):
            median = row["us_median"]
            axes.bar(x, median, color=COLOURS[name_of(row)], width=0.8)
            axes.errorbar(x, median, yerr=[[0], [row["us_p99"] - median]], color="black", linewidth=0.7, capsize=2)
            text = f'{median:.3g}' if median < 1000 else f'{median:.0f}'
            if reference:
                ratio = median / reference
                text += f'\n{ratio:.2f}x' if ratio >= 0.01 else f'\n1/{1 / ratio:.0f}'
            axes.annotate(text, (x, row["us_p99"]), (0, 2), textcoords="offset points", ha="center", va="bottom", fontsize=6)
        if reference:
            axes.axhline(reference, color=COLOURS["bullet double"], linewidth=0.6, linestyle="--")
        if logarithmic:
            axes.set_yscale("log")
        axes.set_ylim(top=top * (20 if logarithmic else 1.2))
        axes.set_xticks(range(len(bars)), [name_of(row).replace(" ", "\n") for row in bars], fontsize=6)
        axes.set_title(scene, fontsize=8)
        axes.grid(True, axis="y", linewidth=0.2)
        axes.set_axisbelow(True)
    for axes in grid[:, 0]:
        axes.set_ylabel("us a step: median, up to p99")
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)


def draw_study(scene, rows, path):
    """A panel for each error: a line for each configuration and number of iterations, over the substeps."""
    errors = [error for error in ERRORS if all(error in row["measures"] for row in rows)]
    figure, grid = plt.subplots(2, 2, figsize=(11, 8), layout="constrained", sharey=True)
    for axes in grid.flat[len(errors):]:
        axes.set_visible(False)
    labels = {}
    for axes, error in zip(grid.flat, errors):
        lines = {}
        for row in rows:
            peer = row["engine"] != "detent"
            default = row["substeps"] == 0 and row["iterations"] == 0
            key = (name_of(row), "default" if default else "over iterations" if peer else row["iterations"])
            lines.setdefault(key, []).append(row)
        for (name, effort), points in lines.items():
            points.sort(key=lambda row: (row["substeps"], row["iterations"]))
            x = [max(abs(row["measures"][error]), FLOOR) for row in points]
            y = [row["us_median"] for row in points]
            label = f"{name}, {effort}" + ("" if isinstance(effort, str) else f' iteration{"s" if effort > 1 else ""}')
            marker = "*" if effort == "default" else MARKERS.get(effort, "x")
            line, = axes.plot(x, y, color=COLOURS.get(name, "black"), marker=marker, linewidth=0.7,
                              markersize=11 if effort == "default" else 4, label=label,
                              markeredgecolor="black" if effort == "default" else None, markeredgewidth=0.5,
                              zorder=3 if effort == "default" else 2)
            labels.setdefault(label, line)
            if name == "fx64" and effort == 1 or effort == "over iterations":
                for row, at in zip(points, zip(x, y)):
                    axes.annotate(str(row["substeps"] or row["iterations"]), at, (3, 3), textcoords="offset points",
                                  fontsize=6, color=COLOURS.get(name, "black"))
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel(ERRORS[error])
        axes.grid(True, which="both", linewidth=0.2)
    for axes in grid[:, 0]:
        axes.set_ylabel("us a step, median")
    figure.suptitle(f"{scene}: time against error. Numbers: substeps (fx64, 1 iteration), of peers iterations")
    figure.legend(labels.values(), labels.keys(), loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=7, frameon=False)
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)


def draw_world(rows, folder):
    if "substeps" not in rows[0]:
        draw_scenes(rows, folder / "world.svg")
        return
    for scene in dict.fromkeys(row["scene"] for row in rows):
        draw_study(scene, [row for row in rows if row["scene"] == scene], folder / f"world-study-{scene}.svg")
