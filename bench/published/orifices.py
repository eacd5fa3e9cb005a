#!/usr/bin/python3
"""Rates of flow through an orifice that others have simulated, set by set, with ours. The table has the columns
sliding_friction, rolling_friction, restitution, flow_g_per_s, flow_sd_g_per_s; it is not part of this repository
(docs/verification.md). A set takes two thirds of a core minute. Exit status 0 where every rate is within 5 %.

The test: 4000 spheres at random in a tube of radius 40 mm, thrown down at 0.3 m/s onto a floor with a hole of radius
11 mm, under a plug of radius 13.5 mm; after 0.4 s the plug moves down at 0.5 m/s for 0.09 s; 1.4 s from its start. Their
tube and hole are polygons of 48 corners.

The rate, as they measure it, is the slope of a line through the mass that has passed 30 mm below the floor, every 8 ms,
between 0.2 and 0.8 of its last value. Some 40 % of the grains pass in this time.
"""
import math
import statistics
import sys

import wheat

COLUMN, COLUMN_SD, UNIT = "flow_g_per_s", "flow_sd_g_per_s", "g/s"
MOST_OFF = 0.05  # of theirs
AIM = f"{100 * MOST_OFF:.0f} % each"
NUM_GRAINS = 4000
START = wheat.Region(radius=0.0375, low=0.004, high=0.085)
# Circles of the polygons' areas.
ROUND = math.sqrt(48 / (2 * math.pi) * math.sin(2 * math.pi / 48))
TUBE_RADIUS, TUBE_BASE, TUBE_LENGTH, HOLE = 0.040 * ROUND, 0.0005, 0.1, 0.011 * ROUND  # [m]
FLOOR_RADIUS, PLUG_RADIUS, PLUG_HEIGHT, COUNTED = 0.046, 0.0135, 0.0008, -0.03  # [m]
SETTLING, OPENING, FLOW, EVERY = 0.4, 0.09, 1.4, 8e-3  # [s]
PLUG_SPEED = 0.5  # [m/s]


def scene(row, law, step, seed):
    return {
        "materials": [wheat.material(row)],
        "models": {"rolling": law},
        "spheres": wheat.spheres(wheat.place(NUM_GRAINS, START, seed)),
        "walls": [{"name": "floor", "shape": "annulus", "diameter": 2 * FLOOR_RADIUS, "inner_diameter": 2 * HOLE},
                  {"name": "tube", "shape": "open_cylinder", "position": [0, 0, TUBE_BASE],
                   "diameter": 2 * TUBE_RADIUS, "length": TUBE_LENGTH},
                  {"name": "plug", "shape": "disc", "position": [0, 0, PLUG_HEIGHT], "diameter": 2 * PLUG_RADIUS,
                   "motion": [{"time": SETTLING, "velocity": [0, 0, -PLUG_SPEED]},
                              {"time": SETTLING + OPENING, "velocity": [0, 0, 0]}]}],
        "domain": {"low": [-0.05, -0.05, COUNTED], "high": [0.05, 0.05, 0.2]},
        "rayleigh_fraction": step,
        "stop": {"time": SETTLING + FLOW},
        "outputs": {"vtp": False, "interval": EVERY,
                    "sections": [{"name": "passed", "position": [0, 0, COUNTED], "direction": [0, 0, -1]}]},
    }


def measure(folder):
    """[g/s]"""
    flow = [(row["time_s"], 1e3 * row["passed_kg"]) for row in wheat.read_table(folder / "series.csv")]
    last = flow[-1][1]
    return wheat.line([p for p in flow if 0.2 * last <= p[1] <= 0.8 * last])[0]


def report(theirs, ours):
    shares = [a / b - 1 for a, b in zip(ours, theirs)]
    largest = max(shares, key=abs)
    return (f"mean {100 * statistics.fmean(shares):+.1f} %, largest {100 * largest:+.1f} % over {len(shares)} sets",
            abs(largest) <= MOST_OFF)


if __name__ == "__main__":
    sys.exit(wheat.main(sys.modules[__name__], seeds=6))
