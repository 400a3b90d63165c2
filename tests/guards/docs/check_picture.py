#!/usr/bin/env python3
"""The picture of the billiards match shows what its recording holds.

usage: check_picture.py BILLIARDS DETENT FOLDER SHOWN

Runs the program BILLIARDS, which writes a recording and a picture into FOLDER, and asks the tool DETENT for the bodies at some
ticks. The balls that the picture shows at these times must lie where the bodies do, to half a pixel. SHOWN, the picture that
documents show, must be of the same match.
"""
import bisect
import json
import math
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

SVG = "{http://www.w3.org/2000/svg}"
BALLS = 16
LEAD = 1.0  # s, before the match starts
PIXEL = 1 / 0.3  # mm
TICKS = [0, 150, 1000, 2200, 2400, 9000, 19130, 19132, 24000]  # before and after each ball that is pocketed, too
BYTES_MAX = 300000


def value_at(animation, seconds):
    """The numbers of an animated attribute at this time."""
    times = [float(time) for time in animation.get("keyTimes").split(";")]
    values = [[float(number) for number in value.split()] for value in animation.get("values").split(";")]
    if len(times) != len(values) or times != sorted(times) or times[0] != 0 or times[-1] != 1:
        sys.exit("key times do not fit the values: " + animation.get("keyTimes"))
    time = seconds / float(animation.get("dur").rstrip("s"))
    after = min(bisect.bisect_right(times, time + 1e-5), len(times) - 1)
    before = after - 1
    if animation.get("calcMode") == "discrete" or times[after] == times[before]:
        return values[before]
    part = min(max((time - times[before]) / (times[after] - times[before]), 0), 1)
    return [a + part * (b - a) for a, b in zip(values[before], values[after])]


def animation_of(group, attribute):
    return next((child for child in group if child.get("attributeName") == attribute), None)


def shown(groups, tick):
    """The places of the balls that are seen at this tick, mm, by number."""
    seconds = LEAD + tick * 0.001
    places = {}
    for number, group in enumerate(groups):
        opacity = animation_of(group, "opacity")
        if opacity is None or value_at(opacity, seconds)[0] > 0:
            places[number] = value_at(animation_of(group, "transform"), seconds)
    return places


def main():
    billiards, detent, folder, shown_picture = sys.argv[1:]
    recording, picture = folder + "/match.detent", folder + "/match.svg"
    subprocess.run([billiards, "--out", recording, "--plot", picture], check=True, stdout=subprocess.DEVNULL)

    with open(picture, "rb") as file:
        content = file.read()
    root = ElementTree.fromstring(content)
    faults = []
    if len(content) > BYTES_MAX:
        faults.append("the file has %d bytes" % len(content))
    for element in root.iter():
        if element.tag == SVG + "script" or not element.get("href", "#").startswith("#"):
            faults.append("not self-contained: " + element.tag)
    groups = [root.find(".//*[@id='ball-%d']" % number) for number in range(BALLS)]
    if None in groups:
        sys.exit("no ball " + str(groups.index(None)))

    for tick in TICKS:
        state = json.loads(subprocess.check_output([detent, "state", recording, "--tick", str(tick), "--json"]))
        places = shown(groups, tick)
        bodies = [body["position"] for body in state["bodies"] if body["type"] == "dynamic"]
        if len(bodies) != len(places):
            faults.append("tick %d: %d balls, %d are shown" % (tick, len(bodies), len(places)))
        for x, _, z in bodies:
            error = min(math.hypot(x * 1000 - place[0], z * 1000 - place[1]) for place in places.values())
            if error > PIXEL / 2:
                faults.append("tick %d: no ball is shown within %.2f mm of (%.4f, %.4f) m" % (tick, error, x, z))

    if state["digest"] not in content.decode():
        faults.append("the picture does not say the final digest " + state["digest"])
    with open(shown_picture, encoding="utf-8") as file:
        if state["config"] == "fx64" and state["digest"] not in file.read():
            faults.append("renew it: billiards --plot " + shown_picture)
    sys.exit("\n".join(faults) or 0)


main()
