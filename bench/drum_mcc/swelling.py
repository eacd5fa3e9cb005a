#!/usr/bin/python3
"""swelling.py DRUM_RESIDUAL PHOTOS CAMPAIGN: what moves the drum's surface at each speed, over a campaign's trials at true
grain size.

Of each trial the area that the simulation covers beyond the photograph, less what it leaves uncovered [mm^2], by `drum_residual`; and
for each speed the plane through these over the parameters, by least squares. Where all parameters move both speeds alike, no set meets
both. Trials whose surface is more than 120 mm^2 off are left out, as a plane does not reach so far.
"""
import argparse
import json
import math
import pathlib
import re
import subprocess

import numpy

FAR = 120  # [mm^2]
SPEEDS = {"15 rpm": "gd_15rpm.png", "45 rpm": "gd_45rpm.png"}


def surplus(drum_residual, photo, trial):
    """Powder of the simulation alone, less that of the photograph alone [mm^2]."""
    told = subprocess.run([drum_residual, photo, trial], check=True, capture_output=True, text=True).stdout
    _, photograph, simulation = map(float, re.findall(r"(\d+\.\d+)", told))
    return simulation - photograph


# What a unit of the plane is, in words and as a coordinate.
UNITS = {"sliding_friction": ("+10 %", lambda v: math.log(v) / math.log(1.1)),
         "rolling_friction": ("+10 %", lambda v: math.log(v) / math.log(1.1)),
         "restitution": ("+0.1", lambda v: v / 0.1),
         "plate_pair_sliding_friction": ("+0.1", lambda v: v / 0.1),
         "fill": ("+0.01", lambda v: v / 0.01)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drum_residual", metavar="DRUM_RESIDUAL")
    parser.add_argument("photos", metavar="PHOTOS", type=pathlib.Path)
    parser.add_argument("campaign", metavar="CAMPAIGN", type=pathlib.Path)
    asked = parser.parse_args()
    campaign = asked.campaign
    searched = [p["name"] for p in json.loads((campaign / "campaign.json").read_text())["parameters"]]
    names = [name for name in searched if name in UNITS]
    trials = {speed: [] for speed in SPEEDS}
    for place in sorted((campaign / "trials").glob("*/trial.json")):
        trial = json.loads(place.read_text())
        if trial["scale_factor"] != 1 or trial["status"] != "ok":
            continue
        speed = list(SPEEDS)[trial["experiment"]]
        at = [UNITS[name][1](value) for name, value in zip(searched, trial["values"]) if name in UNITS]
        trials[speed].append((surplus(asked.drum_residual, asked.photos / SPEEDS[speed], place.parent), at))
    for speed, all_of_it in trials.items():
        near = [t for t in all_of_it if abs(t[0]) < FAR]
        plane = numpy.array([[1] + at for _, at in near])
        middle = plane.mean(axis=0)
        plane[:, 1:] -= middle[1:]
        values = numpy.array([v for v, _ in near])
        fit, *_ = numpy.linalg.lstsq(plane, values, rcond=None)
        rms = math.sqrt(((values - plane @ fit) ** 2).sum() / max(1, len(near) - len(fit)))
        print(f"{speed}: {len(near)} of {len(all_of_it)} true drums, in their middle {fit[0]:+.1f} mm^2, scatter {rms:.1f}")
        for name, slope in zip(names, fit[1:]):
            print(f"  {name} {UNITS[name][0]}: {slope:+.1f} mm^2")


if __name__ == "__main__":
    main()
