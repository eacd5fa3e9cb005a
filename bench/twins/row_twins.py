#!/usr/bin/python3
"""row_twins.py TALUS FOLDER: do two campaigns in a row find what one campaign of both tests finds?

FOLDER is that of dem_twins.py. For each of its powders the campaign with the heap alone comes first; the second has the
wide plate alone, with the first one's posterior as prior and the rest of the joint campaign's budget. It is compared with
the campaign of both tests. One line a powder: the distance of the two recommended sets in half ranges of the joint
campaign, the larger one of the parameters, the volume of the joint 90 % region over the joint campaign's, and the
credible level of the truth.
"""
import argparse
import json
import math
import pathlib
import random

from twin import credible_level, run

NEAR = 1  # half ranges: half of a range
FACTOR = 1.5


def second(options, twin):
    """The wide plate alone, after the heap."""
    spec = json.loads((twin / "both.json").read_text())
    first = json.loads((twin / "heap.json").read_text())
    spec["experiments"] = spec["experiments"][1:]
    spec["parameters"]["prior"] = {"from": "heap"}
    if "simulations" in spec["budget"]:
        spec["budget"]["simulations"] -= first["budget"]["simulations"]
    (twin / "second.json").write_text(json.dumps(spec))
    if not (twin / "second" / "result.json").exists():
        run(options.talus, "calibrate", twin / "second.json", "--out", twin / "second", "--quiet")
    return json.loads((twin / "second" / "result.json").read_text())


def compare(options, twin, truth):
    there = second(options, twin)
    joint = json.loads((twin / "both" / "result.json").read_text())
    apart = max(abs(p["value"] - q["value"]) / ((q["credible_90_high"] - q["credible_90_low"]) / 2)
                for p, q in zip(there["parameters"], joint["parameters"]))
    volume = there["posterior"]["region_90_volume_fraction"] / joint["posterior"]["region_90_volume_fraction"]
    level = credible_level(options.talus, twin / "second", truth)
    print(f"{twin.name}: {apart:.2f} half ranges apart, volume {volume:.2f} of the joint one, "
          f"truth at {level:.3f}", flush=True)
    return apart, volume, level


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("talus")
    parser.add_argument("folder", type=pathlib.Path)
    options = parser.parse_args()
    rows = []
    for twin in sorted(options.folder.glob("twin??*")):
        if not (twin / "both" / "result.json").exists():
            continue
        draw = random.Random(int(twin.name.removeprefix("twin")))  # as dem_twins.py draws it
        ranges = json.loads((twin / "both.json").read_text())["parameters"]
        truth = {k: draw.uniform(r["min"], r["max"]) for k, r in ranges.items()}
        rows.append(compare(options, twin, truth))
    near = sum(apart <= NEAR for apart, _, _ in rows)
    alike = sum(1 / FACTOR <= volume <= FACTOR for _, volume, _ in rows)
    mean = math.exp(sum(math.log(volume) for _, volume, _ in rows) / len(rows))
    print(f"{len(rows)} powders: within half of a range in {near}, volume within a factor {FACTOR} in {alike}, its "
          f"geometric mean {mean:.2f}, truth inside in {sum(level <= 0.9 for _, _, level in rows)}")


main()
