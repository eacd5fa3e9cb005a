#!/usr/bin/python3
"""Heaps of a lifted tube that others have simulated, set by set, with ours. The table has the columns sliding_friction,
rolling_friction, restitution, angle_deg, angle_sd_deg; it is not part of this repository (docs/verification.md). A heap
takes half a core minute. Exit status 0 where the rms of the difference is at most 1.2 deg.

The test: 4000 spheres at random in a cylinder, thrown down at 0.3 m/s into a tube of radius 40 mm on a floor; 0.4 s; the
tube rises by 55 mm at 10 mm/s; 0.4 s.

The angle, as they measure it, of the grains that move at less than 10 mm/s:
1. rings one median diameter wide round the grains' centre of mass. A ring's height is its highest top with three more
   within 1.5 diameters below it; rings of less than four grains do not count;
2. a line through the rings between 0.2 and 0.8 of the highest, without those beyond 2.5 sd in a second pass; where the
   highest is below four diameters, through those between 0.2 and 0.8 of the heap's radius;
3. three times, a line through all tops within 0.75 diameters of the line and the same window.
"""
import math
import statistics
import sys

import wheat

COLUMN, COLUMN_SD, UNIT = "angle_deg", "angle_sd_deg", "deg"
MOST_RMS = 1.2  # [deg]
AIM = f"rms {MOST_RMS} {UNIT}"
NUM_GRAINS = 4000
START = wheat.Region(radius=0.0375, low=0.003, high=0.085)
TUBE_RADIUS, TUBE_LENGTH = 0.040, 0.1  # [m]
SETTLING, LIFT, LIFT_VELOCITY, REST = 0.4, 0.055, 0.01, 0.4  # [s], [m], [m/s], [s]
SIDE = 0.13  # of the walls far away [m]


def scene(row, law, step, seed):
    lifted = SETTLING + LIFT / LIFT_VELOCITY
    side = [{"name": f"side{k}", "shape": "plane", "position": [SIDE * s if k < 2 else 0, 0 if k < 2 else SIDE * s, 0],
             "direction": [-s if k < 2 else 0, 0 if k < 2 else -s, 0]} for k, s in enumerate((-1, 1, -1, 1))]
    return {
        "materials": [wheat.material(row)],
        "models": {"rolling": law},
        "spheres": wheat.spheres(wheat.place(NUM_GRAINS, START, seed)),
        "walls": [{"name": "floor", "shape": "plane"}, *side,
                  {"name": "tube", "shape": "open_cylinder", "diameter": 2 * TUBE_RADIUS, "length": TUBE_LENGTH,
                   "motion": [{"time": SETTLING, "velocity": [0, 0, LIFT_VELOCITY]},
                              {"time": lifted, "velocity": [0, 0, 0]}]}],
        "rayleigh_fraction": step,
        "stop": {"time": lifted + REST},
        "outputs": {"vtp": False},
    }


def measure(folder):
    """[deg]"""
    return angle_of(wheat.read_grains(folder / "final.csv", fastest=0.01))


def angle_of(grains):
    """[deg]"""
    diameter = wheat.median_diameter(grains)
    mass = sum(g.r**3 for g in grains)
    x, y = (sum(g[k] * g.r**3 for g in grains) / mass for k in (0, 1))
    points = [(math.hypot(g.x - x, g.y - y), g.z + g.r) for g in grains]
    rings = wheat.surface(points, diameter)
    peak = max(z for _, z in rings)
    base = statistics.quantiles([r for r, _ in rings], n=20, method="inclusive")[-1]
    if peak < 4 * diameter:
        def within(_, r): return 0.2 * base <= r <= 0.8 * base
        fit = wheat.trimmed_line([p for p in rings if within(None, p[0])])
    else:
        fit = wheat.trimmed_line([p for p in rings if 0.2 * peak <= p[1] <= 0.8 * peak])
        low = 0.2 * max(peak, fit[1])

        def within(fit, r): return low <= wheat.height_at(fit, r) <= 0.8 * peak
    slope = wheat.shell_line(fit, points, diameter, within)[0]
    return math.degrees(math.atan(-slope))


def report(theirs, ours):
    return wheat.rms_report(theirs, ours, MOST_RMS, UNIT)


if __name__ == "__main__":
    sys.exit(wheat.main(sys.modules[__name__]))
