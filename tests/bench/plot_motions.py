"""Draws the rows of `./bench motions --json`: how far motions are apart, over the turn of the step."""
import matplotlib.pyplot as plt

# Name, lever or None for all alike, label, colour, dashes.
DISTANCES = [("screw", 10, "screw, its axis 10 radii away", "tab:red", "-"),
             ("screw", 1, "screw, 1 radius away", "tab:orange", "-"),
             ("tangent", 10, "tangent's screw, 10 radii away", "tab:red", ":"),
             ("tangent", 1, "tangent's screw, 1 radius away", "tab:orange", ":"),
             ("tangent", 0, "tangent's screw through the centre", "tab:purple", ":"),
             ("nlerp", 0, "nlerp, any lever", "tab:blue", "-"),
             ("2 pieces", 1, "2 pieces from the screw, 1 radius away", "tab:green", "--"),
             ("4 pieces", 1, "4 pieces", "tab:olive", "--"),
             ("8 pieces", 1, "8 pieces", "tab:cyan", "--")]
ANGLES = [("tangent", 0, "tangent's screw", "tab:purple", ":"), ("nlerp", 0, "nlerp", "tab:blue", "-")]


def draw_lines(axes, rows, lines, value):
    for motion, lever, label, colour, style in lines:
        points = [row for row in rows if row["motion"] == motion and row["lever"] == lever]
        axes.plot([row["rotation_vector"] for row in points], [row[value] for row in points], label=label, color=colour,
                  linestyle=style, linewidth=1.2)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("turn in the step, rad")
    axes.grid(True, which="major", linewidth=0.3)
    axes.legend(fontsize=6.5, frameon=False, loc="upper left")


def draw_motions(rows, path):
    figure, (distance, angle) = plt.subplots(1, 2, figsize=(10, 5), layout="constrained")
    draw_lines(distance, rows, DISTANCES, "distance")
    distance.set_ylabel("greatest distance of a point of the body, radii")
    distance.set_ylim(1e-9, 1e3)
    draw_lines(angle, rows, ANGLES, "angle")
    angle.set_ylabel("greatest angle, rad")
    angle.set_ylim(1e-9, 1e3)
    angle.set_title("The screw and its pieces turn like the step", fontsize=8)
    figure.suptitle("Between the same two poses, from the motion of the step (pieces: from the screw)")
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)
